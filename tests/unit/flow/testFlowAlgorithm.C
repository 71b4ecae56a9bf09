// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "flowAlgorithm.H"
#include "testBox.H"

using namespace Foam;

namespace
{
flowAlgorithm algorithm(const char* entries, const string& obstacle)
{
    IStringStream is(entries);
    return flowAlgorithm(dictionary(is), [&]() { return obstacle; });
}
} // namespace

TEST(FlowAlgorithm, isStaggeredUnlessSomethingIsInTheWay)
{
    for (const char* entries : {"", "flowAlgorithm auto;"})
    {
        EXPECT_TRUE(algorithm(entries, "").staggered());
        EXPECT_FALSE(algorithm(entries, "of a reason").staggered());
        EXPECT_EQ(algorithm(entries, "of a reason").reason(), "of a reason");
    }
    EXPECT_TRUE(algorithm("flowAlgorithm staggered;", "").staggered());
    EXPECT_FALSE(algorithm("flowAlgorithm pimple;", "").staggered());
}

TEST(FlowAlgorithm, refusesWhatCannotBe)
{
    EXPECT_THROW(algorithm("flowAlgorithm staggered;", "of a reason"),
                 Foam::IOerror);
    EXPECT_THROW(algorithm("flowAlgorithm stagered;", ""), Foam::IOerror);
}

TEST(FlowAlgorithm, knowsTheModels)
{
    test::box b(labelVector(4, 4, 4), vector(1, 1, 1), {false, true, false}, 1);
    const auto obstacle = [&](const word& transport, const word& turbulence)
    {
        return flowAlgorithm::obstacle(*b.U, *b.p, fv::optionList(b.mesh()),
                                       transport, turbulence);
    };
    EXPECT_EQ(obstacle("Newtonian", "Stokes"), "");
    EXPECT_EQ(obstacle("prescribed", "Stokes"), "");
    EXPECT_NE(obstacle("CrossPowerLaw", "Stokes"), "");
    EXPECT_NE(obstacle("Newtonian", "kEpsilon"), "");
}
