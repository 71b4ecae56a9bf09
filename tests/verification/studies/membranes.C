// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Errors of the loads of membrane and bending against the degree of the harmonics

#include "testShapes.H"

using namespace Foam;
using namespace test;

TEST(MembraneOrders, prolateAgainstAxisymmetricTheory)
{
    // Sphere stretched to semi-axes (1, 1, 2): with r = sin t, z = 2 cos t the
    // principal stretches are l = sqrt(cos^2 t + 4 sin^2 t) and 1, tensions
    // T1 = l - l^-3, T2 = (1 - l^-2)/l, curvatures 2/l^3 and 2/l;
    // q_n = sum of curvature times tension,
    // q_t = -(d(r T1)/ds - T2 dr/ds)/r
    const int degrees[] = {8, 12, 16, 24, 32, 48};
    const double table[] = {7.9e-2, 1.7e-2, 3.0e-3, 7.5e-5, 1.6e-6, 5e-10};
    for (int i = 0; i < 6; ++i)
    {
        const int N = degrees[i];
        const membrane m(neoHookean(N));
        const sphericalHarmonics& grid = m.harmonics();
        const int n = grid.nPoints();
        const numbers x(shape(N, [](const vector& e)
                              { return vector(e.x(), e.y(), 2 * e.z()); }));
        numbers q(x.size()), f(3 * n);
        m.load(x.data(), q.data());
        grid.values(q.data(), f.data());

        double error = 0, size = 0;
        for (int k = 0; k < n; ++k)
        {
            const double t = grid.theta(k / grid.nPhi());
            const double p = grid.phi(k % grid.nPhi());
            const double s = std::sin(t), c = std::cos(t);
            const double l = std::sqrt(c * c + 4 * s * s);
            const double T1 = l - 1 / (l * l * l), T2 = (1 - 1 / (l * l)) / l;
            const double dT1 = (1 + 3 / (l * l * l * l)) * 3 * s * c / l;
            const double qn = 2 / (l * l * l) * T1 + 2 / l * T2;
            const double qt = -(dT1 + c / s * (T1 - T2)) / l;
            // Outward normal and tangent in the meridian plane; area l per
            // solid angle
            const double fr = l * (qn * 2 * s / l + qt * c / l);
            const double fz = l * (qn * c / l - qt * 2 * s / l);
            const vector exact(fr * std::cos(p), fr * std::sin(p), fz);
            const vector load(f[k], f[n + k], f[2 * n + k]);
            error += grid.weight(k) * magSqr(load - exact);
            size += grid.weight(k) * magSqr(exact);
        }
        // Limit: a tenth above the published digits
        test::expectBelow("prolate (1,1,2), relative L2 error, N = " +
                              std::to_string(N),
                          std::sqrt(error / size), 1.1 * table[i]);
    }
}

TEST(BendingOrders, biconcaveConverges)
{
    // Error relative to degree 64 against the published table. Factor 1.5, as the table was
    // made with another reference
    const auto loadOf = [](const int N, const sphericalHarmonics& fine)
    {
        const sphericalHarmonics grid(N, 3 * N / 2 + 1);
        const bending b(makeBending(grid, "modulus 1;"));
        numbers q(3 * grid.nCoeffs(), 0), wide(3 * fine.nCoeffs(), 0);
        b.addLoad(shape(N, biconcave).data(), q.data());
        for (int n = 0; n <= N; ++n)
        {
            for (int m = 0; m <= n; ++m)
            {
                for (int sine = 0; sine < (m ? 2 : 1); ++sine)
                {
                    for (int d = 0; d < 3; ++d)
                    {
                        wide[3 * fine.index(n, m, sine) + d] =
                            q[3 * grid.index(n, m, sine) + d];
                    }
                }
            }
        }
        return wide;
    };
    const sphericalHarmonics fine(64, 97);
    const numbers exact(loadOf(64, fine));
    const int degrees[] = {8, 12, 16, 24, 32, 48};
    const double table[] = {0.84, 0.34, 0.24, 4.5e-2, 8.5e-3, 1.6e-4};
    for (int i = 0; i < 6; ++i)
    {
        const numbers q(loadOf(degrees[i], fine));
        double error = 0, size = 0;
        for (size_t j = 0; j < q.size(); ++j)
        {
            error += sqr(q[j] - exact[j]);
            size += sqr(exact[j]);
        }
        test::expectBelow("bending on a biconcave cell, relative L2 error, N "
                          "= " +
                              std::to_string(degrees[i]),
                          std::sqrt(error / size), 1.5 * table[i]);
    }
}
