// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactResistance.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(contactResistance, 0);
defineRunTimeSelectionTable(contactResistance, dictionary);
} // namespace Foam

bool Foam::contactResistance::known(const word& name)
{
    return dictionaryConstructorTablePtr_->found(name);
}

Foam::autoPtr<Foam::contactResistance>
Foam::contactResistance::New(const word& name, const dictionary& interactions,
                             const interactionScene& scene)
{
    return dictionaryConstructorTablePtr_->cfind(name)()(
        readDict(interactions, name, "range 1e-6;"), scene);
}
