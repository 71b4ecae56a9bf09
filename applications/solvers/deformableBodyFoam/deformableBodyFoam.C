// This file is part of deformableBodies. License: GPL-3.0-or-later.
/*
Application
    deformableBodyFoam

Description
    Incompressible viscous flow that carries deformable bodies, coupled by the
    immersed boundary method. Derived from pimpleFoam, on a static mesh:

        ddt(U) + div(phi, U) - div(nu grad(U)) = -grad(p) + f

    Two flow algorithms, PIMPLE { flowAlgorithm auto; } in fvSolution:
      staggered  on uniform boxes, laminar: see staggeredFlow.H
      pimple     as pimpleFoam: any mesh, any condition, turbulence models
      auto       staggered where it can, else pimple; the log says why
    Capsules move with the velocity of the last step, filaments with one predicted
    within the step (in pimple with the last); they act at the faces, where their
    force is balanced against the pressure gradient.

    With -postProcess the bodies are drawn again from the states of the times chosen, in
    postProcessing/VTK/bodies, beside what the functionObjects do.

    Without constant/deformableBodies it is pimpleFoam on a static mesh.

Usage
    \verbatim
    foamJob -wait deformableBodyFoam
    decomposePar; foamJob -parallel -wait deformableBodyFoam
    \endverbatim

    Fields U and p as for pimpleFoam; bodies as described in bodyCollection.H.
*/

#include "fvCFD.H"
#include "singlePhaseTransportModel.H"
#include "turbulentTransportModel.H"
#include "pimpleControl.H"
#include "fvOptions.H"
#include "bodyCollection.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "flowAlgorithm.H"
#include "flowSources.H"
#include "lastStep.H"
#include "fieldsWanted.H"
#include "runProgress.H"
#include "sigFpe.H"
#include "startDictionary.H"
#include "stepGuard.H"
#include "printTraffic.H"

int main(int argc, char* argv[])
{
    argList::addNote("Transient solver for incompressible flow with deformable"
                     " bodies (capsules, filaments) by the immersed boundary"
                     " method.");

    #define CREATE_FIELDS_2 drawBodies.H
    #include "postProcess.H"

    argList::addBoolOption("dry-run", "Read and judge the case, on its own mesh,"
                                      " and take no step");
    #include "setRootCaseLists.H"
    #include "createTime.H"
    #include "createNamedMesh.H"
    #include "checkTime.H"
    #include "refuseDynamicMesh.H"
    #include "createControl.H"
    #include "createTimeControls.H"
    #include "initContinuityErrs.H"
    #include "createFields.H"
    #include "createBodies.H"
    #include "createFvOptions.H"
    #include "createFlow.H"
    #include "createGuard.H"
    scalar CoNum = 0;
    if (adjustTimeStep && lastStep::read(runTime) > 0)
    {
        runTime.setDeltaT(lastStep::read(runTime), false);
    }
    #include "flowCourantNo.H"
    #include "printLimits.H"
    if (adjustTimeStep)
    {
        #include "setInitialDeltaT.H"
        #include "flowCourantNo.H"
    }
    else
    {
        #include "checkCourantNo.H"
    }

    if (args.found("dry-run"))
    {
        #include "endDryRun.H"
        return 0;
    }

    Info<< "\nStarting time loop\n" << endl;

    while (runTime.run())
    {
        {
            const auto timing(effects.time("timeStep"));
            #include "readTimeControls.H"
            #include "setBodyDeltaT.H"
            #include "checkCourantNo.H"

            ++runTime;

            Info<< "Time = " << runTime.timeName() << nl << endl;
        }

        if (bodies.alone())
        {
            bodies.advance(phi);
        }
        else if (staggered)
        {
            #include "staggeredStep.H"
        }
        else
        {
            #include "pimpleStep.H"
        }

        {
            const auto timing(effects.time("output"));
            runTime.write();
            progress.print();
            runTime.printExecutionTime(Info);
        }
    }

    if (runTime.timeIndex() == runTime.startTimeIndex())
    {
        Info<< "No step was taken: it starts at " << runTime.timeName()
            << ", endTime is " << runTime.endTime().value() << ", deltaT "
            << runTime.deltaTValue() << nl << endl;
    }
    else if (!runTime.writeTime())
    {
        Info<< "Not written: the last time, " << runTime.timeName()
            << ", which is no write time (writeControl, writeInterval)" << nl
            << endl;
    }
    printTraffic(runTime);

    Info<< "End\n" << endl;

    return 0;
}
