// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyWriter.H"
#include "bodyPicture.H"
#include "caseFiles.H"
#include "foamVtkSeriesWriter.H"
#include "fvMesh.H"
#include "IPstream.H"
#include "OPstream.H"
#include "resultFile.H"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>

Foam::bodyWriter::bodyWriter(const fvMesh& mesh,
                             const PtrList<bodyGroup>& groups,
                             effectLedger& effects, const string& note,
                             const uniformGrid* wrapInto)
    : time_(mesh.time()),
      region_(mesh.dbDir()),
      pictures_(outputFolder(mesh, "postProcessing/VTK") / "bodies"),
      groups_(groups),
      effects_(effects),
      startTime_(time_.value()),
      startIndex_(time_.timeIndex()),
      wrapInto_(wrapInto)
{
    effects_.declare("samples", true, note);
    effects_.declare("pictures", true, "postProcessing/VTK/bodies");
}

void Foam::bodyWriter::start()
{
    sample(startTime_);
    draw(startTime_, startIndex_);
}

void Foam::bodyWriter::sample(const scalar now)
{
    const auto timing(effects_.time("samples"));
    List<List<scalarList>> rows(groups_.size());
    List<std::vector<bodyColumn>> columns(groups_.size());
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        columns[g] = group.report().columns();
        rows[g] = inOrder<scalarList>(group, [&](const label i)
                                      { return group.report().sample(i); });
        if (group.host() >= 0) addNuclei(columns, rows, g);
    }
    if (Pstream::master() && files_.empty())
    {
        files_.setSize(groups_.size());
        forAll(groups_, g)
        {
            files_.set(g, newResultFile(time_, region_ / "bodies",
                                        groups_[g].name() + ".dat"));
            std::string names("# time body"), units("# [s] [number]");
            for (const bodyColumn& c : columns[g])
            {
                names += " " + c.name;
                units += " [" + c.unit + "]";
            }
            files_[g] << names.c_str() << nl << units.c_str() << endl;
        }
    }

    for (label g = 0; Pstream::master() && g < groups_.size(); ++g)
    {
        std::string text;
        const auto add = [&](const char* format, const auto value)
        {
            char number[32];
            std::snprintf(number, sizeof(number), format, value);
            text += number;
        };
        forAll(rows[g], body)
        {
            if (rows[g][body].empty()) continue; // removed body
            add("%.10g", double(now));
            add(" %ld", long(body));
            for (const scalar x : rows[g][body])
            {
                add(" %.10g", double(x));
            }
            text += '\n';
        }
        files_[g].stdStream() << text << std::flush;
        log(groups_[g].name(), columns[g], rows[g]);
    }
}

// Position of a nucleus relative to the centre of its capsule, and its deformation D
void Foam::bodyWriter::addNuclei(List<std::vector<bodyColumn>>& columns,
                                 List<List<scalarList>>& rows,
                                 const label nuclei) const
{
    const label host = groups_[nuclei].host();
    const std::vector<bodyColumn>& all = columns[nuclei];
    size_t D = 0;
    while (D < all.size() && all[D].name != "D")
        ++D;
    for (const word axis : {"X", "Y", "Z"})
    {
        columns[host].push_back({"nucleus" + axis, "m"});
    }
    columns[host].push_back({"nucleusD", "1"});
    forAll(rows[host], body)
    {
        scalarList& row = rows[host][body];
        const scalarList& inside = rows[nuclei][body];
        if (row.empty()) continue;
        for (direction d = 0; d < 3; ++d)
        {
            row.append(inside.empty() ? 0 : inside[d] - row[d]);
        }
        row.append(inside.empty() || D == all.size() ? 0 : inside[D]);
    }
}

void Foam::bodyWriter::log(const word& name,
                           const std::vector<bodyColumn>& columns,
                           const List<scalarList>& rows)
{
    label n = 0;
    for (const scalarList& row : rows)
    {
        if (row.size()) ++n; // rows of removed bodies are empty
    }
    Info << "Bodies " << name << ": " << n;
    label k = 0;
    for (const bodyColumn& c : columns)
    {
        if (c.inLog && n > 0)
        {
            scalar least = GREAT, largest = -GREAT;
            for (const scalarList& row : rows)
            {
                if (row.empty()) continue;
                least = min(least, row[k]);
                largest = max(largest, row[k]);
            }
            char range[64];
            std::snprintf(range, sizeof(range),
                          largest > least ? " %.4g to %.4g" : " %.4g",
                          double(least), double(largest));
            Info << ", " << c.name << range;
        }
        ++k;
    }
    Info << nl;
}

// The layout is taken from a body. If the master has none, it receives the layout from the
// first rank that has one
static void shareLayout(const Foam::bodyGroup& group, Foam::bodySurface& layout)
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

Foam::bodySurface Foam::bodyWriter::surface(const bodyGroup& group,
                                            const label i) const
{
    bodySurface s(group.report().surface(i));
    if (!wrapInto_) return s;
    const vector L(wrapInto_->length());
    const vector position(group.centre(i) - wrapInto_->origin());
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

// Entries of a .vtp.series file before this time whose files exist. next: set to the number
// after the last file. vtk::seriesWriter::load would end the run if the file is damaged
static Foam::vtk::seriesWriter seriesBefore(const Foam::fileName& file,
                                            const Foam::scalar now,
                                            Foam::label* next = nullptr)
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
                        name, &time, &end) == 2 &&
            end > 0 && time < now - 1e-9 * mag(now) &&
            isFile(file.path() / name))
        {
            series.append(time, fileName(name));
            const char* number = std::strrchr(name, '_');
            if (next && number)
            {
                *next = max(*next, label(std::atol(number + 1)) + 1);
            }
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

// The time index restarts from 0 if <time>/uniform/time is missing
Foam::label Foam::bodyWriter::shift(const scalar now,
                                    const label timeIndex) const
{
    label next = 0;
    if (now <= 0) return next;
    forAll(groups_, g)
    {
        seriesBefore(pictures_ / groups_[g].name() + ".vtp.series", now, &next);
    }
    if (next <= timeIndex) return 0;
    Info << "VTK files are numbered from " << next << ", to keep earlier ones"
         << nl;
    return next - timeIndex;
}

void Foam::bodyWriter::draw(const scalar now, const label timeIndex)
{
    const auto timing(effects_.time("pictures"));
    const fileName& dir = pictures_;
    if (Pstream::master() && shift_ < 0) shift_ = shift(now, timeIndex);

    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        const labelList& local = group.mine();
        bodySurface layout;
        if (local.size()) layout = group.report().surface(0);
        const label nPoints =
            returnReduce(layout.points.size(), maxOp<label>());
        if (nPoints == 0) continue; // all bodies have been removed
        shareLayout(group, layout);
        List<labelList> ofRanks(Pstream::nProcs());
        ofRanks[Pstream::myProcNo()] = local;
        Pstream::gatherList(ofRanks);
        labelList owner(group.nBodies(), -1); // -1: removed body
        forAll(ofRanks, proci)
        {
            UIndirectList<label>(owner, ofRanks[proci]) = proci;
        }

        const fileName stem(dir / group.name() + "_" +
                            Foam::name(shift_ + timeIndex));
        std::unique_ptr<bodyPicture> picture;
        if (Pstream::master())
        {
            picture.reset(new bodyPicture(stem + ".vtp", now, layout));
        }

        // About 20,000 points per piece. Scheduled sends end when they are received, so that
        // no rank runs ahead of the master, which writes
        const label nPerPiece = max(label(1), 20000 / nPoints);
        label next = 0;
        for (label first = 0; first < owner.size(); first += nPerPiece)
        {
            const label end = min(first + nPerPiece, owner.size());
            DynamicList<label> which;
            DynamicList<bodyPicture::fields> some;
            for (; next < local.size() && local[next] < end; ++next)
            {
                which.append(local[next]);
                some.append(bodyPicture::pack(surface(group, next)));
            }
            if (!Pstream::master())
            {
                if (which.empty()) continue;
                OPstream os(Pstream::commsTypes::scheduled,
                            Pstream::masterNo());
                os << which << some;
                continue;
            }

            // The master's own bodies first
            DynamicList<label> numbers;
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
                    bodies[std::lower_bound(numbers.begin(), numbers.end(),
                                            which[k]) -
                           numbers.begin()]
                        .transfer(some[k]);
                }
            }
            if (numbers.size()) picture->write(numbers, bodies);
        }
        if (!Pstream::master()) continue;
        picture.reset();

        // Append to the series of earlier times
        const fileName seriesName(dir / group.name() + ".vtp");
        vtk::seriesWriter series(seriesBefore(seriesName + ".series", now));
        series.append(readScalar(Time::timeName(now)), stem + ".vtp");
        series.write(seriesName);
    }
}
