// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Which meshes and boundary conditions the algorithm can run

#include "staggeredFlow.H"
#include "dictionaryChecks.H"
#include "fixedValueFvPatchFields.H"
#include "zeroGradientFvPatchFields.H"

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

string unknownU(const fvPatchVectorField& Ub)
{
    const bool known = Ub.coupled()
                           ? ofCyclic.found(Ub.type())
                           : ofTime.found(Ub.type()) || coded.found(Ub.type());
    if (known) return string::null;
    return "of conditions for U it knows cyclic and fixed velocities of walls; "
           "it is " +
           Ub.type() + " on patch " + Ub.patch().name();
}

string unknownP(const fvPatchScalarField& pb)
{
    const bool known =
        pb.coupled() ? ofCyclic.found(pb.type())
                     : pb.type() == zeroGradientFvPatchScalarField::typeName;
    if (known) return string::null;
    return "of conditions for p it knows cyclic and zeroGradient; it is " +
           pb.type() + " on patch " + pb.patch().name();
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

    string reason;
    forAll(U.boundaryField(), patchi)
    {
        if (reason.empty()) reason = unknownU(U.boundaryField()[patchi]);
        if (reason.empty()) reason = unknownP(p.boundaryField()[patchi]);
    }
    reason = firstOf(reason);
    if (!reason.empty()) return reason;

    // What the file says of conditions that compute their values may be old
    volVectorField now(IOobject("wallVelocity", U.instance(), U.mesh(),
                                IOobject::NO_READ, IOobject::NO_WRITE, false),
                       U);
    for (fvPatchVectorField& Ub : now.boundaryFieldRef())
    {
        if (!Ub.coupled()) Ub.evaluate();
    }
    wallVelocities unused;
    return readWalls(now, unused);
}

bool Foam::staggeredFlow::wallsLookAtFields() const
{
    bool any = false;
    for (const fvPatchVectorField& Ub : U_.boundaryField())
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
        << "    either write method uniformBoxes; in system/decomposeParDict "
        << "and run decomposePar -force" << nl
        << "    or write PIMPLE { flowAlgorithm pimple; } in "
        << "system/fvSolution, which is far slower" << exit(FatalIOError);
}

// Least and largest velocity of all faces of each side, on all ranks
Foam::string Foam::staggeredFlow::readWalls(const volVectorField& U,
                                            wallVelocities& walls)
{
    const uniformGrid& grid = uniformGrid::New(U.mesh());
    const FixedList<vector, 2> great(vector::max), minusGreat(vector::min);
    wallVelocities least(great), largest(minusGreat);
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
        for (label side = 0; side < 2; ++side)
        {
            const vector lo(returnReduce(least[d][side], minOp<vector>()));
            const vector hi(returnReduce(largest[d][side], maxOp<vector>()));
            if (grid.periodic(d))
            {
                walls[d][side] = Zero;
                continue;
            }
            walls[d][side] = hi;
            const string where =
                string(side ? " on the upper" : " on the lower") + " side in " +
                vector::componentNames[d];
            if (hi.x() < lo.x())
            {
                return "there is no velocity" + where;
            }
            const scalar tolerance = VSMALL + 1e-8 * max(mag(lo), mag(hi));
            if (mag(hi - lo) > tolerance)
            {
                return "the velocity of a wall must be uniform, and it is not" +
                       where;
            }
            if (mag(hi[d]) > tolerance)
            {
                return "the velocity of a wall must be tangential, and it is "
                       "not" +
                       where;
            }
        }
    }
    return string::null;
}
