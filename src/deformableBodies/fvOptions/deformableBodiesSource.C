// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "deformableBodiesSource.H"
#include "addToRunTimeSelectionTable.H"
#include "bodyCollection.H"
#include "dictionaryChecks.H"
#include "fvMatrices.H"

namespace Foam
{
namespace fv
{
defineTypeNameAndDebug(deformableBodiesSource, 0);
addToRunTimeSelectionTable(option, deformableBodiesSource, dictionary);
} // namespace fv
} // namespace Foam

Foam::fv::deformableBodiesSource::deformableBodiesSource(const word& name,
                                                         const word& modelType,
                                                         const dictionary& dict,
                                                         const fvMesh& mesh)
    : option(name, modelType, dict, mesh),
      phiName_(coeffs_.getOrDefault<word>("phi", "phi")),
      bodies_(bodyCollection::New(mesh))
{
    checkEntries(coeffs_, {"type", "active", "U", "phi", "log",
                           word(typeName + "Coeffs")});
    label nOptions = 0;
    for (const entry& e : dict.parent())
    {
        if (e.isDict() && e.dict().getOrDefault<word>("type", "") == typeName &&
            e.dict().getOrDefault<bool>("active", true))
        {
            ++nOptions;
        }
    }
    if (nOptions > 1)
    {
        refuse(dict, "type",
               typeName + " in " + Foam::name(nOptions) + " options",
               "one option: each adds the force of all bodies");
    }
    fieldNames_.setSize(1, coeffs_.getOrDefault<word>("U", "U"));
    applied_.setSize(1, false);
    if (!active_)
    {
        refuse(dict, "active", "false",
               "true; a run without bodies has no such option");
    }
    if (bodies_.empty())
    {
        waitForMaster();
        FatalIOErrorInFunction(dict)
            << "option " << name << " of type deformableBodies: there are no "
            << "bodies, as there is no file constant/deformableBodies"
            << exit(FatalIOError);
    }
    for (const word controls : {"PIMPLE", "PISO"})
    {
        if (!bodies_.system().solverBalances &&
            mesh.solutionDict().found(controls))
        {
            bodies_.limits().checkCorrectors(
                mesh.solutionDict().subDict(controls));
        }
    }
}

bool Foam::fv::deformableBodiesSource::read(const dictionary& dict)
{
    const bool done = option::read(dict);
    if (!active_)
    {
        IOWarningInFunction(dict)
            << "entry active is false: no effect during a run, the bodies "
            << "continue" << endl;
        active_ = true;
    }
    return done;
}

void Foam::fv::deformableBodiesSource::addSup(fvMatrix<vector>& eqn,
                                              const label)
{
    if (bodies_.system().solverBalances || bodies_.empty()) return;

    const auto& phi = mesh_.lookupObject<surfaceScalarField>(phiName_);
    if (phi.dimensions() != dimVolume / dimTime) refuseDensity();
    bodies_.advance(phi);
    bodies_.endStep();
    eqn += bodies_.cellForce();
}

void Foam::fv::deformableBodiesSource::checkApplied() const
{
    if (applied_[0] || bodies_.system().solverBalances) return;
    waitForMaster();
    FatalIOErrorInFunction(dict_)
        << "option " << name_ << ": this solver does not ask for a source of "
        << fieldNames_[0] << ", so that the bodies would not move" << nl
        << "    allowed: solvers of incompressible flow that apply fvOptions, "
        << "as pimpleFoam and pisoFoam do, or deformableBodyFoam"
        << exit(FatalIOError);
}

void Foam::fv::deformableBodiesSource::refuseDensity() const
{
    waitForMaster();
    FatalIOErrorInFunction(dict_)
        << "deformableBodies works in incompressible solvers only, where the "
        << "momentum equation is divided by the density" << exit(FatalIOError);
}

void Foam::fv::deformableBodiesSource::addSup(const volScalarField&,
                                              fvMatrix<vector>&, const label)
{
    refuseDensity();
}

void Foam::fv::deformableBodiesSource::addSup(const volScalarField&,
                                              const volScalarField&,
                                              fvMatrix<vector>&, const label)
{
    refuseDensity();
}
