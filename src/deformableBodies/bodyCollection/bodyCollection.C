// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyCollection.H"
#include "bodyForceField.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "fvc.H"
#include "repeatedDictionary.H"
#include "sceneNumbers.H"
#include "uniformDimensionedFields.H"

namespace Foam
{
defineTypeNameAndDebug(bodyCollection, 0);
}

const Foam::word Foam::bodyCollection::stateEntry("deformableBodies");

Foam::bodyCollection::bodyCollection(const fvMesh& mesh,
                                     const bool solverBalances)
    : regIOobject(IOobject("deformableBodies", mesh.time().timeName(),
                           "uniform", mesh, IOobject::NO_READ,
                           IOobject::AUTO_WRITE)),
      mesh_(mesh),
      grid_(uniformGrid::New(mesh)),
      effects_(mesh.time(), mesh.dbDir()),
      solverBalances_(solverBalances)
{
    const IOobject io("deformableBodies", mesh.time().constant(), mesh,
                      IOobject::MUST_READ, IOobject::NO_WRITE, false);
    if (!isThere<IOdictionary>(io))
    {
        const fileName other(misplacedFile(io));
        if (!other.empty())
        {
            FatalErrorInFunction
                << "there is no file "
                << (io.instance() / io.db().dbDir() / io.name()).c_str()
                << ", but a file " << other.c_str() << nl
                << "    Bodies are read from the first only: move the file, or "
                << "take it away for a run without bodies" << exit(FatalError);
        }
        Info << "No bodies: there is no file constant/deformableBodies" << nl
             << endl;
        effects_.declare("bodies", false, "no constant/deformableBodies");
        writeOpt() = IOobject::NO_WRITE;
        return;
    }
    const IOdictionary dict(io);
    refuseRepeated(dict, dict.filePath());
    grid_.require(dict, "deformableBodies");
    for (direction d = 0; d < 3; ++d)
    {
        if (mesh.geometricD()[d] < 0)
        {
            FatalIOErrorInFunction(dict)
                << "deformableBodies needs three dimensions, but direction "
                << vector::componentNames[d] << " has patches of type empty"
                << nl << "    allowed: cyclic patches in place of them, and "
                << "several cells" << exit(FatalIOError);
        }
    }
    if (mesh.dynamic())
    {
        FatalIOErrorInFunction(dict)
            << "deformableBodies needs a mesh that does not move or change"
            << exit(FatalIOError);
    }
    requireTimeSteps();
    read(dict);
    readState(dict);
    places_.reset(
        new bodyPlaces(mesh, groups_, *markers_, interactions_.get()));
    places_->checkStart(dict);
    forceField_.reset(new bodyForceField(mesh, *this));
    const bool wrap = dict.getOrDefault<bool>("wrap", false);
    writer_.reset(
        new bodyWriter(mesh, groups_, effects_,
                       "postProcessing/bodies, " +
                           (sampleInterval_ == 1
                                ? string("each step")
                                : "one step in " + Foam::name(sampleInterval_)),
                       wrap ? &grid_ : nullptr));
}

void Foam::bodyCollection::requireTimeSteps() const
{
    const dictionary schemes(mesh_.schemesDict().subOrEmptyDict("ddtSchemes"));
    for (const entry& e : schemes)
    {
        if (!e.isStream()) continue;
        const string scheme(e.stream().toString());
        for (const word notInTime :
             {"steadyState", "localEuler", "CoEuler", "SLTS"})
        {
            if (scheme.find(notInTime) == string::npos) continue;
            refuse(schemes, e.keyword(), scheme,
                   "Euler, backward or CrankNicolson: bodies move in time, so "
                   "that solvers of steady flow cannot carry them");
        }
    }
}

Foam::bodyCollection& Foam::bodyCollection::New(const fvMesh& mesh,
                                                const bool solverBalances)
{
    bodyCollection* found =
        mesh.thisDb().getObjectPtr<bodyCollection>("deformableBodies");
    if (!found)
    {
        found = new bodyCollection(mesh, solverBalances);
        found->store();
    }
    return *found;
}

Foam::bodyCollection::~bodyCollection()
{
    // Nothing was simulated in post-processing
    if (lastMoved_ < 0) return;
    effects_.printCost();
    if (Pstream::parRun() && !empty())
    {
        Info << "Bodies handed over between ranks: " << ownership_->handedOver()
             << nl << endl;
    }
}

void Foam::bodyCollection::read(const IOdictionary& dict)
{
    checkEntries(dict, {"FoamFile", "variables", "bodies", "sampleInterval",
                        "accuracy", "kernel", "coupling", "interactions",
                        "loads", "wrap", "restart", "removed", "outside"});

    const IOdictionary transport(
        IOobject("transportProperties", mesh_.time().constant(), mesh_,
                 IOobject::MUST_READ, IOobject::NO_WRITE, false));
    rho_ = readPositive(transport, "rho", dimDensity);
    nu_ = readPositive(transport, "nu", dimViscosity);

    neighbours_.reset(new blockNeighbours(grid_));
    ownership_.reset(new bodyOwnership(*neighbours_));
    markers_.reset(new markerSet(grid_, deltaKernel(dict), *neighbours_));

    const bodyScene scene{grid_,
                          markers_->kernel(),
                          solverBalances_,
                          rho_,
                          rho_ * nu_,
                          readGravity(),
                          expectedDeltaT(),
                          readAccuracy(dict),
                          readCoupling(dict, bodyCoupling::twoWay),
                          removesOutside(dict, false),
                          forces_,
                          effects_};
    bool feedback = false, inFluid = false;
    const dictionary& bodies = dict.subDict("bodies");
    if (bodies.empty()) refuse(dict, "bodies", "{}", "one group and more");
    for (const word& name : bodies.toc())
    {
        if (name == stateEntry || name == "diverged")
        {
            refuse(dict, "bodies", "a group " + name,
                   "other names, as the state has an entry of this name");
        }
        // It becomes a file name
        if (name.find_first_not_of(
                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQR"
                "STUVWXYZ0123456789_-+.") != string::npos)
        {
            refuse(dict, "bodies", "a group with the name \"" + name + "\"",
                   "names of letters, digits and _ - + .");
        }
        groups_.append(bodyGroup::New(name, bodies.subDict(name), scene).ptr());
        feedback = feedback || groups_.last().twoWay();
        inFluid = inFluid || !groups_.last().alone();
    }

    // Samples of many bodies at each step would cost a good part of it
    label nBodies = 0;
    forAll(groups_, g)
    {
        nBodies += groups_[g].nBodies();
    }
    sampleInterval_ =
        dict.getOrDefault<label>("sampleInterval", max(label(1), nBodies / 16));
    if (sampleInterval_ < 1)
    {
        refuse(dict, "sampleInterval", Foam::name(sampleInterval_),
               "1 and greater");
    }

    alone_ = !empty() && !inFluid;
    effects_.declare("interpolation", inFluid,
                     inFluid ? deltaKernel::names[markers_->kernel().type()] +
                                   " kernel at face centres"
                             : word("coupling none"));
    effects_.declare("spreading", feedback,
                     !feedback ? "coupling oneWay or none"
                     : periodicBox()
                         ? "loads act on the fluid, less their mean, which "
                           "nothing holds in a box without walls"
                         : "loads act on the fluid");
    readViscosityRatios(transport);
    const dictionary interactions(dict.subOrEmptyDict("interactions"));
    effects_.declare("interactions", !interactions.empty(),
                     interactions.empty() ? "none given"
                                          : "bodies that come close");
    if (!interactions.empty())
    {
        interactions_.reset(
            new bodyInteractions(interactions, mesh_, groups_, scene));
    }
    effects_.declare("places", true,
                     "bodies that leave their block or the box, or come close");
    readLoads(dict.subOrEmptyDict("loads"));
}

void Foam::bodyCollection::readViscosityRatios(const dictionary& transport)
{
    // A fluid that does not feel the bodies has its own viscosity everywhere
    scalarList ratios(groups_.size(), scalar(1));
    bool unfelt = false;
    forAll(groups_, g)
    {
        const scalar ratio = groups_[g].viscosityRatio();
        if (groups_[g].twoWay())
            ratios[g] = ratio;
        else
            unfelt = unfelt || ratio != 1;
    }
    if (ratios != scalarList(groups_.size(), scalar(1)))
    {
        const word model(transport.get<word>("transportModel"));
        if (model != "Newtonian")
        {
            refuse(transport, "transportModel", model,
                   "Newtonian where bodies have a viscosityRatio");
        }
        contrast_.reset(new viscosityContrast(mesh_, nu_, ratios));
    }
    effects_.declare("viscosityRatio", bool(contrast_),
                     contrast_ ? "up to " + Foam::name(max(ratios)) +
                                     ", down to " + Foam::name(min(ratios))
                     : unfelt ? string("coupling oneWay: the fluid does not "
                                       "feel the bodies")
                              : string("same fluid inside"));
}

void Foam::bodyCollection::readLoads(const dictionary& loads)
{
    wordList names(groups_.size());
    forAll(groups_, g)
    {
        names[g] = groups_[g].name();
    }
    for (const word& name : loads.toc())
    {
        const dictionary& load = loads.subDict(name);
        const word group(load.get<word>("group"));
        const label g = names.find(group);
        if (g < 0)
        {
            refuse(load, "group", group, oneOf(names));
        }
        forces_.append(bodyForce::New(load, groups_[g].points(-1)).ptr());
        effects_.declare(forces_.last().effect(), true, name);
        if (!groups_[g].takesForces())
        {
            refuse(load, "group", group,
                   "a group that acts on the fluid: capsules that are only "
                   "carried by it (coupling oneWay) feel no force");
        }
    }
    if (loads.empty()) effects_.declare("loads", false, "none given");
}

Foam::vector Foam::bodyCollection::readGravity() const
{
    const IOobject io("g", mesh_.time().constant(), mesh_, IOobject::MUST_READ,
                      IOobject::NO_WRITE, false);
    if (!isThere<uniformDimensionedVectorField>(io)) return Zero;
    const uniformDimensionedVectorField g(io);
    checkDimensions(g, dimAcceleration);
    return g.value();
}

bool Foam::bodyCollection::stiff() const
{
    bool any = false;
    forAll(groups_, g)
    {
        any = any || (groups_[g].twoWay() && groups_[g].stiff());
    }
    return any;
}

bool Foam::bodyCollection::adjusted() const
{
    return mesh_.time().controlDict().getOrDefault<bool>("adjustTimeStep",
                                                         false);
}

// What does not depend on the flow, which would be another after a restart
Foam::scalar Foam::bodyCollection::expectedDeltaT() const
{
    if (!adjusted()) return mesh_.time().deltaTValue();
    return mesh_.time().controlDict().getOrDefault<scalar>(
        "maxDeltaT", solverBalances_ ? 0 : GREAT);
}

Foam::scalar Foam::bodyCollection::maxDeltaT(string* reason) const
{
    scalar limit = GREAT;
    forAll(groups_, g)
    {
        if (groups_[g].twoWay() && groups_[g].maxDeltaT() < limit)
        {
            limit = groups_[g].maxDeltaT();
            if (reason)
                *reason = "stiffest waves of group " + groups_[g].name();
        }
    }
    return limit;
}

void Foam::bodyCollection::describe() const
{
    effects_.printEffects();
    if (!empty()) printSceneNumbers(mesh_, rho_, nu_, groups_);
}

void Foam::bodyCollection::start()
{
    describe();
    if (empty()) return;
    writer_->start();
}

void Foam::bodyCollection::checkDeltaT()
{
    string group;
    const Time& time = mesh_.time();
    const scalar limit = maxDeltaT(&group), deltaT = time.deltaTValue();
    if (deltaT <= (1 + 1e-6) * limit) return;

    const string what("deltaT " + Foam::name(deltaT) + " is " +
                      Foam::name(deltaT / limit) + " times what the " + group +
                      " bear by the estimate, " + Foam::name(limit) + " s");
    if (lastMoved_ < 0 && deltaT > 200 * limit)
    {
        FatalErrorInFunction
            << what.c_str() << ": bodies would diverge within a few steps" << nl
            << "    allowed: deltaT up to " << Foam::name(limit)
            << ", at most 200 times that, or softer bodies" << exit(FatalError);
    }
    if (warned_ >= 0 && time.timeIndex() < warned_ + stepGuard::pause) return;
    warned_ = time.timeIndex();
    if (Pstream::master())
    {
        WarningInFunction
            << what.c_str() << nl << "    If bodies diverge, reduce it"
            << (adjusted() ? " (maxDeltaT in system/controlDict: this solver "
                             "adjusts its step without regard to bodies)"
                           : "")
            << endl;
    }
}

Foam::tmp<Foam::volVectorField> Foam::bodyCollection::cellForce() const
{
    return fvc::reconstruct(*forceFlux_);
}

Foam::tmp<Foam::volVectorField> Foam::bodyCollection::fluidForce()
{
    staggeredField faces(grid_.box());
    const vectorField X(collectLoads(identity(groups_.size())));
    if (returnReduce(X.size(), maxOp<label>()))
    {
        const auto timing(effects_.time("spreading"));
        markers_->place(X);
        markers_->spread(F_, faces);
    }
    surfaceScalarField flux(
        IOobject("bodyForceFlux", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimForce / dimVolume * dimArea, Zero));
    flux.setOriented();
    grid_.toFlux(faces, flux);
    return fvc::reconstruct(flux);
}
