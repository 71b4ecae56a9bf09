// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "blockMeans.H"
#include "unitTest.H"
#include <cmath>

using namespace Foam;

namespace
{
//- A start that dies out with time 20 and noise whose correlation time is 1
struct noisyStart
{
    Random random{7};
    scalar noise = 0, time = 0;

    scalarList next(const scalar dt)
    {
        const scalar kept = std::exp(-dt);
        time += dt;
        noise = kept * noise +
                std::sqrt(1 - sqr(kept)) * random.GaussNormal<scalar>();
        return {3 + 0.1 * noise + 2 * std::exp(-time / 20), time};
    }
};
} // namespace

TEST(blockMeans, meanAndErrorOfNoiseAfterATransient)
{
    blockMeans means(2);
    noisyStart s;
    const scalar dt = 0.1;
    for (label i = 0; i < 10000; ++i)
    {
        const scalarList x(s.next(dt));
        means.add(s.time, dt, x);
    }
    const label first = means.afterTransient(0);
    ASSERT_LT(first, means.nBlocks());
    const scalar from = means.start(first);
    EXPECT_GT(from, 40);
    EXPECT_LT(from, 300);
    const blockMeans::mean m(means.of(0, first));

    // Variance of the mean of correlated noise: 2 sigma^2 tau/T
    const scalar expected = 0.1 * std::sqrt(2 / (1000 - from));
    EXPECT_GT(m.error, 0.6 * expected);
    EXPECT_LT(m.error, 2.5 * expected);
    test::expectBelow("error of the mean over its estimate",
                      mag(m.value - 3) / m.error, 3);
}

TEST(blockMeans, allSamplesCountOnce)
{
    blockMeans means(1);
    scalar time = 0, sum = 0, weight = 0;
    for (label i = 0; i < 64 * 37; ++i)
    {
        const scalar dt = 1 + i % 3;
        time += dt;
        sum += dt * i;
        weight += dt;
        means.add(time, dt, scalarList(1, scalar(i)));
    }
    EXPECT_EQ(means.start(0), 0);
    EXPECT_NEAR(means.of(0, 0).value, sum / weight, 1e-9 * sum / weight);
    EXPECT_LT(means.nBlocks(), 128);
    EXPECT_EQ(means.firstFrom(time), means.nBlocks());
    EXPECT_EQ(means.firstFrom(0), 0);
}

TEST(blockMeans, aTransientThatGoesOnIsSaidToBe)
{
    blockMeans means(1);
    for (label i = 1; i <= 1000; ++i)
    {
        means.add(i, 1, scalarList(1, scalar(i)));
    }
    EXPECT_EQ(means.afterTransient(0), means.nBlocks());
}

TEST(blockMeans, aTrendUnderNoiseIsATransient)
{
    // To the end of the run a third of the way to the steady value is left
    blockMeans trend(1), steady(1);
    noisyStart s;
    for (label i = 1; i <= 2000; ++i)
    {
        const scalar t = 0.1 * i, noise = 0.02 * (s.next(0.1)[0] - 3);
        trend.add(t, 0.1, scalarList(1, 1 - std::exp(-t / 180) + noise));
        steady.add(t, 0.1, scalarList(1, 1 - std::exp(-t / 4) + noise));
    }
    EXPECT_EQ(trend.afterTransient(0), trend.nBlocks());
    EXPECT_LT(steady.afterTransient(0), steady.nBlocks());

    // A mean that is asked for all the same has the trend in its error
    const blockMeans::mean m(trend.of(0, trend.firstFrom(100)));
    EXPECT_GT(m.error, 0.1);
}

TEST(blockMeans, aStateGoesOnExactly)
{
    blockMeans whole(2), second(2);
    noisyStart s;
    for (label i = 0; i < 1000; ++i)
    {
        const scalarList x(s.next(0.3));
        whole.add(s.time, 0.3, x);
        second.add(s.time, 0.3, x);
        if (i % 77 == 0)
        {
            const scalarList state(second.state());
            second = blockMeans(2);
            second.restore(state);
        }
    }
    EXPECT_EQ(whole.state(), second.state());
}
