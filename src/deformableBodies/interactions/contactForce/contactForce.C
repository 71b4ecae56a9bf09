// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactForce.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(contactForce, 0);
defineRunTimeSelectionTable(contactForce, dictionary);
} // namespace Foam

bool Foam::contactForce::known(const word& name)
{
    return dictionaryConstructorTablePtr_->found(name);
}

Foam::autoPtr<Foam::contactForce>
Foam::contactForce::New(const word& name, const dictionary& interactions,
                        const interactionScene& scene)
{
    return dictionaryConstructorTablePtr_->cfind(name)()(
        readDict(interactions, name, "range 1e-6;"), scene);
}
