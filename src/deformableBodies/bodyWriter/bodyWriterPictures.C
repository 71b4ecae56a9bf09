// This file is part of deformableBodies. License: GPL-3.0-or-later.

// VTK files of the bodies, and their series

#include "bodyPicture.H"
#include "bodyWriter.H"
#include "foamVtkSeriesWriter.H"
#include "functionObject.H"
#include "IPstream.H"
#include "OPstream.H"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>

namespace
{
// The layout is taken from a body. If the master has none, it receives the layout from the
// first rank that has one
void shareLayout(const Foam::bodyGroup& group, Foam::bodySurface& layout)
{
    using namespace Foam;
    label from = group.mine().size() ? Pstream::myProcNo() : labelMax;
    reduce(from, minOp<label>());
    if (from == Pstream::masterNo()) return;
    if (Pstream::myProcNo() == from)
    {
        OPstream os(Pstream::commsTypes::scheduled, Pstream::masterNo());
        os << label(layout.lines) << layout.faces << layout.scalarNames
           << layout.vectorNames;
    }
    if (Pstream::master())
    {
        IPstream is(Pstream::commsTypes::scheduled, from);
        label lines;
        is >> lines >> layout.faces >> layout.scalarNames >> layout.vectorNames;
        layout.lines = lines;
    }
}

// Entries of a .vtp.series file before this time, in -postProcess also after it, whose files
// exist. next: set to the number after the last file; same: to the file of this time.
// vtk::seriesWriter::load would end the run if the file is damaged
Foam::vtk::seriesWriter seriesWithout(const Foam::fileName& file,
                                      const Foam::scalar now,
                                      Foam::label* next = nullptr,
                                      Foam::fileName* same = nullptr)
{
    using namespace Foam;
    vtk::seriesWriter series;
    std::ifstream is(file);
    bool complete = !is;
    for (std::string line; std::getline(is, line);)
    {
        char name[256];
        double time;
        int end = 0;
        complete = line == "}";
        if (std::sscanf(line.c_str(),
                        " { \"name\" : \"%255[^\"/]\", \"time\" : %lf }%n",
                        name, &time, &end) != 2 ||
            end == 0 || !isFile(file.path() / name))
        {
            continue;
        }
        const scalar after = time - now, margin = 1e-9 * mag(now);
        if (same && mag(after) <= margin) *same = name;
        if (after >= -margin &&
            (!functionObject::postProcess || after <= margin))
        {
            continue;
        }
        series.append(time, fileName(name));
        const char* number = std::strrchr(name, '_');
        if (next && number)
        {
            *next = max(*next, label(std::atol(number + 1)) + 1);
        }
    }
    if (!complete && !next)
    {
        WarningInFunction << "file " << file.c_str()
                          << " is damaged: the series starts again with what "
                          << "can be read of it" << endl;
    }
    return series;
}

// Rank of each body of a group, -1 for removed bodies, on the master
Foam::labelList ranksOfBodies(const Foam::bodyGroup& group)
{
    using namespace Foam;
    List<labelList> ofRanks(Pstream::nProcs());
    ofRanks[Pstream::myProcNo()] = group.mine();
    Pstream::gatherList(ofRanks);
    labelList owner(group.nBodies(), -1);
    forAll(ofRanks, proci)
    {
        UIndirectList<label>(owner, ofRanks[proci]) = proci;
    }
    return owner;
}

using numbersOfBodies = Foam::DynamicList<Foam::label>;
using dataOfBodies = Foam::DynamicList<Foam::bodyPicture::fields>;

// Write the bodies first to end - 1. owner: see ranksOfBodies(); which, some: numbers and data
// of the master's own ones, replaced by those of other ranks
void writePiece(Foam::bodyPicture& picture, const Foam::labelList& owner,
                const Foam::label first, const Foam::label end,
                numbersOfBodies& which, dataOfBodies& some)
{
    using namespace Foam;
    numbersOfBodies numbers;
    for (label body = first; body < end; ++body)
    {
        if (owner[body] >= 0) numbers.append(body);
    }
    std::set<label> owners(owner.begin() + first, owner.begin() + end);
    owners.erase(-1);
    List<bodyPicture::fields> bodies(numbers.size());
    for (const label proci : owners)
    {
        if (proci != Pstream::masterNo())
        {
            IPstream is(Pstream::commsTypes::scheduled, proci);
            is >> which >> some;
        }
        forAll(which, k)
        {
            bodies[std::lower_bound(numbers.begin(), numbers.end(), which[k]) -
                   numbers.begin()]
                .transfer(some[k]);
        }
    }
    if (numbers.size()) picture.write(numbers, bodies);
}
} // namespace

Foam::bodySurface Foam::bodyWriter::surface(const bodyGroup& group,
                                            const label i) const
{
    bodySurface s(group.report().surface(i));
    if (!wrapInto_) return s;
    const vector L(wrapInto_->length());
    // A nucleus stays in its capsule, which is on this rank
    const bodyGroup& whole = group.host() < 0 ? group : groups_[group.host()];
    const label k = group.host() < 0 ? i : whole.mine().find(group.mine()[i]);
    const vector position(whole.centre(k) - wrapInto_->origin());
    for (direction d = 0; d < 3; ++d)
    {
        if (!wrapInto_->periodic(d)) continue;
        const scalar shift = L[d] * std::floor(position[d] / L[d]);
        for (point& x : s.points)
        {
            x[d] -= shift;
        }
    }
    return s;
}

// The time index restarts from 0 if <time>/uniform/time is missing
Foam::label Foam::bodyWriter::shift(const scalar now,
                                    const label timeIndex) const
{
    label next = 0;
    if (now <= 0) return next;
    forAll(groups_, g)
    {
        seriesWithout(pictures_ / groups_[g].name() + ".vtp.series", now,
                      &next);
    }
    if (next <= timeIndex) return 0;
    if (!functionObject::postProcess)
        Info << "VTK files are numbered from " << next
             << ", to keep earlier ones" << nl;
    return next - timeIndex;
}

// The file has pieces of about 20,000 points. Scheduled sends end when they are received, so
// that no rank runs ahead of the master, which writes
void Foam::bodyWriter::write(const bodyGroup& group, const fileName& stem,
                             const scalar now, const bodySurface& layout,
                             const label nPoints) const
{
    const labelList owner(ranksOfBodies(group));
    const labelList& local = group.mine();
    std::unique_ptr<bodyPicture> picture;
    if (Pstream::master())
    {
        picture.reset(new bodyPicture(stem + ".vtp", now, layout));
    }
    const label nPerPiece = max(label(1), 20000 / nPoints);
    label next = 0;
    for (label first = 0; first < owner.size(); first += nPerPiece)
    {
        const label end = min(first + nPerPiece, owner.size());
        numbersOfBodies which;
        dataOfBodies some;
        for (; next < local.size() && local[next] < end; ++next)
        {
            which.append(local[next]);
            some.append(bodyPicture::pack(surface(group, next)));
        }
        if (Pstream::master())
        {
            writePiece(*picture, owner, first, end, which, some);
        }
        else if (which.size())
        {
            OPstream os(Pstream::commsTypes::scheduled, Pstream::masterNo());
            os << which << some;
        }
    }
}

void Foam::bodyWriter::draw(const scalar now, const label timeIndex)
{
    const auto timing(effects_.time("pictures"));
    if (Pstream::master() && shift_ < 0) shift_ = shift(now, timeIndex);

    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        bodySurface layout;
        if (group.mine().size()) layout = group.report().surface(0);
        const label nPoints =
            returnReduce(layout.points.size(), maxOp<label>());
        if (nPoints == 0) continue; // all bodies have been removed
        shareLayout(group, layout);
        fileName stem(pictures_ / group.name() + "_" +
                      Foam::name(shift_ + timeIndex));
        const fileName seriesName(pictures_ / group.name() + ".vtp");
        vtk::seriesWriter series;
        if (Pstream::master())
        {
            fileName same;
            series = seriesWithout(seriesName + ".series", now, nullptr, &same);
            if (functionObject::postProcess && !same.empty())
            {
                stem = pictures_ / same.lessExt();
            }
        }
        write(group, stem, now, layout, nPoints);
        if (!Pstream::master()) continue;

        // Add to the series of other times
        series.append(readScalar(Time::timeName(now)), stem + ".vtp");
        series.sort();
        series.write(seriesName);
    }
}
