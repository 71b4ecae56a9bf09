// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lastStep.H"
#include "caseFiles.H"

namespace
{
using namespace Foam;

//- A file of uniform/, or nothing
dictionary dictionaryOf(const Time& time, const word& name)
{
    const auto dict = stateOfTime(time, name);
    return dict ? dictionary(*dict) : dictionary();
}
} // namespace

Foam::lastStep::lastStep(const Time& time)
    : writtenObject<IOdictionary>("lastStep", "uniform", time,
                                  [this](Ostream& os)
                                  {
                                      os.precision(17);
                                      os.writeEntry("deltaT",
                                                    this->time().deltaTValue());
                                      if (diverged_.empty()) return;
                                      os.writeEntry("diverged", diverged_);
                                  })
{
}

Foam::scalar Foam::lastStep::read(const Time& time)
{
    const auto deltaT = [&](const word& name)
    { return dictionaryOf(time, name).getOrDefault<scalar>("deltaT", 0); };
    const scalar rounded = deltaT("time"), exact = deltaT("lastStep");

    // Another solver may have gone on from there and left the one behind
    return mag(exact - rounded) < 1e-3 * rounded ? exact : rounded;
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
        << time.timePath().c_str() << "), with a smaller deltaT"
        << exit(FatalError);
}

void Foam::lastStep::writeBeforeStop(const Time& time, const string& diverged)
{
    Info << "Writing the state before the stop" << endl;
    lastStep* step = time.getObjectPtr<lastStep>("lastStep");
    if (step) step->diverged_ = diverged;

    // Time::writeNow() would purge earlier times
    time.writeTimeDict();
    for (const word& name : time.sortedToc())
    {
        const auto& object = time.lookupObject<regIOobject>(name);
        if (object.writeOpt() != IOobject::NO_WRITE) object.write();
    }
}
