// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "rangeCheck.H"
#include "testRefusal.H"

using namespace Foam;

namespace
{
std::string judged(const scalar value)
{
    const dictionary dict(test::dictOf("radius 1;"));
    return test::refusal(
        [&]
        {
            checkRanges(dict, {{"radius", "radius/h", value, 1, 10, 3, GREAT,
                                "the kernel is three cells wide"}});
        });
}
} // namespace

TEST(RangeCheck, outsideTheRangeIsRefusedWithTheReason)
{
    for (const scalar value : {0.9, 11.0, -1.0})
    {
        EXPECT_NE(judged(value).find("entry radius has the value radius/h = "),
                  std::string::npos);
        EXPECT_NE(judged(value).find(
                      "allowed: 1 to 10: the kernel is three cells wide"),
                  std::string::npos);
    }
}

TEST(RangeCheck, unsoundIsNoError)
{
    for (const scalar value : {2.0, 5.0})
    {
        EXPECT_EQ(judged(value), "");
    }
}

TEST(RangeCheck, endsOfRangesAreWithinDespiteRoundOff)
{
    EXPECT_EQ(judged(1 - 1e-12), "");
    EXPECT_EQ(judged(10 + 1e-12), "");
    EXPECT_NE(judged(1 - 1e-6), "");
}

TEST(RangeCheck, rangesAreSaidByTheirEnds)
{
    EXPECT_EQ(rangeOf(1, 3), "1 to 3");
    EXPECT_EQ(rangeOf(1, GREAT), "at least 1");
    EXPECT_EQ(rangeOf(-GREAT, 3), "at most 3");
}
