// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testShapes.H"
#include <chrono>

using namespace Foam;
using namespace test;

TEST(Membrane, inflatedSphere)
{
    // q_n = 2 T/R, q is per solid angle
    const double l = 1.3;
    struct law
    {
        const char* entries;
        double T;
    };
    for (const law& w :
         {law{"law neoHookean; Gs 1;", 1 - std::pow(l, -6)},
          law{"law Skalak; Gs 1; C 5;", l * l - 1 + 5 * l * l * (pow4(l) - 1)},
          law{"law Hooke; Gs 1; nu 0.3;", (l * l - 1) * 1.3 / 0.7}})
    {
        const membrane m(make(16, w.entries));
        const sphericalHarmonics& grid = m.harmonics();
        const int n = grid.nPoints();
        numbers q(3 * grid.nCoeffs()), values(3 * n);
        m.load(sphere(16, l).data(), q.data());
        grid.values(q.data(), values.data());
        const double exact = 2 * w.T / l;
        double error = 0;
        for (int k = 0; k < n; ++k)
        {
            const double t = grid.theta(k / grid.nPhi());
            const double p = grid.phi(k % grid.nPhi());
            const vector e(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p),
                           std::cos(t));
            error = max(error, mag(at(values, n, k) / sqr(l) - exact * e));
        }
        test::expectBelow(std::string("inflated sphere, load - 2T/R, ") +
                              w.entries,
                          error / exact, 1e-12);
    }
}

TEST(Membrane, loadIsTheGradientOfTheEnergy)
{
    const int N = 12;
    const membrane m(neoHookean(N));
    numbers x(roughShape(N)), q(x.size()), dx(x.size());
    for (std::size_t k = 0; k < x.size(); ++k)
    {
        dx[k] = 1e-2 * std::sin(2.3 * k) / (1 + k);
    }
    m.load(x.data(), q.data());
    const double exact =
        std::inner_product(q.begin(), q.end(), dx.begin(), 0.0);

    // Central differences, extrapolated to fourth order
    const auto slope = [&](const double h)
    {
        numbers plus(x), minus(x);
        for (std::size_t k = 0; k < x.size(); ++k)
        {
            plus[k] += h * dx[k];
            minus[k] -= h * dx[k];
        }
        return (m.energy(plus.data()) - m.energy(minus.data())) / (2 * h);
    };
    const double measured = (4 * slope(0.05) - slope(0.1)) / 3;
    test::expectBelow("dE/dX against finite differences",
                      std::abs(measured / exact - 1), 1e-8);
}

TEST(Membrane, noForceAndNoTorque)
{
    for (const int N : {8, 16, 24})
    {
        const membrane m(neoHookean(N));
        const sphericalHarmonics& grid = m.harmonics();
        const int n = grid.nPoints();
        const numbers x(roughShape(N));
        numbers q(x.size()), f(3 * n), r(3 * n);
        m.load(x.data(), q.data());
        grid.values(q.data(), f.data());
        grid.values(x.data(), r.data());
        vector force(Zero), torque(Zero);
        double size = 0;
        for (int k = 0; k < n; ++k)
        {
            const vector F(grid.weight(k) *
                           vector(f[k], f[n + k], f[2 * n + k]));
            force += F;
            torque += vector(r[k], r[n + k], r[2 * n + k]) ^ F;
            size += mag(F);
        }
        const std::string name = ", N = " + std::to_string(N);
        test::expectBelow("total force" + name, mag(force) / size, 1e-13);
        test::expectBelow("total torque" + name, mag(torque) / size, 1e-13);
    }
}

// Run by tests/bench/membrane: microseconds and error of one load, transforms included
TEST(Membrane, DISABLED_cost)
{
    const auto microseconds = [](auto work)
    {
        // Least time of several batches
        double least = 1e30;
        for (int batch = 0; batch < 20; ++batch)
        {
            const int n = 20;
            const auto start = std::chrono::steady_clock::now();
            for (int i = 0; i < n; ++i)
            {
                work();
            }
            const std::chrono::duration<double> used(
                std::chrono::steady_clock::now() - start);
            least = min(least, 1e6 * used.count() / n);
        }
        return least;
    };
    std::printf(
        "    N  membrane  + bending  volume gradient  [microseconds]\n");
    for (const int N : {8, 12, 16, 24, 32, 48})
    {
        const membrane m(neoHookean(N));
        const sphericalHarmonics& grid = m.harmonics();
        const bending b(makeBending(grid, "modulus 1;"));
        const numbers x(roughShape(N));
        numbers q(x.size()), t(3 * grid.nPoints()), p(t.size());
        const double load = microseconds([&]() { m.load(x.data(), q.data()); });
        const double bend =
            microseconds([&]() { b.addLoad(x.data(), q.data()); });
        const double volume = microseconds(
            [&]()
            {
                grid.gradient(x.data(), t.data(), p.data());
                grid.analysis(t.data(), q.data());
            });
        std::printf("    %2d  %8.1f  %9.1f  %15.1f\n", N, load, load + bend,
                    volume);
    }
}
