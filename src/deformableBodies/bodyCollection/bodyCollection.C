// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyCollection.H"
#include "bodyReader.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "fvc.H"
#include "lastStep.H"
#include "libraryVersion.H"
#include "periodicBox.H"
#include "duplicateEntries.H"

namespace Foam
{
defineTypeNameAndDebug(bodyCollection, 0);
}

Foam::bodyCollection::bodyCollection(const fvMesh& mesh,
                                     const bool solverBalances)
    : regIOobject(IOobject("deformableBodies", mesh.time().timeName(),
                           "uniform", mesh, IOobject::NO_READ,
                           IOobject::AUTO_WRITE)),
      system_(mesh, solverBalances),
      limits_(system_),
      motion_(system_, trouble_),
      statistics_(system_)
{
    note() = libraryVersion;
    const IOobject io("deformableBodies", mesh.time().constant(), mesh,
                      IOobject::MUST_READ, IOobject::NO_WRITE, false);
    if (fileExists<IOdictionary>(io))
    {
        read(io);
        return;
    }
    refuseMisplaced(io);
    Info << "No bodies: there is no file constant/deformableBodies\n" << endl;
    system_.effects.declare("bodies", false, "no constant/deformableBodies");
    writeOpt() = IOobject::NO_WRITE;
}

void Foam::bodyCollection::refuseMisplaced(const IOobject& io) const
{
    const fileName other(fileWithOtherCapitals(io));
    if (other.empty()) return;
    FatalErrorInFunction
        << "there is no file "
        << (io.instance() / io.db().dbDir() / io.name()).c_str()
        << ", but a file " << other.c_str() << nl
        << "    Bodies are read from the first only: move the file, or take "
           "it away for a run without bodies" << exit(FatalError);
}

void Foam::bodyCollection::read(const IOobject& io)
{
    const fvMesh& mesh = system_.mesh;
    const IOdictionary dict(io);
    refuseDuplicates(dict, dict.filePath());
    for (const word& file : {io.name(), word("transportProperties")})
    {
        readAtStart_.append(new readOnceDictionary(mesh, mesh.time().constant(),
                                                   file, "the bodies go on"));
    }
    bodyReader reader(dict, system_);
    reader.read();
    state_.reset(new bodyState(system_, limits_, reader.given()));
    state_->read(dict);
    boxChecks_.reset(new boxChecks(mesh, system_.groups, *system_.markers,
                                   system_.interactions.get(),
                                   system_.between.get()));
    boxChecks_->checkStart(dict);
    statistics_.read(dict);
    output_.reset(
        new bodyOutput(system_, dict.getOrDefault<bool>("wrap", false)));
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
    if (lastMoved_ == -GREAT) return;
    system_.effects.printCost();
    if (output_) output_->finish();
}

void Foam::bodyCollection::advance(const surfaceScalarField& phi)
{
    const Time& time = system_.mesh.time();
    if (lastMoved_ == time.value()) return;
    limits_.usePimple();
    makeForceFlux();

    staggeredField force(system_.grid.box()), u(system_.grid.box());
    if (!empty() && !system_.withoutFluid && !system_.solverBalances)
    {
        checkStep(phi);
    }
    if (!empty()) system_.grid.toStaggered(phi, u);
    moveWithVelocity(u, force);
    if (!empty())
    {
        // How the solver treats diffusion is not known: by nu dt/h^2
        moveWithPrediction(velocityPrediction::ofLastStep(
            u,
            system_.grid.diffusionNumber(system_.largestViscosity(),
                                         time.deltaTValue()),
            force));
        if (mustStop()) return;
        system_.grid.toFlux(force, *forceFlux_);
    }
}

void Foam::bodyCollection::checkStep(const surfaceScalarField& phi)
{
    if (!stepLimits_)
    {
        stepLimits_.reset(new stepLimits(system_.mesh.time(), phi));
        stepLimits_->guard().expect(
            1, "bodies, which move with the velocity of the last step", true);
    }
    limits_.set(*stepLimits_);
    stepLimits_->setCourantNo(CourantGuard::CourantNo(phi));
    stepLimits_->check([&]() { trouble_.setDiverged(); });
    stepLimits_->checkEstimate(
        "bodies", system_.adjustsStep()
                      ? " (maxDeltaT in system/controlDict: this solver "
                        "adjusts its step without regard to bodies)"
                      : "");
}

void Foam::bodyCollection::makeForceFlux()
{
    if (forceFlux_.valid()) return;
    const fvMesh& mesh = system_.mesh;
    forceFlux_.reset(new surfaceScalarField(
        IOobject("bodyForceFlux", mesh.time().timeName(), mesh), mesh,
        dimensionedScalar(dimAcceleration * dimArea, Zero)));
    forceFlux_->setOriented();
}

Foam::tmp<Foam::volVectorField> Foam::bodyCollection::cellForce() const
{
    return fvc::reconstruct(*forceFlux_);
}

void Foam::bodyCollection::moveWithVelocity(const staggeredView& u,
                                            staggeredField& force)
{
    if (lastMoved_ == -GREAT)
    {
        limits_.describe();
        if (output_) output_->start();
    }
    lastMoved_ = system_.mesh.time().value();
    if (empty()) return;
    statistics_.begin();

    const auto timing(system_.effects.time("boxChecks"));
    system_.begin();
    if (output_->slipDue()) motion_.recordSlip(u);
    motion_.moveWithVelocity(u, force);
}

void Foam::bodyCollection::moveWithPrediction(const velocityPrediction& p)
{
    motion_.moveWithPrediction(p);
}

void Foam::bodyCollection::look()
{
    const scalar now = system_.mesh.time().value();
    if (trouble_.any || lastLooked_ == now) return;
    lastLooked_ = now;
    const auto timing(system_.effects.time("boxChecks"));
    const label here = boxChecks_->look(trouble_.sentence);
    const label worst = returnReduce(here, maxOp<label>());
    if (here < worst) trouble_.sentence.clear();
    trouble_.fate = boxChecks::fate(worst);
    trouble_.any = trouble_.fate != boxChecks::INSIDE;
}

void Foam::bodyCollection::endStep(const std::function<void()>& beforeStop)
{
    if (empty()) return;
    look();
    if (!mustStop())
    {
        if (system_.solverBalances) statistics_.end();
        output_->sample();
        boxChecks_->lookAtPairs();
        return;
    }
    beforeStop();
    stop();
}

void Foam::bodyCollection::stop()
{
    const Time& time = system_.mesh.time();
    const string sentence(firstOf(trouble_.sentence));
    const bool left = trouble_.fate == boxChecks::LEFT;
    const bool pressed = trouble_.fate == boxChecks::PRESSED;
    const char* what = left      ? "left the box"
                       : pressed ? "was pressed through a wall"
                                 : "diverged";
    string remedy("an earlier time with a smaller " + stepEntry(time));
    if (left) remedy = "\"outside remove;\" in its group";
    if (pressed)
        remedy +=
            string(system_.interactions
                       ? " and a larger strength of repulsion"
                       : " and interactions { repulsion { } }") +
            " (of fibres: collision), or \"outside remove;\" in its group";
    lastStep::writeBeforeStop(time, trouble_.outside() ? string() : sentence);
    waitForMaster();
    FatalErrorInFunction << "a body " << what << " at time " << time.timeName()
                         << ": " << sentence.c_str() << nl
                         << "    allowed: " << remedy.c_str() << nl
                         << "    Bodies are written to this time"
                         << exit(FatalError);
}

Foam::string Foam::bodyCollection::nearest(const point& x) const
{
    scalar least = GREAT;
    string name;
    for (const bodyGroup& group : system_.groups)
    {
        forAll(group.mine(), i)
        {
            const scalar apart =
                mag(nearestImage(system_.grid, group.centre(i), x));
            if (!(apart < least)) continue;
            least = apart;
            name = group.nameOfBody(group.mine()[i]);
        }
    }
    return firstOf(least == returnReduce(least, minOp<scalar>()) ? name
                                                                 : string());
}

Foam::bodyCollection::snapshot Foam::bodyCollection::save() const
{
    snapshot s;
    for (const bodyGroup& group : system_.groups)
    {
        s.numbers.append(group.mine());
        s.states.append(group.states());
    }
    if (!system_.interactions) return s;
    s.interactions = system_.interactions->memory();
    s.contactWork = system_.interactions->samples().work();
    return s;
}

void Foam::bodyCollection::restore(const snapshot& s)
{
    forAll(system_.groups, g)
    {
        bodyGroup& group = system_.groups[g];
        while (group.mine().size()) group.release(group.mine().size() - 1);
        forAll(s.numbers[g], i)
        {
            group.insert(s.numbers[g][i], s.states[g][i], dictionary::null);
        }
    }
    if (system_.interactions)
    {
        system_.interactions->remember(s.interactions);
        system_.interactions->samples().setWork(s.contactWork);
        system_.interactions->stepBack();
    }
    trouble_.clear();

    // Earlier than all times of the step
    const Time& time = system_.mesh.time();
    lastMoved_ = lastLooked_ = time.value() - time.deltaTValue();
}

bool Foam::bodyCollection::writeData(Ostream& os) const
{
    state_->write(os, trouble_.any && !trouble_.outside());
    if (system_.interactions) system_.interactions->outdate();
    output_->drawWritten();
    output_->lookAtErrors();
    system_.effects.write();
    return os.good();
}
