// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "deadLoad.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(deadLoad, 0);
addToRunTimeSelectionTable(bodyForce, deadLoad, dictionary);
} // namespace Foam

Foam::deadLoad::deadLoad(const dictionary& dict, const bodyPoints& body)
    : bodyForce(dict.get<word>("group")),
      force_(Function1<vector>::New("force", dict)),
      at_(dict, body)
{
    needLine(dict, body);
    checkEntries(dict,
                 withCoeffs(dict, {"type", "group", "force", "at"}, {"force"}));
}

void Foam::deadLoad::add(const bodyPoints& body, const scalar time,
                         vectorField& F) const
{
    F += at_.shares(body.lengths) * force_->value(time);
}
