// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pointPair.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "ListOps.H"

namespace Foam
{
defineTypeNameAndDebug(pointPair, 0);
addToRunTimeSelectionTable(bodyForce, pointPair, dictionary);
} // namespace Foam

Foam::pointPair::pointPair(const dictionary& dict, const bodyPoints& body)
    : bodyForce(dict.get<word>("group")),
      force_(Function1<scalar>::New("force", dict)),
      direction_(dict.getOrDefault<vector>("direction", vector(1, 0, 0))),
      share_(body.positions.size(), Zero)
{
    needSurface(dict, body);
    checkEntries(
        dict, withCoeffs(dict, {"type", "group", "force", "direction", "patch"},
                         {"force"}));
    if (!(mag(direction_) > 0))
    {
        refuse(dict, "direction", "(0 0 0)", "a direction");
    }
    direction_ /= mag(direction_);
    const scalar patch = dict.getOrDefault<scalar>("patch", 0.05);
    if (!(patch > 0 && patch <= 0.5))
    {
        refuse(dict, "patch", Foam::name(patch), "above 0, up to 0.5");
    }

    // Points are taken from either end inwards until the patch has its area
    const scalarField along(body.positions & direction_);
    const scalarField area(mag(body.areas));
    const labelList order(sortedOrder(along));
    const scalar wanted = patch * sum(area);
    for (const bool far : {false, true})
    {
        scalar left = wanted;
        for (label i = 0; i < order.size() && left > 0; ++i)
        {
            const label k = order[far ? order.size() - 1 - i : i];
            const scalar part = min(area[k], left);
            share_[k] += (far ? 1 : -1) * part / wanted;
            left -= part;
        }
    }
}

void Foam::pointPair::add(const bodyPoints&, const scalar time,
                          vectorField& F) const
{
    F += share_ * (force_->value(time) * direction_);
}
