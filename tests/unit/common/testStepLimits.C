// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stepLimits.H"
#include "testBox.H"

using namespace Foam;

namespace
{
//- Limits in a run with given entries of controlDict, at time 0
struct run
{
    test::box b;
    Time time;
    stepLimits limits;

    static dictionary controls(const char* entries)
    {
        IStringStream is(
            "startFrom startTime; startTime 0; stopAt endTime; endTime 100;"
            "deltaT 1; writeControl adjustableRunTime; writeInterval 1;");
        dictionary dict(is);
        IStringStream more(entries);
        dict.merge(dictionary(more));
        return dict;
    }

    explicit run(const char* entries)
        : b(labelVector(4, 4, 4), vector(1, 1, 1), {false, false, false}, 1),
          time(controls(entries), test::mesh().time().rootPath(),
               test::mesh().time().caseName(), "system", "constant", false),
          limits(time, *b.phi)
    {
        limits.readControls();
        limits.guard().expect(1, "the scheme", true);
    }
};
} // namespace

TEST(StepLimits, theSmallestBinds)
{
    run r("adjustTimeStep yes; maxCo 0.5; maxDeltaT 3;");
    r.limits.setCourantNo(2);
    const auto expectBinding = [&](const scalar dt, const char* why)
    {
        EXPECT_DOUBLE_EQ(r.limits.binding().dt, dt);
        EXPECT_EQ(r.limits.binding().why, why);
    };
    expectBinding(0.25, "maxCo");
    r.limits.guard().expect(0.1, "the scheme", true);
    expectBinding(0.05, "the scheme");
    r.limits.set("bodies", 0.01, "waves of group cells");
    expectBinding(0.01, "waves of group cells");
    r.limits.set("diffusion", 0.005, "diffusion explicit");
    expectBinding(0.005, "diffusion explicit");

    // A row that is set again replaces the one before
    r.limits.set("diffusion", GREAT, "", "implicit");
    r.limits.set("bodies", GREAT, "", "none");
    expectBinding(0.05, "the scheme");
    r.limits.setCourantNo(0);
    expectBinding(1.2, "slow growth");
}

TEST(StepLimits, maxDeltaTBinds)
{
    run r("adjustTimeStep yes; deltaT 3; maxDeltaT 3.1;");
    EXPECT_EQ(r.limits.binding().why, "maxDeltaT");
    EXPECT_DOUBLE_EQ(r.limits.binding().dt, 3.1);
}

TEST(StepLimits, stepsGrowByAFifthAtMost)
{
    run r("adjustTimeStep yes; maxCo 1;");
    const auto stepAt = [&](const scalar Co)
    {
        r.limits.setCourantNo(Co);
        return r.limits.binding().dt;
    };
    EXPECT_NEAR(stepAt(0.01), 1.2, 1e-12);
    EXPECT_NEAR(stepAt(1 / 1.5), 1.15, 1e-12);
    EXPECT_NEAR(stepAt(1), 1, 1e-12);

    // Reduced at once
    EXPECT_NEAR(stepAt(4), 0.25, 1e-12);
}

TEST(StepLimits, stepsMeetWriteTimesFromBelow)
{
    run r("");
    for (scalar limit = 0.05; limit < 1.9; limit *= 1.03)
    {
        stepLimits::setRounded(r.time, limit);
        const scalar deltaT = r.time.deltaTValue();
        EXPECT_LE(deltaT, (1 + 1e-6) * limit);
        EXPECT_GE(deltaT, 0.5 * min(limit, scalar(1)));
        EXPECT_NEAR(1 / deltaT, std::round(1 / deltaT), 1e-9) << limit;
    }
}

TEST(StepLimits, adjustedStepKeepsTheVelocity)
{
    run r("adjustTimeStep yes; maxCo 0.5;");
    r.limits.setCourantNo(2);
    r.limits.adjust(r.time);
    EXPECT_NEAR(r.time.deltaTValue(), 0.25, 1e-12);
    EXPECT_NEAR(r.limits.CourantNo(), 0.5, 1e-12);

    // A Courant number that was measured in a sub-step
    run divided("adjustTimeStep yes; maxCo 0.5;");
    divided.time.subCycle(8);
    ++divided.time;
    divided.limits.setCourantNo(0.5);
    divided.time.endSubCycle();
    EXPECT_NEAR(divided.limits.binding().dt, 0.125, 1e-12);
    EXPECT_NEAR(divided.limits.smallestOther(), 0.125, 1e-12);

    run fixed("adjustTimeStep no; maxCo 0.5;");
    fixed.limits.setCourantNo(2);
    fixed.limits.adjust(fixed.time);
    EXPECT_EQ(fixed.time.deltaTValue(), 1);
}

TEST(StepLimits, smallestOtherLeavesOutTheScheme)
{
    run r("adjustTimeStep yes; maxCo 2; maxDeltaT 30;");
    r.limits.guard().expect(0.1, "the scheme", true);
    r.limits.setCourantNo(0.5);
    EXPECT_NEAR(r.limits.smallestOther(), 4, 1e-12);
    r.limits.set("diffusion", 3, "diffusion explicit");
    EXPECT_EQ(r.limits.smallestOther(), 3);
}

TEST(StepLimits, printsTheTable)
{
    run r("adjustTimeStep yes; maxCo 0.5;");
    r.limits.set("diffusion", GREAT, "", "implicit");
    r.limits.set("bodies", 0.125, "waves of group cells");
    const auto table = [&]()
    {
        OStringStream os;
        r.limits.print(os);
        return os.str();
    };
    EXPECT_EQ(table(),
              "Limits of the time step (deltaT is 1, adjusted)\n"
              "    flow        none, at rest\n"
              "    diffusion   none, implicit\n"
              "    bodies      0.125 s, waves of group cells\n"
              "    controlDict none, no maxDeltaT; Courant number up to maxCo "
              "0.5\n"
              "    endTime     after some 800 steps\n\n");
    r.limits.setCourantNo(4);
    EXPECT_NE(table().find("flow        0.25 s, Courant number 1 for the "
                           "scheme\n"),
              std::string::npos);
}

TEST(StepLimits, refusesWrongInput)
{
    for (const char* entries : {"maxCo 0;", "maxDeltaT -1;"})
    {
        for (const std::string adjusted : {"yes; ", "no; "})
        {
            EXPECT_THROW(run(("adjustTimeStep " + adjusted + entries).c_str()),
                         Foam::IOerror);
        }
    }
}

TEST(StepLimits, checksTheCourantNumber)
{
    run r("");
    const auto message = [&](const scalar Co)
    {
        r.limits.setCourantNo(Co);
        try
        {
            r.limits.check([]() {});
        }
        catch (const Foam::error& e)
        {
            return std::string(e.message());
        }
        return std::string();
    };
    EXPECT_EQ(message(0.5), "");
    EXPECT_EQ(message(19), "");
    EXPECT_NE(message(21).find("Courant number 21, limit 20"),
              std::string::npos);
    EXPECT_NE(message(CourantGuard::notFinite)
                  .find("the velocity is not finite"),
              std::string::npos);
}

TEST(StepLimits, checksEstimates)
{
    run r("");
    const auto message = [&](const scalar limit)
    {
        r.limits.set("bodies", limit, "waves of group cells");
        try
        {
            r.limits.checkEstimate("bodies");
        }
        catch (const Foam::error& e)
        {
            return std::string(e.message());
        }
        return std::string();
    };
    EXPECT_EQ(message(1), "");
    EXPECT_EQ(message(0.1), "");
    const std::string hopeless(message(0.004));
    EXPECT_NE(hopeless.find("deltaT 1 exceeds the estimated limit of the waves "
                            "of group cells, 0.004 s, by a factor of 250"),
              std::string::npos);
    EXPECT_NE(hopeless.find("allowed: deltaT up to 0.004"), std::string::npos);
}
