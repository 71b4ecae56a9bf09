// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "prescribedViscosity.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

namespace Foam
{
namespace viscosityModels
{
defineTypeNameAndDebug(prescribed, 0);
addToRunTimeSelectionTable(viscosityModel, prescribed, dictionary);
} // namespace viscosityModels
} // namespace Foam

Foam::viscosityModels::prescribed::prescribed(const word& name,
                                              const dictionary& properties,
                                              const volVectorField& U,
                                              const surfaceScalarField& phi)
    : viscosityModel(name, properties, U, phi),
      nu_(IOobject("nu", U.time().timeName(), U.db(), IOobject::MUST_READ,
                   IOobject::AUTO_WRITE),
          U.mesh())
{
    const scalar least = gMin(nu_.primitiveField());
    if (!(least > 0))
    {
        refuse(properties, "transportModel prescribed",
               "with nu down to " + Foam::name(least),
               "a field nu greater than 0");
    }
}
