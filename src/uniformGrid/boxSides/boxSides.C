// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "boxSides.H"
#include "dictionaryChecks.H"
#include "fixedValueFvPatchFields.H"
#include "noSlipFvPatchVectorField.H"
#include "volFields.H"
#include "wallPolyPatch.H"

Foam::FixedList<Foam::FixedList<Foam::boxSide, 2>, 3>
Foam::boxSides(const uniformGrid& grid)
{
    const fvMesh& mesh = grid.mesh();
    const volVectorField* U = mesh.foundObject<volVectorField>("U")
                                  ? &mesh.lookupObject<volVectorField>("U")
                                  : nullptr;
    FixedList<FixedList<boxSide, 2>, 3> sides;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.coupled()) continue;
        const bool isWall = isA<wallPolyPatch>(patch),
                   closed =
                       isWall &&
                       (!U || U->boundaryField()[patch.index()].fixesValue());
        FixedList<labelVector, 2> at(labelVector::zero);
        forAll(patch, i)
        {
            const label facei = patch.start() + i;
            at[!grid.lowerSide(facei)][grid.faceDirection(facei)] = 1;
        }
        for (label s = 0; s < 2; ++s)
        {
            reduce(at[s], maxOp<labelVector>());
            for (direction d = 0; d < 3; ++d)
            {
                if (!at[s][d]) continue;
                boxSide& side = sides[d][s];
                side.closed = closed && (side.closed || side.patches.empty());
                side.wall = side.wall || isWall;
                side.patches +=
                    (side.patches.empty() ? "" : ", ") + patch.name();
            }
        }
    }
    return sides;
}

void Foam::requireWalls(const uniformGrid& grid, const bool all)
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
        const bool ofWall =
            ofWalls.found(Ub.type()) || (all && Ub.fixesValue());
        if (!ofWall || through > 1e-9 * gMax(mag(Ub))) continue;
        waitForMaster();
        FatalErrorInFunction
            << "patch " << patch.name() << " of type " << patch.type()
            << " has the velocity of a wall (" << Ub.type()
            << ", along it): bodies would pass through it" << nl
            << "    allowed: type wall; in system/blockMeshDict, or in "
            << "constant/polyMesh/boundary" << exit(FatalError);
    }
}
