// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pointCopies.H"
#include <type_traits>

namespace
{
using namespace Foam;

const scalar* numbers(const UList<vector>& v)
{
    return reinterpret_cast<const scalar*>(v.cdata());
}

//- Call act(n), with n as a compile-time constant if it is 3
template<class Act>
void ofNumbers(const label n, Act act)
{
    if (n == 3)
        act(std::integral_constant<label, 3>());
    else
        act(n);
}
} // namespace

void Foam::pointCopies::route(const UList<vector>& X, const label margin)
{
    nOwn_ = X.size();
    if (!Pstream::parRun())
    {
        X_.shallowCopy(X);
        return;
    }

    // Most points are far from other ranks and need no search
    const boundBox inner(neighbours_.near(margin).alone);
    DynamicList<label> outer;
    DynamicList<vector> outerPoints;
    forAll(X, k)
    {
        if (inner.contains(X[k])) continue;
        outer.append(k);
        outerPoints.append(X[k]);
    }
    const List<labelVector> cells(neighbours_.cover(outerPoints, margin));
    const blockNeighbours::table& reached = neighbours_.near(margin);
    const label nRanks = neighbours_.ranks().size();
    to_.setSize(nRanks);
    for (DynamicList<label>& k : to_)
    {
        k.clear();
    }
    label next = 0;
    const auto keepUpTo = [&](const label end)
    {
        for (; next < end; ++next)
        {
            to_[neighbours_.me()].append(next);
        }
        ++next;
    };
    forAll(outer, i)
    {
        keepUpTo(outer[i]);
        neighbours_.each(reached, cells[i],
                         [&](const label r) { to_[r].append(outer[i]); });
    }
    keepUpTo(X.size());
    labelList sizes(nRanks);
    forAll(to_, i)
    {
        sizes[i] = to_[i].size();
    }
    sizes = neighbours_.sizes(sizes);
    first_.setSize(nRanks + 1);
    first_[0] = 0;
    forAll(sizes, i)
    {
        first_[i + 1] = first_[i] + sizes[i];
    }
    copies_.setSize(first_.last());
    handOut(numbers(X), 3, reinterpret_cast<scalar*>(copies_.data()));
    X_.shallowCopy(copies_);
}

bool Foam::pointCopies::holds(const label k) const
{
    return !Pstream::parRun() || neighbours_.holder(X_[k]) == neighbours_.me();
}

Foam::blockNeighbours::values Foam::pointCopies::parts(scalar* local,
                                                       const label n) const
{
    blockNeighbours::values all;
    forAll(to_, i)
    {
        all.emplace_back(local + n * first_[i],
                         n * (first_[i + 1] - first_[i]));
    }
    return all;
}

void Foam::pointCopies::handOut(const scalar* own, const label n,
                                scalar* local) const
{
    blockNeighbours::values in(parts(local, n)), out;
    List<scalarField> sent(to_.size());
    forAll(to_, i)
    {
        const bool toSelf = i == neighbours_.me();
        if (!toSelf) sent[i].setSize(n * to_[i].size());
        out.push_back(toSelf ? in[i] : sent[i]);
        scalar* value = out[i].data();
        ofNumbers(n,
                  [&](const auto n)
                  {
                      for (const label k : to_[i])
                          for (label c = 0; c < n; ++c)
                              *value++ = own[n * k + c];
                  });
    }
    neighbours_.exchange(out, in);
}

Foam::scalarField Foam::pointCopies::handOut(const scalar* own,
                                             const label n) const
{
    if (!Pstream::parRun())
    {
        return scalarField(UList<scalar>(const_cast<scalar*>(own), n * nOwn_));
    }
    scalarField local(n * first_.last());
    handOut(own, n, local.data());
    return local;
}

void Foam::pointCopies::addUp(const scalarField& local, const label n,
                              scalar* own) const
{
    if (!Pstream::parRun())
    {
        for (label k = 0; k < n * nOwn_; ++k)
        {
            own[k] += local[k];
        }
        return;
    }
    const blockNeighbours::values out(
        parts(const_cast<scalar*>(local.cdata()), n));
    blockNeighbours::values in;
    List<scalarField> received(to_.size());
    forAll(to_, i)
    {
        const bool toSelf = i == neighbours_.me();
        if (!toSelf) received[i].setSize(n * to_[i].size());
        in.push_back(toSelf ? out[i] : received[i]);
    }
    neighbours_.exchange(out, in);
    forAll(to_, i)
    {
        const scalar* part = in[i].cdata();
        ofNumbers(n,
                  [&](const auto n)
                  {
                      for (const label k : to_[i])
                          for (label c = 0; c < n; ++c)
                              own[n * k + c] += *part++;
                  });
    }
}
