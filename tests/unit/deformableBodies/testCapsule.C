// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsule.H"
#include "capsuleNearField.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
//- A capsule of degree 5 with all fields that motions and near field may have
capsule full()
{
    const size_t n = 3 * 36;
    capsule c;
    c.lastDeltaT = 0.25;
    double value = 0;
    for (capsule::coefficients* v : {&c.x, &c.velocity, &c.previous, &c.lag,
                                     &c.lagBefore, &c.onFluid, &c.nearMemory})
    {
        v->resize(v == &c.nearMemory ? capsuleNearField::memorySize * n : n);
        for (double& x : *v)
        {
            x = value += 0.5;
        }
    }
    return c;
}
} // namespace

TEST(Capsule, stateIsRestored)
{
    const capsule c(full());
    capsule again;
    again.x.resize(c.x.size());
    again.restore(c.state(), true, true, true);
    EXPECT_EQ(again.state(), c.state());
    EXPECT_EQ(capsule::degreeOf(c.state()), 5);
    EXPECT_LT(mag(capsule::centreOf(c.state()) - c.centre()), 1e-15);
}

TEST(Capsule, fieldsOfOtherMotionsAreLeftOut)
{
    const capsule c(full());
    capsule again;
    again.x.resize(c.x.size());
    again.restore(c.state(), true, false, false);
    EXPECT_EQ(again.previous, c.previous);
    EXPECT_TRUE(again.lag.empty());
    EXPECT_TRUE(again.onFluid.empty());
    EXPECT_TRUE(again.nearMemory.empty());
}

TEST(Capsule, otherStatesAreNoCapsules)
{
    scalarList state(full().state());
    state.setSize(state.size() - 1);
    EXPECT_EQ(capsule::degreeOf(state), -1);
    EXPECT_EQ(capsule::degreeOf(scalarList()), -1);
    EXPECT_EQ(capsule::degreeOf(scalarList(18, 0.5)), -1);
}
