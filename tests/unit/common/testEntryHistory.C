// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "entryHistory.H"
#include "testRefusal.H"

using namespace Foam;
using test::dictOf;

TEST(GivenEntries, changesAreNamedWithTheirDictionaries)
{
    const auto then =
        entriesOf(dictOf("membrane { Gs 30; law Hooke; } harmonics 8;"), {});
    const auto now =
        entriesOf(dictOf("membrane { Gs 60; law Hooke; } gravity on;"), {});
    const List<changedEntry> all(changes(then, now));
    ASSERT_EQ(all.size(), 3);
    EXPECT_EQ(all[0].text(), "gravity not given, now on");
    EXPECT_EQ(all[1].text(), "harmonics 8, now not given");
    EXPECT_EQ(all[2].text(), "membrane.Gs 30, now 60");
}

TEST(GivenEntries, orderAndBlanksAreNoChange)
{
    const auto then = entriesOf(dictOf("a 1; b ( 1 2 );"), {});
    const auto now = entriesOf(dictOf("b (1  2); a 1;"), {});
    EXPECT_TRUE(changes(then, now).empty());
}

TEST(GivenEntries, someAreLeftOut)
{
    const auto all = entriesOf(dictOf("a 1; b 2; c { b 3; }"), {"b"});
    ASSERT_EQ(all.size(), 2);
    EXPECT_EQ(all[0].first(), "a");
    EXPECT_EQ(all[1].first(), "c.b");
}

TEST(GivenEntries, longValuesAreKeptAsADigestThatTellsThemApart)
{
    const std::string zeros(300, '0');
    const auto then = entriesOf(dictOf("a \"" + zeros + "1\";"), {});
    const auto now = entriesOf(dictOf("a \"" + zeros + "2\";"), {});
    EXPECT_LT(then[0].second().size(), 60u);
    EXPECT_TRUE(changes(then, then).empty());
    ASSERT_EQ(changes(then, now).size(), 1);
    EXPECT_EQ(changes(then, now)[0].text(), "a (...), now (...)");
}
