// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "sphericalHarmonics.H"

using Foam::sphericalHarmonics;

namespace
{
std::vector<double> randomCoeffs(const sphericalHarmonics& sh)
{
    Foam::Random random(3);
    std::vector<double> c(3 * sh.nCoeffs());
    for (double& x : c)
    {
        x = 2 * random.sample01<Foam::scalar>() - 1;
    }
    return c;
}

double dot(const std::vector<double>& a, const std::vector<double>& b)
{
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}
} // namespace

class SphericalHarmonics : public ::testing::TestWithParam<int>
{
protected:
    const int N = GetParam();
    sphericalHarmonics sh{N, 3 * N / 2 + 1};
    std::vector<double> c = randomCoeffs(sh);
    std::vector<double> x = std::vector<double>(3 * sh.nPoints());
    std::vector<double> xt = x, xp = x, back = c;
};

TEST_P(SphericalHarmonics, weightsSumToTheSphere)
{
    double sum = 0;
    for (int k = 0; k < sh.nPoints(); ++k)
    {
        sum += sh.weight(k);
    }
    // Round-off of a sum of some thousand terms
    test::expectBelow("sum of weights / 4 pi - 1",
                      std::abs(sum / (16 * std::atan(1.0)) - 1), 1e-13);
}

TEST_P(SphericalHarmonics, analysisInvertsSynthesis)
{
    sh.values(c.data(), x.data());
    sh.analysis(x.data(), back.data());
    double error = 0;
    for (std::size_t k = 0; k < c.size(); ++k)
    {
        error = std::max(error, std::abs(c[k] - back[k]));
    }
    test::expectBelow("coefficients there and back", error, 2e-13);
}

TEST_P(SphericalHarmonics, adjointsAreTransposes)
{
    std::vector<double> f(x), g(x);
    for (std::size_t k = 0; k < f.size(); ++k)
    {
        f[k] = std::sin(1.3 * k);
        g[k] = std::cos(0.7 * k);
    }
    sh.gradient(c.data(), xt.data(), xp.data());
    sh.gradientAdjoint(f.data(), g.data(), back.data());
    const double forward = dot(xt, f) + dot(xp, g);
    const double size = std::sqrt(dot(xt, xt) * dot(f, f));
    test::expectBelow("gradient and its adjoint",
                      std::abs(forward - dot(c, back)) / size, 1e-14);
}

TEST_P(SphericalHarmonics, gradientsOfKnownFields)
{
    // x = (sin t cos p, sin t sin p, cos t) and y = x^2 - y^2 + z (n <= 2)
    std::vector<double> f(x);
    const int n = sh.nPoints();
    for (int k = 0; k < n; ++k)
    {
        const double t = sh.theta(k / sh.nPhi()), p = sh.phi(k % sh.nPhi());
        f[k] = std::sin(t) * std::cos(p);
        f[n + k] = std::cos(t);
        f[2 * n + k] = std::pow(std::sin(t), 2) * std::cos(2 * p);
    }
    sh.analysis(f.data(), c.data());
    sh.gradient(c.data(), xt.data(), xp.data());
    double error = 0;
    for (int k = 0; k < n; ++k)
    {
        const double t = sh.theta(k / sh.nPhi()), p = sh.phi(k % sh.nPhi());
        const double exact[6] = {std::cos(t) * std::cos(p),
                                 -std::sin(p),
                                 -std::sin(t),
                                 0,
                                 std::sin(2 * t) * std::cos(2 * p),
                                 -2 * std::sin(t) * std::sin(2 * p)};
        for (int c = 0; c < 3; ++c)
        {
            error = std::max(error, std::abs(xt[c * n + k] - exact[2 * c]));
            error = std::max(error, std::abs(xp[c * n + k] - exact[2 * c + 1]));
        }
    }
    test::expectBelow("gradient of low harmonics", error, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(degree, SphericalHarmonics,
                         ::testing::Values(8, 16, 33));
