// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Orders in time of flows in which the viscosity varies

#include "testFlow.H"
#include "testOrder.H"

using namespace Foam;
using namespace test;

TEST(FlowOrders, layersOfTwoViscosities)
{
    // Decay of a shear across two layers: lower half nu = 1, upper half nu = ratio
    const label n = 16;
    for (const scalar ratio : {0.1, 0.5, 2.0, 10.0, 100.0})
    {
        const scalar largest = max(ratio, scalar(1));

        // Differences of runs with steps of dt, dt/2, dt/4
        std::vector<staggeredField> u;
        for (const label r : {1, 2, 4})
        {
            test::box c(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n),
                        wallsInY, 1);

            forAll(*c.nu, i)
            {
                (*c.nu)[i] = c.mesh().C()[i].y() < 0.5 ? 1 : ratio;
            }
            c.start([](const vector& x)
                    { return vector(std::sin(pi * x.y()), 0, 0); });
            const scalar dt = 0.5 / sqr(scalar(n)) / largest;
            u.push_back(run(c, "diffusion ADI;", 200 * dt, 200 * r).u);
        }
        std::printf("    layers 1 : %g, nu_max dt/h^2 = 0.5, 0.25: error %.2e "
                    "%.2e\n",
                    ratio, 4.0 / 3 * difference(u[0], u[1]),
                    4.0 / 3 * difference(u[1], u[2]));
        expectOrder("    their decay, order in time",
                    std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                    1.9);
    }
}

TEST(FlowOrders, dropOfOtherViscosity)
{
    const label n = 16;
    for (const scalar ratio : {0.1, 10.0, 100.0})
    {
        const scalar largest = max(ratio, scalar(1));
        const auto start = [](const vector& x)
        {
            return vector(std::sin(pi * x.y()) * std::sin(2 * pi * x.z()), 0,
                          std::sin(pi * x.y()));
        };

        std::vector<staggeredField> u;
        const scalar dt = 0.25 / sqr(scalar(n)) / largest;
        for (const label r : {1, 2, 4})
        {
            auto b = drop(n, ratio);
            b->start(start);
            const flowRun o(run(*b, "diffusion ADI;", 20 * dt, 20 * r));
            EXPECT_LE(o.divergence, 1e-14);
            u.push_back(o.u);
        }
        char what[100];
        std::snprintf(what, sizeof(what),
                      "drop, viscosity ratio %g, order in "
                      "time",
                      ratio);
        expectOrder(what,
                    std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                    1.9);
    }
}
