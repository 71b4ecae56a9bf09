// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stabilisedMotion.H"

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Dense>
#include <numeric>

namespace
{
using namespace Foam;
using numbers = std::vector<double>;

//- Linear part of a shape: columns are the coefficients of Y_1m
Eigen::Matrix3d linearPart(const sphericalHarmonics& grid, const numbers& x)
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

Foam::stabilisedMotion::stabilisedMotion(const sphericalHarmonics& grid,
                                         const scalar tension,
                                         const scalar bendingModulus,
                                         const scalar mu, const scalar radius)
    : degree_(grid.nCoeffs()),
      rate_(grid.degree() + 1, 0)
{
    for (int n = 0; n <= grid.degree(); ++n)
    {
        for (int m = 0; m <= n; ++m)
        {
            degree_[grid.index(n, m, false)] = n;
            if (m) degree_[grid.index(n, m, true)] = n;
        }
        if (n)
        {
            const scalar bend = n * (n + 3) / radius;
            rate_[n] = 1.5 / (mu * radius * (2 * n + 1)) *
                       (tension * n * (n + 1) + bendingModulus * bend * bend);
        }
    }
}

void Foam::stabilisedMotion::apply(
    const numbers& x, const numbers& previous, numbers& base, const scalar dt,
    const scalar ratio, const scalar enclosed,
    const std::function<void(const numbers&, numbers&)>& volumeGradient,
    const sphericalHarmonics& grid) const
{
    numbers g(x.size()), target(x);
    const auto volume = [&](const numbers& y)
    {
        volumeGradient(y, g);
        return std::inner_product(y.begin(), y.end(), g.begin(), 0.0) / 3;
    };
    if (previous.size())
    {
        const Eigen::AngleAxisd q(
            rotation(linearPart(grid, x), linearPart(grid, previous)));
        const Eigen::Matrix3d full(q.toRotationMatrix());
        const Eigen::Matrix3d part(
            Eigen::AngleAxisd(ratio * q.angle(), q.axis()).toRotationMatrix());
        target = previous;
        for (size_t i = 0; i < degree_.size(); ++i)
        {
            double* t = target.data() + 3 * i;
            rotate(full, t);
            for (int d = 0; d < 3; ++d)
            {
                t[d] = x[3 * i + d] + ratio * (x[3 * i + d] - t[d]);
            }
            rotate(part, t);
        }
    }
    for (size_t i = 0; i < degree_.size(); ++i)
    {
        if (degree_[i] == 0) continue; // the place of the whole
        const double keep = 1 / (1 + dt * rate_[degree_[i]]);
        for (int d = 0; d < 3; ++d)
        {
            const size_t j = 3 * i + d;
            base[j] = target[j] + keep * (base[j] - target[j]);
        }
    }

    // Two passes of Newton's method back to the volume
    for (int pass = 0; pass < 2; ++pass)
    {
        const double lack = enclosed - volume(base);
        double square = 0;
        numbers step(g);
        for (size_t i = 0; i < degree_.size(); ++i)
        {
            const int n = degree_[i];
            const double weight =
                n ? 1 / ((2 * n + 1) * (1 + dt * rate_[n])) : 0;
            for (int d = 0; d < 3; ++d)
            {
                step[3 * i + d] *= weight;
                square += g[3 * i + d] * step[3 * i + d];
            }
        }
        for (size_t j = 0; j < base.size(); ++j)
        {
            base[j] += lack / square * step[j];
        }
    }
}
