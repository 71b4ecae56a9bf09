// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactSamples.H"
#include "resultFile.H"
#include "Time.H"

void Foam::contactSamples::write(const scalar closestHere,
                                 const label nPairsHere)
{
    const scalar closest = returnReduce(closestHere, minOp<scalar>());
    const label pairs = returnReduce(nPairsHere, sumOp<label>()) / 2;
    const scalar power = returnReduce(power_, sumOp<scalar>());
    const scalar work = returnReduce(work_, sumOp<scalar>());
    if (!Pstream::master()) return;
    if (!file_.valid())
    {
        file_ = newResultFile(time_, fileName(region_) / "interactions",
                              "interactions.dat");
        file_() << "# time closest pairs power work" << nl
                << "# [s] [m] [1] [W] [J]" << endl;
        file_().precision(10);
    }
    file_() << time_.value() << ' ' << (closest < GREAT ? closest : 0) << ' '
            << pairs << ' ' << power << ' ' << work << endl;
}
