// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyOutput.H"
#include "functionTimes.H"
#include "fvc.H"

Foam::bodyOutput::bodyOutput(bodySystem& system, const bool wrap)
    : system_(system),
      writer_(system.mesh, system.groups, system.effects,
              "postProcessing/bodies, " +
                  (system.sampleInterval == 1
                       ? string("each step")
                       : "one step in " + Foam::name(system.sampleInterval)),
              wrap ? &system.grid : nullptr)
{
    const fvMesh& mesh = system.mesh;
    if (isNamed("bodyForce", mesh.time()))
    {
        forceField_.reset(new volVectorField(
            IOobject("bodyForce", mesh.time().timeName(), mesh), mesh,
            dimensionedVector(dimForce / dimVolume, Zero)));
    }
}

Foam::tmp<Foam::volVectorField> Foam::bodyOutput::force() const
{
    const fvMesh& mesh = system_.mesh;
    staggeredField faces(system_.grid.box());
    system_.spreadLoads(faces);
    surfaceScalarField flux(
        IOobject("bodyForceFlux", mesh.time().timeName(), mesh), mesh,
        dimensionedScalar(dimForce / dimVolume * dimArea, Zero));
    flux.setOriented();
    system_.grid.toFlux(faces, flux);
    return fvc::reconstruct(flux);
}

void Foam::bodyOutput::start()
{
    writer_.start();
    if (!system_.contrast) system_.nu->compare(system_.groups);
}

void Foam::bodyOutput::sample()
{
    const Time& time = system_.mesh.time();
    if (forceField_ && isLookedAt("bodyForce", time)) *forceField_ = force();
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
    if (forceField_) *forceField_ = force();
    drawWritten();
}

void Foam::bodyOutput::drawWritten()
{
    const Time& time = system_.mesh.time();
    writer_.draw(time.value(), time.timeIndex());
}

void Foam::bodyOutput::finish() const
{
    Info << "Error indicators at the end (largest over the bodies)" << nl;
    for (const bodyGroup& group : system_.groups)
    {
        judgeIndicators(group.name(), group.report().indicators());
    }
    Info << endl;
    if (system_.interactions) system_.interactions->judge();
    if (Pstream::parRun())
    {
        Info << "Bodies handed over between ranks: "
             << system_.ownership->handedOver() << nl << endl;
    }
}
