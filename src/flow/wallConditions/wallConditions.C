// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "wallConditions.H"
#include "dictionaryChecks.H"
#include "fixedValueFvPatchFields.H"

namespace
{
using namespace Foam;

//- Velocities of walls that are functions of position and time
const wordList givenTypes({"fixedValue", "noSlip", "uniformFixedValue",
                           "movingWallVelocity", "translatingWallVelocity",
                           "rotatingWallVelocity",
                           "timeVaryingMappedFixedValue"});

//- Conditions whose code may read the fields. Others that fix a value may follow the
//  flow
const wordList codedTypes({"codedFixedValue", "exprFixedValue"});

//- Types of periodic sides without a jump
const wordList cyclicTypes({"cyclic", "processor", "processorCyclic"});

//- One sentence on a condition of an unsupported type; empty if it is supported
template<class Condition>
string unknown(const Condition& f, const wordList& wallTypes,
               const string& supported)
{
    if ((f.coupled() ? cyclicTypes : wallTypes).found(f.type()))
    {
        return string::null;
    }
    return "of conditions for " + supported + "; it is " + f.type() +
           " on patch " + f.patch().name();
}
} // namespace

Foam::wallConditions::wallConditions(volVectorField& U,
                                     const dictionary& controls)
    : U_(U),
      controls_(controls)
{
    for (const fvPatchVectorField& Ub : U.boundaryField())
    {
        if (Ub.coupled()) continue;
        change_ =
            change_ || Ub.type() != fixedValueFvPatchVectorField::typeName;
        readFields_ = readFields_ || !givenTypes.found(Ub.type());
    }
    reduce(change_, orOp<bool>());
    reduce(readFields_, orOp<bool>());
    read(U, now_);
}

Foam::string Foam::wallConditions::unsupported(const volVectorField& U,
                                               const volScalarField& p)
{
    wordList wallTypes(givenTypes);
    wallTypes.append(codedTypes);
    string reason;
    forAll(U.boundaryField(), patchi)
    {
        if (reason.empty())
            reason = unknown(U.boundaryField()[patchi], wallTypes,
                             "U it knows cyclic and fixed velocities of walls");
        if (reason.empty())
            reason = unknown(p.boundaryField()[patchi], {"zeroGradient"},
                             "p it knows cyclic and zeroGradient");
    }
    reason = firstOf(reason);
    if (!reason.empty()) return reason;

    // Values in the file may be old where a condition computes them
    volVectorField now(U);
    for (fvPatchVectorField& Ub : now.boundaryFieldRef())
    {
        if (!Ub.coupled()) Ub.evaluate();
    }
    wallVelocities unused;
    return read(now, unused);
}

void Foam::wallConditions::begin()
{
    start_ = now_;
    end_ = now_;
    if (!change_) return;

    for (fvPatchVectorField& Ub : U_.boundaryFieldRef())
    {
        if (!Ub.coupled()) Ub.evaluate();
    }
    const string reason(read(U_, end_));
    if (reason.empty()) return;
    waitForMaster();
    FatalIOErrorInFunction(controls_)
        << "flowAlgorithm staggered cannot go on at time "
        << U_.time().timeName() << ": " << reason.c_str()
        << "; use flowAlgorithm pimple" << exit(FatalIOError);
}

Foam::wallVelocities Foam::wallConditions::advance(const scalar fraction)
{
    wallVelocities change;
    for (direction d = 0; d < 3; ++d)
    {
        for (label side = 0; side < 2; ++side)
        {
            const vector next((1 - fraction) * start_[d][side] +
                              fraction * end_[d][side]);
            change[d][side] = next - now_[d][side];
            now_[d][side] = next;
        }
    }
    return change;
}

// Compares the least and the largest velocity of the faces of each side, on all ranks
Foam::string Foam::wallConditions::read(const volVectorField& U,
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
