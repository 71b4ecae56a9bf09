// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fibreResistances.H"
#include "unitTest.H"

using namespace Foam;

// A push at s' adds 1 + 12 |s s'| of the speed in the middle at s: against the sum over
// all pairs of points of a rod, one body after the other
TEST(FibreResistances, implicitLossOfRods)
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    const scalar h = cmptMax(grid.h());
    contactPoints points(grid);
    points.clear(3);
    const vectorField x{List<vector>({vector::zero, vector(3 * h, 0, 0)})};
    points.addLine(0, 0, x, x, 0.2 * h, false);
    points.addLine(2, 2, x, x, 0.4 * h, false);
    lineMotions motions(points.size());
    points.moveLine(0, x, x, motions);
    points.moveLine(2, x, x, motions);
    scalarField k(points.size());
    forAll(k, i)
    {
        k[i] = 1 + i % 3;
    }
    const scalarField mobility{scalarList({0.5, 7, 2})};
    const scalarField loss(
        fibreResistances::implicit(points, motions.along, mobility, k));
    scalar wrong = 0;
    for (const label b : {0, 2})
    {
        const contactPoints::range& body = points.ofBody(b);
        EXPECT_GT(body.size, 5);
        for (label i = body.first; i < body.end(); ++i)
        {
            scalar expected = 0;
            for (label j = body.first; j < body.end(); ++j)
            {
                expected += mobility[b] * k[j] *
                            (1 + 12 * motions.along[i] * motions.along[j]);
            }
            wrong = max(wrong, mag(loss[i] / expected - 1));
        }
    }
    test::expectBelow("loss of speed against all pairs", wrong, 1e-13);
}
