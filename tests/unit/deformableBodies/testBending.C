// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testShapes.H"

using namespace Foam;
using namespace test;

TEST(Bending, noForceAndNoTorque)
{
    for (const int N : {8, 16, 24})
    {
        const sphericalHarmonics grid(N, 3 * N / 2 + 1);
        const int n = grid.nPoints();
        const bending b(makeBending(grid, "modulus 1; reference initial;",
                                    shape(N, biconcave)));
        const numbers x(roughShape(N));
        numbers q(x.size(), 0), f(3 * n), r(3 * n);
        b.addLoad(x.data(), q.data());
        grid.values(q.data(), f.data());
        grid.values(x.data(), r.data());
        vector force(Zero), torque(Zero);
        double size = 0;
        for (int k = 0; k < n; ++k)
        {
            const vector F(grid.weight(k) * at(f, n, k));
            force += F;
            torque += at(r, n, k) ^ F;
            size += mag(F);
        }
        const std::string name = ", N = " + std::to_string(N);
        test::expectBelow("bending, total force" + name, mag(force) / size,
                          1e-13);
        test::expectBelow("bending, total torque" + name, mag(torque) / size,
                          1e-13);
    }
}

TEST(Bending, againstTheShearOfMeanCurvature)
{
    // Uniform reference: dW = INT J Q^a n.dx_a with Q = -E_B grad_s(2H); the gradient is
    // computed independently
    const int N = 48;
    const sphericalHarmonics grid(N, 3 * N / 2 + 1);
    const int n = grid.nPoints();
    const bending b(makeBending(grid, "modulus 1; reference 0.7;"));
    const numbers x(roughShape(N));
    numbers q(x.size(), 0), c(n), H(3 * n, 0), h(x.size());
    b.addLoad(x.data(), q.data());
    bending::curvature(grid, x.data(), c.data());
    std::copy(c.begin(), c.end(), H.begin());
    grid.analysis(H.data(), h.data());

    numbers t(3 * n), p(3 * n), ht(3 * n), hp(3 * n), other(x.size());
    grid.gradient(x.data(), t.data(), p.data());
    grid.gradient(h.data(), ht.data(), hp.data());
    for (int k = 0; k < n; ++k)
    {
        const vector xt(at(t, n, k)), xp(at(p, n, k));
        const vector area(xt ^ xp);
        const double J = mag(area), r = 1 / (J * J);
        // 2H is -c
        const double Qt = r * ((xp & xp) * ht[k] - (xt & xp) * hp[k]);
        const double Qp = r * ((xt & xt) * hp[k] - (xt & xp) * ht[k]);
        for (int d = 0; d < 3; ++d)
        {
            t[d * n + k] = grid.weight(k) * Qt * area[d];
            p[d * n + k] = grid.weight(k) * Qp * area[d];
        }
    }
    grid.gradientAdjoint(t.data(), p.data(), other.data());
    double error = 0, size = 0;
    for (size_t i = 0; i < q.size(); ++i)
    {
        error += sqr(q[i] - other[i]);
        size += sqr(q[i]);
    }
    test::expectBelow("bending against -E_B grad(2H), relative",
                      std::sqrt(error / size), 1e-7);
}

TEST(Bending, smallWaveOnASphere)
{
    // w = eps Y_n on the unit sphere, its own reference: q_n = E_B n(n+1)
    // (n(n+1) - 2) w, for large n the E_B Lap^2 w of a flat plate
    for (const int degree : {2, 6, 12})
    {
        const int N = 16;
        const sphericalHarmonics grid(N, 3 * N / 2 + 1);
        const int n = grid.nPoints();
        const bending b(makeBending(grid, "modulus 1;"));
        const double eps = 1e-6;
        numbers wave(3 * grid.nCoeffs(), 0), values(3 * n);
        wave[3 * grid.index(degree, 1, true)] = eps;
        grid.values(wave.data(), values.data());
        numbers r(3 * n), x(wave.size()), q(wave.size(), 0), f(3 * n);
        numbers e(3 * n);
        grid.values(sphere(N).data(), e.data());
        for (int k = 0; k < n; ++k)
        {
            for (int d = 0; d < 3; ++d)
            {
                r[d * n + k] = (1 + values[k]) * e[d * n + k];
            }
        }
        grid.analysis(r.data(), x.data());
        b.addLoad(x.data(), q.data());
        grid.values(q.data(), f.data());
        double along = 0, square = 0;
        for (int k = 0; k < n; ++k)
        {
            along += grid.weight(k) * (at(f, n, k) & at(e, n, k)) * values[k];
            square += grid.weight(k) * sqr(values[k]);
        }
        const double nn = degree * (degree + 1.0);
        test::expectBelow("wave of degree " + std::to_string(degree) +
                              ", load over E_B n(n+1)(n(n+1)-2) w, from 1",
                          mag(along / square / (nn * (nn - 2)) - 1), 1e-4);
    }
}

TEST(Bending, relaxation)
{
    // Overdamped motion along the load: a Y_20 bulge of a sphere with bending decays; a
    // sphere compressed to 0.85 without bending buckles at constant volume, with falling
    // energy
    const int N = 12;
    const sphericalHarmonics grid(N, 3 * N / 2 + 1);
    const bending b(makeBending(grid, "modulus 1;"));
    numbers x(shape(N, [](const vector& e)
                    { return (1 + 0.1 * (3 * sqr(e.z()) - 1)) * e; }));
    const double first = b.energy(x.data());
    double last = first;
    bool falls = true;
    for (int step = 0; step < 2000; ++step)
    {
        numbers q(x.size(), 0);
        b.addLoad(x.data(), q.data());
        for (size_t i = 0; i < x.size(); ++i)
        {
            x[i] -= 2e-5 * q[i];
        }
        const double now = b.energy(x.data());
        falls = falls && now <= last;
        last = now;
    }
    EXPECT_TRUE(falls);
    test::expectBelow("Y_20 bulge, bending energy left", last / first, 0.5);

    const membrane m(make(N, "law neoHookean; Gs 1;"));
    numbers y(shape(N, [](const vector& e)
                    { return 0.85 * (1 + 1e-3 * test::noise(e)) * e; }));
    // Step along the load minus the part that would change the volume
    const sphericalHarmonics& g = m.harmonics();
    const int n = g.nPoints();
    numbers q(y.size()), t(3 * n), p(3 * n), area(3 * n), gv(y.size());
    const double start = m.energy(y.data());
    last = start;
    falls = true;
    for (int step = 0; step < 3000; ++step)
    {
        g.gradient(y.data(), t.data(), p.data());
        for (int k = 0; k < n; ++k)
        {
            const vector dS(at(t, n, k) ^ at(p, n, k));
            for (int d = 0; d < 3; ++d)
            {
                area[d * n + k] = dS[d];
            }
        }
        g.analysis(area.data(), gv.data());
        m.load(y.data(), q.data());
        const double part =
            std::inner_product(q.begin(), q.end(), gv.begin(), 0.0) /
            std::inner_product(gv.begin(), gv.end(), gv.begin(), 0.0);
        for (size_t i = 0; i < y.size(); ++i)
        {
            y[i] -= 2e-3 * (q[i] - part * gv[i]);
        }
        const double now = m.energy(y.data());
        falls = falls && now <= last * (1 + 1e-12);
        last = now;
    }
    EXPECT_TRUE(falls);
    test::expectBelow("compressed sphere, energy left", last / start, 0.5);
}
