// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "segmentDistance.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
scalar distance(const point& a, const point& b, const point& c, const point& d)
{
    return mag(connection(a, b, c, d));
}

//- Least distance of many points of both
scalar ofPoints(const point& a, const point& b, const point& c, const point& d)
{
    const label n = 200;
    scalar least = GREAT;
    for (label i = 0; i <= n; ++i)
    {
        for (label j = 0; j <= n; ++j)
        {
            least = min(least, mag(a + scalar(i) / n * (b - a) - c -
                                   scalar(j) / n * (d - c)));
        }
    }
    return least;
}
} // namespace

TEST(SegmentDistance, betweenTheEndsOrAtThem)
{
    const point a(-1, 0, 0), b(1, 0, 0);
    EXPECT_NEAR(distance(a, b, point(0, -1, 0.3), point(0, 1, 0.3)), 0.3,
                1e-15);
    EXPECT_NEAR(distance(a, b, point(0, 2, 0), point(0, 3, 0)), 2, 1e-15);
    EXPECT_NEAR(distance(a, b, point(2, 1, 0), point(3, 1, 0)), std::sqrt(2.0),
                1e-15);
}

TEST(SegmentDistance, parallelSegmentsAndPoints)
{
    const point a(0, 0, 0), b(1, 0, 0);
    EXPECT_NEAR(distance(a, b, point(0.5, 1, 0), point(7, 1, 0)), 1, 1e-15);
    EXPECT_NEAR(distance(a, b, point(2, 0, 0), point(7, 0, 0)), 1, 1e-15);
    EXPECT_NEAR(distance(a, a, point(3, 4, 0), point(3, 4, 0)), 5, 1e-15);
}

TEST(SegmentDistance, isThatOfTheNearestPoints)
{
    Random random(4);
    scalar worst = 0;
    for (label k = 0; k < 50; ++k)
    {
        point p[4];
        for (point& x : p)
        {
            x = 2 * random.sample01<vector>() - vector::one;
        }
        const scalar exact = distance(p[0], p[1], p[2], p[3]),
                     found = ofPoints(p[0], p[1], p[2], p[3]);
        EXPECT_LE(exact, found + 1e-14);
        worst = max(worst, found - exact);
    }
    test::expectBelow("points of segments are further apart by", worst, 0.02);
}

TEST(SegmentDistance, pointsFromTheSecondToTheFirst)
{
    const vector r(connection(point(0, 0, 1), point(1, 0, 1), point(0, 0, 0),
                              point(1, 0, 0)));
    EXPECT_NEAR(mag(r - vector(0, 0, 1)), 0, 1e-15);
}

TEST(SegmentDistance, onlyLinesThatTurnBackAreFolded)
{
    vectorField straight(5), arc(5), hook(5);
    forAll(straight, i)
    {
        straight[i] = vector(i, 0, 0);
        arc[i] = vector(std::sin(0.25 * i), std::cos(0.25 * i), 0);
        hook[i] = vector(i < 3 ? i : 4 - i, 0.1 * i, 0);
    }
    EXPECT_FALSE(folded(straight));
    EXPECT_FALSE(folded(arc));
    EXPECT_TRUE(folded(hook));
}
