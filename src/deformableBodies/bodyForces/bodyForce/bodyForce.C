// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyForce.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(bodyForce, 0);
defineRunTimeSelectionTable(bodyForce, dictionary);
} // namespace Foam

Foam::autoPtr<Foam::bodyForce> Foam::bodyForce::New(const dictionary& dict,
                                                    const bodyPoints& body)
{
    const word type(dict.get<word>("type"));
    auto cstr = dictionaryConstructorTablePtr_->cfind(type);
    if (!cstr.found())
    {
        refuse(dict, "type", type,
               oneOf(dictionaryConstructorTablePtr_->sortedToc()));
    }
    return cstr()(dict, body);
}

void Foam::bodyForce::needSurface(const dictionary& dict,
                                  const bodyPoints& body)
{
    if (body.isSurface() && body.volume == 0) return;
    refuse(dict, "type", dict.get<word>("type"),
           body.isSurface()
               ? "gravity and prescribed velocities of rigid bodies"
               : "(deadLoad followerLoad) on filaments");
}

void Foam::bodyForce::needLine(const dictionary& dict, const bodyPoints& body)
{
    if (!body.isSurface()) return;
    refuse(dict, "type", dict.get<word>("type"),
           body.volume > 0 ? "gravity and prescribed velocities of rigid bodies"
                           : "(pointPair) on capsules");
}
