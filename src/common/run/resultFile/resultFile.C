// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "resultFile.H"
#include "OSspecific.H"

Foam::autoPtr<Foam::OFstream>
Foam::newResultFile(const Time& time, const fileName& folder, const word& name)
{
    const fileName dir(time.globalPath() / "postProcessing" / folder /
                       Time::timeName(time.startTime().value()));
    mkDir(dir);
    const fileName file(dir / name);
    if (isFile(file, false))
    {
        label n = 1;
        while (isFile(file + "." + Foam::name(n), false))
        {
            ++n;
        }
        const fileName kept(file + "." + Foam::name(n));
        mv(file, kept);
        Info << time.relativePath(file).c_str()
             << " of an earlier run is kept as " << kept.name() << endl;
    }
    return autoPtr<OFstream>(new OFstream(file));
}
