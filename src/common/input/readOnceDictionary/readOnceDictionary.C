// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "readOnceDictionary.H"
#include "fileOperation.H"
#include "Time.H"

// Registered with Time, so that it does not clash with a dictionary of the same name that
// is registered with the mesh and is read again
Foam::readOnceDictionary::readOnceDictionary(const objectRegistry& mesh,
                                             const fileName& instance,
                                             const word& name,
                                             const string& who)
    : IOdictionary(IOobject(name, instance, mesh.dbDir(), mesh.time(),
                            IOobject::MUST_READ_IF_MODIFIED,
                            IOobject::NO_WRITE)),
      who_(who)
{
    // Only the watch on the file is needed; the entries may be long lists
    clear();
}

bool Foam::readOnceDictionary::readIfModified()
{
    if (!modified()) return false;
    for (const label watch : watchIndices())
    {
        fileHandler().setUnmodified(watch);
    }
    if (!said_ && Pstream::master())
    {
        WarningInFunction
            << "file " << objectPath().c_str()
            << ", or a file that it includes, has changed: it is read at the "
            << "start only, and " << who_.c_str()
            << " with the old entries. Stop and restart from a written time "
            << "to use the new ones" << endl;
    }
    said_ = true;
    return false;
}
