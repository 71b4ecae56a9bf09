// This file is part of deformableBodies. License: GPL-3.0-or-later.

// How many lines of markers lie in one place

#include "markerSet.H"
#include "segmentDistance.H"

namespace
{
using namespace Foam;

//- The layers of cells of one direction that this rank's markers lie in, cut
//  into bins of three cells and more: whatever is within 1.5 cells of a place
//  lies in the bins of the places 1.5 cells below and above
struct binsOfDirection
{
    scalar origin, perCell, n, lo;
    bool periodic, whole;

    //- Coordinates of this rank's cells begin after below; bins per cell
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

    //- Cells above the first layer of this rank
    scalar place(const scalar coordinate) const
    {
        const scalar x = (coordinate - origin) * perCell - lo;
        if (!periodic || (x >= -below && x < n - below)) return x;
        return x - n * std::floor((x + below) / n);
    }

    label bin(const scalar place) const
    {
        if (!whole) return clamped(label((place + 3) * scale));
        const label b = place < 0 ? -1 : label(place * scale);
        if (!periodic) return clamped(b);
        return b < 0 ? nBins - 1 : b >= nBins ? b - nBins : b;
    }

    //- Shortest of all images
    scalar distance(const scalar a, const scalar b) const
    {
        const scalar x = std::abs(a - b);
        return periodic ? min(x, n - x) : x;
    }

private:
    label clamped(const label b) const
    {
        return min(max(b, label(0)), nBins - 1);
    }
};

//- Markers in bins
class markerBins
{
public:
    //- What is looked at of a marker, in one place of memory
    struct entry
    {
        scalar at[3];
        label line, number, next;
        bool folded; //!< may distant parts of its line meet?

        //- Neighbours within one line: in one that is folded those further apart
        //  meet by chance
        bool isBeside(const entry& other) const
        {
            const label apart = 4;
            return line == other.line &&
                   (!folded || std::abs(number - other.number) <= apart);
        }
    };

private:
    //- The markers of a bin: the first, and their line if they have one in common,
    //  else -1
    struct binContent
    {
        label first = -1, line = -1;
    };

    const binsOfDirection bins_[3];
    std::vector<entry> all_;
    std::vector<binContent> contents_;

    label binOf(const label i, const label j, const label k) const
    {
        return i + bins_[0].nBins * (j + bins_[1].nBins * k);
    }

public:
    //- ids of each marker: its line, left out where negative, its number and whether
    //  the line is folded
    markerBins(const uniformGrid& grid, const UList<vector>& X,
               const scalarField& ids)
        : bins_{{grid, 0}, {grid, 1}, {grid, 2}},
          all_(X.size()),
          contents_(bins_[0].nBins * bins_[1].nBins * bins_[2].nBins)
    {
        forAll(X, k)
        {
            entry& e = all_[k];
            e.line = label(ids[3 * k]);
            e.number = label(ids[3 * k + 1]);
            e.folded = ids[3 * k + 2];
            if (e.line < 0) continue;
            for (direction d = 0; d < 3; ++d)
            {
                e.at[d] = bins_[d].place(X[k][d]);
            }
            binContent& c =
                contents_[binOf(bins_[0].bin(e.at[0]), bins_[1].bin(e.at[1]),
                                bins_[2].bin(e.at[2]))];
            c.line = c.first < 0 || c.line == e.line ? e.line : -1;
            e.next = c.first;
            c.first = k;
        }
    }

    const entry& operator[](const label k) const { return all_[k]; }

    //- Cells between two markers in a direction, to the nearest image
    scalar distance(const entry& a, const entry& b, const direction d) const
    {
        return bins_[d].distance(a.at[d], b.at[d]);
    }

    //- visit(other) of all in the bins within lineReach of a marker, but for bins
    //  where there is only its own line, which is not folded
    template<class Visit>
    void eachNear(const entry& e, Visit visit) const
    {
        label bin[3][2];
        int nBins[3];
        for (direction d = 0; d < 3; ++d)
        {
            bin[d][0] = bins_[d].bin(e.at[d] - markerSet::lineReach);
            bin[d][1] = bins_[d].bin(e.at[d] + markerSet::lineReach);
            nBins[d] = bin[d][0] == bin[d][1] ? 1 : 2;
        }
        // Which of them matter is hard to foresee: no branches
        label near[8];
        int count = 0;
        for (int l = 0; l < nBins[2]; ++l)
        {
            for (int j = 0; j < nBins[1]; ++j)
            {
                for (int i = 0; i < nBins[0]; ++i)
                {
                    near[count] = binOf(bin[0][i], bin[1][j], bin[2][l]);
                    const binContent& c = contents_[near[count]];
                    count += (c.first >= 0) & ((c.line != e.line) | e.folded);
                }
            }
        }
        for (int b = 0; b < count; ++b)
        {
            for (label m = contents_[near[b]].first; m >= 0; m = all_[m].next)
            {
                visit(all_[m]);
            }
        }
    }
};
} // namespace

constexpr Foam::scalar Foam::markerSet::lineReach;

// A line also counts as folded where its periodic images are within reach
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
    scalarField ids(3 * size());
    for (label begin = 0, end = 0; begin < line.size(); begin = end)
    {
        while (end < line.size() && line[end] == line[begin])
            ++end;
        const bool folded = mayFold && line[begin] >= 0 && isFolded(begin, end);
        for (label k = begin; k < end; ++k)
        {
            ids[3 * k] = line[k];
            ids[3 * k + 1] = k;
            ids[3 * k + 2] = folded;
        }
    }
    return copies_.handOut(ids.cdata(), 3);
}

void Foam::markerSet::closeLines(const UList<vector>& X, const labelUList& line,
                                 const visitor& visit) const
{
    const UList<vector>& here = copies_.here();
    const markerBins bins(grid_, here, linesHere(X, line, false));
    forAll(here, k)
    {
        const markerBins::entry& e = bins[k];
        if (e.line < 0 || !copies_.holds(k)) continue;
        bins.eachNear(e,
                      [&](const markerBins::entry& other)
                      {
                          if (other.line == e.line) return;
                          scalar squares = 0;
                          for (direction d = 0; d < 3; ++d)
                          {
                              squares += sqr(bins.distance(e, other, d));
                          }
                          if (squares < sqr(lineReach))
                          {
                              visit(e.line, other.line, here[k],
                                    std::sqrt(squares));
                          }
                      });
    }
}

// The kernel sees another marker the less the further it is away along each
// direction; here a straight line down to zero stands for that
void Foam::markerSet::lineDensity(const UList<vector>& X,
                                  const labelUList& line, const bool mayFold,
                                  scalarField& density) const
{
    const UList<vector>& here = copies_.here();
    const markerBins bins(grid_, here, linesHere(X, line, mayFold));

    scalarField others(here.size(), Zero);
    std::vector<std::pair<label, scalar>> touched; // line, largest share
    forAll(here, k)
    {
        // A marker's surroundings are known to the rank that holds its cell
        const markerBins::entry& e = bins[k];
        if (e.line < 0 || !copies_.holds(k)) continue;
        touched.clear();
        const auto touch = [&](const markerBins::entry& other)
        {
            if (e.isBeside(other)) return;
            scalar share = 1;
            for (direction d = 0; d < 3; ++d)
            {
                const scalar away = bins.distance(e, other, d);
                share *= max(scalar(0), 1 - away * (1 / lineReach));
            }
            if (share == 0) return;
            for (auto& t : touched)
            {
                if (t.first != other.line) continue;
                t.second = max(t.second, share);
                return;
            }
            touched.push_back({other.line, share});
        };
        bins.eachNear(e, touch);
        for (const auto& t : touched)
        {
            others[k] += t.second;
        }
    }

    density.setSize(size());
    density = 1;
    copies_.addUp(others, 1, density.data());
}
