// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testFlow.H"

using namespace Foam;
using namespace test;

TEST(WallConditions, wallsMustMoveAsOne)
{
    test::box b(labelVector(4, 4, 4), vector(1, 1, 1), wallsInY, 1);
    b.moveWalls(Zero, vector(1, 0, 2));
    EXPECT_EQ(wallConditions::unsupported(*b.U, *b.p), "");
    b.U->boundaryFieldRef()[3][5] = Zero;
    EXPECT_EQ(wallConditions::unsupported(*b.U, *b.p),
              "the velocity of a wall must be uniform, and it is not on the "
              "upper side in y");
    b.moveWalls(vector(0, 0.1, 0), Zero);
    EXPECT_EQ(wallConditions::unsupported(*b.U, *b.p),
              "the velocity of a wall must be tangential, and it is not on the "
              "lower side in y");
}

// By noSlip, whose values are kept in some releases and reset to 0 in others
TEST(WallConditions, aWallThatGoesWrongOnTheWay)
{
    test::box b(labelVector(4, 4, 4), vector(1, 1, 1), wallsInY, 1, "noSlip");
    b.moveWalls(Zero, Zero);
    auto flow = b.flow("");
    step(*flow, 0.001);
    fvPatchVectorField& wall = b.U->boundaryFieldRef()[3];
    wall[5] = vector(1, 0, 0);
    wall.evaluate();
    if (mag(wall[5]) > 0)
        EXPECT_THROW(step(*flow, 0.001), Foam::IOerror);
    else
        EXPECT_NO_THROW(step(*flow, 0.001));
}
