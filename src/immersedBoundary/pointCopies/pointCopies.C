// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pointCopies.H"

namespace
{
using namespace Foam;

const scalar* numbers(const UList<vector>& v)
{
    return reinterpret_cast<const scalar*>(v.cdata());
}
} // namespace

void Foam::pointCopies::place(const UList<vector>& X, const label margin)
{
    nOwn_ = X.size();
    if (!Pstream::parRun())
    {
        X_ = X;
        return;
    }

    neighbours_.cover(X, margin);
    const blockNeighbours::table& reached = neighbours_.near(margin);
    const label nRanks = neighbours_.ranks().size();
    List<DynamicList<label>> to(nRanks);
    forAll(X, k)
    {
        neighbours_.each(reached, X[k],
                         [&](const label i) { to[i].append(k); });
    }
    to_.setSize(nRanks);
    forAll(to, i)
    {
        to_[i].transfer(to[i]);
    }

    List<scalarField> out(pack(numbers(X), 3)), in;
    neighbours_.exchange(out, in, false);
    in[neighbours_.me()].transfer(out[neighbours_.me()]);
    first_.setSize(nRanks + 1);
    first_[0] = 0;
    forAll(in, i)
    {
        first_[i + 1] = first_[i] + in[i].size() / 3;
    }
    X_.setSize(first_.last());
    scalar* const x = reinterpret_cast<scalar*>(X_.data());
    forAll(in, i)
    {
        std::copy(in[i].begin(), in[i].end(), x + 3 * first_[i]);
    }
}

bool Foam::pointCopies::holds(const label k) const
{
    return !Pstream::parRun() || neighbours_.holder(X_[k]) == neighbours_.me();
}

Foam::List<Foam::scalarField> Foam::pointCopies::pack(const scalar* own,
                                                      const label n) const
{
    List<scalarField> out(to_.size());
    forAll(to_, i)
    {
        out[i].setSize(n * to_[i].size());
        scalar* at = out[i].data();
        for (const label k : to_[i])
        {
            at = std::copy_n(own + n * k, n, at);
        }
    }
    return out;
}

Foam::scalarField Foam::pointCopies::handOut(const scalar* own,
                                             const label n) const
{
    if (!Pstream::parRun())
    {
        return scalarField(UList<scalar>(const_cast<scalar*>(own), n * nOwn_));
    }
    List<scalarField> out(pack(own, n)), in(to_.size());
    forAll(in, i)
    {
        in[i].setSize(n * (first_[i + 1] - first_[i]));
    }
    neighbours_.exchange(out, in, true);
    in[neighbours_.me()].transfer(out[neighbours_.me()]);

    scalarField here(n * first_.last());
    forAll(in, i)
    {
        std::copy(in[i].begin(), in[i].end(), here.begin() + n * first_[i]);
    }
    return here;
}

void Foam::pointCopies::addUp(const scalarField& here, const label n,
                              scalar* own) const
{
    if (!Pstream::parRun())
    {
        for (label k = 0; k < n * nOwn_; ++k)
        {
            own[k] += here[k];
        }
        return;
    }
    List<scalarField> out(to_.size()), in(to_.size());
    forAll(to_, i)
    {
        in[i].setSize(n * to_[i].size());
        out[i] = SubField<scalar>(here, n * (first_[i + 1] - first_[i]),
                                  n * first_[i]);
    }
    neighbours_.exchange(out, in, true);
    in[neighbours_.me()].transfer(out[neighbours_.me()]);
    forAll(to_, i)
    {
        const scalar* part = in[i].cdata();
        for (const label k : to_[i])
        {
            for (label c = 0; c < n; ++c)
            {
                own[n * k + c] += *part++;
            }
        }
    }
}
