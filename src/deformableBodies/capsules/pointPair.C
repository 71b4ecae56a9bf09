// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pointPair.H"
#include "dictionaryChecks.H"
#include "ListOps.H"

Foam::pointPair::pointPair(const dictionary& dict, const vectorField& X,
                           const scalarField& area)
    : force_(Function1<scalar>::New("force", dict)),
      direction_(dict.getOrDefault<vector>("direction", vector(1, 0, 0))),
      share_(X.size(), Zero)
{
    checkEntries(dict, {"type", "group", "force", "direction", "patch"});
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

    // Inwards from either end until the patch is full
    const scalarField along(X & direction_);
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

void Foam::pointPair::add(vector* F, const scalar time) const
{
    const vector force(force_->value(time) * direction_);
    forAll(share_, k)
    {
        F[k] += share_[k] * force;
    }
}
