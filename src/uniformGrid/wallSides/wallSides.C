// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "wallSides.H"
#include "volFields.H"
#include "wallPolyPatch.H"

Foam::FixedList<Foam::FixedList<bool, 2>, 3>
Foam::wallSides(const uniformGrid& grid)
{
    const fvMesh& mesh = grid.mesh();
    const volVectorField* U = mesh.foundObject<volVectorField>("U")
                                  ? &mesh.lookupObject<volVectorField>("U")
                                  : nullptr;
    FixedList<labelVector, 2> walls(labelVector::zero),
        others(labelVector::zero);
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.coupled()) continue;
        const bool isWall =
            isA<wallPolyPatch>(patch) &&
            (!U || U->boundaryField()[patch.index()].fixesValue());
        forAll(patch, i)
        {
            const label facei = patch.start() + i;
            (isWall ? walls : others)[!grid.lowerSide(facei)]
                                     [grid.faceDirection(facei)] = 1;
        }
    }
    FixedList<FixedList<bool, 2>, 3> sides(FixedList<bool, 2>(false));
    for (label side = 0; side < 2; ++side)
    {
        reduce(walls[side], maxOp<labelVector>());
        reduce(others[side], maxOp<labelVector>());
        for (direction d = 0; d < 3; ++d)
        {
            sides[d][side] = walls[side][d] && !others[side][d];
        }
    }
    return sides;
}
