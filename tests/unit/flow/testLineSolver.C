// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lineSolver.H"
#include "testWaves.H"

using namespace Foam;
using namespace test;

TEST(LineSolver, solvesForWaves)
{
    if (!blocks()) return; // rectangular blocks are required
    const cellBox& box = grid().box();
    scalar worst = 0;
    for (direction d = 0; d < 3; ++d)
    {
        for (const bool faces : {false, true})
        {
            const auto sides(conditions(3, faces ? d : -1));
            const waves w(sides);
            lineSolver solver(grid(), d, faces);
            for (const scalar beta : {0.01, 1.0, 100.0})
            {
                scalarField exact(box.nPlaces(), Zero), x(box.nPlaces());
                box.cells([&](const label i, const labelVector& c)
                          { exact[i] = w.at(c); });
                x = (1 + beta * w.along[d].eigenvalue()) * exact;
                solver.begin(x.data(), beta);
                solver.finish(x.data());
                worst = max(worst, gMax(mag(x - exact)));
            }
        }
    }
    // Round-off times 1 + 4 beta
    test::expectBelow("lines of a wave, error", worst, 1e-12);
}

TEST(LineSolver, keepsLinearProfilesBetweenWalls)
{
    if (!blocks()) return;
    const cellBox& box = grid().box();
    scalar worst = 0;
    for (direction d = 0; d < 3; ++d)
    {
        if (grid().periodic(d)) continue;
        lineSolver solver(grid(), d, false);
        scalarField exact(box.nPlaces(), Zero), x;
        box.cells([&](const label i, const labelVector& c)
                  { exact[i] = -1 + 3 * (c[d] + 0.5) / grid().n()[d]; });
        x = exact;
        solver.begin(x.data(), 10, -1, 2);
        solver.finish(x.data());
        worst = max(worst, gMax(mag(x - exact)));
    }
    test::expectBelow("linear profile, change", worst, 1e-13);
}
