// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stabilisedMotion.H"
#include "testBox.H"
#include "testShapes.H"

using namespace test;

namespace
{
const int N = 8;

numbers turned(const numbers& x, const double angle)
{
    const tensor Q(std::cos(angle), -std::sin(angle), 0, std::sin(angle),
                   std::cos(angle), 0, 0, 0, 1);
    numbers y(x);
    for (size_t j = 0; j < x.size(); j += 3)
    {
        const vector v(Q & vector(x[j], x[j + 1], x[j + 2]));
        for (int d = 0; d < 3; ++d)
        {
            y[j + d] = v[d];
        }
    }
    return y;
}

double apart(const numbers& a, const numbers& b)
{
    double most = 0;
    for (size_t j = 0; j < a.size(); ++j)
    {
        most = std::max(most, std::abs(a[j] - b[j]));
    }
    return most;
}
} // namespace

class StabilisedMotion : public ::testing::Test
{
protected:
    const sphericalHarmonics grid{N, 3 * N / 2 + 1};
    const numbers x = roughShape(N);
    effectTable effects{mesh().time(), "stabilisedMotion"};

    void SetUp() { effects.declare("stabilised", true, "test"); }

    //- Shell of a neo-Hookean membrane, whose tension G is Gs
    capsuleShell shell(const double tension, const double bending = 0)
    {
        OStringStream os;
        os.precision(17);
        os << "membrane { law neoHookean; Gs " << tension << "; } ";
        if (bending > 0) os << "bending { modulus " << bending << "; }";
        IStringStream is(os.str());
        const dictionary dict(is);
        capsuleShell made(N, 1.5, dict, sphere(N), effects);
        made.readBending(dict, 1, sphere(N));
        return made;
    }

    double volume(const numbers& y) { return shell(1).measure(y).volume; }

    //- base after a step from x with a tension; volume: of the first shape
    numbers moved(const double tension, const numbers& previous, numbers base,
                  const double dt, const double ratio, const double volume)
    {
        const capsuleShell s(shell(tension));
        const capsuleMotion::setting setting{s, grid, 1, 1, 0, effects};
        capsule c;
        c.x = x;
        c.previous = previous;
        stabilisedMotion(setting, stabilisedMotion::waves(setting))
            .correct(c, base, dt, ratio, volume);
        return base;
    }
    numbers moved(const double tension, const numbers& previous,
                  const numbers& base)
    {
        return moved(tension, previous, base, 0.1, 1, volume(base));
    }
};

TEST_F(StabilisedMotion, ratesAreThoseOfTheMobility)
{
    // 1.5/(mu a (2n+1)) (G n(n+1) + E_B [n(n+3)]^2/a^2), n = 8
    const capsuleShell s(shell(2, 0.1));
    const stabilisedMotion::waves waves({s, grid, 0.5, 3, 4, effects});
    EXPECT_NEAR(waves.fastest() /
                    (1.5 / (3 * 0.5 * 17) * (2 * 72 + 0.1 * sqr(88 / 0.5))),
                1, 1e-14);

    // t_n = 10 rho a^2/[mu (2n+1)^2]: a quarter is left where it is nine times the step
    const scalar start = 10 * 4 * sqr(0.5) / (3 * sqr(17.0));
    EXPECT_NEAR(waves.within(8, start / 9) / (waves.fastest() * start / 9),
                0.25, 1e-14);
}

TEST_F(StabilisedMotion, aMembraneWithoutTensionMovesWithTheFluid)
{
    numbers faster(roughShape(N));
    for (size_t j = 0; j < faster.size(); ++j)
    {
        faster[j] = 1.01 * faster[j] + 0.001 * std::sin(1.0 * j);
    }
    EXPECT_LE(apart(moved(1e-30, x, faster), faster), 1e-13);
}

// Turning goes on however stiff the membrane is, with steps that change too
TEST_F(StabilisedMotion, turningIsNotHeldBack)
{
    for (const double ratio : {1.0, 0.5, 2.0})
    {
        const numbers next(turned(x, 0.1 * ratio));
        const numbers result(
            moved(1e6, turned(x, -0.1), next, 0.1, ratio, volume(x)));
        test::expectBelow("turned by a stiff membrane's step",
                          apart(result, next), 1e-12);
    }
}

TEST_F(StabilisedMotion, theFirstStepIsDrawnToTheShapeAtRest)
{
    numbers base(x);
    const size_t last = base.size() - 1;
    base[last] += 0.01;
    const numbers result(moved(1e9, numbers(), base, 0.1, 1, volume(x)));
    EXPECT_NEAR(result[last], x[last], 1e-4);
}

TEST_F(StabilisedMotion, theMeanPositionFollowsTheFluid)
{
    numbers base(x);
    const size_t mean = 3 * grid.index(0, 0, false);
    base[mean + 1] += 0.3;
    EXPECT_NEAR(moved(1e6, x, base)[mean + 1], base[mean + 1], 1e-12);
}

TEST_F(StabilisedMotion, theVolumeIsRestored)
{
    numbers base(x);
    for (double& v : base)
    {
        v *= 1.01;
    }
    const numbers result(moved(10, x, base, 0.1, 1, volume(x)));
    test::expectBelow("volume", std::abs(volume(result) / volume(x) - 1), 1e-8);
}
