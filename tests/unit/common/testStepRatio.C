// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stepRatio.H"
#include "unitTest.H"

using namespace Foam;

TEST(StepRatio, isThatOfTheStepsUpToFour)
{
    EXPECT_EQ(stepRatio(0.5, 1), 0.5);
    EXPECT_EQ(stepRatio(4, 1), 4);
}

TEST(StepRatio, isZeroWithoutALastStepOrAfterAFarShorterOne)
{
    EXPECT_EQ(stepRatio(1, 0), 0);
    EXPECT_EQ(stepRatio(4.1, 1), 0);
}
