// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "functionTimes.H"
#include "testRefusal.H"

using namespace Foam;

namespace
{
//- Time steps of the next n at which a functionObject is due: "0101"
std::string due(const std::string& function, const label n = 6)
{
    Time& time = const_cast<Time&>(test::mesh().time());
    const label index = time.timeIndex();
    const scalar value = time.value();
    const dictionary dict(test::dictOf(function));
    std::string steps;
    for (label i = 0; i < n; ++i)
    {
        time.setTime(scalar(i), i);
        steps += isDue(dict, time) ? '1' : '0';
    }
    time.setTime(value, index);
    return steps;
}
} // namespace

TEST(FunctionTimes, timeStepsAreCounted)
{
    EXPECT_EQ(due("type thing;"), "111111");
    EXPECT_EQ(due("type thing; executeInterval 3; writeInterval 3;"), "100100");
    EXPECT_EQ(due("type thing; executeControl none; writeInterval 2;"),
              "101010");
}

TEST(FunctionTimes, thoseThatOnlyWriteWaitForIt)
{
    EXPECT_EQ(due("type writeObjects; writeInterval 2;"), "101010");
    EXPECT_EQ(due("type thing; writeInterval 2;"), "111111");
    EXPECT_EQ(due("type writeObjects; writeControl none;"), "000000");
}

TEST(FunctionTimes, unknownControlsAreTakenToLookAlways)
{
    EXPECT_EQ(due("type thing; executeControl cpuTime;"), "111111");
}
