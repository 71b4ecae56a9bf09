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

void Foam::bodyCollection::advance(const surfaceScalarField& phi)
{
    const Time& time = mesh_.time();
    if (lastAdvanced_ == time.timeIndex()) return;

    staggeredField faces(grid_.box());
    if (!empty()) grid_.toStaggered(phi, faces);
    advance(faces, faces);
    if (!forceFlux_.valid())
    {
        forceFlux_.reset(new surfaceScalarField(
            IOobject("bodyForceFlux", time.timeName(), mesh_), mesh_,
            dimensionedScalar(dimAcceleration * dimArea, Zero)));
        forceFlux_->setOriented();
    }
    if (!empty()) grid_.toFlux(faces, *forceFlux_);
}

void Foam::bodyCollection::advance(const staggeredView& u,
                                   staggeredField& force)
{
    const Time& time = mesh_.time();
    if (lastAdvanced_ < 0) start();
    lastAdvanced_ = time.timeIndex();
    if (empty())
    {
        force.clear();
        return;
    }

    const labelList now(groupsThat(false));
    const scalar dt = time.deltaTValue();
    if (time.timeIndex() % sampleInterval_ == 0) observe(u);
        if (!alone_ && now.size())
    {
        const auto timing(effects_.time("interpolation"));
        X_.setSize(nMarkers(now));
        vector* X = X_.data();
        for (const label g : now)
        {
            groups_[g].markers(X, dt);
            X += groups_[g].nMarkers();
        }
        boundary_->interpolate(X_, {u}, U_);
    }

    if (contrast_) updateViscosity(force);

    // Diffusion in a solver of which no more is known
    const scalar number = nu_ * dt / std::pow(grid_.cellVolume(), 2.0 / 3);
    move(now, false, implicitDiffusion::kept(number));

    force.clear();
    collectLoads(now);
    spread(force);

    if (!waiting() && time.timeIndex() % sampleInterval_ == 0)
    {
        sample(time.value());
    }
}

void Foam::bodyCollection::correct(const staggeredFlow::prediction& p)
{
    // With the force of the last step, where the markers are now
    const labelList later(groupsThat(true));
    const Time& time = mesh_.time();
    for (const label g : later)
    {
        X_.setSize(groups_[g].nMarkers());
        groups_[g].markers(X_.data(), time.deltaTValue());
    }
    collectLoads(later);
    const vectorField before(F_);
    for (const auto& force : p.force)
    {
        spread(*force.second, force.first);
    }
    {
        const auto timing(effects_.time("interpolation"));
        boundary_->interpolate(X_, p.u, U_);
    }
    move(later, true, p.kept);

    // And what it has changed by
    collectLoads(later);
    F_ -= before;
    for (const auto& force : p.force)
    {
        spread(*force.second, force.first);
    }

    if (time.timeIndex() % sampleInterval_ == 0) sample(time.value());
}

Foam::labelList Foam::bodyCollection::groupsThat(const bool wait) const
{
    DynamicList<label> which;
    forAll(groups_, g)
    {
        if ((solverPredicts_ && groups_[g].forces()) == wait) which.append(g);
    }
    return labelList(std::move(which));
}

Foam::label Foam::bodyCollection::nMarkers(const labelList& groups) const
{
    label n = 0;
    for (const label g : groups)
    {
        n += groups_[g].nMarkers();
    }
    return n;
}

void Foam::bodyCollection::observe(const staggeredView& u)
{
    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        if (!group.forces()) continue;
        const auto timing(effects_.time("interpolation"));
        X_.setSize(group.nMarkers());
        group.markers(X_.data(), 0);
        boundary_->interpolate(X_, {u}, U_);
        group.observe(U_.cdata());
    }
}

void Foam::bodyCollection::move(const labelList& groups, const bool predicted,
                                const scalar kept)
{
    const Time& time = mesh_.time();
    const bodyStep step{time.value(), time.deltaTValue(), predicted, kept};
    const vector* U = U_.cdata();
    string trouble;
    for (const label g : groups)
    {
        const string t(groups_[g].move(U, step));
        if (trouble.empty()) trouble = t;
        U += groups_[g].nMarkers();
    }
    if (returnReduce(!trouble.empty(), orOp<bool>())) stop(trouble);
}

void Foam::bodyCollection::collectLoads(const labelList& groups)
{
    DynamicList<label> acting;
    for (const label g : groups)
    {
        if (groups_[g].twoWay()) acting.append(g);
    }
    X_.setSize(nMarkers(acting));
    F_.setSize(X_.size());
    const scalar middle =
        mesh_.time().value() - 0.5 * mesh_.time().deltaTValue();
    label at = 0;
    for (const label g : acting)
    {
        groups_[g].loads(X_.data() + at, F_.data() + at, middle);
        at += groups_[g].nMarkers();
    }
}

void Foam::bodyCollection::spread(staggeredField& force, const scalar factor)
{
    if (!returnReduce(X_.size(), maxOp<label>())) return;

    const auto timing(effects_.time("spreading"));
    const vectorField F(factor / rho_ * F_);
    boundary_->spread(X_, F, force);
    if (periodicBox()) removeMean(F, force);
}

void Foam::bodyCollection::updateViscosity(staggeredField& work)
{
    const auto timing(effects_.time("viscosityRatio"));
    label at = 0, used = 0;
    scalar excess = 0;
    vectorField X(X_.size()), G(X_.size());
    for (const label g : groupsThat(false))
    {
        const bodyGroup& group = groups_[g];
        const label n = group.nMarkers();
        const scalar more = group.viscosityRatio() - 1;
        if (more != 0)
        {
            SubField<vector>(X, n, used) = SubField<vector>(X_, n, at);
            SubField<vector> dS(G, n, used);
            group.areas(dS.data());
            dS *= -more;
            excess += more * group.volume();
            used += n;
        }
        at += n;
    }
    X.setSize(used);
    G.setSize(used);
    contrast_->update(*boundary_, X, G, excess, work);
}

bool Foam::bodyCollection::periodicBox() const
{
    return grid_.periodic(0) && grid_.periodic(1) && grid_.periodic(2);
}

void Foam::bodyCollection::removeMean(const vectorField& F,
                                      staggeredField& force) const
{
    const vector L(grid_.length());
    const vector mean(gSum(F) / (L.x() * L.y() * L.z()));
    for (direction d = 0; d < 3; ++d)
    {
        force[d] -= mean[d];
    }
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
