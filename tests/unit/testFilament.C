// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Filaments by themselves, against exact solutions. Length 1, mass per length 1

#include "testFilament.H"
#include <chrono>

using namespace Foam;
using namespace test;

// Hanging chain in its first mode, g = 10: largest relative error to t = 4
TEST(Filament, pendulumOfModeOne)
{
    const scalar omega = 3.80236, z1 = 2.404825558, eps = 1e-3;
    scalar before = 0;
    for (const label N : {16, 32, 64})
    {
        // Nodes at equal distance along the chain that hangs in -x; s' from the
        // free end
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
                largest = max(largest, mag(f.places()[N].y() / eps -
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

// From straight at 0.1 pi, B* = 0.01, g = 10
TEST(Filament, nonlinearSwing)
{
    const scalar angle = 0.1 * constant::mathematical::pi;
    const auto p = make(64, 0.01, filament::HINGED, filament::FREE);
    filament x(p, Zero, vector(-std::cos(angle), std::sin(angle), 0));
    const std::vector<std::pair<scalar, scalar>> reference = {
        {0.2, 0.249186},  {0.4, 0.057618}, {0.6, -0.250113}, {0.8, -0.346147},
        {1.0, -0.253351}, {1.6, 0.345103}, {2.0, 0.085441}};
    scalar largest = 0, length = 0;
    const scalar dt = 5e-4;
    run(x, dt, 4000, vector(-10, 0, 0),
        [&](const filament& f, const scalar t)
        {
            length = max(length, f.lengthError());
            for (const auto& r : reference)
            {
                if (mag(t - r.first) < 0.5 * dt)
                {
                    largest = max(largest, mag(f.places()[64].y() - r.second));
                }
            }
        });
    test::expectBelow("tip against the reference", largest / 0.309, 0.01);
    test::expectBelow("length of the segments, relative", length, 1e-10);
}

// Frequencies of small vibrations, f = (beta L)^2/(2 pi) sqrt(B/(m L^4)), from
// crossings of zero by an end that starts from a mode at rest
TEST(Filament, vibrations)
{
    using filament = Foam::filament;
    const struct
    {
        const char* name;
        filament::endType ends[2];
        scalar beta[2];
    } cases[3] = {
        {"clamped-free",
         {filament::CLAMPED, filament::FREE},
         {1.875104, 4.694091}},
        {"hinged-free",
         {filament::HINGED, filament::FREE},
         {3.926602, 7.068583}},
        {"free-free", {filament::FREE, filament::FREE}, {4.730041, 7.853205}}};
    const label N = 64;
    for (const auto& c : cases)
    {
        for (const scalar b : c.beta)
        {
            const auto shape = [&](const scalar s)
            {
                const scalar z = b * s, ch = std::cosh(b), sh = std::sinh(b),
                             co = std::cos(b), si = std::sin(b);
                if (c.ends[0] == filament::HINGED)
                {
                    return std::sin(z) + si / sh * std::sinh(z);
                }
                const scalar sign = c.ends[0] == filament::CLAMPED ? -1 : 1;
                const scalar ratio = c.ends[0] == filament::CLAMPED
                                         ? (ch + co) / (sh + si)
                                         : (ch - co) / (sh - si);
                return std::cosh(z) + sign * std::cos(z) -
                       ratio * (std::sinh(z) + sign * std::sin(z));
            };
            const auto p = make(N, 1, c.ends[0], c.ends[1]);
            vectorField nodes(N + 1, vector(0, 1e-4 * shape(0), 0));
            for (label i = 1; i <= N; ++i)
            {
                const scalar dy =
                    1e-4 * (shape(i * p.ds()) - shape((i - 1) * p.ds()));
                nodes[i] = nodes[i - 1] +
                           vector(std::sqrt(sqr(p.ds()) - sqr(dy)), dy, 0);
            }
            filament x(p, nodes);
            x.clamp(0, vector(1, 0, 0));
            const scalar omega = sqr(b), dt = 0.01 / omega;
            scalar before = nodes[N].y(), first = 0, last = 0;
            label crossings = 0;
            run(x, dt, 2000, Zero,
                [&](const filament& f, const scalar t)
                {
                    const scalar y = f.places()[N].y();
                    if (y * before < 0)
                    {
                        last = t - dt * y / (y - before);
                        if (!crossings++) first = last;
                    }
                    before = y;
                });
            const scalar measured =
                constant::mathematical::pi * (crossings - 1) / (last - first);
            test::expectBelow(std::string(c.name) + ", beta L = " +
                                  std::to_string(b) + ", relative",
                              mag(std::sqrt(measured / omega) - 1), 0.005);
        }
    }
}

// Clamped, pushed along itself towards the clamp, in a fluid that drags: waves
// die at f L^3/B = 72 and grow at 80 (threshold 76)
TEST(Filament, flutter)
{
    const label N = 64;
    for (const scalar push : {72.0, 80.0})
    {
        auto p = make(N, 1, filament::CLAMPED, filament::FREE);
        p.mass = 0;
        filament x(p, Zero, vector(1, 0, 0));
        const scalarField c(N + 1, 1);
        const vectorField U(N + 1, Zero);
        vectorField f(N + 1, Zero), before(x.places());
        auto all(around(x, f, c, U));
        scalar early = 0, late = 0;
        for (label step = 1; step <= 8000; ++step)
        {
            // Along the shape extrapolated to the end of the step
            const vectorField ahead(2.0 * x.places() - before);
            for (label i = 0; i <= N; ++i)
            {
                const vector t(ahead[min(i + 1, N)] -
                               ahead[max(i - 1, label(0))]);
                f[i] = -push * t / mag(t);
            }
            if (step < 20) f[N].y() += 0.1;
            before = x.places();
            all.force = f;
            ASSERT_TRUE(x.step(2e-4, all));
            const scalar y = mag(x.places()[N].y());
            if (step > 2000 && step <= 5000) early = max(early, y);
            if (step > 5000) late = max(late, y);
        }
        std::printf("    f L^3/B = %g: amplitude late over early %.3f\n", push,
                    late / early);
        if (push < 76)
            EXPECT_LE(late, 0.5 * early);
        else
            EXPECT_GE(late, 0.9 * early);
    }
}

// Released with a bend in a fluid at rest that drags: nothing may grow, whatever
// drag and stiffness. With mass and drag at the nodes; and neutral, with drag at
// points between them, set back from the ends, as in two-way coupling
TEST(Filament, neverGrows)
{
    const label points = 15;
    for (const scalar mass : {1.0, 0.0})
    {
        const label N = mass > 0 ? 32 : points + 1;
        scalar worst = 0;
        for (const scalar drag : {0.01, 0.1, 1.0, 2.0})
        {
            for (const scalar stiffness : {1e-8, 1e-4, 1e-1, 1e1, 1e3})
            {
                auto p = make(N, 1, filament::FREE, filament::FREE);
                const scalar dt = 0.01;
                p.mass = mass;
                p.rigidity = stiffness * pow4(p.ds()) / 16 / sqr(dt);
                vectorField nodes(N + 1, Zero);
                for (label i = 1; i <= N; ++i)
                {
                    const scalar a =
                        0.5 * std::sin(7.0 * i / N) + 0.2 * (i % 2);
                    nodes[i] = nodes[i - 1] +
                               p.ds() * vector(std::cos(a), std::sin(a), 0);
                }
                filament x(p, nodes);
                const vectorField zero(N + 1, Zero);
                auto all(around(x, zero, scalarField(N + 1, drag / dt), zero));
                if (mass == 0)
                {
                    all.points.setSize(points);
                    all.drag = scalarField(points, drag / dt / points);
                    all.U.setSize(points);
                    forAll(all.points, k)
                    {
                        const scalar s = N * (0.05 + 0.9 * k / (points - 1));
                        all.points[k] = {label(s), s - label(s)};
                    }
                }
                const scalar initial = x.bendingEnergy();
                for (label n = 0; n < 400; ++n)
                {
                    ASSERT_TRUE(x.step(dt, all)) << "stiffness " << stiffness;
                    worst = max(
                        worst,
                        (x.kineticEnergy() + x.bendingEnergy()) / initial - 1);
                }
            }
        }
        test::expectBelow("mass " + std::to_string(int(mass)) +
                              ": largest growth of the energy",
                          worst, 1e-6);
    }
}

// Released straight and horizontal with steps of 0.1 sqrt(L/g), any stiffness
TEST(Filament, stableAtLargeSteps)
{
    for (const scalar rigidity : {0.0, 0.01, 1.0, 100.0, 1e4})
    {
        for (const scalar angle : {0.1, 0.5})
        {
            const auto p = make(32, rigidity, filament::HINGED, filament::FREE);
            const scalar a = angle * constant::mathematical::pi;
            filament x(p, Zero, vector(-std::cos(a), std::sin(a), 0));
            scalar length = 0, energy = 0;
            run(x, 0.1, 300, vector(-1, 0, 0),
                [&](const filament& f, scalar)
                {
                    length = max(length, f.lengthError());
                    energy = max(energy, f.kineticEnergy());
                });
            test::expectBelow("B* = " + std::to_string(rigidity) +
                                  ": length of the segments",
                              length, 1e-10);
            EXPECT_LE(energy, 0.5 * (1 - std::cos(a)));
        }
    }
}

// Steps that Newton's method cannot take are halved, and go through
TEST(Filament, halvesItsSteps)
{
    const auto p = make(32, 0, filament::HINGED, filament::FREE);
    filament x(p, Zero, vector(0, 1, 0));
    label most = 0;
    scalar length = 0;
    run(x, 1, 8, vector(-1, 0, 0),
        [&](const filament& f, scalar)
        {
            most = max(most, f.iterations());
            length = max(length, f.lengthError());
        });
    std::printf("    %d iterations in one step\n", int(most));
    EXPECT_GT(most, 20);
    test::expectBelow("length of the segments", length, 1e-10);
}

// Run by tests/bench/filament: microseconds per step
TEST(Filament, DISABLED_cost)
{
    for (const label N : {16, 32, 64, 128})
    {
        const auto p = make(N, 0.01, filament::HINGED, filament::FREE);
        filament x(p, Zero, vector(-1, 1, 0));
        const auto nothing = [](const filament&, scalar) {};
        run(x, 1e-3, 200, vector(-10, 0, 0), nothing);
        const auto start = std::chrono::steady_clock::now();
        run(x, 1e-3, 3000, vector(-10, 0, 0), nothing);
        const std::chrono::duration<double> d(std::chrono::steady_clock::now() -
                                              start);
        const double us = 1e6 * d.count() / 3000;
        std::printf("    N = %d: %.1f us, %d iterations\n", int(N), us,
                    int(x.iterations()));
        if (N == 32) test::expectBelow("N = 32, microseconds", us, 30);
    }
}

// Force on the fluid, inertia and load add up to nothing, as inner forces do
TEST(Filament, exchangesMomentum)
{
    const label N = 32;
    for (const scalar mass : {0.0, 1.0})
    {
        auto p = make(N, 0.01, filament::FREE, filament::FREE);
        p.mass = mass;
        filament x(p, Zero, vector(1, 0, 0));
        vectorField U(N + 1), f(N + 1, vector(0, -1, 0.3));
        forAll(U, i)
        {
            U[i] = vector(0, std::sin(0.4 * i), std::cos(0.3 * i));
        }
        const auto all(around(x, f, scalarField(N + 1, 2), U));
        const scalar dt = 0.01;
        vectorField V(N + 1, Zero), before(V);
        scalar worst = 0;
        for (label step = 0; step < 60; ++step)
        {
            before = V;
            V = x.velocities();
            ASSERT_TRUE(x.step(dt, all));
            vector sum(Zero);
            scalar sizes = 0;
            forAll(V, i)
            {
                const scalar w = p.ds() * (i == 0 || i == N ? 0.5 : 1);
                const vector drag(w * 2 * (x.velocities()[i] - U[i]));
                sum += drag - w * f[i] +
                       w * mass / (2 * dt) *
                           (3 * x.velocities()[i] - 4 * V[i] + before[i]);
                sizes += mag(drag);
            }
            if (step > 1) worst = max(worst, mag(sum) / sizes);
        }
        test::expectBelow("mass " + std::to_string(int(mass)) +
                              ": sum of all forces over that of the drag",
                          worst, 1e-11);
    }
}

// Elastica of a cantilever under a load at its tip, P L^2/B = 1, 2, 5, 10, and
// under a distributed one, q L^3/B = 1, 5, 10; at rest after steps with much drag
TEST(Filament, cantilever)
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
            const vector tip(x.places()[N]);
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
