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
        EXPECT_FALSE(algorithm(entries, "there is a reason").staggered());
        EXPECT_EQ(algorithm(entries, "there is a reason").reason(), "there is a reason");
    }
    EXPECT_TRUE(algorithm("flowAlgorithm staggered;", "").staggered());
    EXPECT_FALSE(algorithm("flowAlgorithm pimple;", "").staggered());
}

TEST(FlowAlgorithm, refusesWhatCannotBe)
{
    EXPECT_THROW(algorithm("flowAlgorithm staggered;", "there is a reason"),
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

TEST(FlowAlgorithm, namesTheEffects)
{
    const auto effects = [](const string& obstacle, const bool flows)
    {
        std::string all;
        for (const auto& e : algorithm("", obstacle).effects(flows))
        {
            all += e.name + (e.active ? ": " : " skipped: ") + e.note + "; ";
        }
        return all;
    };
    EXPECT_EQ(effects("", true),
              "momentum: staggered; pressure: fast transforms; "
              "diffusion: its implicit part; "
              "fields: U, p, phi when they are looked at; ");
    EXPECT_EQ(effects("", false), "momentum skipped: coupling none; "
                                  "pressure skipped: fast transforms; ");
    EXPECT_EQ(effects("there is a reason", true),
              "momentum: pimple; pressure: pimple, PISO corrections; ");
}

TEST(FlowAlgorithm, expectsAStableCourantNumber)
{
    test::box b(labelVector(4, 4, 4), vector(1, 1, 1), {false, true, false}, 1);
    const auto stable =
        [&](const string& obstacle, const bool bodies, const label nOuter)
    {
        CourantGuard guard(*b.phi);
        algorithm("", obstacle).expect(guard, bodies, nOuter);
        return guard.stable();
    };
    for (const char* obstacle : {"", "there is a reason"})
    {
        EXPECT_EQ(stable(obstacle, true, 1), 1);
        EXPECT_EQ(stable(obstacle, true, 2), 1);
        EXPECT_EQ(stable(obstacle, false, 2), GREAT);
    }
    EXPECT_EQ(stable("", false, 1), GREAT);
    EXPECT_EQ(stable("there is a reason", false, 1), 5);
}

TEST(FlowAlgorithm, refusesNegativeViscosity)
{
    EXPECT_NO_THROW(flowAlgorithm::checkViscosity(dictionary(), 0));
    EXPECT_THROW(flowAlgorithm::checkViscosity(dictionary(), -1e-9),
                 Foam::IOerror);
}
