// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Time steps of filaments: stability and cost

#include "testFilament.H"
#include <chrono>

using namespace Foam;
using namespace test;

// Released with a bend in a fluid at rest with drag: no energy grows, whatever drag and
// stiffness. Once with mass and with drag at the nodes; once neutrally buoyant with drag at
// points between the nodes, set back from the ends as in two-way coupling
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

// Released straight and horizontal, steps of 0.1 sqrt(L/g), any stiffness
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

// Steps at which Newton's method fails are divided and succeed
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

// Five filaments in lanes, some lanes empty, give the same results as single filaments. One
// is at rest (converges at once), one divides its steps while the others continue
TEST(Filament, togetherAsOneByOne)
{
    const auto p = make(32, 0, filament::HINGED, filament::FREE);
    const scalar angles[] = {0, 0.2, 0.5, 0.5001, 0.7};
    std::vector<filament> alone;
    for (const scalar angle : angles)
    {
        const scalar a = angle * constant::mathematical::pi;
        alone.emplace_back(p, Zero, vector(-std::cos(a), std::sin(a), 0));
    }
    std::vector<filament> together(alone);
    const vectorField f(33, vector(-1, 0, 0)), U(33, Zero);
    List<filament*> lines(5);
    List<filament::surroundings> all(5);
    scalar apart = 0;
    label most = 0;
    for (label step = 0; step < 5; ++step)
    {
        for (label i = 0; i < 5; ++i)
        {
            all[i] = around(alone[i], f, scalarField(33, 1e-3 * i), U);
            lines[i] = &together[i];
        }
        const List<bool> advanced(filament::step(0.7, lines, all));
        for (label i = 0; i < 5; ++i)
        {
            ASSERT_TRUE(advanced[i]);
            ASSERT_TRUE(alone[i].step(0.7, all[i]));
            apart =
                max(apart, max(mag(alone[i].positions() - together[i].positions())));
            most = max(most, together[i].iterations());
        }
    }
    EXPECT_GT(most, 20);
    test::expectBelow("places", apart, 1e-9);
}

// Root mean square of the tip's swing in the last two of 20 periods over that in the first
// two, released straight at 0.05 pi. Higher modes beat, so that the ratio may exceed 1; the
// ratio of a smaller step shows the dissipation of the scheme
TEST(Filament, keepsItsAmplitude)
{
    const scalar angle = 0.05 * constant::mathematical::pi;
    const scalar period = 1.62;
    const auto kept = [&](const filament::schemeType scheme, const scalar dt)
    {
        auto p = make(32, 0.01, filament::HINGED, filament::FREE);
        p.scheme = scheme;
        filament x(p, Zero, vector(-std::cos(angle), std::sin(angle), 0));
        scalar early = 0, late = 0;
        run(x, dt, label(20 * period / dt), vector(-10, 0, 0),
            [&](const filament& f, const scalar t)
            {
                const scalar y2 = sqr(f.positions()[32].y());
                if (t < 2 * period) early += y2;
                if (t > 18 * period) late += y2;
            });
        return std::sqrt(late / early);
    };
    const scalar right = kept(filament::IMPLICIT, 5e-4);
    const scalar implicit = kept(filament::IMPLICIT, 2e-3);
    std::printf(
        "    kept at dt = 2e-3: %.4f, twoStep %.4f, twoStepCentred %.4f\n",
        implicit, kept(filament::TWO_STEP, 2e-3),
        kept(filament::TWO_STEP_CENTRED, 2e-3));
    test::expectBelow("lost to the step", 1 - implicit / right, 0.04);
    EXPECT_GE(implicit, 0.96);
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
    }
}

// Run by tests/bench/filament: the largest of 0.1, 0.05, 0.025 ... sqrt(L/g) at which 30
// time units from straight and horizontal end without failure
TEST(Filament, DISABLED_largestSteps)
{
    const char* names[3] = {"implicit", "twoStep", "twoStepCentred"};
    for (int k = 0; k < 3; ++k)
    {
        std::printf("    %-15s", names[k]);
        for (const scalar rigidity : {0.0, 0.01, 1.0, 100.0, 1e4})
        {
            auto p = make(32, rigidity, filament::HINGED, filament::FREE);
            p.scheme = filament::schemeType(k);
            const vectorField f(33, vector(-1, 0, 0)), U(33, Zero);
            scalar dt = 0.2;
            bool good = false;
            while (!good && dt > 1e-4)
            {
                dt /= 2;
                filament x(p, Zero, vector(0, 1, 0));
                const auto all(around(x, f, scalarField(33, Zero), U));
                good = true;
                for (label n = 0; good && n < label(30 / dt); ++n)
                {
                    good = x.step(dt, all) && x.lengthError() < 0.01 &&
                           x.kineticEnergy() < 0.6;
                }
            }
            std::printf("  B* = %g: %.1e", rigidity, good ? dt : 0.0);
        }
        std::printf("\n");
    }
}
