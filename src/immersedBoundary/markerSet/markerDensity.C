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
    scalar origin, h, n, lo, size;
    bool periodic, whole;
    label nBins;

    binsOfDirection(const uniformGrid& grid, const direction d)
        : origin(grid.origin()[d]),
          h(grid.h()[d]),
          n(grid.n()[d]),
          lo(grid.box().lo[d]),
          size(grid.box().size[d]),
          periodic(grid.periodic(d)),
          whole(size == n),
          nBins(whole ? max(label(n / 3), label(1)) : label(size / 3) + 3)
    {
    }

    //- Cells above the first layer of this rank
    scalar place(const scalar coordinate) const
    {
        const scalar x = (coordinate - origin) / h - lo;
        const scalar below = whole ? 0 : 0.5 * (n - size);
        return periodic ? x - n * std::floor((x + below) / n) : x;
    }

    label bin(const scalar place) const
    {
        if (!whole) return clamped(label((place + 3) / 3));
        const label b = label(std::floor(place * nBins / n));
        return periodic ? (b + nBins) % nBins : clamped(b);
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
    const label sameLine = 4; // markers further apart in the list meet by chance

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
    labelList firstIn(bins[0].nBins * bins[1].nBins * bins[2].nBins, -1);
    labelList next(X_.size(), -1);
    vectorField at(X_.size());
    forAll(X_, k)
    {
        if (ids[2 * k] < 0) continue;
        for (direction d = 0; d < 3; ++d)
        {
            at[k][d] = bins[d].place(X_[k][d]);
        }
        label& first = firstIn[binOf(bins[0].bin(at[k].x()),
                                     bins[1].bin(at[k].y()),
                                     bins[2].bin(at[k].z()))];
        next[k] = first;
        first = k;
    }

    scalarField others(X_.size(), Zero);
    std::vector<std::pair<scalar, scalar>> touched; // line, largest share
    forAll(X_, k)
    {
        // A marker's surroundings are known to the rank that holds its cell
        if (ids[2 * k] < 0 ||
            (Pstream::parRun() &&
             neighbours_.holder(X_[k]) != neighbours_.me()))
        {
            continue;
        }
        label bin[3][2];
        int nBins[3];
        for (direction d = 0; d < 3; ++d)
        {
            bin[d][0] = bins[d].bin(at[k][d] - reach);
            bin[d][1] = bins[d].bin(at[k][d] + reach);
            nBins[d] = bin[d][0] == bin[d][1] ? 1 : 2;
        }
        touched.clear();
        for (int b = 0; b < nBins[0] * nBins[1] * nBins[2]; ++b)
        {
            const int i = b % nBins[0], j = b / nBins[0] % nBins[1],
                      l = b / (nBins[0] * nBins[1]);
            for (label m = firstIn[binOf(bin[0][i], bin[1][j], bin[2][l])];
                 m >= 0; m = next[m])
            {
                if (ids[2 * m] == ids[2 * k] &&
                    mag(ids[2 * m + 1] - ids[2 * k + 1]) <= sameLine)
                {
                    continue;
                }
                scalar share = 1;
                for (direction d = 0; d < 3; ++d)
                {
                    share *= max(scalar(0), 1 - bins[d].distance(at[k][d],
                                                                 at[m][d]) /
                                                    reach);
                }
                if (share == 0) continue;
                bool known = false;
                for (auto& t : touched)
                {
                    if (t.first != ids[2 * m]) continue;
                    t.second = max(t.second, share);
                    known = true;
                }
                if (!known) touched.push_back({ids[2 * m], share});
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
