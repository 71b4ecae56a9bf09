// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "markerSet.H"
#include <algorithm>

namespace
{
using namespace Foam;

scalar* numbers(vectorField& v)
{
    return reinterpret_cast<scalar*>(v.data());
}

const scalar* numbers(const vectorField& v)
{
    return reinterpret_cast<const scalar*>(v.cdata());
}
} // namespace

Foam::markerSet::markerSet(const uniformGrid& grid, const deltaKernel& kernel,
                           blockNeighbours& neighbours)
    : grid_(grid),
      kernel_(kernel),
      neighbours_(neighbours)
{
}

void Foam::markerSet::place(const vectorField& X)
{
    nOwn_ = X.size();
    if (!Pstream::parRun())
    {
        X_ = X;
        makeStencils();
        return;
    }

    neighbours_.cover(X, margin());
    const blockNeighbours::table& reached = neighbours_.near(margin());
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
    forAll(in, i)
    {
        std::copy(in[i].begin(), in[i].end(), numbers(X_) + 3 * first_[i]);
    }
    makeStencils();
}

Foam::List<Foam::scalarField> Foam::markerSet::pack(const scalar* own,
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

Foam::scalarField Foam::markerSet::handOut(const scalar* own,
                                           const label n) const
{
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

void Foam::markerSet::addUp(const scalarField& here, const label n,
                            scalar* own) const
{
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

void Foam::markerSet::interpolate(const List<staggeredView>& u,
                                  vectorField& U) const
{
    U.setSize(nOwn_);
    if (!Pstream::parRun())
    {
        gather(u, U);
        return;
    }
    scalarField here(3 * X_.size());
    UList<vector> there(reinterpret_cast<vector*>(here.data()), X_.size());
    gather(u, there);
    U = Zero;
    addUp(here, 3, numbers(U));
}

void Foam::markerSet::spread(const vectorField& F, staggeredField& f) const
{
    if (!Pstream::parRun())
    {
        scatter(F, f);
        return;
    }
    scalarField here(handOut(numbers(F), 3));
    scatter(UList<vector>(reinterpret_cast<vector*>(here.data()), X_.size()),
            f);
}
