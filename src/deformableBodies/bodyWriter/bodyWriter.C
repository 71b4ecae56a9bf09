// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyWriter.H"
#include "caseFiles.H"
#include "fvMesh.H"
#include "resultFile.H"
#include <cstdio>

Foam::bodyWriter::bodyWriter(const fvMesh& mesh,
                             const PtrList<bodyGroup>& groups,
                             effectTable& effects, const string& note,
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
        means_.setSize(groups_.size());
        forAll(groups_, g)
        {
            if (groups_[g].nBodies() > 1)
            {
                means_.set(
                    g, new groupMeans(
                           newResultFile(time_, region_ / "bodyMeans",
                                         groups_[g].name() + ".dat"),
                           columns[g]));
            }
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

    const int digits = max(10u, IOstream::defaultPrecision());
    for (label g = 0; Pstream::master() && g < groups_.size(); ++g)
    {
        std::string text;
        const auto add = [&](const scalar value, const int precision)
        {
            char number[32];
            std::snprintf(number, sizeof(number), "%.*g", precision, double(value));
            text += number;
        };
        forAll(rows[g], body)
        {
            if (rows[g][body].empty()) continue; // removed body
            add(now, 10);
            text += ' ' + std::to_string(body);
            for (const scalar x : rows[g][body])
            {
                text += ' ';
                add(x, digits);
            }
            text += '\n';
        }
        files_[g].stdStream() << text << std::flush;
        if (means_.set(g)) means_[g].write(now, rows[g]);
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
