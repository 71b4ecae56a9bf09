// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "axialMean.H"
#include "unitTest.H"
#include "UList.H"

using namespace Foam;

namespace
{
axialMean over(const std::initializer_list<scalar> angles)
{
    axialMean all;
    for (const scalar angle : angles)
    {
        const axialMean line(axialMean::of(angle));
        all.cosine += line.cosine / angles.size();
        all.sine += line.sine / angles.size();
    }
    return all;
}
} // namespace

TEST(axialMean, nearlyParallelLinesAcrossTheTurn)
{
    const axialMean lines(over({179, -179, 1, -1}));
    EXPECT_NEAR(lines.value(), 0, 1e-12);
    EXPECT_NEAR(lines.deviation(), 1, 1e-3);
}

TEST(axialMean, anglesCloseTogetherAsNumbers)
{
    const axialMean lines(over({20, 22, 27}));
    EXPECT_NEAR(lines.value(), 23, 0.01);
    EXPECT_NEAR(lines.deviation(), std::sqrt(26.0 / 3), 0.01);

    // A change of cosine and sine by that of an angle of 0.5 degrees
    const scalar change = 2 * degToRad(0.5);
    EXPECT_NEAR(lines.error(change * mag(lines.sine), change * lines.cosine),
                0.5, 0.02);
}
