// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "squeezeFilms.H"
#include "unitTest.H"

using namespace Foam;

TEST(squeezeFilms, makeUpForAllInContactAndNothingAtTwoCells)
{
    for (const auto& lack : {squeezeFilms::lack, squeezeFilms::lackAtWall})
    {
        EXPECT_EQ(lack(0), 1);
        EXPECT_EQ(lack(2), 0);
        EXPECT_LT(lack(1.99), 1e-3);
        for (scalar gap = 0; gap < 1.9; gap += 0.1)
        {
            EXPECT_LT(lack(gap + 0.1), lack(gap));
        }
    }
}
