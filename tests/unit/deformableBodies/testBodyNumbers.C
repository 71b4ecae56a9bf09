// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyNumbers.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
struct group
{
    word name_;
    label n;
    const word& name() const { return name_; }
    label nBodies() const { return n; }
};
} // namespace

// Groups without bodies included
TEST(BodyNumbers, countThroughAllGroups)
{
    const std::vector<group> groups{{"a", 3}, {"none", 0}, {"b", 1}, {"c", 5}};
    const bodyNumbers numbers(groups);
    EXPECT_EQ(numbers.nGroups(), 4);
    label next = 0;
    for (label g = 0; g < 4; ++g)
    {
        EXPECT_EQ(numbers.nBodies(g), groups[g].n);
        EXPECT_EQ(numbers.find(groups[g].name()), g);
        EXPECT_EQ(numbers.name(g), groups[g].name());
        for (label body = 0; body < groups[g].n; ++body, ++next)
        {
            EXPECT_EQ(numbers.number(g, body), next);
            EXPECT_EQ(numbers.group(next), g);
            EXPECT_EQ(numbers.body(next), body);
        }
    }
    EXPECT_EQ(next, 9);
    EXPECT_EQ(numbers.find("d"), -1);
}
