// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "histogram.H"
#include "nearField.H"
#include "pairDistribution.H"
#include "unitTest.H"
#include <cmath>
#include <sstream>

using namespace Foam;

TEST(histogram, findsItsRangeAndSumsToOne)
{
    Random random(3);
    histogram h(40), half(40);
    scalar time = 0;
    for (label i = 0; i < 20000; ++i)
    {
        const scalar x = 5 + 0.2 * random.GaussNormal<scalar>();
        time += 1 + i % 2;
        h.add(x, 1 + i % 2);
        half.add(x, 1 + i % 2);
        if (i == 10000)
        {
            const scalarList state(half.state());
            half = histogram(40);
            half.restore(state);
        }
    }
    scalar sum = 0, mean = 0, bins = 0;
    h.visit(
        [&](const scalar from, const scalar density)
        {
            sum += density * h.width();
            mean += density * h.width() * (from + 0.5 * h.width());
            ++bins;
        });
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(mean, 5, 0.01);
    EXPECT_LE(bins, 40);
    EXPECT_GE(bins, 10);
    EXPECT_EQ(h.state(), half.state());
}

// Centres without order have a distribution of 1 at each distance and in each direction, also
// between sides that are not periodic
TEST(pairDistribution, ofCentresWithoutOrderIsOne)
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    const vector L(grid.length());
    const scalar reach = 0.4 * cmptMin(L);
    pairDistribution pairs(grid, reach, 4, 0, 1);
    Random random(5);
    for (label sample = 0; sample < 20; ++sample)
    {
        pointField X(200);
        for (point& x : X)
        {
            x = grid.origin() +
                cmptMultiply(L, random.sample01<vector>());
        }
        pairs.add(X, 0.5);
    }
    OStringStream radial, map;
    pairs.write(radial, map);
    std::istringstream rows(radial.str());
    std::string line;
    scalar worst = 0, n = 0;
    while (std::getline(rows, line))
    {
        if (line[0] == '#') continue;
        std::istringstream numbers(line);
        scalar r, g, gX, gY, gZ;
        numbers >> r >> g >> gX >> gY >> gZ;
        if (++n == 1) continue; // few pairs
        worst = max(worst, mag(g - 1));
        EXPECT_NEAR(gX, 1, 0.25);
        EXPECT_NEAR(gY, 1, 0.25);
        EXPECT_NEAR(gZ, 1, 0.25);
    }
    EXPECT_EQ(n, 4);
    test::expectBelow("pair distribution less 1", worst, 0.1);
}

// The fit of the near field at other surfaces. The flow that the mesh does not resolve of a net
// force follows from the second moment of the kernel and that of the differences:
// 2/3 (int r^2 phi dr - 1/20)
TEST(nearField, atOtherSurfacesIsFitted)
{
    const nearField field(deltaKernel::Roma3, 1, 1, 0.5, nearField::OTHER);
    const scalar first = field.exact(0.05).A;
    scalar worst = 0;
    for (scalar q = 0.05; q < 8; q += 0.07)
    {
        const nearField::mobility e(field.exact(q)), f(field.fitted(q));
        worst = max(worst, mag(e.A - f.A) / first);
        worst = max(worst, sqr(q) * mag(e.C - f.C) / first);
    }
    test::expectBelow("error of the fit over A(0)", worst, 5e-3);
    const deltaKernel kernel(deltaKernel::Roma3);
    scalar moment = 0;
    for (scalar r = 0.0005; r < kernel.reach(); r += 0.001)
    {
        moment += 2 * 0.001 * sqr(r) * kernel.phi(r);
    }
    const scalar expected = 2.0 / 3 * (moment - 0.05);
    test::expectBelow("flow that the mesh does not resolve, relative error",
                      mag(field.unresolvedFlow() / expected - 1), 0.02);
}
