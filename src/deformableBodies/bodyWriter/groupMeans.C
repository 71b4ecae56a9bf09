// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "groupMeans.H"
#include "axialMean.H"

Foam::groupMeans::groupMeans(autoPtr<OFstream>&& file,
                             const std::vector<bodyColumn>& columns)
    : file_(std::move(file))
{
    std::string names("# time number"), units("# [s] [1]");
    for (const bodyColumn& c : columns)
    {
        names += " " + c.name + " " + c.name + "Deviation";
        units += " [" + c.unit + "] [" + c.unit + "]";
        angles_.append(c.unit == "degrees");
    }
    file_() << names.c_str() << nl << units.c_str() << endl;
    file_().precision(10);
}

void Foam::groupMeans::write(const scalar time, const List<scalarList>& rows)
{
    DynamicList<const scalarList*> bodies;
    for (const scalarList& row : rows)
    {
        if (row.size()) bodies.append(&row);
    }
    const scalar n = bodies.size();
    if (n == 0) return;
    file_() << time << ' ' << n;
    forAll(angles_, c)
    {
        scalar mean = 0, squares = 0;
        axialMean lines;
        for (const scalarList* row : bodies)
        {
            const axialMean line(axialMean::of((*row)[c]));
            lines.cosine += line.cosine / n;
            lines.sine += line.sine / n;
            mean += (*row)[c] / n;
        }
        for (const scalarList* row : bodies)
        {
            squares += sqr((*row)[c] - mean) / n;
        }
        file_() << ' ' << (angles_[c] ? lines.value() : mean) << ' '
                << (angles_[c] ? lines.deviation() : Foam::sqrt(squares));
    }
    file_() << endl;
}
