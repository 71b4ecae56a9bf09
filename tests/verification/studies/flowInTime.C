// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Orders of the staggered flow in time: differences of runs with n, 2n, 4n steps

#include "testFlow.H"
#include "testOrder.H"

using namespace Foam;
using namespace test;

namespace
{
//- Order in time: differences of runs with n, 2n, 4n steps
template<class Start>
scalar timeOrder(const labelVector& n, const vector& L,
                 const FixedList<bool, 3>& walls, const scalar nu,
                 const Start start, const char* controls, const scalar end,
                 const label steps, const scalar wobble = 0)
{
    std::vector<staggeredField> u;
    for (const label refinement : {1, 2, 4})
    {
        test::box b(n, L, walls, nu);
        b.start(start);
        const flowRun o(run(b, controls, end, refinement * steps, wobble));
        EXPECT_LE(o.divergence, 1e-14);
        u.push_back(o.u);
    }
    return std::log2(difference(u[0], u[1]) / difference(u[1], u[2]));
}
} // namespace

TEST(FlowOrders, orderInTimePeriodic)
{
    struct scheme
    {
        const char* controls;
        scalar nu;
        label steps;
        scalar wobble, least;
    };
    for (const scheme& s :
         {scheme{"diffusion explicit;", 0.002, 40, 0, 1.9},
          scheme{"diffusion ADI;", 0.02, 40, 0, 1.9},
          scheme{"diffusion ADI;", 0.02, 40, 0.3, 1.9},
          scheme{"diffusion FFT;", 0.02, 40, 0, 1.9},
          scheme{"diffusion explicit;", 0.002, 40, 0.3, 1.9},
          scheme{"timeScheme RK3; diffusion explicit;", 0.002, 20, 0, 2.9},
          scheme{"timeScheme RK3; diffusion ADI;", 0.02, 20, 0, 1.9}})
    {
        expectOrder(std::string("periodic, order in time, ") + s.controls +
                        (s.wobble ? " steps alternate +-30 %" : ""),
                    timeOrder(labelVector(16, 16, 16),
                              vector(2 * pi, 2 * pi, 2 * pi), periodic, s.nu,
                              vortices, s.controls, 2, s.steps, s.wobble),
                    s.least);
    }
}

TEST(FlowOrders, orderInTimeBetweenWalls)
{
    // nu dt/h^2 of the coarsest of three runs, at a Courant number of 0.3
    const label n = 16;
    const scalar h = 1.0 / n, dt = 0.3 * h;
    for (const scalar number : {0.1, 0.5, 2.5})
    {
        for (const char* diffusion : {"diffusion ADI;", "diffusion FFT;"})
        {
            char what[100];
            std::snprintf(what, sizeof(what),
                          "walled vortex, order in time, nu dt/h^2 %.1f %s",
                          number, diffusion);
            expectOrder(what,
                        timeOrder(labelVector(2 * n, n, 2 * n), vector(2, 1, 2),
                                  wallsInY, number * h * h / dt, walledVortex,
                                  diffusion, 10 * dt, 10),
                        1.9);
        }
    }
}

TEST(FlowOrders, kineticEnergyWithoutViscosity)
{
    for (const bool RK3 : {false, true})
    {
        const char* controls = RK3 ? "timeScheme RK3;" : "";
        const auto drift = [&](const label steps)
        {
            test::box b(labelVector(16, 16, 16), vector(2 * pi, 2 * pi, 2 * pi),
                        periodic, 0);
            b.start(vortices);
            auto flow = b.flow(controls);
            const scalar dt = 2.0 / steps;
            step(*flow, dt); // makes the velocity divergence-free; AB2 begins with Euler
            const auto energy = [&]()
            {
                const staggeredField u(velocityOf(*flow, b));
                return sumSqr(u[0]) + sumSqr(u[1]) + sumSqr(u[2]);
            };
            const scalar before = energy();
            for (label n = 0; n < steps; ++n)
            {
                flow->force().clear();
                step(*flow, dt);
            }
            return mag(energy() / before - 1);
        };
        const scalar coarse = drift(40), fine = drift(80);
        test::expectBelow(
            std::string("energy drift in 2 time units, 80 steps ") + controls,
            fine, RK3 ? 3e-6 : 3e-5);
        expectOrder("    its order in time", std::log2(coarse / fine),
                    RK3 ? 2.8 : 1.9);
    }
}

TEST(FlowOrders, oscillatingWall)
{
    // Wall that moves with sin(t): order in time; the velocity of walls is read each step
    // from a condition that changes
    std::vector<staggeredField> u;
    for (const label steps : {20, 40, 80})
    {
        test::box b(labelVector(4, 32, 4), vector(1, 1, 1), wallsInY, 0.5,
                    "noSlip");
        auto flow = b.flow("diffusion ADI;");
        const scalar dt = 2.0 / steps;
        for (label n = 1; n <= steps; ++n)
        {
            const scalar t = n * dt;
            b.moveWalls(Zero, vector(sqr(std::sin(t)), 0, 0));
            flow->force().clear();
            step(*flow, dt);
        }
        u.push_back(velocityOf(*flow, b));
    }
    expectOrder("oscillating wall, order in time",
                std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                1.9);
}
