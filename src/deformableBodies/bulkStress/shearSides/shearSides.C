// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "shearSides.H"
#include "uniformGrid.H"
#include "volFields.H"

namespace
{
using namespace Foam;

//- Mean velocity of the sides across a direction, the lower and the upper one; 0 of both
//  where a side does not fix it (collective)
FixedList<vector, 2> velocities(const volVectorField& U,
                                const uniformGrid& grid, const direction d)
{
    FixedList<vector, 2> sum(vector::zero);
    scalar area[2] = {0, 0};
    bool fixed = true;
    for (const fvPatchVectorField& side : U.boundaryField())
    {
        if (side.patch().coupled()) continue;
        const scalarField& magSf = side.patch().magSf();
        forAll(side, i)
        {
            const label facei = side.patch().start() + i;
            if (grid.faceDirection(facei) != d) continue;
            const bool upper = !grid.lowerSide(facei);
            fixed = fixed && side.fixesValue();
            sum[upper] += magSf[i] * side[i];
            area[upper] += magSf[i];
        }
    }
    for (label upper = 0; upper < 2; ++upper)
    {
        reduce(sum[upper], sumOp<vector>());
        reduce(area[upper], sumOp<scalar>());
        sum[upper] /= area[upper] + VSMALL;
    }
    if (!returnReduce(fixed, andOp<bool>())) sum = vector::zero;
    return sum;
}
} // namespace

Foam::shearSides Foam::shearSides::of(const fvMesh& mesh)
{
    shearSides all;
    if (!mesh.foundObject<volVectorField>("U")) return all;
    const auto& U = mesh.lookupObject<volVectorField>("U");
    const uniformGrid& grid = uniformGrid::New(mesh);
    for (direction d = 0; d < 3; ++d)
    {
        if (grid.periodic(d)) continue;
        const FixedList<vector, 2> sides(velocities(U, grid, d));
        vector across(sides[1] - sides[0]);
        across[d] = 0;
        direction f = d == 0 ? 1 : 0;
        for (direction e = 0; e < 3; ++e)
        {
            if (mag(across[e]) > mag(across[f])) f = e;
        }
        const scalar rate = across[f] / grid.length()[d];
        if (mag(rate) <= mag(all.rate)) continue;
        all.gradient = d;
        all.flow = f;
        all.lower = sides[0];
        all.upper = sides[1];
        all.rate = rate;
        const scalar whole = mag(across);
        across[f] = 0;
        all.oblique = mag(across) / whole;
    }
    return all;
}
