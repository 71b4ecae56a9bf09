// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyCollection.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "functionTimes.H"
#include "fvc.H"
#include "repeatedDictionary.H"
#include "sceneNumbers.H"

namespace Foam
{
defineTypeNameAndDebug(bodyCollection, 0);
}

const Foam::wordList Foam::bodyCollection::stateEntries(
    {"deformableBodies", "diverged", "forAllGroups", "interactions"});

Foam::bodyCollection::bodyCollection(const fvMesh& mesh,
                                     const bool solverBalances)
    : regIOobject(IOobject("deformableBodies", mesh.time().timeName(),
                           "uniform", mesh, IOobject::NO_READ,
                           IOobject::AUTO_WRITE)),
      mesh_(mesh),
      grid_(uniformGrid::New(mesh)),
      effects_(mesh.time(), mesh.dbDir()),
      solverBalances_(solverBalances),
      placed_(grid_)
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
            firstRankSpeaks();
            FatalIOErrorInFunction(dict)
                << "deformableBodies needs three dimensions, but direction "
                << vector::componentNames[d] << " has patches of type empty"
                << nl << "    allowed: cyclic patches in place of them, and "
                << "several cells" << exit(FatalIOError);
        }
    }
    if (mesh.dynamic())
    {
        firstRankSpeaks();
        FatalIOErrorInFunction(dict)
            << "deformableBodies needs a mesh that does not move or change"
            << exit(FatalIOError);
    }
    requireTimeSteps();
    for (const word& file : {io.name(), word("transportProperties")})
    {
        watched_.append(new startDictionary(mesh, file, "the bodies go on"));
    }
    read(dict);
    readState(dict);
    places_.reset(
        new bodyPlaces(mesh, groups_, *markers_, interactions_.get()));
    places_->checkStart(dict);
    if (isNamed("bodyForce", mesh.time()))
    {
        forceField_.reset(new volVectorField(
            IOobject("bodyForce", mesh.time().timeName(), mesh), mesh,
            dimensionedVector(dimForce / dimVolume, Zero)));
    }
    const bool wrap = dict.getOrDefault<bool>("wrap", false);
    writer_.reset(
        new bodyWriter(mesh, groups_, effects_,
                       "postProcessing/bodies, " +
                           (sampleInterval_ == 1
                                ? string("each step")
                                : "one step in " + Foam::name(sampleInterval_)),
                       wrap ? &grid_ : nullptr));
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
    if (empty()) return;
    Info << "Error indicators at the end (largest over the bodies)" << nl;
    forAll(groups_, g)
    {
        judgeIndicators(groups_[g].name(), groups_[g].indicators());
    }
    Info << endl;
    if (interactions_) interactions_->judge();
    if (Pstream::parRun())
    {
        Info << "Bodies handed over between ranks: " << ownership_->handedOver()
             << nl << endl;
    }
}

bool Foam::bodyCollection::twoWay() const
{
    bool any = false;
    forAll(groups_, g)
    {
        any = any || groups_[g].twoWay();
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
            {
                *reason = (groups_[g].forcing() == forcingType::none
                               ? "stiffest waves of group "
                               : "bodies lighter than the fluid in group ") +
                          groups_[g].name();
            }
        }
    }
    return limit;
}

Foam::List<Foam::expectedErrors>
Foam::bodyCollection::errors(const flowScales& flow) const
{
    List<expectedErrors> all(groups_.size());
    forAll(groups_, g)
    {
        all[g] = groups_[g].errors(flow);
        if (fromFaces_ && groups_[g].twoWay())
        {
            all[g].parts.push_back(
                {"flow", 0.01, "pimple in place of staggered", nullptr});
        }
    }
    return all;
}

Foam::scalar Foam::bodyCollection::wantedDeltaT() const
{
    if (empty() || accuracy_.wanted <= 0 || !adjusted() || !solverBalances_)
    {
        return GREAT;
    }
    if (!wantedIsKnown_)
    {
        wantedIsKnown_ = true;
        const bool before = wantedDeltaT_ < GREAT;
        string from;
        List<expectedErrors> all(errors(scalesAtStart(mesh_, from)));
        forAll(groups_, g)
        {
            if (before &&
                !returnReduce(groups_[g].startsAfresh(), orOp<bool>()))
            {
                continue;
            }
            wantedDeltaT_ =
                min(wantedDeltaT_, stepFor(all[g], accuracy_.wanted));
        }
    }
    return wantedDeltaT_;
}

void Foam::bodyCollection::describe() const
{
    effects_.printEffects();
    if (empty()) return;
    List<expectedErrors> errors(
        this->errors(printSceneNumbers(mesh_, rho_, *nu_, groups_)));
    bool fresh = false;
    forAll(groups_, g)
    {
        if (wantedDeltaT() < GREAT) stepFor(errors[g], accuracy_.wanted);
        fresh = fresh || groups_[g].startsAfresh();
    }

    // What a run was begun with is not refused in the middle
    reduce(fresh, orOp<bool>());
    judgeErrors(errors, fresh ? accuracy_.wanted : 0,
                mesh_.time().constant() / "deformableBodies");
}

void Foam::bodyCollection::start()
{
    describe();
    if (empty()) return;
    writer_->start();
    if (!contrast_) nu_->compare(groups_);
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
    collectLoads(identity(groups_.size()));
    if (returnReduce(X_.size(), maxOp<label>()))
    {
        const auto timing(effects_.time("spreading"));
        markers_->place(X_);
        markers_->spread(F_, faces);
    }
    surfaceScalarField flux(
        IOobject("bodyForceFlux", mesh_.time().timeName(), mesh_), mesh_,
        dimensionedScalar(dimForce / dimVolume * dimArea, Zero));
    flux.setOriented();
    grid_.toFlux(faces, flux);
    return fvc::reconstruct(flux);
}
