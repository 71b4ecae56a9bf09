// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The scene as groups know it: fluid, flow, gravity and likely time step

#include "bodyReader.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "uniformDimensionedFields.H"

Foam::bodyScene Foam::bodyReader::scene(const flowScales& flow) const
{
    const Time& time = system_.mesh.time();
    bodyScene scene{system_.grid,
                    system_.markers->kernel(),
                    flow,
                    system_.forces,
                    system_.placed,
                    system_.effects,
                    system_.firstLoads};
    scene.forceAtFaces = system_.solverBalances;
    scene.rho = system_.rho;
    scene.mu = system_.rho * system_.nu->value();
    scene.g = readGravity();
    scene.adjusted = system_.adjustsStep();
    scene.deltaT = largestDeltaT();
    scene.likelyDeltaT = likelyDeltaT(flow);
    scene.flowDeltaT = flowDeltaT();
    scene.startTime = time.startTime().value();
    scene.duration = time.endTime().value() - scene.startTime;
    scene.accuracy = system_.accuracy;
    scene.coupling = readCoupling(dict_, bodyCoupling::twoWay);
    scene.removesOutside = removesOutside(dict_, false);
    return scene;
}

Foam::vector Foam::bodyReader::readGravity() const
{
    const fvMesh& mesh = system_.mesh;
    const IOobject io("g", mesh.time().constant(), mesh, IOobject::MUST_READ,
                      IOobject::NO_WRITE, false);
    if (!fileExists<uniformDimensionedVectorField>(io)) return Zero;
    const uniformDimensionedVectorField g(io);
    checkDimensions(g, dimAcceleration);
    return g.value();
}

Foam::scalar Foam::bodyReader::largestDeltaT() const
{
    const Time& time = system_.mesh.time();
    if (!system_.adjustsStep()) return time.deltaTValue();
    return time.controlDict().getOrDefault<scalar>(
        "maxDeltaT", system_.solverBalances ? 0 : GREAT);
}

Foam::scalar Foam::bodyReader::likelyDeltaT(const flowScales& flow) const
{
    const scalar most = largestDeltaT(), byFlow = CourantDeltaT(flow, GREAT);
    return most > 0 ? min(most, byFlow) : byFlow;
}

Foam::scalar Foam::bodyReader::CourantDeltaT(const flowScales& flow,
                                             const scalar most) const
{
    if (!system_.adjustsStep() || flow.speed <= 0) return GREAT;
    const dictionary& control = system_.mesh.time().controlDict();
    return min(control.getOrDefault<scalar>("maxCo", 1), most) *
           cmptMin(system_.grid.h()) / flow.speed;
}

Foam::scalar Foam::bodyReader::flowDeltaT() const
{
    if (largestDeltaT() > 0) return 0;
    if (system_.flowDeltaT >= 0) return system_.flowDeltaT;
    const scalar rate = system_.flow.rate;
    scalar dt = system_.flow.speed > 0 ? CourantDeltaT(system_.flow, 0.5) : 0;
    if (rate > 0) dt = min(dt, 0.04 / rate);
    return system_.flowDeltaT = dt;
}
