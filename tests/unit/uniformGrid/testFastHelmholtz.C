// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fastHelmholtz.H"
#include "testWaves.H"

using namespace Foam;
using namespace test;

namespace
{
//- Error of the solution for a product of waves as right-hand side
scalar errorOf(const FixedList<sideConditions, 3>& sides, const scalar sigma)
{
    const FixedList<scalar, 3> a({1.3, 0.7, 2.0});
    const waves w(sides);
    scalar eigenvalue = sigma;
    for (direction d = 0; d < 3; ++d)
    {
        eigenvalue += a[d] * w.along[d].eigenvalue();
    }
    const List<labelVector> cells(grid().cells());
    scalarField exact(cells.size()), x(cells.size());
    forAll(exact, i)
    {
        exact[i] = w.at(cells[i]);
    }
    x = eigenvalue * exact;
    fastHelmholtz solver(grid(), sides);
    solver.solve(x.data(), x.cdata(), sigma, a);
    return gMax(mag(x - exact));
}
} // namespace

TEST(FastHelmholtz, solvesForWaves)
{
    for (const scalar sigma : {0.0, 3.0})
    {
        scalar worst = 0;
        for (unsigned code = 0; code < 4; ++code)
        {
            worst = max(worst, errorOf(conditions(code), sigma));
        }
        test::expectBelow("error at the cell centres, sigma " +
                              std::to_string(int(sigma)),
                          worst, 1e-13);
    }
}

TEST(FastHelmholtz, solvesForValuesOnWalls)
{
    scalar worst = 0;
    for (label d = 0; d < 3; ++d)
    {
        worst = max(worst, errorOf(conditions(3, d), 1));
    }
    test::expectBelow("error on faces", worst, 1e-13);
}

TEST(FastHelmholtz, ignoresTheMeanWhereItIsFree)
{
    const auto sides(conditions(0));
    fastHelmholtz solver(grid(), sides);
    EXPECT_TRUE(solver.singular(0));
    EXPECT_FALSE(solver.singular(1));
    scalarField x(mesh().nCells(), 5);
    solver.solve(x.data(), x.cdata(), 0, FixedList<scalar, 3>(1));
    test::expectBelow("solution for a constant", gMax(mag(x)), 1e-13);
}
