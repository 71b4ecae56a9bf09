// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "resultFile.H"
#include "functionObject.H"
#include "OSspecific.H"

namespace
{
using namespace Foam;

//- Rename a file that is there
void keepAside(const Time& time, const fileName& file)
{
    if (!isFile(file, false)) return;
    label n = 1;
    while (isFile(file + "." + Foam::name(n), false))
    {
        ++n;
    }
    const fileName kept(file + "." + Foam::name(n));
    mv(file, kept);
    Info << time.relativePath(file).c_str() << " of an earlier run is kept as "
         << kept.name() << endl;
}
} // namespace

Foam::autoPtr<Foam::OFstream>
Foam::newResultFile(const Time& time, const fileName& folder, const word& name)
{
    const fileName dir(time.globalPath() / "postProcessing" / folder /
                       Time::timeName(time.startTime().value()));
    mkDir(dir);
    const fileName file(dir / name);
    keepAside(time, file);
    if (!functionObject::postProcess)
    {
        keepLaterResults(time, folder, time.startTime().value(), name);
    }
    return autoPtr<OFstream>(new OFstream(file));
}

// Not by the file handler, which may want all ranks
void Foam::keepLaterResults(const Time& time, const fileName& folder,
                            const scalar last, const word& name)
{
    const fileName top(time.globalPath() / "postProcessing" / folder);
    for (const fileName& other : readDir(top, fileName::DIRECTORY))
    {
        scalar at;
        if (!readScalar(other.c_str(), at) || at <= last * (1 + SMALL))
        {
            continue;
        }
        for (const fileName& file : readDir(top / other, fileName::FILE))
        {
            if (name.empty() ? file.ext() == "dat" : file == name)
                keepAside(time, top / other / file);
        }
    }
}
