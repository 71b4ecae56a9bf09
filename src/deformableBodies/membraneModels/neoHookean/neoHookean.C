// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "neoHookean.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

namespace Foam
{
namespace membraneModels
{
defineTypeNameAndDebug(neoHookean, 0);
addToRunTimeSelectionTable(membraneModel, neoHookean, dictionary);
} // namespace membraneModels
} // namespace Foam

Foam::membraneModels::neoHookean::neoHookean(const dictionary& dict)
    : Gs_(readPositive(dict, "Gs", dimForce / dimLength))
{
    checkEntries(dict, {"law", "Gs"});
}

void Foam::membraneModels::neoHookean::evaluate(const label n, const double* I1,
                                                const double* I2, double* W,
                                                double* W1, double* W2) const
{
    for (label k = 0; k < n; ++k)
    {
        const double r = 1 / (I2[k] + 1);
        W[k] = 0.5 * Gs_ * (I1[k] - 1 + r);
        W1[k] = 0.5 * Gs_;
        W2[k] = -0.5 * Gs_ * r * r;
    }
}
