// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Start times that were not written to their end

#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "fileOperation.H"
#include "polyMesh.H"
#include "Time.H"

void Foam::requireFinishedTime(const polyMesh& mesh, const wordList& fields,
                               const wordList& optional)
{
    const Time& time = mesh.time();
    if (time.value() <= 0) return;
    string missing;
    wordList all(fields);
    all.append(optional);
    forAll(all, i)
    {
        const IOobject io(all[i], time.timeName(), mesh, IOobject::MUST_READ,
                          IOobject::NO_WRITE, false);
        const bool found =
            !fileHandler().filePath(false, io, "volVectorField", false).empty();
        const bool any = returnReduce(found, orOp<bool>());
        if (!found && (any || i < fields.size())) missing = io.objectPath();
    }
    missing = firstOf(missing);
    if (missing.empty()) return;

    wordList times;
    for (const instant& t : time.times())
    {
        if (t.name() != time.constant()) times.append(t.name());
    }
    if (!times.found(time.timeName()))
    {
        refuse(time.controlDict(), "startTime", time.timeName(),
               "existing times, " + oneOf(times));
    }
    FatalErrorInFunction
        << "time " << time.timeName() << " is unfinished, as there is no file "
        << missing.c_str() << nl
        << "    The run may have been killed while it wrote. Delete the folder "
        << time.timeName() << (Pstream::parRun() ? " of all processors" : "")
        << ", or start from an earlier time" << exit(FatalError);
}
