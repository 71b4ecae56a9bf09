// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "markerSet.H"

Foam::markerSet::markerSet(const uniformGrid& grid, const deltaKernel& kernel,
                           blockNeighbours& neighbours)
    : grid_(grid),
      kernel_(kernel),
      copies_(neighbours, label(kernel.reach() + 1))
{
}

void Foam::markerSet::place(const vectorField& X)
{
    copies_.place(X);
    makeStencils();
}

void Foam::markerSet::interpolate(const List<staggeredView>& u,
                                  vectorField& U) const
{
    U.setSize(size());
    if (!Pstream::parRun())
    {
        gather(u, U);
        return;
    }
    scalarField here(3 * X().size());
    UList<vector> there(reinterpret_cast<vector*>(here.data()), X().size());
    gather(u, there);
    U = Zero;
    copies_.addUp(here, 3, reinterpret_cast<scalar*>(U.data()));
}

void Foam::markerSet::spread(const vectorField& F,
                             const staggeredTarget& f) const
{
    if (!Pstream::parRun())
    {
        scatter(F, f);
        return;
    }
    scalarField here(
        copies_.handOut(reinterpret_cast<const scalar*>(F.cdata()), 3));
    scatter(UList<vector>(reinterpret_cast<vector*>(here.data()), X().size()),
            f);
}
