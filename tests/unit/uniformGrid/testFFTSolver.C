// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testMatrix.H"

using namespace Foam;
using namespace test;

TEST(FFTSolver, residualInAllBoundaryKinds)
{
    const unsigned combinations = 1u << nWalls();
    for (const scalar sigma : {0.0, 3.0})
    {
        scalar error = 0, residual = 0;
        for (unsigned d = 0; d < combinations; ++d)
        {
            const solved o(
                solveRandom(d, sigma, constantGamma(),
                            "solver FFT; tolerance 1e-30; maxIter 3;", false));
            error = max(error, o.error);
            residual = max(residual, o.residual);
        }
        const std::string what = std::to_string(combinations) +
                                 " kinds of walls, sigma " +
                                 std::to_string(int(sigma));
        test::expectBelow("residual, " + what, residual, 1e-12);
        test::expectBelow("error, " + what, error, 1e-10);
    }
}

TEST(FFTSolver, respectsSetReference)
{
    const solved o(solveRandom(0, 0, constantGamma(),
                               "solver FFT; tolerance 1e-30; maxIter 3;",
                               true));
    test::expectBelow("residual with setReference", o.residual, 1e-12);
    test::expectBelow("error with setReference", o.error, 1e-10);
}
