// This file is part of deformableBodies. License: GPL-3.0-or-later.

// How many lines of markers lie in one place

#include "markerSet.H"

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
} // namespace

// The kernel sees another marker the less the further it is away along each
// direction; here a straight line down to zero stands for that
void Foam::markerSet::lineDensity(const labelUList& line,
                                  scalarField& density) const
{
    const scalar reach = 1.5;
    const label sameLine =
        4; // markers further apart in the list meet by chance

    // Line of each marker here, and its number in the list of its owner
    scalarField ids(2 * nOwn_);
    forAll(line, k)
    {
        ids[2 * k] = line[k];
        ids[2 * k + 1] = k;
    }
    if (Pstream::parRun()) ids = handOut(ids.cdata(), 2);

    const binsOfDirection bins[3] = {{grid_, 0}, {grid_, 1}, {grid_, 2}};
    const auto binOf = [&](const label i, const label j, const label k)
    { return i + bins[0].nBins * (j + bins[1].nBins * k); };

    // What is looked at of a marker, in one place of memory
    struct entry
    {
        scalar at[3];
        label line, number, next;
    };
    std::vector<entry> all(X_.size());
    std::vector<label> firstIn(bins[0].nBins * bins[1].nBins * bins[2].nBins,
                               -1);
    forAll(X_, k)
    {
        entry& e = all[k];
        e.line = label(ids[2 * k]);
        e.number = label(ids[2 * k + 1]);
        if (e.line < 0) continue;
        for (direction d = 0; d < 3; ++d)
        {
            e.at[d] = bins[d].place(X_[k][d]);
        }
        label& first = firstIn[binOf(bins[0].bin(e.at[0]), bins[1].bin(e.at[1]),
                                     bins[2].bin(e.at[2]))];
        e.next = first;
        first = k;
    }

    scalarField others(X_.size(), Zero);
    std::vector<std::pair<label, scalar>> touched; // line, largest share
    forAll(X_, k)
    {
        // A marker's surroundings are known to the rank that holds its cell
        const entry& e = all[k];
        if (e.line < 0 || (Pstream::parRun() &&
                           neighbours_.holder(X_[k]) != neighbours_.me()))
        {
            continue;
        }
        label bin[3][2];
        int nBins[3];
        for (direction d = 0; d < 3; ++d)
        {
            bin[d][0] = bins[d].bin(e.at[d] - reach);
            bin[d][1] = bins[d].bin(e.at[d] + reach);
            nBins[d] = bin[d][0] == bin[d][1] ? 1 : 2;
        }
        touched.clear();
        const auto touch = [&](const entry& other)
        {
            if (other.line == e.line &&
                mag(other.number - e.number) <= sameLine)
            {
                return;
            }
            scalar share = 1;
            for (direction d = 0; d < 3; ++d)
            {
                const scalar away = bins[d].distance(e.at[d], other.at[d]);
                share *= max(scalar(0), 1 - away * (1 / reach));
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
        for (int l = 0; l < nBins[2]; ++l)
        {
            for (int j = 0; j < nBins[1]; ++j)
            {
                for (int i = 0; i < nBins[0]; ++i)
                {
                    for (label m =
                             firstIn[binOf(bin[0][i], bin[1][j], bin[2][l])];
                         m >= 0; m = all[m].next)
                    {
                        touch(all[m]);
                    }
                }
            }
        }
        for (const auto& t : touched)
        {
            others[k] += t.second;
        }
    }

    density.setSize(nOwn_);
    density = 1;
    if (Pstream::parRun())
    {
        addUp(others, 1, density.data());
    }
    else
    {
        density += others;
    }
}
