// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testMatrix.H"

using namespace Foam;
using namespace test;

TEST(FFTPreconditioner, preconditionsVariableCoefficients)
{
    const solved o(solveRandom(0, 0, wallGamma(),
                               "solver PCG; preconditioner FFT; "
                               "tolerance 1e-8; relTol 0;",
                               false));
    test::expectBelow("PCG + FFT iterations to 1e-8, 1/A beside walls",
                      o.iterations, 8);
    test::expectBelow("its residual", o.residual, 1e-8);
}
