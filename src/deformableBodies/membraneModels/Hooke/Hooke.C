// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "Hooke.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

namespace Foam
{
namespace membraneModels
{
defineTypeNameAndDebug(Hooke, 0);
addToRunTimeSelectionTable(membraneModel, Hooke, dictionary);
} // namespace membraneModels
} // namespace Foam

Foam::membraneModels::Hooke::Hooke(const dictionary& dict)
    : Gs_(readPositive(dict, "Gs", dimForce / dimLength)),
      ratio_(0)
{
    checkEntries(dict, {"law", "Gs", "nu"});
    requireEntry(dict, "nu");
    const scalar nu = dict.get<scalar>("nu");
    if (!(nu > -1 && nu < 1))
    {
        refuse(dict, "nu", Foam::name(nu), "between -1 and 1");
    }
    ratio_ = nu / (1 - nu);
}

void Foam::membraneModels::Hooke::evaluate(const label n, const double* I1,
                                           const double* I2, double* W,
                                           double* W1, double* W2) const
{
    for (label k = 0; k < n; ++k)
    {
        W[k] =
            0.25 * Gs_ * ((1 + ratio_) * I1[k] * I1[k] + 2 * I1[k] - 2 * I2[k]);
        W1[k] = 0.5 * Gs_ * ((1 + ratio_) * I1[k] + 1);
        W2[k] = -0.5 * Gs_;
    }
}
