// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "dictionary.H"
#include "markerSet.H"
#include "segmentDistance.H"
#include <map>

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

//- Markers of this rank at random positions in the box and beyond its periodic sides
vectorField randomMarkers(const label n)
{
    Random random(7 + Pstream::myProcNo());
    vectorField X(n);
    for (vector& x : X)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const scalar s = random.sample01<scalar>();
            x[d] = grid().origin()[d] +
                   grid().length()[d] * (grid().periodic(d) ? 3 * s - 1 : s);
        }
    }
    return X;
}

vectorField randomVectors(const label n, const label seed)
{
    Random random(seed + Pstream::myProcNo());
    vectorField v(n);
    for (vector& x : v)
    {
        x = 2 * random.sample01<vector>() - vector::one;
    }
    return v;
}

//- Sum of a component over the cells of all ranks
template<class Values>
scalar sumOfCells(Values value)
{
    scalar sum = 0;
    for (const label i : grid().index())
    {
        sum += value(i);
    }
    return returnReduce(sum, sumOp<scalar>());
}

template<class Function>
void fill(staggeredField& u, Function f)
{
    for (const label i : grid().index())
    {
        for (direction d = 0; d < 3; ++d)
        {
            u[d][i] = f(test::facePoint(grid(), grid().box().cell(i), d), d);
        }
    }
}
} // namespace

class MarkerSet : public ::testing::TestWithParam<deltaKernel::kernelType>
{
protected:
    blockNeighbours neighbours{grid()};
    markerSet markers{grid(), deltaKernel(GetParam()), neighbours};
};

TEST_P(MarkerSet, interpolationIsTheAdjointOfSpreading)
{
    const vectorField X(randomMarkers(500)), F(randomVectors(500, 11));
    staggeredField u(grid().box()), f(grid().box());
    fill(u,
         [](const point& p, const direction d) { return test::noise(p, d); });

    vectorField U;
    markers.setPositions(X);
    markers.interpolate({u}, U);
    markers.spread(F, f);

    scalar onMarkers = gSum(F & U), size = gSum(mag(F) * mag(U));
    scalar onGrid = 0;
    for (direction d = 0; d < 3; ++d)
    {
        onGrid += grid().cellVolume() *
                  sumOfCells([&](const label i) { return u[d][i] * f[d][i]; });
    }
    test::expectBelow("power on markers - power on grid, relative",
                      mag(onMarkers - onGrid) / size, 1e-13);
}

// Interpolation equals a sum over the grid points, for whole, clipped and cut markers
TEST_P(MarkerSet, interpolatesAsTheKernelSays)
{
    const vectorField X(randomMarkers(500));
    staggeredField u(grid().box());
    fill(u,
         [](const point& p, const direction d) { return test::noise(p, d); });
    vectorField U;
    markers.setPositions(X);
    markers.interpolate({u}, U);

    scalar error = 0;
    forAll(X, k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            kernelStencil s[3];
            for (direction e = 0; e < 3; ++e)
            {
                const label n = grid().n()[e];
                const bool periodic = grid().periodic(e);
                // Position with the same rounding as in markerSet, as differences are
                // magnified beside a wall
                scalar x = (X[k][e] - grid().origin()[e]) * (1 / grid().h()[e]);
                if (periodic) x -= n * std::floor(x / n);

                // Points beyond periodic sides are wrapped
                const label beyond = periodic ? 4 : 0;
                s[e] = deltaKernel(GetParam())
                           .stencil(x, e == d ? 0 : 0.5,
                                    e == d && !periodic ? 1 : -beyond,
                                    n - 1 + beyond);
                for (label& i : s[e].index)
                {
                    i = (i + n) % n;
                }
            }
            scalar sum = 0;
            for (label a = 0; a < s[0].size; ++a)
            {
                for (label b = 0; b < s[1].size; ++b)
                {
                    for (label c = 0; c < s[2].size; ++c)
                    {
                        const labelVector ijk(s[0].index[a], s[1].index[b],
                                              s[2].index[c]);
                        sum += s[0].weight[a] * s[1].weight[b] *
                               s[2].weight[c] *
                               test::noise(test::facePoint(grid(), ijk, d), d);
                    }
                }
            }
            error = max(error, mag(U[k][d] - sum));
        }
    }
    test::expectBelow("error of the sum over the points",
                      returnReduce(error, maxOp<scalar>()), 1e-13);
}

TEST_P(MarkerSet, findsVelocitiesInOneSweepWithForces)
{
    const vectorField X(randomMarkers(3000)), F(randomVectors(3000, 17));
    staggeredField f(grid().box()), g(grid().box());
    fill(f,
         [](const point& p, const direction d) { return test::noise(p, d); });
    g = f;
    vectorField U, V;
    markers.setPositions(X);
    markers.spread(F, f);
    markers.interpolate({f}, U);
    markers.spreadAndInterpolate(F, g, {g}, V);
    test::expectBelow("velocities, relative", gMax(mag(U - V)) / gMax(mag(U)),
                      1e-13);
    for (direction d = 0; d < 3; ++d)
    {
        test::expectBelow("field with the forces, relative",
                          gMax(mag(f[d] - g[d])) / gMax(mag(f[d])), 1e-13);
    }
}

TEST_P(MarkerSet, conservesForce)
{
    const vectorField X(randomMarkers(500)), F(randomVectors(500, 5));
    staggeredField f(grid().box());
    markers.setPositions(X);
    markers.spread(F, f);
    vector total(Zero);
    for (direction d = 0; d < 3; ++d)
    {
        total[d] = grid().cellVolume() *
                   sumOfCells([&](const label i) { return f[d][i]; });
    }
    test::expectBelow("total force spread - total of markers, relative",
                      mag(total - gSum(F)) / gSum(mag(F)), 1e-12);
}

TEST_P(MarkerSet, interpolatesLinearFieldsExactly)
{
    // Field that is linear in directions that are not periodic, so that walls are tested
    // too. Components normal to a wall within a cell of it are excluded, as their stencil
    // has one point that is not a boundary value
    vectorField X(randomMarkers(500));
    vector slope(Zero);
    for (direction d = 0; d < 3; ++d)
    {
        if (!grid().periodic(d)) slope[d] = 1.7 - d;
    }
    staggeredField u(grid().box());
    fill(u, [&](const point& p, const direction d)
         { return 0.3 + (d + 1) * (slope & p); });
    vectorField U;
    markers.setPositions(X);
    markers.interpolate({u}, U);

    scalar error = 0;
    forAll(X, k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const scalar x = (X[k][d] - grid().origin()[d]) / grid().h()[d];
            const bool single =
                !grid().periodic(d) && (x < 1 || x > grid().n()[d] - 1);
            if (single) continue;
            error = max(error, mag(U[k][d] - 0.3 - (d + 1) * (slope & X[k])));
        }
    }
    test::expectBelow("error of a linear field, also beside walls",
                      returnReduce(error, maxOp<scalar>()), 1e-12);
}

// Lines of 7 markers with a spacing of one cell, at random positions
TEST_P(MarkerSet, countsLinesInOnePlace)
{
    Random random(3);
    for (const label n : {1, 2, 5})
    {
        // n coinciding lines on the first rank, at a position known to all ranks, and one
        // line of another rank across them
        const bool first = Pstream::master();
        const bool last = Pstream::myProcNo() == Pstream::nProcs() - 1;
        vector start(random.sample01<vector>());
        start = grid().origin() + cmptMultiply(start, grid().length());
        const label each = 7, middle = 3;
        vectorField X((first ? n * each : 0) + (last ? each : 0));
        labelList line(X.size());
        const auto put = [&](const label at, const label number,
                             const vector& x, const direction d)
        {
            for (label k = 0; k < each; ++k)
            {
                X[at + k] = x;
                X[at + k][d] += (k - middle) * grid().h()[d];
                line[at + k] = number;
            }
        };
        for (label i = 0; first && i < n; ++i)
        {
            put(i * each, i, start, 0);
        }
        if (last) put(X.size() - each, 77, start, 1);

        markers.setPositions(X);
        scalarField density;
        markers.lineDensity(X, line, X.size(), density);
        forAll(X, k)
        {
            // Markers that the crossing line touches, and markers without another line. In a
            // direction shorter than the line the box brings it back onto itself
            const label at = k % each;
            const label lines = at == middle ? n + 1 : line[k] == 77 ? 1 : n;
            if (mag(at - middle) == 1) continue;
            if (grid().n()[line[k] == 77 ? 1 : 0] < each + 2) continue;
            EXPECT_NEAR(density[k], lines, 1e-12) << "marker " << at;
        }
    }
}

// A straight line, a line that returns to itself, and one that is coiled up
TEST_P(MarkerSet, countsALineOnceUnlessItIsFolded)
{
    const label each = 12;
    for (const label strands : {1, 2, 4})
    {
        vectorField X(Pstream::master() ? each : 0);
        const vector middle(grid().origin() + 0.5 * grid().length());
        const vector part(grid().h().x(), 0, 0);
        const label n = each / strands;
        forAll(X, k)
        {
            const label at = k / n % 2 ? n - 1 - k % n : k % n;
            X[k] = middle + scalar(at - n / 2) * part;
        }
        if (grid().n()[0] < each + 2) continue;
        markers.setPositions(X);
        scalarField density;
        markers.lineDensity(X, labelList(X.size(), 5), X.size(), density);
        if (X.empty()) continue;

        // At its end a strand has two markers in reach, one of them a cell away
        const scalar expected = strands == 1 ? 1 : strands == 2 ? 1.8 : 3.4;
        EXPECT_NEAR(density[0], expected, 1e-12);
        if (strands == 1) EXPECT_NEAR(max(density), 1, 1e-12);
    }
}

// Many straight or folded lines in a small part of the box, some across periodic sides, some
// not counted: against a search over all pairs of markers of all ranks
TEST_P(MarkerSet, countsLinesAsAllPairsDo)
{
    const label nLines = 14, each = 10;
    const uniformGrid& g = grid();
    const scalar reach = markerSet::lineReach;
    Random random(11 + Pstream::myProcNo());
    vectorField X(nLines * each);
    labelList line(X.size());
    scalarField folded(X.size());
    for (label i = 0; i < nLines; ++i)
    {
        const vector part(1.4 * random.sample01<vector>() - 0.7 * vector::one);
        const vector start(cmptMultiply(min(7 * vector::one, vector(g.n())),
                                        random.sample01<vector>()) -
                           vector(g.periodic(0), g.periodic(1), g.periodic(2)));
        const bool hairpin = i % 3 == 0;
        for (label j = 0; j < each; ++j)
        {
            const label k = i * each + j;
            vector x(start + scalar(hairpin ? min(j, each - 1 - j) : j) * part);
            for (direction d = 0; d < 3; ++d)
            {
                if (g.periodic(d)) continue;
                x[d] = min(max(x[d], scalar(0)), scalar(g.n()[d]));
            }
            X[k] = g.origin() + cmptMultiply(x, g.h());
            line[k] = i % 5 == 4 ? -1 : i + nLines * Pstream::myProcNo();
        }
        const vector chord(
            cmptDivide(X[(i + 1) * each - 1] - X[i * each], g.h()));
        bool wraps = false;
        for (direction d = 0; d < 3; ++d)
        {
            wraps = wraps ||
                    (g.periodic(d) && mag(chord[d]) > g.n()[d] - 2 * reach);
        }
        // Clipping to walls may have bent a straight line
        const SubList<vector> nodes(X, each, i * each);
        SubList<scalar>(folded, each, i * each) =
            scalar(wraps || Foam::folded(nodes));
    }

    List<vectorField> places(Pstream::nProcs());
    List<labelList> lines(Pstream::nProcs());
    List<scalarField> foldeds(Pstream::nProcs());
    places[Pstream::myProcNo()] = X;
    lines[Pstream::myProcNo()] = line;
    Pstream::gatherList(places);
    Pstream::scatterList(places);
    Pstream::gatherList(lines);
    Pstream::scatterList(lines);
    foldeds[Pstream::myProcNo()] = folded;
    Pstream::gatherList(foldeds);
    Pstream::scatterList(foldeds);
    scalarField expected(X.size(), 1);
    scalar nClose = 0, sumOfDistances = 0;
    forAll(X, k)
    {
        std::map<label, scalar> largest, sums;
        forAll(places, proci)
        {
            forAll(places[proci], m)
            {
                const label other = lines[proci][m];
                vector away(cmptDivide(places[proci][m] - X[k], g.h()));
                scalar share = 1;
                for (direction d = 0; d < 3; ++d)
                {
                    if (g.periodic(d))
                    {
                        away[d] -= g.n()[d] * std::round(away[d] / g.n()[d]);
                    }
                    share *= max(scalar(0), 1 - mag(away[d]) / reach);
                }
                if (line[k] < 0 || other < 0) continue;
                if (other != line[k] && mag(away) < reach)
                {
                    nClose += 1;
                    sumOfDistances += mag(away);
                }
                if (other == line[k] && (!folded[k] || mag(m - k) <= 2))
                {
                    continue;
                }
                largest[other] = max(largest[other], share);
                if (foldeds[proci][m]) sums[other] += share;
            }
        }
        for (const auto& l : largest)
        {
            expected[k] += max(l.second, 0.6 * sums[l.first]);
        }
    }

    markers.setPositions(X);
    scalarField density;
    markers.lineDensity(X, line, X.size(), density);
    test::expectBelow("lines at markers, against all pairs",
                      gMax(mag(density - expected)), 1e-11);
    EXPECT_GT(gMax(density), 2);
    markers.closeLines(X, line,
                       [&](label, label, const point&, const scalar distance)
                       {
                           nClose -= 1;
                           sumOfDistances -= distance;
                       });
    EXPECT_EQ(returnReduce(nClose, sumOp<scalar>()), 0);
    test::expectBelow("distances of close lines, sum against all pairs",
                      mag(returnReduce(sumOfDistances, sumOp<scalar>())), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(kernels, MarkerSet,
                         ::testing::Values(deltaKernel::Roma3,
                                           deltaKernel::Peskin4),
                         [](const auto& i)
                         { return deltaKernel::names[i.param]; });
