// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "periodicBox.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

//- Points within some three boxes about the middle one
std::vector<point> somePoints(const label n)
{
    Random random(11);
    std::vector<point> points;
    for (label i = 0; i < n; ++i)
    {
        points.push_back(
            grid().origin() +
            cmptMultiply(3 * random.sample01<vector>() - vector::one,
                         grid().length()));
    }
    return points;
}

//- Largest deviation of r from whole periods, over the length of the box; where a
//  direction is not periodic r has to be 0
scalar notPeriods(const vector& r)
{
    scalar most = 0;
    for (direction d = 0; d < 3; ++d)
    {
        const scalar x = r[d] / grid().length()[d];
        most = max(most, mag(grid().periodic(d) ? x - std::round(x) : x));
    }
    return most;
}
} // namespace

TEST(PeriodicBox, imagesLieInTheBox)
{
    scalar outside = 0, notShifted = 0;
    for (const point& x : somePoints(500))
    {
        const point in(intoBox(grid(), x));
        notShifted = max(notShifted, notPeriods(in - x));
        for (direction d = 0; d < 3; ++d)
        {
            if (!grid().periodic(d)) continue;
            const scalar s = (in[d] - grid().origin()[d]) / grid().length()[d];
            outside = max(outside, max(-s, s - 1));
        }
    }
    test::expectBelow("outside of the box, over its length", outside, 1e-14);
    test::expectBelow("shift beside whole periods", notShifted, 1e-14);
}

// Against all images of two boxes to either side
TEST(PeriodicBox, nearestImageIsTheNearest)
{
    const std::vector<point> points(somePoints(60));
    scalar longer = 0, notShifted = 0;
    for (const point& a : points)
    {
        for (const point& b : points)
        {
            const vector r(nearestImage(grid(), a, b));
            notShifted = max(notShifted, notPeriods(r - (a - b)));
            for (direction d = 0; d < 3; ++d)
            {
                scalar least = mag(a[d] - b[d]);
                for (label k = -3; k <= 3 && grid().periodic(d); ++k)
                {
                    least =
                        min(least, mag(a[d] - b[d] + k * grid().length()[d]));
                }
                longer = max(longer, mag(mag(r[d]) - least));
            }
        }
    }
    test::expectBelow("nearest image against all", longer, 1e-14);
    test::expectBelow("shift beside whole periods", notShifted, 1e-14);
}
