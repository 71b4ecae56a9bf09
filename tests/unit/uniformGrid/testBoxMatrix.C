// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testMatrix.H"

using namespace Foam;
using namespace test;

TEST(BoxMatrix, refusesVariableCoefficients)
{
    surfaceScalarField gamma(constantGamma());
    forAll(gamma, facei)
    {
        gamma[facei] *= 1 + 0.1 * test::noise(gamma.mesh().Cf()[facei]);
    }
    bool refused = false;
    try
    {
        solveRandom(0, 0, gamma, "solver FFT; tolerance 1e-12;", false);
    }
    catch (const Foam::error& e)
    {
        refused = std::string(e.message()).find("vary") != std::string::npos;
    }
    EXPECT_TRUE(refused) << "a variable matrix was solved as if constant";
}
