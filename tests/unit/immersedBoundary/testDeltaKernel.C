// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "deltaKernel.H"

using namespace Foam;

class DeltaKernel : public ::testing::TestWithParam<deltaKernel::kernelType>
{
protected:
    deltaKernel kernel{GetParam()};
};

// The weights at many positions are values of phi, and the sum of their squares does not
// depend on the position
TEST_P(DeltaKernel, weightsAreThoseOfTheFunction)
{
    const label n = 1000;
    scalarField x(n), lowest(n), w0(n), w1(n), w2(n), w3(n);
    forAll(x, k)
    {
        x[k] = 7 + 0.013 * k;
    }
    scalar* const weight[4] = {w0.data(), w1.data(), w2.data(), w3.data()};
    kernel.weights(n, x.cdata(), lowest.data(), weight);
    scalar worst = 0, squares = 0;
    forAll(x, k)
    {
        scalar sum = 0;
        for (label i = 0; i < 4; ++i)
        {
            const scalar w = weight[i][k];
            worst = max(worst, mag(w - kernel.phi(x[k] - (lowest[k] + i))));
            sum += w * w;
        }
        squares = max(squares, mag(sum - kernel.sumOfSquares()));
    }
    test::expectBelow("weights against the function", worst, 1e-14);
    test::expectBelow("sum of squares", squares, 1e-14);
}

TEST_P(DeltaKernel, losesNoForceBesideWalls)
{
    scalar worst = 0;
    for (scalar e = 1; e > 1e-9; e /= 4)
    {
        for (const scalar sign : {1.0, -1.0})
        {
            for (const scalar offset : {0.0, 0.5})
            {
                const kernelStencil s(
                    kernel.stencil(sign * e, offset, offset == 0, 9));
                scalar sum = 0;
                for (label k = 0; k < s.size; ++k)
                {
                    sum += s.weight[k];
                }
                worst = max(worst, mag(sum - 1));
            }
        }
    }
    test::expectBelow("sum of weights - 1, from a cell off to past the wall",
                      worst, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(kernels, DeltaKernel,
                         ::testing::Values(deltaKernel::Roma3,
                                           deltaKernel::Peskin4),
                         [](const auto& i)
                         { return deltaKernel::names[i.param]; });
