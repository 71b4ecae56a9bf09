// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lastStep.H"
#include "caseFiles.H"
#include "IOdictionary.H"
#include "Time.H"

Foam::lastStep::lastStep(const Time& time)
    : regIOobject(IOobject("lastStep", time.timeName(), "uniform", time,
                           IOobject::NO_READ, IOobject::AUTO_WRITE))
{
}

const Foam::word& Foam::lastStep::type() const
{
    return IOdictionary::typeName;
}

bool Foam::lastStep::writeData(Ostream& os) const
{
    const int precision = os.precision(17);
    os.writeEntry("deltaT", time().deltaTValue());
    os.precision(precision);
    return os.good();
}

Foam::scalar Foam::lastStep::read(const Time& time)
{
    const auto deltaT = [&](const word& name)
    {
        const IOobject io(name, time.timeName(), "uniform", time,
                          IOobject::MUST_READ, IOobject::NO_WRITE, false);
        return isThere<IOdictionary>(io)
                   ? IOdictionary(io).getOrDefault<scalar>("deltaT", 0)
                   : scalar(0);
    };
    const scalar rounded = deltaT("time"), exact = deltaT("lastStep");

    // Another solver may have gone on from there and left the one behind
    return mag(exact - rounded) < 1e-3 * rounded ? exact : rounded;
}
