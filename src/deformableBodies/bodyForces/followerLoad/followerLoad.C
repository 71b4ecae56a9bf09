// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "followerLoad.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(followerLoad, 0);
addToRunTimeSelectionTable(bodyForce, followerLoad, dictionary);
} // namespace Foam

Foam::followerLoad::followerLoad(const dictionary& dict, const bodyPoints& body)
    : bodyForce(dict.get<word>("group")),
      force_(Function1<scalar>::New("force", dict)),
      at_(dict, body)
{
    needLine(dict, body);
    checkEntries(dict,
                 withCoeffs(dict, {"type", "group", "force", "at"}, {"force"}));
}

void Foam::followerLoad::add(const bodyPoints& body, const scalar time,
                             vectorField& F) const
{
    const vectorField& X = body.positions;
    const label last = X.size() - 1;
    const scalarField share(at_.shares(body.lengths));
    const scalar force = force_->value(time);
    forAll(X, i)
    {
        if (share[i] == 0) continue;
        const vector t(X[min(i + 1, last)] - X[max(i - 1, label(0))]);
        F[i] += share[i] * force / mag(t) * t;
    }
}
