// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lastStep.H"
#include "caseFiles.H"

namespace
{
using namespace Foam;

//- Dictionary <time>/uniform/<name>, empty if there is none
dictionary dictionaryOf(const Time& time, const word& name)
{
    const auto dict = stateOfTime(time, name);
    return dict ? dictionary(*dict) : dictionary();
}
} // namespace

Foam::word Foam::stepEntry(const Time& time)
{
    const bool adjusted =
        time.controlDict().getOrDefault<bool>("adjustTimeStep", false);
    return adjusted ? "maxDeltaT" : "deltaT";
}

Foam::label Foam::stepIndex(const Time& time)
{
    return time.subCycling() ? time.prevTimeState().timeIndex()
                             : time.timeIndex();
}

Foam::lastStep::lastStep(const Time& time)
    : stateObject<IOdictionary>("lastStep", "uniform", time,
                                [this](Ostream& os)
                                {
                                    os.precision(17);
                                    os.writeEntry("deltaT",
                                                  this->time().deltaTValue());
                                    writeDivision(os);
                                    if (diverged_.empty()) return;
                                    os.writeEntry("diverged", diverged_);
                                })
{
    const dictionary last(dictionaryOf(time, "lastStep"));
    last.readIfPresent("subSteps", division_.subSteps);
    last.readIfPresent("lastSubSteps", division_.lastSubSteps);
    last.readIfPresent("nGood", division_.nGood);
    last.readIfPresent("nGoodWanted", division_.nGoodWanted);
    last.readIfPresent("maxDeltaT", division_.maxDeltaT);
    last.readIfPresent("nUnchecked", division_.nUnchecked);
}

void Foam::lastStep::writeDivision(Ostream& os) const
{
    if (division_.nGoodWanted == division().nGoodWanted) return;
    os.writeEntry("subSteps", division_.subSteps);
    os.writeEntry("lastSubSteps", division_.lastSubSteps);
    os.writeEntry("nGood", division_.nGood);
    os.writeEntry("nGoodWanted", division_.nGoodWanted);
    os.writeEntry("maxDeltaT", division_.maxDeltaT);
    os.writeEntry("nUnchecked", division_.nUnchecked);
}

Foam::scalar Foam::lastStep::read(const Time& time)
{
    const auto deltaT = [&](const word& name)
    { return dictionaryOf(time, name).getOrDefault<scalar>("deltaT", 0); };
    const scalar rounded = deltaT("time"), exact = deltaT("lastStep");

    // lastStep is out of date if another solver has written this time since: then the two
    // steps differ by more than the rounding of uniform/time
    return mag(exact - rounded) < 1e-3 * rounded ? exact : rounded;
}

Foam::scalar Foam::lastStep::readSubStep(const Time& time)
{
    return read(time) / dictionaryOf(time, "lastStep")
                            .getOrDefault<label>("lastSubSteps", 1);
}

Foam::scalar Foam::lastStep::subStep(const Time& time)
{
    const auto* step = time.findObject<lastStep>("lastStep");
    const label parts =
        step && !time.subCycling() ? step->division_.lastSubSteps : 1;
    return time.deltaTValue() / parts;
}

void Foam::lastStep::refuseDiverged(const Time& time)
{
    const dictionary last(dictionaryOf(time, "lastStep"));
    const string why(last.getOrDefault<string>("diverged", ""));
    const scalar deltaT = read(time);
    const bool byOther =
        deltaT > 0 && deltaT != last.getOrDefault("deltaT", 0.0);
    if (why.empty() || byOther) return;
    FatalErrorInFunction
        << "time " << time.timeName() << " was written because the run diverged"
        << " there: " << why.c_str() << nl
        << "    allowed: an earlier time to start from (startTime in "
        << "system/controlDict, or delete the folder "
        << time.timePath().c_str() << "), with a smaller " << stepEntry(time)
        << exit(FatalError);
}

void Foam::lastStep::writeBeforeStop(const Time& time, const string& diverged)
{
    Info << "Writing the state before the stop" << endl;
    lastStep* step = time.getObjectPtr<lastStep>("lastStep");
    if (step) step->diverged_ = diverged;

    // Time::writeNow() would delete earlier times if purgeWrite is set
    time.writeTimeDict();
    for (const word& name : time.sortedToc())
    {
        const auto& object = time.lookupObject<regIOobject>(name);
        if (object.writeOpt() != IOobject::NO_WRITE) object.write();
    }
}
