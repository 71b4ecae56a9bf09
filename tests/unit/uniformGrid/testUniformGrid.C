// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "uniformGrid.H"

using namespace Foam;

TEST(UniformGrid, recognisesTheBox)
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    EXPECT_TRUE(grid.valid()) << grid.reason();
    EXPECT_EQ(grid.n(), labelVector(12, 10, 8));
}
