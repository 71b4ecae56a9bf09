// This file is part of deformableBodies. License: GPL-3.0-or-later.
/*
Application
    seedBodies

Description
    Finds where the bodies of a case are at the start, ahead of the run, and writes
    it: for each group with the entry placement a file constant/<group>Places with
    positions and directions, to be included in place of that entry.

Usage
    \verbatim
    seedBodies
    \endverbatim

    and then in the group of constant/deformableBodies, in place of placement {...}:
    \verbatim
    #include "cellsPlaces"
    \endverbatim
*/

#include "fvCFD.H"
#include "bodyCollection.H"
#include "OFstream.H"

int main(int argc, char* argv[])
{
    Foam::argList::addNote("Writes where the bodies of a case are at the start:"
                           " constant/<group>Places for each group with the"
                           " entry placement.");
    Foam::argList::noParallel();
    #include "setRootCase.H"
    #include "createTime.H"
    #include "createMesh.H"

    // The scales of the flow are those of the solver
    const IOobject ofU("U", runTime.timeName(), mesh, IOobject::MUST_READ);
    autoPtr<volVectorField> U;
    if (IOobject(ofU).typeHeaderOk<volVectorField>(true))
    {
        U.reset(new volVectorField(ofU, mesh));
    }
    const bodyCollection bodies(mesh, true);
    label nFiles = 0;
    for (const bodyGroup& group : bodies.system().groups)
    {
        if (!group.start().atRandom) continue;
        const fileName file(runTime.constantPath() / mesh.dbDir() /
                            group.name() + "Places");
        OFstream os(file);
        os.precision(17);
        os << "// Where the bodies of group " << group.name()
           << " are at the start, by seedBodies" << nl << nl;
        os.writeEntry("positions", group.start().positions);
        os.writeEntry("directions", group.start().directions);
        if (!os.good())
        {
            FatalErrorInFunction << "cannot write " << file.c_str()
                                 << exit(FatalError);
        }
        ++nFiles;
        Info << "Written: " << runTime.relativePath(file).c_str()
             << ", to be included in place of placement" << nl;
    }
    if (!nFiles)
    {
        FatalErrorInFunction
            << "no group of constant/deformableBodies has an entry placement"
            << nl << "    allowed: such as placement { type random; number 20; }"
            << exit(FatalError);
    }
    Info << nl << "End" << nl << endl;
    return 0;
}
