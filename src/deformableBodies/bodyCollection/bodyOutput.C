// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Samples, pictures and restart files of the bodies, written by the first rank

#include "bodyCollection.H"
#include "foamVtkSeriesWriter.H"
#include "foamVtkSurfaceWriter.H"
#include "OSspecific.H"
#include "IFstream.H"
#include <fstream>
#include <iomanip>
#include <sstream>

template<class Type, class Get>
Foam::List<Type> Foam::bodyCollection::collect(const bodyGroup& group, Get get)
{
    List<List<Type>> all(Pstream::nProcs());
    List<Type>& own = all[Pstream::myProcNo()];
    own.setSize(group.mine().size());
    forAll(own, i)
    {
        own[i] = get(i);
    }
    Pstream::gatherList(all);

    List<Type> ordered;
    if (Pstream::master())
    {
        ordered.setSize(group.nBodies());
        for (label body = 0; body < group.nBodies(); ++body)
        {
            ordered[body] =
                all[body % Pstream::nProcs()][body / Pstream::nProcs()];
        }
    }
    return ordered;
}

void Foam::bodyCollection::sample(const scalar now)
{
    const Time& time = mesh_.time();
    if (Pstream::master() && files_.empty())
    {
        const fileName dir(time.globalPath() / "postProcessing" / "bodies" /
                           Time::timeName(time.startTime().value()));
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
        const List<scalarList> rows(collect<scalarList>(
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

void Foam::bodyCollection::draw(const scalar now, const label timeIndex) const
{
    const fileName dir(mesh_.time().globalPath() / "VTK" / "bodies");

    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        bodySurface layout;
        const List<List<scalarField>> bodies(
            collect<List<scalarField>>(group,
                                       [&](const label i)
                                       {
                                           layout = group.surface(i);
                                           return packed(layout);
                                       }));
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

bool Foam::bodyCollection::writeData(Ostream& os) const
{
    // 17 digits carry a double exactly; the file is text whatever writeFormat
    std::ostringstream text;
    text << std::setprecision(17);
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        const List<scalarList> states(collect<scalarList>(
            group, [&](const label i) { return group.state(i); }));
        text << group.name() << "\n(\n";
        for (const scalarList& s : states)
        {
            text << '(';
            for (const scalar x : s)
            {
                text << x << ' ';
            }
            text << ")\n";
        }
        text << ");\n";
    }
    if (diverged_) text << "diverged true;\n";
    if (Pstream::master()) os << text.str().c_str();

    draw(mesh_.time().value(), mesh_.time().timeIndex());
    effects_.write();
    return os.good();
}

void Foam::bodyCollection::readState()
{
    const Time& time = mesh_.time();

    // The first rank's directory, or that of the undecomposed case
    fileName file(time.timePath() / "uniform" / "deformableBodies");
    if (!isFile(file))
    {
        file = time.globalPath() / time.timeName() / "uniform" /
               "deformableBodies";
    }
    dictionary saved;
    bool found = false;
    if (Pstream::master() && isFile(file))
    {
        IFstream is(file);
        saved = dictionary(is);
        found = true;
    }
    Pstream::scatter(found);
    if (!found)
    {
        if (time.value() > 0)
        {
            WarningInFunction
                << "no saved bodies (uniform/deformableBodies) for time "
                << time.timeName()
                << ": they start from constant/deformableBodies" << endl;
        }
        return;
    }
    Info << "Bodies continue from " << file << nl;

    // All ranks need the dictionary, for their checks and messages
    Pstream::scatter(saved);
    saved.name() = file;
    if (saved.getOrDefault<bool>("diverged", false))
    {
        FatalIOErrorInFunction(saved)
            << "this state was written because a body diverged" << nl
            << "    allowed: an earlier time to start from"
            << exit(FatalIOError);
    }

    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        const List<scalarList> states(
            saved.get<List<scalarList>>(group.name()));
        if (states.size() != group.nBodies())
        {
            FatalIOErrorInFunction(saved)
                << states.size() << " bodies in group " << group.name()
                << " where constant/deformableBodies has " << group.nBodies()
                << exit(FatalIOError);
        }
        forAll(group.mine(), i)
        {
            group.setState(i, states[group.mine()[i]], saved);
        }
    }
}
