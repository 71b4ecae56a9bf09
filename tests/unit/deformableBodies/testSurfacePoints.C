// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "surfacePoints.H"
#include "unitTest.H"

using namespace Foam;

// A capsule in a uniform stream is carried without a change of its shape, and in a linear flow
// without waves of higher degrees: on the coarsest grids, too
TEST(SurfacePoints, linearFieldsHaveNoHigherHarmonics)
{
    for (const std::pair<label, label>& grid :
         {std::pair<label, label>(6, 10), {7, 10}, {7, 12}, {8, 12}, {10, 12}})
    {
        const label degree = grid.first;
        const surfacePoints points(degree, grid.second, degree);
        std::vector<vector> v(points.size());
        for (label k = 0; k < points.size(); ++k)
        {
            const vector x(points.onUnitSphere(k));
            v[k] = vector(1, x.x(), x.z());
        }
        std::vector<double> coeffs(3 * points.grid().nCoeffs());
        points.analysis(v.data(), coeffs.data());
        double higher = 0, all = 0;
        for (size_t i = 0; i < coeffs.size(); ++i)
        {
            const bool wanted = points.grid().degreeOf(i / 3) <= 1;
            (wanted ? all : higher) += sqr(coeffs[i]);
        }
        EXPECT_LT(std::sqrt(higher / all), 1e-13)
            << degree << " on " << grid.second << " latitudes";
    }
}
