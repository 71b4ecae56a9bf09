// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "warnRarely.H"
#include "unitTest.H"

using namespace Foam;

TEST(WarnRarely, warnsFirstAndAfterThePause)
{
    warnRarely rarely;
    EXPECT_TRUE(rarely.due(7));
    EXPECT_TRUE(rarely.due(7)); // nothing was warned of yet
    rarely.warned(7);
    EXPECT_FALSE(rarely.due(7));
    EXPECT_FALSE(rarely.due(6 + warnRarely::pause));
    EXPECT_TRUE(rarely.due(7 + warnRarely::pause));
    rarely.warned(7 + warnRarely::pause);
    EXPECT_FALSE(rarely.due(8 + warnRarely::pause));

    warnRarely often(10);
    often.warned(0);
    EXPECT_FALSE(often.due(9));
    EXPECT_TRUE(often.due(10));
}

TEST(WarnRarely, warnsOnce)
{
    warnRarely once(warnRarely::once);
    EXPECT_TRUE(once.due(0));
    once.warned(0);
    EXPECT_FALSE(once.due(1));
    EXPECT_FALSE(once.due(labelMax));
}
