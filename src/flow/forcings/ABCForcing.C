// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "ABCForcing.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "IOdictionary.H"

namespace Foam
{
namespace fv
{
defineTypeNameAndDebug(ABCForcing, 0);
addToRunTimeSelectionTable(option, ABCForcing, dictionary);
} // namespace fv
} // namespace Foam

Foam::fv::ABCForcing::ABCForcing(const word& name, const word& modelType,
                                 const dictionary& dict, const fvMesh& mesh)
    : lowModeForcing(name, modelType, dict, mesh,
                     {"velocity", "waveNumber", "A", "B", "C"})
{
    const vector L(grid_.length());
    if (cmptMax(L) - cmptMin(L) > 1e-6 * cmptMax(L))
    {
        waitForMaster();
        FatalIOErrorInFunction(dict_)
            << modelType << " needs a cube, but the box measures " << L
            << exit(FatalIOError);
    }
    const label n = coeffs_.getOrDefault<label>("waveNumber", 1);
    if (n < 1) refuse(coeffs_, "waveNumber", Foam::name(n), "1 and greater");

    const IOdictionary transport(
        IOobject("transportProperties", mesh.time().constant(), mesh,
                 IOobject::MUST_READ, IOobject::NO_WRITE, false));
    const scalar nu = readPositive(transport, "nu", dimViscosity);
    const scalar U0 = readPositive(coeffs_, "velocity", dimVelocity);
    const scalar f0 = nu * magSqr(waveVector(labelVector(n, 0, 0))) * U0;
    const scalar A = f0 * coeffs_.getOrDefault<scalar>("A", 1);
    const scalar B = f0 * coeffs_.getOrDefault<scalar>("B", 1);
    const scalar C = f0 * coeffs_.getOrDefault<scalar>("C", 1);

    // a cos(kx) is Re(a exp(ikx)), a sin(kx) is Re(-i a exp(ikx))
    const complexNumber i(0, 1);
    setModes({{labelVector(n, 0, 0), {0, -i * B, B}},
              {labelVector(0, n, 0), {C, 0, -i * C}},
              {labelVector(0, 0, n), {-i * A, A, 0}}},
             "waveNumber");
}
