// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "groupMeans.H"

Foam::groupMeans::groupMeans(autoPtr<OFstream>&& file,
                             const std::vector<bodyColumn>& columns)
    : file_(std::move(file))
{
    std::string names("# time number"), units("# [s] [1]");
    for (const bodyColumn& c : columns)
    {
        names += " " + c.name + " " + c.name + "Deviation";
        units += " [" + c.unit + "] [" + c.unit + "]";
    }
    file_() << names.c_str() << nl << units.c_str() << endl;
    file_().precision(10);
}

void Foam::groupMeans::write(const scalar time, const List<scalarList>& rows)
{
    scalarField sum, squares;
    scalar n = 0;
    for (const scalarList& row : rows)
    {
        if (row.empty()) continue;
        sum.setSize(row.size(), Zero);
        sum += row;
        ++n;
    }
    if (n == 0) return;
    sum /= n;
    squares.setSize(sum.size(), Zero);
    for (const scalarList& row : rows)
    {
        if (row.size()) squares += sqr(scalarField(row) - sum);
    }
    file_() << time << ' ' << n;
    forAll(sum, c)
    {
        file_() << ' ' << sum[c] << ' ' << Foam::sqrt(squares[c] / n);
    }
    file_() << endl;
}
