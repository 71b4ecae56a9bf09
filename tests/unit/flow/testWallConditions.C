// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testFlow.H"

using namespace Foam;
using namespace test;

TEST(WallConditions, wallsMustMoveAsOne)
{
    test::box b(labelVector(4, 4, 4), vector(1, 1, 1), wallsInY, 1, "noSlip");
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

    // A wall that goes wrong on the way
    b.moveWalls(Zero, Zero);
    auto flow = b.flow("");
    step(*flow, 0.001);
    b.U->boundaryFieldRef()[3][5] = vector(1, 0, 0);
    EXPECT_THROW(step(*flow, 0.001), Foam::IOerror);
}
