// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Orders of filaments in space

#include "testFilament.H"

using namespace Foam;
using namespace test;

// Hanging chain in its first mode, g = 10: largest relative error to t = 4
TEST(FilamentOrders, pendulumOfModeOne)
{
    const scalar omega = 3.80236, z1 = 2.404825558, eps = 1e-3;
    scalar before = 0;
    for (const label N : {16, 32, 64})
    {
        // Nodes with equal spacing along the chain hanging in -x; s' from the free end
        const auto p = make(N, 0, filament::HINGED, filament::FREE);
        vectorField nodes(N + 1, Zero);
        for (label i = 1; i <= N; ++i)
        {
            const auto y = [&](const label k)
            { return eps * J0(z1 * std::sqrt(1 - scalar(k) / N)); };
            const scalar dy = y(i) - y(i - 1);
            nodes[i] =
                nodes[i - 1] + vector(-std::sqrt(sqr(p.ds()) - sqr(dy)), dy, 0);
        }
        filament x(p, nodes);
        scalar largest = 0;
        run(x, 5e-4, 8000, vector(-10, 0, 0),
            [&](const filament& f, const scalar t)
            {
                largest = max(largest, mag(f.positions()[N].y() / eps -
                                           std::cos(omega * t)));
            });
        std::printf("    N = %d: largest relative error %.2e\n", int(N),
                    largest);
        if (before > 0)
        {
            const scalar order = std::log2(before / largest);
            std::printf("    order %.2f\n", order);
            EXPECT_NEAR(order, 2, 0.1);
        }
        before = largest;
    }
}

// Elastica of a cantilever with a load at its tip, P L^2/B = 1, 2, 5, 10, and with a
// distributed load, q L^3/B = 1, 5, 10; at rest after steps with much drag
TEST(FilamentOrders, cantilever)
{
    const struct
    {
        bool point;
        scalar load, dx, dy;
    } cases[7] = {
        {true, 1, 0.056433, 0.301721},  {true, 2, 0.160642, 0.493457},
        {true, 5, 0.387628, 0.713792},  {true, 10, 0.554996, 0.810609},
        {false, 1, 0.008754, 0.123471}, {false, 5, 0.153343, 0.495905},
        {false, 10, 0.343646, 0.700200}};
    for (const auto& c : cases)
    {
        scalar before = 0;
        for (const label N : {32, 64})
        {
            const auto p = make(N, 1, filament::CLAMPED, filament::FREE);
            filament x(p, Zero, vector(1, 0, 0));
            const vector load(0, -c.load, 0);
            vectorField f(N + 1, c.point ? vector(Zero) : load);
            if (c.point) f[N] = load / (0.5 * p.ds());
            for (label step = 0; step < 400; ++step)
            {
                ASSERT_TRUE(x.step(0.05, around(x, f, scalarField(N + 1, 10),
                                                vectorField(N + 1, Zero))));
            }
            const vector tip(x.positions()[N]);
            const scalar error =
                max(mag(1 - tip.x() - c.dx), mag(-tip.y() - c.dy));
            if (N == 64)
            {
                const std::string what(
                    std::string(c.point ? "P L^2/B = " : "q L^3/B = ") +
                    std::to_string(int(c.load)));
                test::expectBelow(what + ": tip, relative to its displacement",
                                  error / c.dy, 0.005);
                test::expectBelow(what + ": order, off 2",
                                  mag(std::log2(before / error) - 2), 0.2);
            }
            before = error;
        }
    }
}
