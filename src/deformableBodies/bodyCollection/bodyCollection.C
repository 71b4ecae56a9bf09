// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyCollection.H"
#include "dictionaryChecks.H"
#include "fvc.H"
#include "uniformDimensionedFields.H"

namespace Foam
{
defineTypeNameAndDebug(bodyCollection, 0);
}

Foam::bodyCollection::bodyCollection(const fvMesh& mesh)
    : regIOobject(IOobject("deformableBodies", mesh.time().timeName(),
                           "uniform", mesh, IOobject::NO_READ,
                           IOobject::AUTO_WRITE)),
      mesh_(mesh),
      startTime_(mesh.time().value()),
      startIndex_(mesh.time().timeIndex()),
      grid_(uniformGrid::New(mesh)),
      effects_(mesh.time())
{
    IOobject io("deformableBodies", mesh.time().constant(), mesh,
                IOobject::MUST_READ, IOobject::NO_WRITE, false);
    if (!io.typeHeaderOk<IOdictionary>(true))
    {
        effects_.declare("bodies", false, "no constant/deformableBodies");
        writeOpt() = IOobject::NO_WRITE;
        return;
    }
    const IOdictionary dict(io);
    grid_.require(dict, "deformableBodies");
    if (mesh.dynamic())
    {
        FatalIOErrorInFunction(dict)
            << "deformableBodies needs a mesh that does not move or change"
            << exit(FatalIOError);
    }
    read(dict);
    readState();
}

Foam::bodyCollection& Foam::bodyCollection::New(const fvMesh& mesh)
{
    bodyCollection* found =
        mesh.thisDb().getObjectPtr<bodyCollection>("deformableBodies");
    if (!found)
    {
        found = new bodyCollection(mesh);
        found->store();
    }
    return *found;
}

Foam::bodyCollection::~bodyCollection()
{
    // Nothing was simulated in post-processing
    if (lastAdvanced_ >= 0) effects_.printCost();
}

void Foam::bodyCollection::read(const IOdictionary& dict)
{
    checkEntries(dict,
                 {"FoamFile", "variables", "bodies", "sampleInterval",
                  "accuracy", "kernel", "coupling", "interactions", "loads"});

    if (!dict.subOrEmptyDict("interactions").empty())
    {
        refuse(dict, "interactions", "{...}",
               "an empty one; not available yet");
    }

    sampleInterval_ = dict.getOrDefault<label>("sampleInterval", 1);
    if (sampleInterval_ < 1)
    {
        refuse(dict, "sampleInterval", Foam::name(sampleInterval_),
               "1 and greater");
    }
    const word accuracy(dict.getOrDefault<word>("accuracy", "standard"));
    if (!wordList({"draft", "standard", "reference"}).found(accuracy))
    {
        refuse(dict, "accuracy", accuracy, "(draft standard reference)");
    }

    const IOdictionary transport(
        IOobject("transportProperties", mesh_.time().constant(), mesh_,
                 IOobject::MUST_READ, IOobject::NO_WRITE, false));
    rho_ = readPositive(transport, "rho", dimDensity);
    nu_ = readPositive(transport, "nu", dimViscosity);

    boundary_.reset(new immersedBoundary(grid_, deltaKernel(dict)));

    const Time& time = mesh_.time();
    const bool adjusted =
        time.controlDict().getOrDefault<bool>("adjustTimeStep", false);
    const bodyScene scene{
        grid_,         boundary_->kernel(),
        rho_,          rho_ * nu_,
        readGravity(), adjusted ? GREAT : time.deltaTValue(),
        accuracy,      bodyGroup::readCoupling(dict, "twoWay"),
        effects_};
    bool feedback = false, inFluid = false;
    const dictionary& bodies = dict.subDict("bodies");
    for (const word& name : bodies.toc())
    {
        groups_.append(bodyGroup::New(name, bodies.subDict(name), scene).ptr());
        feedback = feedback || groups_.last().twoWay();
        inFluid = inFluid || !groups_.last().alone();
    }

    alone_ = !empty() && !inFluid;
    effects_.declare("interpolation", inFluid,
                     inFluid ? deltaKernel::names[boundary_->kernel().type()] +
                                   " kernel at face centres"
                             : word("coupling none"));
    effects_.declare("spreading", feedback,
                     feedback ? "loads act on the fluid"
                              : "coupling oneWay or none");
    scalarList ratios(groups_.size());
    forAll(groups_, g)
    {
        ratios[g] = groups_[g].viscosityRatio();
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
                               : string("same fluid inside"));
    effects_.declare("interactions", false, "none given");
    readLoads(dict.subOrEmptyDict("loads"));
}

void Foam::bodyCollection::readLoads(const dictionary& loads)
{
    for (const word& name : loads.toc())
    {
        const dictionary& load = loads.subDict(name);
        const word group(load.get<word>("group"));
        wordList all(groups_.size());
        forAll(groups_, g)
        {
            all[g] = groups_[g].name();
            if (all[g] == group) groups_[g].addLoad(name, load);
        }
        if (!all.found(group))
        {
            OStringStream allowed;
            allowed << flatOutput(all);
            refuse(load, "group", group, allowed.str());
        }
    }
    effects_.declare("loads", !loads.empty(),
                     loads.empty() ? string("none given")
                                   : string(loads.toc()[0]));
}

Foam::vector Foam::bodyCollection::readGravity() const
{
    const uniformDimensionedVectorField g(
        IOobject("g", mesh_.time().constant(), mesh_, IOobject::READ_IF_PRESENT,
                 IOobject::NO_WRITE, false),
        dimensionedVector(dimAcceleration, Zero));
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

Foam::scalar Foam::bodyCollection::maxDeltaT() const
{
    scalar limit = GREAT;
    forAll(groups_, g)
    {
        if (groups_[g].twoWay()) limit = min(limit, groups_[g].maxDeltaT());
    }
    return limit;
}

void Foam::bodyCollection::start()
{
    effects_.printEffects();
    if (empty()) return;

    const scalar deltaT = mesh_.time().deltaTValue();
    if (deltaT > maxDeltaT())
    {
        Info << "--> Note: deltaT " << deltaT << " is above the estimate "
             << maxDeltaT() << " for the stiffest body; if bodies diverge, "
             << "reduce it" << nl << endl;
    }
    sample(startTime_);
    draw(startTime_, startIndex_);
}

void Foam::bodyCollection::stop(const string& trouble)
{
    List<string> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = trouble;
    Pstream::gatherList(all);
    Pstream::scatterList(all);

    Time& time = const_cast<Time&>(mesh_.time());
    diverged_ = true;
    if (beforeStop_) beforeStop_();
    Info << "Writing the state before the stop" << endl;
    time.writeNow();
    for (const string& t : all)
    {
        if (!t.empty())
        {
            FatalErrorInFunction
                << "a body diverged at time " << time.timeName() << ": "
                << t.c_str() << nl
                << "    What it looked like has been written to time "
                << time.timeName() << "; go on from an earlier time with a "
                << "smaller deltaT" << exit(FatalError);
        }
    }
}

Foam::tmp<Foam::volVectorField> Foam::bodyCollection::cellForce() const
{
    return fvc::reconstruct(*forceFlux_);
}
