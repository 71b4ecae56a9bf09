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
    Capsules move with the velocity of the last step; filaments and rigid bodies with one
    predicted within the step (in pimple with the last). Their force enters at the faces,
    where it is balanced against the pressure gradient.

    With -postProcess the bodies are drawn again from the states of the chosen times,
    in postProcessing/VTK/bodies, beside the output of the functionObjects.

    Without constant/deformableBodies it solves the flow alone; with flowAlgorithm pimple it
    is then pimpleFoam on a static mesh.

Usage
    \verbatim
    foamJob -wait deformableBodyFoam
    decomposePar; foamJob -parallel -wait deformableBodyFoam
    \endverbatim

    Fields U and p as for pimpleFoam; bodies as described in bodyCollection.H; the
    time step in stepLimits.H.
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
#include "lastStep.H"
#include "runProgress.H"
#include "sigFpe.H"
#include "fieldsWanted.H"
#include "pimpleState.H"
#include "staggeredStep.H"
#include "stepRetries.H"
#include "readOnceDictionary.H"
#include "printEnd.H"
#include "boxSides.H"

int main(int argc, char* argv[])
{
    argList::addNote("Transient solver for incompressible flow with deformable"
                     " bodies (capsules, filaments, rigid bodies) by the"
                     " immersed boundary method.");

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
    #include "initContinuityErrs.H"
    #include "createFields.H"
    #include "createBodies.H"
    #include "createFvOptions.H"
    #include "createFlow.H"
    #include "startLimits.H"
    #include "createRetries.H"

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
            bodies.limits().set(limits);
            limits.adjust(runTime);
            if (flows)
            {
                limits.check(fill);
                limits.checkEstimate("bodies");
                limits.checkEstimate("contacts");
            }

            ++runTime;

            Info<< "Time = " << runTime.timeName() << nl << endl;
        }

        {
            #include "takeStep.H"
        }

        {
            const auto timing(effects.time("output"));
            runTime.write();
            progress.print();
            runTime.printExecutionTime(Info);
        }
    }

    retries.printCount();
    printEnd(runTime);

    return 0;
}
