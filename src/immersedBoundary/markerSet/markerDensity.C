// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Line density, and pairs of markers of different lines that are close

#include "markerBins.H"
#include "segmentDistance.H"

constexpr Foam::scalar Foam::markerSet::lineReach;

// A line also counts as folded if its periodic images are within reach
Foam::scalarField Foam::markerSet::linesHere(const UList<vector>& X,
                                             const labelUList& line,
                                             const label nMayFold) const
{
    const auto isFolded = [&](const label begin, const label end)
    {
        const vector chord(X[end - 1] - X[begin]);
        for (direction d = 0; d < 3; ++d)
        {
            const scalar most = grid_.n()[d] - 2 * lineReach;
            if (grid_.periodic(d) && mag(chord[d]) > most * grid_.h()[d])
            {
                return true;
            }
        }
        return folded(SubList<vector>(X, end - begin, begin));
    };
    scalarField ids(2 * size());
    for (label begin = 0, end = 0; begin < line.size(); begin = end)
    {
        while (end < line.size() && line[end] == line[begin])
            ++end;
        const bool folded =
            begin < nMayFold && line[begin] >= 0 && isFolded(begin, end);
        for (label k = begin; k < end; ++k)
        {
            ids[2 * k] = line[k];
            ids[2 * k + 1] = folded ? k : -1;
        }
    }
    return copies_.handOut(ids.cdata(), 2);
}

void Foam::markerSet::closeLines(const UList<vector>& X, const labelUList& line,
                                 const visitor& visit) const
{
    const UList<vector>& local = copies_.here();
    markerBins bins(grid_, local, linesHere(X, line, 0));
    forAll(local, k)
    {
        const markerOfLine& m = bins[k];
        if (m.line < 0 || !copies_.holds(k)) continue;
        bins.eachNear(m,
                      [&](const markerOfLine& other, scalar)
                      {
                          if (other.line == m.line) return;
                          const scalar distance = bins.distance(m, other);
                          if (distance < lineReach)
                          {
                              visit(m.line, other.line, local[k], distance);
                          }
                      });
    }
}

void Foam::markerSet::lineDensity(const UList<vector>& X,
                                  const labelUList& line, const label nMayFold,
                                  scalarField& density) const
{
    const UList<vector>& local = copies_.here();
    markerBins bins(grid_, local, linesHere(X, line, nMayFold));

    scalarField others(local.size(), Zero);
    // A line counts by its marker with the largest share, or by all of them where it is
    // folded and may be coiled up: those of a strand a cell apart add up to one
    struct lineHere
    {
        label line;
        scalar largest, sum;
    };
    const scalar ofStrand = 0.6;
    std::vector<lineHere> touched;
    forAll(local, k)
    {
        // The rank that holds the cell knows all markers around it
        const markerOfLine& m = bins[k];
        if (m.line < 0 || !copies_.holds(k)) continue;
        touched.clear();
        bins.eachNear(m,
                      [&](const markerOfLine& other, const scalar share)
                      {
                          if (m.isBeside(other)) return;
                          const scalar part = other.folded() ? share : 0;
                          for (lineHere& t : touched)
                          {
                              if (t.line != other.line) continue;
                              t.largest = max(t.largest, share);
                              t.sum += part;
                              return;
                          }
                          touched.push_back({other.line, share, part});
                      });
        for (const lineHere& t : touched)
        {
            others[k] += max(t.largest, ofStrand * t.sum);
        }
    }

    density.setSize(size());
    density = 1;
    copies_.addUp(others, 1, density.data());
}
