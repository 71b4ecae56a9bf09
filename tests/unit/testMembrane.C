// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "IStringStream.H"
#include "membrane.H"

using namespace Foam;

namespace
{
using numbers = std::vector<double>;

//- Coefficients of a mapped unit sphere
template<class Map>
numbers shape(const int N, Map map)
{
    const sphericalHarmonics grid(N, 3 * N / 2 + 1);
    const int n = grid.nPoints();
    numbers x(3 * n), c(3 * grid.nCoeffs());
    for (int k = 0; k < n; ++k)
    {
        const double t = grid.theta(k / grid.nPhi());
        const double p = grid.phi(k % grid.nPhi());
        const vector v(map(vector(std::sin(t) * std::cos(p),
                                  std::sin(t) * std::sin(p), std::cos(t))));
        for (int d = 0; d < 3; ++d)
        {
            x[d * n + k] = v[d];
        }
    }
    grid.analysis(x.data(), c.data());
    return c;
}

numbers sphere(const int N, const double R = 1)
{
    return shape(N, [R](const vector& e) { return R * e; });
}

//- Sheared, with bumps: nothing special about it
numbers roughShape(const int N)
{
    return shape(N,
                 [](const vector& e)
                 {
                     return (1 + 0.1 * e.x() * e.y() - 0.08 * pow3(e.z())) * e +
                            vector(0.3 * e.y(), 0.1 * e.z(), 0);
                 });
}

membrane neoHookean(const int N)
{
    IStringStream law("law neoHookean; Gs 1;");
    return membrane(N, 3 * N / 2 + 1, dictionary(law), sphere(N));
}
} // namespace

TEST(Membrane, inflatedSphere)
{
    // q_n = 2 T/R, T = Gs (1 - l^-6); q is per solid angle
    const double l = 1.3, exact = 2 * (1 - std::pow(l, -6)) / l;
    const membrane m(neoHookean(16));
    const sphericalHarmonics& grid = m.harmonics();
    const int n = grid.nPoints();
    numbers q(3 * grid.nCoeffs()), values(3 * n);
    m.load(sphere(16, l).data(), q.data());
    grid.values(q.data(), values.data());
    double error = 0;
    for (int k = 0; k < n; ++k)
    {
        const double t = grid.theta(k / grid.nPhi());
        const double p = grid.phi(k % grid.nPhi());
        const vector e(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p),
                       std::cos(t));
        const vector f(values[k], values[n + k], values[2 * n + k]);
        error = max(error, mag(f / sqr(l) - exact * e));
    }
    test::expectBelow("inflated sphere: load - 2T/R", error / exact, 1e-12);
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

TEST(Membrane, prolateAgainstAxisymmetricTheory)
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
        // A tenth above the published digits
        test::expectBelow("prolate (1,1,2), relative L2 error, N = " +
                              std::to_string(N),
                          std::sqrt(error / size), 1.1 * table[i]);
    }
}
