// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Orders of the staggered flow in space

#include "testFlow.H"
#include "testOrder.H"

using namespace Foam;
using namespace test;

TEST(FlowOrders, TaylorGreenInSpace)
{
    // Two-dimensional vortex, exact; the velocity decays by exp(-2 nu t)
    const scalar nu = 0.05, end = 0.5;
    const auto exact = [&](const vector& x)
    {
        return std::exp(-2 * nu * end) *
               vector(std::cos(x.x()) * std::sin(x.y()),
                      -std::sin(x.x()) * std::cos(x.y()), 0);
    };
    const auto start = [&](const vector& x)
    { return std::exp(2 * nu * end) * exact(x); };

    scalar before = 0;
    for (const label n : {16, 32, 64})
    {
        test::box b(labelVector(n, n, 4), vector(2 * pi, 2 * pi, 1), periodic,
                    nu);
        b.start(start);
        const flowRun o(run(b, "", end, 8 * n));
        const scalar e = errorOf(o.u, b, exact);
        EXPECT_LE(o.divergence, 1e-14);
        if (before)
        {
            expectOrder("Taylor-Green, order in space, " + std::to_string(n),
                        std::log2(before / e), 1.95, 2.05);
        }
        before = e;
    }
}

TEST(FlowOrders, orderInSpaceBetweenWalls)
{
    // Difference of successive grids at faces of the coarser one, averaged from those of the
    // finer one
    std::vector<staggeredField> u;
    std::vector<scalar> d;
    for (const label n : {16, 32, 64})
    {
        test::box b(labelVector(2 * n, n, 4), vector(2, 1, 4.0 / n), wallsInY,
                    0.05);
        b.start(
            [](const vector& x)
            {
                const vector v(walledVortex(x));
                return vector(
                    v.x(), sqr(std::sin(pi * x.y())) * std::sin(pi * x.x()), 0);
            });
        u.push_back(run(b, "", 0.25, 10 * n).u);
        if (u.size() < 2) continue;

        const staggeredField &fine = u[u.size() - 1], &coarse = u[u.size() - 2];
        scalar sum = 0;
        coarse.box().cells(
            [&](const label i, const labelVector& c)
            {
                if (c.z()) return;
                for (direction e = 0; e < 2; ++e)
                {
                    labelVector f(2 * c.x(), 2 * c.y(), 0), g(f);
                    ++g[1 - e];
                    sum += sqr(coarse[e][i] -
                               0.5 * (fine[e][fine.box().index(f)] +
                                      fine[e][fine.box().index(g)]));
                }
            });
        d.push_back(std::sqrt(sum) / n);
    }
    expectOrder("walled vortex, order in space, 16 32 64",
                std::log2(d[0] / d[1]), 1.95, 2.05);
}

TEST(FlowOrders, CouetteStartUp)
{
    // Start from rest at t = 0, exact from t0 on: walls at y = 0 (at rest) and 1
    const scalar nu = 1, t0 = 0.02, end = 0.08;
    const auto exactAt = [&](const scalar t)
    {
        return [=](const vector& x)
        {
            scalar u = x.y();
            for (label k = 1; k < 60; ++k)
            {
                u += 2 / (k * pi) * (k % 2 ? -1 : 1) *
                     std::exp(-sqr(k * pi) * nu * t) * std::sin(k * pi * x.y());
            }
            return vector(u, 0, 0);
        };
    };
    const auto after =
        [&](const label n, const label steps, const char* controls)
    {
        test::box b(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n), wallsInY,
                    nu);
        b.moveWalls(Zero, vector(1, 0, 0));
        b.start(exactAt(t0));
        return errorOf(run(b, controls, end, steps).u, b, exactAt(t0 + end));
    };

    // nu dt/h^2 = 0.1 on every grid: order in space and time together
    expectOrder("Couette start-up, order in space, nu dt/h^2 0.1",
                std::log2(after(16, 205, "") / after(32, 819, "")), 1.95, 2.05);
    expectOrder("Couette start-up, order in space, explicit",
                std::log2(after(16, 410, "diffusion explicit;") /
                          after(32, 1638, "diffusion explicit;")),
                1.95, 2.05);

    // Order in time on a fixed grid, from differences of successive steps
    for (const scalar number : {0.1, 0.5, 2.5})
    {
        const label n = 32;
        const scalar dt = number / sqr(scalar(n));
        const label steps = max(label(end / dt + 0.5), label(8));
        std::vector<staggeredField> u;
        for (const label r : {1, 2, 4})
        {
            test::box b(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n),
                        wallsInY, nu);
            b.moveWalls(Zero, vector(1, 0, 0));
            b.start(exactAt(t0));
            u.push_back(run(b, "diffusion ADI;", steps * dt, r * steps).u);
        }
        expectOrder("Couette start-up, order in time, nu dt/h^2 " +
                        std::to_string(number).substr(0, 3),
                    std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                    1.9);
    }
}
