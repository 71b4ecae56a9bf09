// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "wallSides.H"
#include "dictionaryChecks.H"
#include "fixedValueFvPatchFields.H"
#include "noSlipFvPatchVectorField.H"
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

void Foam::requireWalls(const uniformGrid& grid)
{
    const auto* U = grid.mesh().findObject<volVectorField>("U");
    if (!U) return;
    for (const fvPatchVectorField& Ub : U->boundaryField())
    {
        const polyPatch& patch = Ub.patch().patch();
        if (patch.coupled() || isA<wallPolyPatch>(patch) ||
            returnReduce(patch.size(), sumOp<label>()) == 0)
            continue;
        const wordList ofWalls({noSlipFvPatchVectorField::typeName,
                                fixedValueFvPatchVectorField::typeName});
        const scalar through = gMax(mag(Ub & Ub.patch().nf()));
        if (!ofWalls.found(Ub.type()) || through > 1e-9 * gMax(mag(Ub)))
            continue;
        waitForMaster();
        FatalErrorInFunction
            << "patch " << patch.name() << " of type " << patch.type()
            << " has the velocity of a wall (" << Ub.type()
            << ", along it): bodies would pass through it" << nl
            << "    allowed: type wall; in system/blockMeshDict, or in "
            << "constant/polyMesh/boundary" << exit(FatalError);
    }
}
