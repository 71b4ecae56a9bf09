// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Stability of the flow engine: convection, diffusion, and viscosities that differ

#include "testFlow.H"
#include <cmath>

using namespace Foam;
using namespace test;

TEST(FlowStability, stableAtLargeViscousSteps)
{
    const label n = 16;
    test::box b(labelVector(n, n, n), vector(1, 1, 1), wallsInY, 1);
    b.start([](const vector& x)
            { return vector(test::noise(x), 0, test::noise(x, 7)); });
    const scalar dt = 10.0 / sqr(scalar(n));
    for (const char* diffusion : {"diffusion ADI;", "diffusion FFT;"})
    {
        const flowRun o(run(b, diffusion, 200 * dt, 200));
        staggeredField zero(o.u.box());
        test::expectBelow(
            std::string("noise after 200 steps of nu dt/h^2 = 10, ") +
                diffusion,
            difference(o.u, zero), 1e-2);
    }
}

// Noise in a uniform velocity: at the stated Courant number AB2 gives a wave back half of
// what viscosity takes, at 2^(1/3) of it all. The last waves have some five cells
TEST(FlowStability, wavesOfFiveCellsDoNotGrow)
{
    struct flowCase
    {
        const char* controls;
        vector U, h;
        scalar nu;
    };
    const vector cubes(1, 1, 1);
    for (const flowCase& f :
         {flowCase{"diffusion explicit;", vector(1, 0, 0), cubes, 0.0025},
          flowCase{"diffusion explicit;", vector(0, 0, 1), cubes, 0.02},
          flowCase{"diffusion ADI;", vector(1, 0, 0), cubes, 0.02},
          flowCase{"diffusion FFT;", vector(0, 1, 0), cubes, 0.2},
          flowCase{"diffusion explicit;", vector(1, 1, 0), cubes, 0.02},
          flowCase{"diffusion explicit;", vector(1, 0, 0), vector(3, 1, 2),
                   0.05}})
    {
        const label n = 16;
        test::box b(labelVector(n, n, n), n * f.h, periodic, f.nu);
        b.start(
            [&](const vector& x)
            {
                const scalar a = 1e-6;
                return f.U + a * vector(test::noise(x), test::noise(x, 5),
                                        test::noise(x, 9));
            });
        for (const scalar share : {1.0, 1.5})
        {
            auto flow =
                b.flow((std::string("timeScheme AB2; ") + f.controls).c_str());
            const scalar Co = flow->stableCourantNo();
            const scalar dt = share * Co / flow->CourantNo(1);

            // In which waves along U decay by some e^2, those of five cells by more
            const label nSteps = label(2 * magSqr(cmptMultiply(f.h, f.U)) /
                                       magSqr(f.U) / (f.nu * dt));
            const auto noiseAfter = [&](const label steps)
            {
                for (label i = 0; i < steps; ++i)
                {
                    step(*flow, dt);
                }
                staggeredField u(velocityOf(*flow, b));
                scalar sum = 0;
                for (direction d = 0; d < 3; ++d)
                {
                    const scalar mean = Foam::sum(u[d]) / u.box().count();
                    sum += Foam::sumSqr(u[d] - mean);
                }
                return std::sqrt(sum);
            };
            const scalar before = noiseAfter(nSteps);
            const scalar growth = noiseAfter(nSteps) / before;
            char what[128];
            std::snprintf(what, sizeof(what),
                          "noise at %g of Courant number %.3f, nu %g, ", share,
                          Co, f.nu);
            if (share > 1)
                test::expectBelow(what + std::string("1/growth"), 1 / growth,
                                  0.9);
            else
                test::expectBelow(what + std::string(f.controls), growth, 0.6);
        }
    }
}

// Waves of two cells across the velocity, at the largest step for explicit diffusion
TEST(FlowStability, explicitDiffusionBearsTheCourantNumber)
{
    struct flowCase
    {
        const char* controls;
        scalar Co, number;
        vector h;
    };
    for (const flowCase& f : {flowCase{"timeScheme RK3; diffusion explicit;",
                                       1.69, 0.1299, vector(1, 1, 1)},
                              flowCase{"timeScheme RK3; diffusion explicit;",
                                       1.69, 0.1299, vector(3, 1, 2)},
                              flowCase{"timeScheme AB2; diffusion explicit;",
                                       0.61, 0.0699, vector(1, 1, 1)}})
    {
        const label n = 16;
        const scalar dt = f.Co * f.h.x();
        const scalar perNu =
            dt / 3 * (1 / sqr(f.h.x()) + 1 / sqr(f.h.y()) + 1 / sqr(f.h.z()));
        test::box b(labelVector(n, n, n), n * f.h, periodic, f.number / perNu);
        b.start(
            [](const vector& x)
            {
                return vector(1, 0, 0) + 1e-6 * vector(test::noise(x),
                                                       test::noise(x, 5),
                                                       test::noise(x, 9));
            });
        auto flow = b.flow(f.controls);
        const auto noiseAfter = [&](const label steps)
        {
            for (label i = 0; i < steps; ++i)
            {
                step(*flow, dt);
            }
            const staggeredField u(velocityOf(*flow, b));
            return std::sqrt(Foam::sumSqr(u[1]) + Foam::sumSqr(u[2]));
        };
        const scalar before = noiseAfter(40);
        test::expectBelow(std::string("noise after 40 steps, ") + f.controls,
                          noiseAfter(40) / before, 1);
    }
}

TEST(FlowStability, timeSchemeThatBearsTheStep)
{
    test::box b(labelVector(8, 8, 8), vector(8, 8, 8), periodic, 0.01);
    b.start([](const vector& x)
            { return vector(1 + 0.1 * std::sin(pi * x.y() / 4), 0, 0); });
    const auto chosen =
        [&](const char* controls, const scalar Co, const bool adjusted)
    {
        auto flow = b.flow(controls);
        const scalar dt = Co / flow->CourantNo(1);
        flow->chooseTimeScheme(dt, adjusted);
        step(*flow, dt);
        EXPECT_EQ(flow->nStages(), flow->timeScheme() == "RK3" ? 3 : 1);
        return flow->timeScheme();
    };
    // AB2 bears (3.4 nu/(u h))^(1/3) = 0.31 less the terms of higher order
    EXPECT_EQ(chosen("", 0.27, false), "AB2");
    EXPECT_EQ(chosen("", 0.4, false), "RK3");
    EXPECT_EQ(chosen("", 0.6, true), "AB2");
    EXPECT_EQ(chosen("", 1.5, true), "RK3");
    EXPECT_EQ(chosen("timeScheme AB2;", 1.5, true), "AB2");
    EXPECT_EQ(chosen("timeScheme RK3;", 0.3, false), "RK3");
    EXPECT_EQ(chosen("convection off;", 1.5, false), "AB2");
}

TEST(FlowStability, dropOfOtherViscosity)
{
    const label n = 16;
    for (const scalar ratio : {0.1, 10.0, 100.0})
    {
        const scalar largest = max(ratio, scalar(1));
        char what[128];
        for (const scalar number : {1.0, 10.0})
        {
            const auto noiseAfter = [&](const label steps)
            {
                auto b = drop(n, ratio);
                b->start(
                    [](const vector& x)
                    { return vector(test::noise(x), 0, test::noise(x, 7)); });
                const flowRun o(run(*b, "diffusion ADI;",
                                    steps * number / sqr(scalar(n)) / largest,
                                    steps));
                return difference(o.u, staggeredField(o.u.box()));
            };
            const scalar before = noiseAfter(400), after = noiseAfter(1600);
            std::snprintf(
                what, sizeof(what),
                "    noise kept from step 400 to 1600, viscosity ratio "
                "%g, nu_max dt/h^2 = %g, of %.1e",
                ratio, number, before);
            test::expectBelow(what, after / before, 0.7);
        }
    }
}
