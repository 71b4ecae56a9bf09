// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "markerSet.H"

Foam::markerSet::markerSet(const uniformGrid& grid, const deltaKernel& kernel,
                           blockNeighbours& neighbours)
    : grid_(grid),
      kernel_(kernel),
      copies_(neighbours)
{
}

void Foam::markerSet::place(const vectorField& X)
{
    copies_.place(X, label(kernel_.reach() + 1));
    sort();
}

void Foam::markerSet::interpolate(const List<staggeredView>& u,
                                  vectorField& U) const
{
    scatterThenGather(vectorField(), {}, u, U);
}

void Foam::markerSet::spread(const vectorField& F,
                             const staggeredTarget& f) const
{
    vectorField none;
    scatterThenGather(F, {f}, {}, none);
}

void Foam::markerSet::spreadAndInterpolate(const vectorField& F,
                                           const staggeredTarget& f,
                                           const List<staggeredView>& u,
                                           vectorField& U) const
{
    scatterThenGather(F, {f}, u, U);
}

// From and to the ranks that own the markers
void Foam::markerSet::scatterThenGather(const vectorField& F,
                                        const List<staggeredTarget>& f,
                                        const List<staggeredView>& u,
                                        vectorField& U) const
{
    if (u.size()) U.setSize(size());
    if (!Pstream::parRun())
    {
        sweep(F, f, u, U);
        return;
    }
    const auto numbers = [](const UList<vector>& v)
    { return reinterpret_cast<const scalar*>(v.cdata()); };
    scalarField forces, values(u.size() ? 3 * X().size() : 0);
    if (f.size()) forces = copies_.handOut(numbers(F), 3);
    const label n = X().size();
    const UList<vector> forcesHere(reinterpret_cast<vector*>(forces.data()),
                                   f.size() ? n : 0);
    UList<vector> valuesHere(reinterpret_cast<vector*>(values.data()),
                             u.size() ? n : 0);
    sweep(forcesHere, f, u, valuesHere);
    if (u.empty()) return;
    U = Zero;
    copies_.addUp(values, 3, reinterpret_cast<scalar*>(U.data()));
}
