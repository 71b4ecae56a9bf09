// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Time schemes of filaments: implicit, and two kept for comparison

#include "testFilament.H"
#include <chrono>

using namespace Foam;
using namespace test;

namespace
{
//- A scene that all three schemes can run: without drag
struct schemeScene
{
    const char* name;
    filament::properties p;
    vectorField nodes;
    vectorField force; // force per length
    bool ramp;         // force grows gradually
    vector clamp;
    scalar scale;   // period of the motion of the tip
    scalar end, dt; // end of the run, and largest step
};

//- Scenes: release from straight, chain in its first mode, beam loaded at its tip with half
//  a cosine, vibration of a beam
std::vector<schemeScene> schemeScenes()
{
    const label N = 32;
    std::vector<schemeScene> all;
    const auto add = [&](const char* name, const scalar rigidity,
                         const filament::endType first, const scalar end,
                         const scalar dt) -> schemeScene&
    {
        all.push_back({name, make(N, rigidity, first, filament::FREE),
                       vectorField(N + 1, Zero), vectorField(N + 1, Zero),
                       false, vector(1, 0, 0), 1, end, dt});
        return all.back();
    };
    // Nodes along x with a rise dy per segment
    const auto curve = [&](schemeScene& s, const auto& y, const scalar along)
    {
        for (label i = 1; i <= N; ++i)
        {
            const scalar dy = y(i) - y(i - 1);
            s.nodes[i] =
                s.nodes[i - 1] +
                vector(along * std::sqrt(sqr(s.p.ds()) - sqr(dy)), dy, 0);
        }
    };
    {
        schemeScene& s = add("swing", 0.01, filament::HINGED, 2, 2.5e-3);
        const scalar a = 0.1 * constant::mathematical::pi;
        curve(
            s, [&](const label i) { return i * std::sin(a) / N; }, -1);
        s.force = vector(-10, 0, 0);
    }
    {
        schemeScene& s = add("chain", 0, filament::HINGED, 2, 2.5e-3);
        s.scale = 1e-3;
        curve(
            s,
            [&](const label i) {
                return s.scale * J0(2.404825558 * std::sqrt(1 - scalar(i) / N));
            },
            -1);
        s.force = vector(-10, 0, 0);
    }
    {
        schemeScene& s = add("load", 1, filament::CLAMPED, 2, 2.5e-2);
        curve(
            s, [](label) { return 0; }, 1);
        s.ramp = true;
        s.force[N] = vector(0, -2, 0) / (0.5 * s.p.ds());
    }
    {
        schemeScene& s = add("beam", 1, filament::CLAMPED, 2, 5e-2);
        s.scale = 1e-3;
        const scalar b = 1.875104;
        const scalar ratio =
            (std::cosh(b) + std::cos(b)) / (std::sinh(b) + std::sin(b));
        curve(
            s,
            [&](const label i)
            {
                const scalar z = b * i / N;
                return 0.5 * s.scale *
                       (std::cosh(z) - std::cos(z) -
                        ratio * (std::sinh(z) - std::sin(z)));
            },
            1);
    }
    return all;
}

struct schemeRun
{
    std::vector<vector> tip;
    scalar length = 0, us = 0;
};

schemeRun runScheme(const schemeScene& s, const filament::schemeType scheme,
                    const scalar dt)
{
    filament::properties p(s.p);
    p.scheme = scheme;
    filament x(p, s.nodes);
    x.clamp(0, s.clamp);
    const label N = p.segments, every = label(s.end / 40 / dt + 0.5);
    auto all(
        around(x, s.force, scalarField(N + 1, Zero), vectorField(N + 1, Zero)));
    schemeRun r;
    const auto start = std::chrono::steady_clock::now();
    for (label step = 1; step <= 40 * every; ++step)
    {
        // The centred scheme needs the force at the middle of its positions
        const scalar t =
            dt * (scheme == filament::TWO_STEP_CENTRED ? step - 1 : step);
        if (s.ramp)
        {
            all.force = 0.5 *
                        (1 - std::cos(constant::mathematical::pi * t / s.end)) *
                        s.force;
        }
        if (!x.step(dt, all)) break;
        r.length = max(r.length, x.lengthError());
        if (step % every == 0) r.tip.push_back(x.positions()[N]);
    }
    const std::chrono::duration<double> d(std::chrono::steady_clock::now() -
                                          start);
    r.us = 1e6 * d.count() / (40 * every);
    return r;
}
} // namespace

// Comparison of the three schemes: largest error of the tip relative to a small step of the
// implicit scheme, error of the lengths, and time. Two are of second order, that of the
// thesis of first
TEST(FilamentOrders, schemes)
{
    const char* names[3] = {"implicit", "twoStep", "twoStepCentred"};
    for (const schemeScene& s : schemeScenes())
    {
        const schemeRun right(runScheme(s, filament::IMPLICIT, s.dt / 128));
        ASSERT_EQ(right.tip.size(), 40u);
        scalar needed[3] = {0, 0, 0}, steps[3] = {0, 0, 0};
        for (int k = 0; k < 3; ++k)
        {
            scalar before = 0, order = 0;
            for (scalar dt = s.dt; dt > 0.9 * s.dt / 8; dt /= 2)
            {
                const schemeRun r(runScheme(s, filament::schemeType(k), dt));
                scalar error = 0;
                for (std::size_t i = 0; i < r.tip.size(); ++i)
                {
                    error = max(error, mag(r.tip[i] - right.tip[i]) / s.scale);
                }
                const bool broke =
                    r.tip.size() < right.tip.size() || !(error < 1);
                const scalar ms = 1e-3 * r.us * s.end / dt;
                std::printf("    scheme %-6s %-15s dt %.1e tip %.1e lengths "
                            "%.1e us %.1f ms %.2f\n",
                            s.name, names[k], dt, broke ? NAN : error, r.length,
                            r.us, ms);
                if (broke)
                {
                    before = 0;
                    continue;
                }
                if (before > 0) order = std::log2(before / error);
                before = error;

                // Time for an error of 1e-3, extrapolated from the last line
                const scalar slope = k == filament::TWO_STEP ? 1 : 0.5;
                needed[k] = ms * std::pow(error / 1e-3, slope);
                steps[k] = s.end / dt * std::pow(error / 1e-3, slope);
            }
            std::printf(
                "    %s, %s: order %.2f, %.0f steps and %.2f ms for an error "
                "of 1e-3\n",
                s.name, names[k], order, steps[k], needed[k]);
            EXPECT_GE(order, k == filament::TWO_STEP ? 0.8 : 1.7);
        }
        // A step of the implicit scheme costs about twice one of the others; its total time
        // has to be a tenth (a fifth for the quasi-static load)
        test::expectBelow(std::string(s.name) +
                              ": steps for 1e-3, implicit over twoStep",
                          steps[0] / steps[1], s.ramp ? 0.1 : 0.05);
    }
}

// Varying steps keep the second order
TEST(FilamentOrders, variableSteps)
{
    const schemeScene s(schemeScenes()[1]);
    const auto tip = [&](const scalar dt, const scalar wobble)
    {
        filament x(s.p, s.nodes);
        const label N = s.p.segments;
        const auto all(around(x, s.force, scalarField(N + 1, Zero),
                              vectorField(N + 1, Zero)));
        for (label n = 0; n < label(1 / dt + 0.5); ++n)
        {
            EXPECT_TRUE(x.step(dt * (1 + (n % 2 ? -1 : 1) * wobble), all));
        }
        return x.positions()[N];
    };
    const vector right(tip(1.25e-4, 0));
    const scalar coarse = mag(tip(4e-3, 0.5) - right),
                 fine = mag(tip(2e-3, 0.5) - right);
    std::printf("    steps that vary by 3: errors %.1e, %.1e\n", coarse, fine);
    test::expectBelow("order, off 2", mag(std::log2(coarse / fine) - 2), 0.2);
}
