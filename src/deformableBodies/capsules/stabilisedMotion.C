// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stabilisedMotion.H"
#include "quietEigen.H"
#include <Eigen/Dense>
#include <numeric>

namespace
{
using namespace Foam;
using coefficients = capsule::coefficients;

//- Linear part of a shape: columns are the coefficients of Y_1m
Eigen::Matrix3d linearPart(const sphericalHarmonics& grid,
                           const coefficients& x)
{
    Eigen::Matrix3d A;
    const int of[3] = {grid.index(1, 1, false), grid.index(1, 1, true),
                       grid.index(1, 0, false)};
    for (int k = 0; k < 3; ++k)
    {
        for (int d = 0; d < 3; ++d)
        {
            A(d, k) = x[3 * of[k] + d];
        }
    }
    return A;
}

//- Rotation of the polar decomposition of F = now before^-1
Eigen::AngleAxisd rotation(const Eigen::Matrix3d& now,
                           const Eigen::Matrix3d& before)
{
    const Eigen::Matrix3d F(now * before.inverse());
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU |
                                                       Eigen::ComputeFullV);
    return Eigen::AngleAxisd(
        Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()));
}

void rotate(const Eigen::Matrix3d& q, double* x)
{
    Eigen::Map<Eigen::Vector3d> v(x);
    v = (q * v).eval();
}
} // namespace

Foam::stabilisedMotion::waves::waves(const setting& s)
    : rate_(s.harmonics.degree() + 1, 0),
      start_(rate_)
{
    const membraneModel& law = s.shell.model();
    const scalar shear = law.shearModulus(), area = law.areaModulus(),
                 outside = 2 * s.mu / (1 + s.viscosityRatio);
    const bool stiffArea = area > 4 * shear;
    const scalar tension =
        max(0.25 * (shear + area),
            0.5 * (area - shear) * (stiffArea ? s.mu / outside : 1));
    for (int n = 1; n <= s.harmonics.degree(); ++n)
    {
        const scalar bend = n * (n + 3) / s.radius;
        start_[n] = 10 * s.rho * sqr(s.radius / (2 * n + 1)) / s.mu;
        rate_[n] =
            1.5 / (s.mu * s.radius * (2 * n + 1)) *
            (tension * n * (n + 1) + s.shell.bendingModulus() * bend * bend);
    }
}

Foam::scalar Foam::stabilisedMotion::waves::inertia() const
{
    scalar largest = 0;
    for (size_t n = 2; n < rate_.size(); ++n)
    {
        largest = max(largest, rate_[n] * start_[n]);
    }

    // Degree 2 of tension: 1.5 * 6/5 * 10/25
    return largest / 0.72;
}

Foam::stabilisedMotion::stabilisedMotion(const setting& s, const waves& rates)
    : capsuleMotion(s.shell, GREAT),
      effects_(s.effects),
      harmonics_(s.harmonics),
      rate_(rates)
{
}

Foam::capsuleMotion::coefficients
Foam::stabilisedMotion::extrapolate(const coefficients& x,
                                    const coefficients& previous,
                                    const double ratio) const
{
    if (previous.empty()) return x;
    const Eigen::AngleAxisd q(
        rotation(linearPart(harmonics_, x), linearPart(harmonics_, previous)));
    const Eigen::Matrix3d full(q.toRotationMatrix());
    const Eigen::Matrix3d part(
        Eigen::AngleAxisd(ratio * q.angle(), q.axis()).toRotationMatrix());
    coefficients target(previous);
    for (int i = 0; i < harmonics_.nCoeffs(); ++i)
    {
        double* t = target.data() + 3 * i;
        rotate(full, t);
        for (int d = 0; d < 3; ++d)
        {
            t[d] = x[3 * i + d] + ratio * (x[3 * i + d] - t[d]);
        }
        rotate(part, t);
    }
    return target;
}

void Foam::stabilisedMotion::correct(const capsule& c, coefficients& x,
                                     const scalar dt, const scalar ratio,
                                     const scalar volume) const
{
    const auto timing(effects_.time("stabilised"));
    const coefficients target(extrapolate(c.x, c.previous, ratio));
    for (int i = 0; i < harmonics_.nCoeffs(); ++i)
    {
        const int n = harmonics_.degreeOf(i);
        if (n == 0) continue; // the position of the whole
        const double keep = 1 / (1 + rate_.within(n, dt));
        for (int d = 0; d < 3; ++d)
        {
            const int j = 3 * i + d;
            x[j] = target[j] + keep * (x[j] - target[j]);
        }
    }
    restoreVolume(x, dt, volume);
}

void Foam::stabilisedMotion::restoreVolume(coefficients& x, const scalar dt,
                                           const scalar enclosed) const
{
    coefficients g(x.size());
    for (int newton = 0; newton < 2; ++newton)
    {
        shell_.volumeGradient(x, g);
        const double volume =
            std::inner_product(x.begin(), x.end(), g.begin(), 0.0) / 3;
        const double lack = enclosed - volume;
        double square = 0;
        coefficients step(g);
        for (int i = 0; i < harmonics_.nCoeffs(); ++i)
        {
            const int n = harmonics_.degreeOf(i);
            const double weight =
                n ? 1 / ((2 * n + 1) * (1 + rate_.within(n, dt))) : 0;
            for (int d = 0; d < 3; ++d)
            {
                step[3 * i + d] *= weight;
                square += g[3 * i + d] * step[3 * i + d];
            }
        }
        for (size_t j = 0; j < x.size(); ++j)
        {
            x[j] += lack / square * step[j];
        }
    }
}
