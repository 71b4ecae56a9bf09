// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The force is divergence-free, statistically steady, of the strength given, and repeatable

#include "testForcing.H"

using namespace Foam;
using namespace test;

TEST(EswaranPopeForcing, stochasticForceIsSteadyAndSolenoidal)
{
    const scalar twoPi = constant::mathematical::twoPi;
    test::box b(labelVector(16, 16, 16), vector(twoPi, twoPi, twoPi),
                FixedList<bool, 3>(false), 1);
    auto o = make(b, stirring);
    const auto& forcing = refCast<fv::lowModeForcing>(*o);
    EXPECT_EQ(forcing.modes().size(), 16u); // 32 with 0 < |m| <= 2, in pairs

    Time& time = const_cast<Time&>(b.mesh().time());
    const scalar t0 = time.value();
    const label index0 = time.timeIndex();
    scalar along = 0, sum = 0, late = 0, correlation = 0;
    const label n = 40000, lag = 10;
    std::vector<double> history;
    for (label i = 0; i < n; ++i)
    {
        time.setTime(t0 + 1 + i, index0 + 1 + i); // deltaT is 1
        time.setDeltaT(0.05, false);
        refCast<fv::lowModeForcing>(*o).advance();
        scalar f2 = 0;
        for (const auto& m : forcing.modes())
        {
            std::complex<double> kc = 0;
            const vector k(forcing.waveVector(m.m));
            for (direction d = 0; d < 3; ++d)
            {
                kc += k[d] * m.c[d];
                f2 += 0.5 * std::norm(m.c[d]);
            }
            along = max(along, std::abs(kc));
        }
        sum += f2 / n;
        if (2 * i >= n) late += 2 * f2 / n;
        history.push_back(forcing.modes()[0].c[1].real());
    }
    scalar variance = 0;
    for (label i = 0; i + lag < n; ++i)
    {
        correlation += history[i] * history[i + lag];
        variance += sqr(history[i]);
    }
    test::expectBelow("stochastic force: k.c", along, 1e-14);
    // 40000 steps of 0.05 are 2000 independent samples of 64 numbers
    test::expectBelow("    mean square against acceleration^2, relative",
                      mag(sum / 4 - 1), 0.02);
    test::expectBelow("    second half against the whole", mag(late / sum - 1),
                      0.02);
    test::expectBelow("    correlation after one time scale against 1/e",
                      mag(correlation / variance - std::exp(-1.0)), 0.06);
    time.setTime(t0, index0);
    time.setDeltaT(1, false);
}

// Modes of a shell: in boxes that are no cubes each component has its third of the force
TEST(EswaranPopeForcing, isotropicInAnyBox)
{
    for (const label longer : {1, 2, 4})
    {
        test::box b(labelVector(10 * longer, 10, 10), vector(longer, 1, 1),
                    FixedList<bool, 3>(false), 1);
        auto o = make(b, stirring);
        const auto& forcing = refCast<fv::lowModeForcing>(*o);
        vector share(Zero);
        for (const auto& m : forcing.modes())
        {
            const vector k(forcing.waveVector(m.m));
            share += vector::one - cmptMultiply(k, k) / magSqr(k);
        }
        EXPECT_GT(3 * cmptMin(share) / (2 * forcing.modes().size()), 0.96);
        test::expectBelow("share of a component, times three, less one",
                          3 * cmptMax(share) / (2 * forcing.modes().size()) - 1,
                          0.03);
    }
}

TEST(EswaranPopeForcing, repeatsBySeed)
{
    test::box b(labelVector(8, 8, 8), vector(1, 1, 1),
                FixedList<bool, 3>(false), 1);
    const auto f = [&](const char* text) { return forceOf(*make(b, text), b); };
    EXPECT_EQ(max(mag(f(stirring)[0] - f(stirring)[0])), 0);
    EXPECT_GT(max(mag(f(stirring)[0] -
                      f("type EswaranPopeForcing; acceleration 2; timeScale "
                        "0.5; maxWaveNumber 2; seed 4;")[0])),
              0.1);
}

TEST(EswaranPopeForcing, refusesWrongInput)
{
    const FixedList<bool, 3> open(false);
    test::box cube(labelVector(4, 4, 4), vector(1, 1, 1), open, 1);
    test::box walls(labelVector(4, 4, 4), vector(1, 1, 1),
                    FixedList<bool, 3>(true), 1);
    const auto expectIn = [](const std::string& all, const char* part) {
        EXPECT_NE(all.find(part), std::string::npos)
            << all << " lacks " << part;
    };
    expectIn(refusal(cube, stirring), "less than half the number of cells");
    expectIn(refusal(walls, stirring), "periodic in all directions");
    expectIn(refusal(cube, "type EswaranPopeForcing; acceleration 1; "
                           "timeScale 1; maxWaveNmber 1;"),
             "unknown entry maxWaveNmber");
    expectIn(refusal(cube, "type EswaranPopeForcing; acceleration -1; "
                           "timeScale 1; maxWaveNumber 1;"),
             "numbers greater than 0");
    expectIn(refusal(cube, "type EswaranPopeForcing; acceleration 1; "
                           "timeScale 1; maxWaveNumber 0.5;"),
             "1 and greater");
}
