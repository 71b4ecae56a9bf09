// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Single filaments against exact solutions and balances. Length 1, mass per length 1

#include "testFilament.H"

using namespace Foam;
using namespace test;

// Released straight at 0.1 pi, B* = 0.01, g = 10
TEST(Filament, nonlinearSwing)
{
    const scalar angle = 0.1 * constant::mathematical::pi;
    const auto p = make(64, 0.01, filament::HINGED, filament::FREE);
    filament x(p, Zero, vector(-std::cos(angle), std::sin(angle), 0));
    const std::vector<std::pair<scalar, scalar>> reference = {
        {0.2, 0.249186},  {0.4, 0.057618}, {0.6, -0.250113}, {0.8, -0.346147},
        {1.0, -0.253351}, {1.6, 0.345103}, {2.0, 0.085441}};
    scalar largest = 0, length = 0, outside = 0;
    const scalar dt = 5e-4;
    run(x, dt, 4000, vector(-10, 0, 0),
        [&](const filament& f, const scalar t)
        {
            length = max(length, f.lengthError());
            const boundBox box(f.positions(), false), rough(f.roughBounds());
            outside = max(outside, cmptMax(rough.min() - box.min()));
            outside = max(outside, cmptMax(box.max() - rough.max()));
            for (const auto& r : reference)
            {
                if (mag(t - r.first) < 0.5 * dt)
                {
                    largest = max(largest, mag(f.positions()[64].y() - r.second));
                }
            }
        });
    test::expectBelow("tip against the reference", largest / 0.309, 0.01);
    test::expectBelow("length of the segments, relative", length, 1e-10);
    test::expectBelow("outside its bounds from ends and length", outside,
                      1e-12);
}

// Frequencies of small vibrations, f = (beta L)^2/(2 pi) sqrt(B/(m L^4)), from zero
// crossings of an end, started in a mode at rest
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
                    const scalar y = f.positions()[N].y();
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

// Clamped filament with a follower load towards the clamp, in a fluid with drag: waves decay
// at f L^3/B = 72 and grow at 80 (threshold 76)
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
        vectorField f(N + 1, Zero), before(x.positions());
        auto all(around(x, f, c, U));
        scalar early = 0, late = 0;
        for (label step = 1; step <= 8000; ++step)
        {
            // Load along the shape extrapolated to the end of the step
            const vectorField ahead(2.0 * x.positions() - before);
            for (label i = 0; i <= N; ++i)
            {
                const vector t(ahead[min(i + 1, N)] -
                               ahead[max(i - 1, label(0))]);
                f[i] = -push * t / mag(t);
            }
            if (step < 20) f[N].y() += 0.1;
            before = x.positions();
            all.force = f;
            ASSERT_TRUE(x.step(2e-4, all));
            const scalar y = mag(x.positions()[N].y());
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

// The sum of drag, inertia and load is zero, as inner forces cancel
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

// An accelerated base is equivalent to gravity
TEST(Filament, baseMotion)
{
    const label N = 32;
    const scalar angle = 0.1 * constant::mathematical::pi;
    const vector along(-std::cos(angle), std::sin(angle), 0), g(-10, 0, 0);
    const auto p = make(N, 0.01, filament::HINGED, filament::FREE);
    filament hanging(p, Zero, along), pulled(p, Zero, along);
    const vectorField none(N + 1, Zero), weight(N + 1, g);
    const auto heavy(around(hanging, weight, scalarField(N + 1, Zero), none));
    const auto light(around(pulled, none, scalarField(N + 1, Zero), none));
    const scalar dt = 1e-3;
    scalar worst = 0;
    for (label n = 1; n <= 500; ++n)
    {
        const vector base(-0.5 * sqr(n * dt) * g);
        pulled.moveEnd(0, base);
        ASSERT_TRUE(hanging.step(dt, heavy) && pulled.step(dt, light));
        EXPECT_LT(mag(pulled.positions()[0] - base), 1e-14);
        worst =
            max(worst, mag(pulled.positions()[N] - base - hanging.positions()[N]));
    }
    test::expectBelow("tip against the same under gravity [lengths]", worst,
                      5e-3);
}
