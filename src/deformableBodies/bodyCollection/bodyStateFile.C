// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyStateFile.H"
#include "caseFiles.H"
#include "fileOperation.H"
#include "IFstream.H"
#include "IOdictionary.H"

const Foam::word Foam::bodyStateFile::groups("deformableBodies");
const Foam::word Foam::bodyStateFile::allGroups("forAllGroups");
const Foam::word Foam::bodyStateFile::interactions("interactions");
const Foam::word Foam::bodyStateFile::diverged("diverged");

namespace
{
//- FatalError of all ranks
void refuseFile(const Foam::fileName& file, const Foam::string& why)
{
    using namespace Foam;
    FatalErrorInFunction
        << "file " << file.c_str() << ' ' << why.c_str() << nl
        << "    allowed: what a run has written to "
        << "it, an earlier time to start from, or restart initial in "
        << "constant/deformableBodies" << exit(FatalError);
}
} // namespace

bool Foam::bodyStateFile::reserved(const word& name)
{
    return name == groups || name == allGroups || name == interactions ||
           name == diverged;
}

bool Foam::bodyStateFile::read(const fvMesh& mesh, dictionary& saved,
                               fileName& file)
{
    const Time& time = mesh.time();
    const IOobject io("deformableBodies", time.timeName(), "uniform", mesh,
                      IOobject::MUST_READ, IOobject::NO_WRITE, false);

    // In the first rank's directory, or that of the undecomposed case
    file = fileHandler().filePath(true, io, IOdictionary::typeName);
    if (file.empty())
    {
        file = time.globalPath() / time.timeName() / mesh.dbDir() / "uniform" /
               io.name();
    }
    Pstream::scatter(file);
    bool found = false;
    string text;
    if (Pstream::master())
    {
        IFstream is(file);
        found = is.good();
        if (found)
        {
            text =
                std::string(std::istreambuf_iterator<char>(is.stdStream()), {});
        }
    }
    Pstream::scatter(found);
    if (!found) return false;

    const bool own = text.find("FoamFile") != string::npos &&
                     text.find("deformableBodies") != string::npos &&
                     text.find("decomposedBlockData") == string::npos;
    if (!returnReduce(own || !Pstream::master(), andOp<bool>()))
    {
        refuseFile(
            file,
            "is no state of bodies: it was not written by deformableBodies");
    }
    string wrong(wrongBrackets(text));
    Pstream::scatter(wrong);
    if (!wrong.empty()) refuseFile(file, "is damaged: " + wrong);
    if (Pstream::master())
    {
        IFstream is(file);
        saved = dictionary(is);
    }

    // All ranks need the dictionary, for their checks and messages
    Pstream::scatter(saved);
    saved.name() = file;
    return true;
}
