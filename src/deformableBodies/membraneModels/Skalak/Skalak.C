// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "Skalak.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

namespace Foam
{
namespace membraneModels
{
defineTypeNameAndDebug(Skalak, 0);
addToRunTimeSelectionTable(membraneModel, Skalak, dictionary);
} // namespace membraneModels
} // namespace Foam

Foam::membraneModels::Skalak::Skalak(const dictionary& dict)
    : Gs_(readPositive(dict, "Gs", dimForce / dimLength)),
      C_(0)
{
    requireEntry(dict, "C");
    C_ = dict.get<scalar>("C");
    checkEntries(dict, {"law", "Gs", "C"});
    if (!(C_ >= 0 && C_ <= 1e6))
    {
        refuse(dict, "C", Foam::name(C_),
               "0 and greater, up to 1e6: no membrane resists more, and time "
               "steps become as short");
    }
}

void Foam::membraneModels::Skalak::evaluate(const label n, const double* I1,
                                            const double* I2, double* W,
                                            double* W1, double* W2) const
{
    for (label k = 0; k < n; ++k)
    {
        W[k] = 0.25 * Gs_ *
               (I1[k] * I1[k] + 2 * I1[k] - 2 * I2[k] + C_ * I2[k] * I2[k]);
        W1[k] = 0.5 * Gs_ * (I1[k] + 1);
        W2[k] = 0.5 * Gs_ * (C_ * I2[k] - 1);
    }
}
