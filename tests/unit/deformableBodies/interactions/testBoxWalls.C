// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "boxWalls.H"
#include "unitTest.H"

using namespace Foam;

TEST(BoxWalls, nearestWall)
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    const vector L(grid.length());
    const point corner(grid.origin());
    boxWalls::sides sides(FixedList<bool, 2>(false));
    vector inward(Zero);
    EXPECT_EQ(boxWalls(grid, sides).distance(corner, inward), GREAT);
    EXPECT_EQ(inward, vector::zero);

    // Both sides of y and the upper one of z
    sides[1][0] = sides[1][1] = sides[2][1] = true;
    const boxWalls walls(grid, sides);
    const auto expect =
        [&](const vector& part, const scalar distance, const vector& away)
    {
        const point x(corner + cmptMultiply(part, L));
        EXPECT_NEAR(walls.distance(x, inward), distance, 1e-12 * mag(L));
        EXPECT_EQ(inward, away);
    };
    expect(vector(0.01, 0.1, 0.02), 0.1 * L.y(), vector(0, 1, 0));
    expect(vector(0.99, 0.8, 0.02), 0.2 * L.y(), vector(0, -1, 0));
    expect(vector(0.5, 0.5, 0.9), 0.1 * L.z(), vector(0, 0, -1));

    // Within a wall
    expect(vector(0.5, -0.05, 0.5), -0.05 * L.y(), vector(0, 1, 0));
}

// Patches of the mesh of unit tests are no walls
TEST(BoxWalls, patchesAreNoWalls)
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    vector inward(Zero);
    EXPECT_EQ(boxWalls(grid).distance(grid.origin(), inward), GREAT);
}
