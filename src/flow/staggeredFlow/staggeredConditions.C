// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Which meshes and boundary conditions the algorithm can run

#include "staggeredFlow.H"
#include "dictionaryChecks.H"

namespace
{
using namespace Foam;

//- Velocities of walls that are functions of place and time, and those whose code
//  may look at the fields. Others that fix a value may follow the flow
const wordList ofTime({"fixedValue", "noSlip", "uniformFixedValue",
                       "movingWallVelocity", "translatingWallVelocity",
                       "rotatingWallVelocity", "timeVaryingMappedFixedValue"});
const wordList coded({"codedFixedValue", "exprFixedValue"});

//- A jump across a periodic side, for one, is a type of its own
const wordList ofCyclic({"cyclic", "processor", "processorCyclic"});

//- A sentence where a condition is of a type that is not known
template<class Condition>
string unknown(const Condition& f, const wordList& ofWalls, const string& known)
{
    if ((f.coupled() ? ofCyclic : ofWalls).found(f.type())) return string::null;
    return "of conditions for " + known + "; it is " + f.type() + " on patch " +
           f.patch().name();
}
} // namespace

Foam::string Foam::staggeredFlow::unsupported(const volVectorField& U,
                                              const volScalarField& p)
{
    const uniformGrid& grid = uniformGrid::New(U.mesh());
    if (!grid.valid()) return "the mesh is no uniform box: " + grid.reason();

    for (direction d = 0; d < 3; ++d)
    {
        if (grid.n()[d] < 3)
        {
            return "there are fewer than three cells in direction " +
                   string(vector::componentNames[d]);
        }
    }

    wordList ofWalls(ofTime);
    ofWalls.append(coded);
    string reason;
    forAll(U.boundaryField(), patchi)
    {
        if (reason.empty())
            reason = unknown(U.boundaryField()[patchi], ofWalls,
                             "U it knows cyclic and fixed velocities of walls");
        if (reason.empty())
            reason = unknown(p.boundaryField()[patchi], {"zeroGradient"},
                             "p it knows cyclic and zeroGradient");
    }
    reason = firstOf(reason);
    if (!reason.empty()) return reason;

    // What the file says of conditions that compute their values may be old
    volVectorField now(U);
    for (fvPatchVectorField& Ub : now.boundaryFieldRef())
    {
        if (!Ub.coupled()) Ub.evaluate();
    }
    wallVelocities unused;
    return readWalls(now, unused);
}

bool Foam::staggeredFlow::lookAtFields(const volVectorField& U)
{
    bool any = false;
    for (const fvPatchVectorField& Ub : U.boundaryField())
    {
        any = any || (!Ub.coupled() && !ofTime.found(Ub.type()));
    }
    return returnReduce(any, orOp<bool>());
}

void Foam::staggeredFlow::requireBlocks(const fvMesh& mesh,
                                        const dictionary& controls)
{
    const uniformGrid& grid = uniformGrid::New(mesh);
    const bool whole = grid.index().size() == grid.box().count();
    if (returnReduce(whole && grid.index().size(), andOp<bool>())) return;

    firstRankSpeaks();
    FatalIOErrorInFunction(controls)
        << "only the decomposition keeps this case from the flow algorithm "
        << "staggered: the cells of a rank must be one rectangular block" << nl
        << "    either write method uniformBoxes; in system/decomposeParDict, "
        << "libs (deformableBodies); in system/controlDict, and run "
        << "decomposePar -force" << nl
        << "    or write PIMPLE { flowAlgorithm pimple; } in "
        << "system/fvSolution, which is far slower" << exit(FatalIOError);
}

// Least and largest velocity of all faces of each side, on all ranks
Foam::string Foam::staggeredFlow::readWalls(const volVectorField& U,
                                            wallVelocities& walls)
{
    const uniformGrid& grid = uniformGrid::New(U.mesh());
    const FixedList<vector, 2> great(vector::rootMax), low(vector::rootMin);
    wallVelocities least(great), largest(low);
    for (const fvPatchVectorField& Ub : U.boundaryField())
    {
        if (Ub.coupled()) continue;
        forAll(Ub, i)
        {
            const label facei = Ub.patch().start() + i;
            const direction d = grid.faceDirection(facei);
            const label side = grid.lowerSide(facei) ? 0 : 1;
            least[d][side] = min(least[d][side], Ub[i]);
            largest[d][side] = max(largest[d][side], Ub[i]);
        }
    }
    for (direction d = 0; d < 3; ++d)
    {
        walls[d] = vector::zero;
        for (label side = 0; side < 2 && !grid.periodic(d); ++side)
        {
            const vector lo(returnReduce(least[d][side], minOp<vector>()));
            const vector hi(returnReduce(largest[d][side], maxOp<vector>()));
            const scalar tolerance = VSMALL + 1e-8 * max(mag(lo), mag(hi));
            walls[d][side] = hi;
            const char* wrong =
                hi.x() < lo.x() ? "there is no velocity"
                : mag(hi - lo) > tolerance
                    ? "the velocity of a wall must be uniform, and it is not"
                : mag(hi[d]) > tolerance
                    ? "the velocity of a wall must be tangential, and it is not"
                    : nullptr;
            if (!wrong) continue;
            return wrong + string(side ? " on the upper" : " on the lower") +
                   " side in " + vector::componentNames[d];
        }
    }
    return string::null;
}
