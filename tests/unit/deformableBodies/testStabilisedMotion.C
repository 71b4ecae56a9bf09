// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stabilisedMotion.H"
#include "testShapes.H"

using namespace test;

namespace
{
const int N = 8;

//- In place of the volume: V = |x|^3 of all coefficients but the mean ones
void gradient(const numbers& x, numbers& g)
{
    double square = 0;
    for (size_t j = 3; j < x.size(); ++j)
    {
        square += sqr(x[j]);
    }
    for (size_t j = 0; j < x.size(); ++j)
    {
        g[j] = j < 3 ? 0 : 3 * std::sqrt(square) * x[j];
    }
}

double volume(const numbers& x)
{
    numbers g(x);
    gradient(x, g);
    return std::inner_product(x.begin(), x.end(), g.begin(), 0.0) / 3;
}

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

    //- base after a step from x with a tension
    numbers moved(const double tension, const numbers& previous, numbers base,
                  const double dt = 0.1, const double ratio = 1) const
    {
        stabilisedMotion(grid, tension, 0, 1, 1)
            .apply(x, previous, base, dt, ratio, volume(base), gradient, grid);
        return base;
    }
};

TEST_F(StabilisedMotion, ratesAreThoseOfTheMobility)
{
    // 1.5/(mu a (2n+1)) (G n(n+1) + E_B [n(n+3)]^2/a^2), n = 8
    const stabilisedMotion m(grid, 2, 0.1, 3, 0.5);
    EXPECT_NEAR(m.fastest() /
                    (1.5 / (3 * 0.5 * 17) * (2 * 72 + 0.1 * sqr(88 / 0.5))),
                1, 1e-14);
}

TEST_F(StabilisedMotion, aMembraneWithoutTensionMovesWithTheFluid)
{
    const numbers base(roughShape(N));
    numbers faster(base);
    for (size_t j = 0; j < base.size(); ++j)
    {
        faster[j] = 1.01 * base[j] + 0.001 * std::sin(1.0 * j);
    }
    EXPECT_LE(apart(moved(0, x, faster), faster), 1e-14);
}

// Turning goes on however stiff the membrane is, with steps that change too
TEST_F(StabilisedMotion, turningIsNotHeldBack)
{
    for (const double ratio : {1.0, 0.5, 2.0})
    {
        const numbers next(turned(x, 0.1 * ratio));
        const numbers result(moved(1e6, turned(x, -0.1), next, 0.1, ratio));
        test::expectBelow("turned by a stiff membrane's step",
                          apart(result, next), 1e-13);
    }
}

TEST_F(StabilisedMotion, theFirstStepIsDrawnToTheShapeAtRest)
{
    numbers base(x);
    const size_t last = base.size() - 1;
    base[last] += 0.01;
    const numbers result(moved(1e9, numbers(), base));
    EXPECT_NEAR(result[last], x[last], 1e-4);
}

TEST_F(StabilisedMotion, theMeanPlaceFollowsTheFluid)
{
    numbers base(x);
    const size_t mean = 3 * grid.index(0, 0, false);
    base[mean + 1] += 0.3;
    EXPECT_NEAR(moved(1e6, x, base)[mean + 1], base[mean + 1], 1e-14);
}

TEST_F(StabilisedMotion, theVolumeIsRestored)
{
    numbers base(x);
    for (double& v : base)
    {
        v *= 1.01;
    }
    numbers result(base);
    stabilisedMotion(grid, 10, 0, 1, 1)
        .apply(x, x, result, 0.1, 1, volume(x), gradient, grid);
    test::expectBelow("volume", std::abs(volume(result) / volume(x) - 1), 1e-8);
}
