// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyOutput.H"
#include "functionTimes.H"
#include "fvc.H"
#include <algorithm>

Foam::bodyOutput::bodyOutput(bodySystem& system, const bool wrap)
    : system_(system),
      writer_(system.mesh, system.groups, system.effects,
              "postProcessing/bodies, " +
                  (system.sampleInterval == 1
                       ? string("each step")
                       : "one step in " + Foam::name(system.sampleInterval)),
              wrap ? &system.grid : nullptr)
{
    addForceField("bodyForce", identity(system.groups.size()));
    forAll(system.groups, g)
    {
        addForceField("bodyForce." + system.groups[g].name(), labelList(1, g));
    }
}

void Foam::bodyOutput::addForceField(const word& name, const labelList& groups)
{
    const fvMesh& mesh = system_.mesh;
    if (!isNamed(name, mesh.time())) return;
    forceFields_.push_back({groups, nullptr});
    forceFields_.back().field.reset(
        new volVectorField(IOobject(name, mesh.time().timeName(), mesh), mesh,
                           dimensionedVector(dimForce / dimVolume, Zero)));
}

Foam::tmp<Foam::volVectorField>
Foam::bodyOutput::force(const labelUList& groups) const
{
    const fvMesh& mesh = system_.mesh;
    staggeredField faces(system_.grid.box());
    system_.spreadLoads(groups, faces);
    surfaceScalarField flux(
        IOobject("bodyForceFlux", mesh.time().timeName(), mesh), mesh,
        dimensionedScalar(dimForce / dimVolume * dimArea, Zero));
    flux.setOriented();
    system_.grid.toFlux(faces, flux);
    return fvc::reconstruct(flux);
}

bool Foam::bodyOutput::slipDue() const
{
    return sampleDue() ||
           std::any_of(samplers_.begin(), samplers_.end(),
                       [](const std::function<bool()>& due) { return due(); });
}

void Foam::bodyOutput::start()
{
    writer_.start();
    if (!system_.contrast) system_.nu->compare(system_.groups);
}

void Foam::bodyOutput::sample()
{
    const Time& time = system_.mesh.time();
    for (const forceField& f : forceFields_)
    {
        if (isDueFor(f.field->name(), time)) *f.field = force(f.groups);
    }
    if (!sampleDue() || lastSampled_ == stepIndex(time)) return;

    lastSampled_ = stepIndex(time);
    writer_.sample(time.value());
    if (!system_.contrast) system_.nu->compare(system_.groups);
    if (system_.interactions) system_.interactions->sample();
}

void Foam::bodyOutput::draw()
{
    system_.ownership->migrate(system_.groups);
    if (system_.interactions) system_.interactions->update();
    for (bodyGroup& group : system_.groups)
    {
        // Pictures show the markers
        vectorField X(group.nMarkers());
        group.placeMarkers(X.data(), 0);
    }
    for (const forceField& f : forceFields_)
    {
        *f.field = force(f.groups);
    }
    drawWritten();
}

void Foam::bodyOutput::drawWritten()
{
    const Time& time = system_.mesh.time();
    writer_.draw(time.value(), time.timeIndex());
}

void Foam::bodyOutput::lookAtErrors(const bool atEnd)
{
    for (const bodyGroup& group : system_.groups)
    {
        checkIndicators(group.name(), group.report().indicators(),
                        system_.mesh.time().value(), atEnd, warned_);
    }
}

void Foam::bodyOutput::finish()
{
    Info << "Error indicators at the end (largest over the bodies)" << nl;
    lookAtErrors(true);
    Info << endl;
    if (system_.interactions) system_.interactions->reportOverlaps();
    if (Pstream::parRun())
    {
        Info << "Bodies handed over between ranks: "
             << system_.ownership->handedOver() << nl << endl;
    }
}
