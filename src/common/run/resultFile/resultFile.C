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
        // Not by the file handler, which may want all ranks
        const scalar start = time.startTime().value();
        for (const fileName& other : readDir(dir.path(), fileName::DIRECTORY))
        {
            scalar began;
            if (!readScalar(other.c_str(), began)) continue;
            if (began > start * (1 + SMALL))
                keepAside(time, dir.path() / other / name);
        }
    }
    return autoPtr<OFstream>(new OFstream(file));
}
