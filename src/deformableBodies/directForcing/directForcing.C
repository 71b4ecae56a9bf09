// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "directForcing.H"

Foam::vectorField
Foam::directForcing::forcedMarkers::takeVelocity(const vector* now,
                                                 const bool firstStep)
{
    vectorField difference(U.size(), Zero);
    forAll(U, k)
    {
        if (!firstStep) difference[k] = now[k] - U[k];
        U[k] = now[k];
    }
    return difference;
}

Foam::scalar Foam::directForcing::freeVelocities(label, const vector*,
                                                 const scalar*, const bodyStep&,
                                                 vectorField&) const
{
    NotImplemented;
    return 0;
}

void Foam::directForcing::loads(vector* X, vector* F, scalar) const
{
    forAll(mine(), i)
    {
        const forcedMarkers& m = forced(i);
        X = std::copy(m.X.begin(), m.X.end(), X);
        F = std::copy(m.forces.begin(), m.forces.end(), F);
    }
}
