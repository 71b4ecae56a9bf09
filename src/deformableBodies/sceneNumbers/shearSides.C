// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "shearSides.H"
#include "uniformGrid.H"
#include "volFields.H"

namespace
{
//- Velocities of sides that do not change in time: the mesh does not move
const Foam::wordList atRest({"fixedValue", "noSlip", "movingWallVelocity"});
} // namespace

Foam::sideVelocities::sideVelocities(const volVectorField& U,
                                     const uniformGrid& grid, const direction d)
    : lower(Zero),
      upper(Zero),
      fixed(true),
      steady(true)
{
    scalar area[2] = {0, 0};
    for (const fvPatchVectorField& side : U.boundaryField())
    {
        if (side.patch().coupled()) continue;
        const scalarField& magSf = side.patch().magSf();
        const bool fixesValue = side.fixesValue(),
                   rests = atRest.found(side.type());
        forAll(side, i)
        {
            const label facei = side.patch().start() + i;
            if (grid.faceDirection(facei) != d) continue;
            const bool isLower = grid.lowerSide(facei);
            (isLower ? lower : upper) += magSf[i] * side[i];
            area[isLower] += magSf[i];
            fixed = fixed && fixesValue;
            steady = steady && rests;
        }
    }
    reduce(lower, sumOp<vector>());
    reduce(upper, sumOp<vector>());
    lower /= returnReduce(area[1], sumOp<scalar>()) + VSMALL;
    upper /= returnReduce(area[0], sumOp<scalar>()) + VSMALL;
    reduce(fixed, andOp<bool>());
    reduce(steady, andOp<bool>());
}

Foam::shearSides Foam::shearSides::of(const fvMesh& mesh)
{
    shearSides all;
    if (!mesh.foundObject<volVectorField>("U")) return all;
    const auto& U = mesh.lookupObject<volVectorField>("U");
    const uniformGrid& grid = uniformGrid::New(mesh);
    for (direction d = 0; d < 3; ++d)
    {
        if (grid.periodic(d)) continue;
        const sideVelocities sides(U, grid, d);
        if (!sides.fixed) continue;
        if (all.rate == 0 && all.steady && !sides.steady) all.gradient = d;
        all.steady = all.steady && sides.steady;
        vector across(sides.upper - sides.lower);
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
        all.lower = sides.lower;
        all.upper = sides.upper;
        all.rate = rate;
        const scalar whole = mag(across);
        across[f] = 0;
        all.oblique = mag(across) / whole;
    }
    return all;
}
