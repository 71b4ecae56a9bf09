// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyWriter.H"
#include "foamVtkSeriesWriter.H"
#include "foamVtkSurfaceWriter.H"
#include "IPstream.H"
#include "OPstream.H"
#include "OSspecific.H"
#include <fstream>
#include <iomanip>
#include <sstream>

Foam::bodyWriter::bodyWriter(const Time& time, const PtrList<bodyGroup>& groups,
                             effectLedger& effects)
    : time_(time),
      groups_(groups),
      effects_(effects),
      startTime_(time.value()),
      startIndex_(time.timeIndex())
{
    effects_.declare("samples", true, "postProcessing/bodies");
    effects_.declare("pictures", true, "VTK/bodies");
}

void Foam::bodyWriter::start()
{
    sample(startTime_);
    draw(startTime_, startIndex_);
}

void Foam::bodyWriter::sample(const scalar now)
{
    const auto timing(effects_.time("samples"));
    if (Pstream::master() && files_.empty())
    {
        const fileName dir(time_.globalPath() / "postProcessing" / "bodies" /
                           Time::timeName(time_.startTime().value()));
        mkDir(dir);
        files_.setSize(groups_.size());
        forAll(groups_, g)
        {
            files_.set(g, new OFstream(dir / groups_[g].name() + ".dat"));
            files_[g] << "# time body";
            for (const word& name : groups_[g].columns())
            {
                files_[g] << ' ' << name;
            }
            files_[g] << endl;
        }
    }

    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        const List<scalarList> rows(inOrder<scalarList>(
            group, [&](const label i) { return group.sample(i); }));
        forAll(rows, body)
        {
            std::ostringstream line;
            line << std::setprecision(10) << now << ' ' << body;
            for (const scalar x : rows[body])
            {
                line << ' ' << x;
            }
            files_[g] << line.str().c_str() << nl;
        }
        if (Pstream::master()) files_[g].flush();
    }
}

namespace Foam
{
// A surface travels as its points and fields; the faces are the same for all
// bodies of a group
static List<scalarField> packed(const bodySurface& s)
{
    List<scalarField> p;
    const auto add = [&](const vectorField& v)
    {
        for (direction d = 0; d < 3; ++d)
        {
            p.append(scalarField(v.component(d)));
        }
    };
    add(s.points);
    for (const vectorField& v : s.vectors)
    {
        add(v);
    }
    p.append(s.scalars);
    return p;
}
} // namespace Foam

// The writer of surfaces of OpenFOAM v1912 knows no lines; in this format they
// differ from polygons by name alone
static void polygonsToLines(const Foam::fileName& file)
{
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    std::string s(text.str());
    for (const std::string before : {"NumberOf", "<", "</"})
    {
        const auto at = s.find(before + "Polys");
        if (at != std::string::npos) s.replace(at + before.size(), 5, "Lines");
    }
    std::ofstream(file) << s;
}

// The first rank may have no body to know from how all of them are drawn
static void shareLayout(const Foam::bodyGroup& group, Foam::bodySurface& layout)
{
    using namespace Foam;
    label from = group.mine().size() ? Pstream::myProcNo() : labelMax;
    reduce(from, minOp<label>());
    if (from == Pstream::masterNo()) return;
    if (Pstream::myProcNo() == from)
    {
        OPstream os(Pstream::commsTypes::blocking, Pstream::masterNo());
        os << label(layout.lines) << layout.faces << layout.scalarNames
           << layout.vectorNames;
    }
    if (Pstream::master())
    {
        IPstream is(Pstream::commsTypes::blocking, from);
        label lines;
        is >> lines >> layout.faces >> layout.scalarNames >> layout.vectorNames;
        layout.lines = lines;
    }
}

void Foam::bodyWriter::draw(const scalar now, const label timeIndex)
{
    const auto timing(effects_.time("pictures"));
    const fileName dir(time_.globalPath() / "VTK" / "bodies");

    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        bodySurface layout;
        const List<List<scalarField>> bodies(
            inOrder<List<scalarField>>(group,
                                       [&](const label i)
                                       {
                                           layout = group.surface(i);
                                           return packed(layout);
                                       }));
        shareLayout(group, layout);
        if (!Pstream::master() || bodies.empty()) continue;

        const label nPoints = bodies[0][0].size();
        const label nAll = nPoints * bodies.size();
        const label nVectors = layout.vectorNames.size();
        const auto vectors = [&](const label first)
        {
            vectorField v(nAll);
            forAll(bodies, body)
            {
                for (label k = 0; k < nPoints; ++k)
                {
                    for (direction d = 0; d < 3; ++d)
                    {
                        v[body * nPoints + k][d] = bodies[body][first + d][k];
                    }
                }
            }
            return v;
        };

        const pointField points(vectors(0));
        DynamicList<face> faces;
        scalarField number(nAll);
        forAll(bodies, body)
        {
            for (face f : layout.faces)
            {
                for (label& p : f)
                {
                    p += body * nPoints;
                }
                faces.append(f);
            }
            SubField<scalar>(number, nPoints, body * nPoints) = scalar(body);
        }
        const faceList allFaces(std::move(faces));

        mkDir(dir);
        const fileName stem(dir / group.name() + "_" + Foam::name(timeIndex));
        {
            vtk::surfaceWriter writer(points, allFaces, stem, false);
            writer.setTime(instant(now, Time::timeName(now)));
            writer.writeTimeValue();
            writer.writeGeometry();
            writer.beginPointData(1 + nVectors + layout.scalarNames.size());
            writer.write("body", number);
            forAll(layout.vectorNames, v)
            {
                writer.write(layout.vectorNames[v], vectors(3 * (v + 1)));
            }
            forAll(layout.scalarNames, s)
            {
                scalarField values(nAll);
                forAll(bodies, body)
                {
                    SubField<scalar>(values, nPoints, body * nPoints) =
                        bodies[body][3 * (nVectors + 1) + s];
                }
                writer.write(layout.scalarNames[s], values);
            }
        }

        if (layout.lines) polygonsToLines(stem + ".vtp");

        // The series goes on after a restart
        const fileName seriesName(dir / group.name() + ".vtp");
        vtk::seriesWriter series;
        series.load(seriesName, true, now);
        series.append(now, stem + ".vtp");
        series.write(seriesName);
    }
}
