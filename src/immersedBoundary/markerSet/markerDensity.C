// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Line density, and pairs of markers of different lines that are close

#include "markerSet.H"
#include "alignedVector.H"
#include "segmentDistance.H"
#include <algorithm>
#include <cmath>

namespace
{
using namespace Foam;

//- Bins along one direction for the markers of this rank, at least three cells wide. All
//  markers within 1.5 cells of a position lie in the two bins that contain the positions
//  1.5 cells below and above it
struct binsOfDirection
{
    scalar origin, perCell, n, lo;
    bool periodic, whole;

    //- Positions of a periodic direction are wrapped to [-below, n - below) relative to
    //  the block; scale: bins per cell
    scalar below, scale;
    label nBins;

    binsOfDirection(const uniformGrid& grid, const direction d)
        : origin(grid.origin()[d]),
          perCell(1 / grid.h()[d]),
          n(grid.n()[d]),
          lo(grid.box().lo[d]),
          periodic(grid.periodic(d)),
          whole(grid.box().size[d] == grid.n()[d] ||
                (periodic && grid.n()[d] - grid.box().size[d] < 3))
    {
        const label size = grid.box().size[d];
        below = whole ? 0 : 0.5 * (n - size);
        nBins = whole ? max(grid.n()[d] / 3, label(1)) : size / 3 + 3;
        scale = whole ? nBins / n : 1.0 / 3;
    }

    //- Position of a coordinate [m] in cells from the first layer of this rank
    scalar position(const scalar coordinate) const
    {
        const scalar x = (coordinate - origin) * perCell - lo;
        if (!periodic || (x >= -below && x < n - below)) return x;
        return x - n * std::floor((x + below) / n);
    }

    label bin(const scalar cells) const
    {
        if (!whole) return clamped(label((cells + 3) * scale));
        const label b = cells < 0 ? -1 : label(cells * scale);
        if (!periodic) return clamped(b);
        return b < 0 ? nBins - 1 : b % nBins;
    }

    //- Distance of two positions to the nearest image [cells]; without branches, so that
    //  loops over it vectorise
    scalar distance(const scalar a, const scalar b) const
    {
        const scalar x = std::abs(a - b);
        return std::min(x, (periodic ? n : GREAT) - x);
    }

private:
    label clamped(const label b) const
    {
        return min(max(b, label(0)), nBins - 1);
    }
};

//- Marker in a bin: position [cells], line (negative: in no bin, not counted), number along
//  the line if that is folded (negative otherwise), next marker in the bin (negative: none)
struct markerOfLine
{
    scalar position[3];
    label line, number, next;

    bool folded() const { return number >= 0; }

    //- True for markers of one line that do not count for each other. In a folded line
    //  these are close neighbours only
    bool isBeside(const markerOfLine& other) const
    {
        const label apart = 4;
        return line == other.line &&
               (!folded() || std::abs(number - other.number) <= apart);
    }
};

//- Search of markers near a marker, by bins
class markerBins
{
    const binsOfDirection bins_[3];
    std::vector<markerOfLine> all_;

    //- Bin: its first marker, and the line of its markers, -1 if there are several lines
    struct binContent
    {
        label first = -1, line = -1;
    };
    std::vector<binContent> contents_;

    //- Candidates around the marker of the last search, kept for the next marker of the
    //  same line that reaches into the same bins: line, bins below and above in each
    //  direction, indices and positions of the candidates. Bins with no other line are
    //  skipped unless the line is folded
    label line_ = -1, near_[3][2] = {};
    std::vector<label> candidates_;
    alignedVector<scalar> positions_[3];

    //- Share of each candidate, padded to whole vectors; candidates whose share is not zero
    alignedVector<scalar> share_;
    std::vector<label> counted_;

    label binOf(const label i, const label j, const label k) const
    {
        return i + bins_[0].nBins * (j + bins_[1].nBins * k);
    }

    void lookAround(const markerOfLine& m)
    {
        bool same = m.line == line_;
        line_ = m.line;
        for (direction d = 0; d < 3; ++d)
        {
            for (int side = 0; side < 2; ++side)
            {
                const label b = bins_[d].bin(
                    m.position[d] + (2 * side - 1) * markerSet::lineReach);
                same = same && near_[d][side] == b;
                near_[d][side] = b;
            }
        }
        if (same) return;

        // No branches, as the processor cannot predict which bins are needed
        label chosen[8], nChosen = 0;
        const auto nAlong = [&](const direction d)
        { return near_[d][0] == near_[d][1] ? 1 : 2; };
        for (int k = 0; k < nAlong(2); ++k)
        {
            for (int j = 0; j < nAlong(1); ++j)
            {
                for (int i = 0; i < nAlong(0); ++i)
                {
                    const label b =
                        binOf(near_[0][i], near_[1][j], near_[2][k]);
                    const binContent& c = contents_[b];
                    chosen[nChosen] = b;
                    nChosen +=
                        (c.first >= 0) & ((c.line != m.line) | m.folded());
                }
            }
        }
        candidates_.clear();
        for (label b = 0; b < nChosen; ++b)
        {
            for (label k = contents_[chosen[b]].first; k >= 0; k = all_[k].next)
            {
                candidates_.push_back(k);
            }
        }
        share_.resize((candidates_.size() + 7) / 8 * 8);
        if (candidates_.empty()) return;
        counted_.resize(candidates_.size());
        for (direction d = 0; d < 3; ++d)
        {
            positions_[d].resize(share_.size());
            for (size_t i = 0; i < candidates_.size(); ++i)
            {
                positions_[d][i] = all_[candidates_[i]].position[d];
            }
        }
    }

public:
    //- ids: two numbers per marker, its line and its number along a folded line or -1
    markerBins(const uniformGrid& grid, const UList<vector>& X,
               const scalarField& ids)
        : bins_{{grid, 0}, {grid, 1}, {grid, 2}},
          all_(X.size()),
          contents_(bins_[0].nBins * bins_[1].nBins * bins_[2].nBins)
    {
        forAll(X, k)
        {
            markerOfLine& m = all_[k];
            m.line = label(ids[2 * k]);
            m.number = label(ids[2 * k + 1]);
            if (m.line < 0) continue;
            for (direction d = 0; d < 3; ++d)
            {
                m.position[d] = bins_[d].position(X[k][d]);
            }
            binContent& c = contents_[binOf(bins_[0].bin(m.position[0]),
                                            bins_[1].bin(m.position[1]),
                                            bins_[2].bin(m.position[2]))];
            c.line = c.first < 0 || c.line == m.line ? m.line : -1;
            m.next = c.first;
            c.first = k;
        }
    }

    const markerOfLine& operator[](const label k) const { return all_[k]; }

    //- Distance of two markers to the nearest image [cells]
    scalar distance(const markerOfLine& a, const markerOfLine& b) const
    {
        scalar squares = 0;
        for (direction d = 0; d < 3; ++d)
        {
            squares += sqr(bins_[d].distance(a.position[d], b.position[d]));
        }
        return std::sqrt(squares);
    }

    //- Call visit(other, share) for the markers less than lineReach away from m along each
    //  direction. share: product over the directions of 1 - distance/lineReach, in place
    //  of the kernel. Markers of m's own line may be skipped unless it is folded. Fast if
    //  successive m are neighbours on one line
    template<class Visit>
    void eachNear(const markerOfLine& m, Visit visit)
    {
        lookAround(m);
        scalar* __restrict__ share = share_.data();
        for (size_t i = 0; i < share_.size(); ++i)
        {
            const auto along = [&](const direction d)
            {
                const scalar away =
                    bins_[d].distance(m.position[d], positions_[d][i]);
                return std::max(scalar(0),
                                1 - away * (1 / markerSet::lineReach));
            };
            share[i] = along(0) * along(1) * along(2);
        }
        label nCounted = 0;
        for (size_t i = 0; i < candidates_.size(); ++i)
        {
            counted_[nCounted] = i; // no branch, as in lookAround()
            nCounted += share[i] > 0;
        }
        for (label k = 0; k < nCounted; ++k)
        {
            visit(all_[candidates_[counted_[k]]], share[counted_[k]]);
        }
    }
};
} // namespace

constexpr Foam::scalar Foam::markerSet::lineReach;

// A line also counts as folded if its periodic images are within reach
Foam::scalarField Foam::markerSet::linesHere(const UList<vector>& X,
                                             const labelUList& line,
                                             const bool mayFold) const
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
        const bool folded = mayFold && line[begin] >= 0 && isFolded(begin, end);
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
    markerBins bins(grid_, local, linesHere(X, line, false));
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
                                  const labelUList& line, const bool mayFold,
                                  scalarField& density) const
{
    const UList<vector>& local = copies_.here();
    markerBins bins(grid_, local, linesHere(X, line, mayFold));

    scalarField others(local.size(), Zero);
    std::vector<std::pair<label, scalar>> touched; // line, largest share
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
                          for (auto& t : touched)
                          {
                              if (t.first != other.line) continue;
                              t.second = max(t.second, share);
                              return;
                          }
                          touched.push_back({other.line, share});
                      });
        for (const auto& t : touched)
        {
            others[k] += t.second;
        }
    }

    density.setSize(size());
    density = 1;
    copies_.addUp(others, 1, density.data());
}
