// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "deltaKernel.H"

using namespace Foam;

class DeltaKernel : public ::testing::TestWithParam<deltaKernel::kernelType>
{
protected:
    deltaKernel kernel{GetParam()};
};

TEST_P(DeltaKernel, losesNoForceBesideWalls)
{
    scalar worst = 0;
    for (scalar e = 1; e > 1e-9; e /= 4)
    {
        for (const scalar sign : {1.0, -1.0})
        {
            kernelStencil s;
            for (const scalar offset : {0.0, 0.5})
            {
                kernel.stencil(sign * e, offset, offset == 0, 9, 10, false, s);
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
