// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Sums over the points of surfaces

#include "nearField.H"
#include "mathematicalConstants.H"

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Core>
#include <algorithm>

namespace
{
const double pi = Foam::constant::mathematical::pi;

//- Number of points that the sum handles as one vector
constexpr int nLanes = 16;
using lanes = Eigen::Array<float, nLanes, 1>;
using lanesAt = Eigen::Map<lanes>;
using oneLane = Eigen::Array<float, 1, 1>;
} // namespace

template<class Lanes>
inline __attribute__((always_inline)) void
Foam::nearField::evaluate(const Lanes& s, Lanes& A, Lanes& C) const
{
    const Lanes t = 1 / (1 + s * (1 / c_));
    const auto sum = [](const coefficients& a, const int begin, const int end,
                        const Lanes& x)
    {
        Lanes y = Lanes::Constant(a[begin]);
        for (int k = begin + 1; k < end; ++k)
        {
            y = y * x + a[k];
        }
        return y;
    };
    const Lanes v = 2.5f * t - 1.5f, tt = t * t, t4 = tt * tt, t8 = t4 * t4;
    const Lanes far = t * t.sqrt();
    A = far * sum(A_, 0, nFar, t) + t8 * sum(A_, nFar, nFar + nNear, v);
    C = far * t * sum(C_, 0, nFar, t) + t8 * sum(C_, nFar, nFar + nNear, v);
}

Foam::nearField::mobility Foam::nearField::fitted(const scalar q) const
{
    oneLane A, C;
    evaluate<oneLane>(oneLane::Constant(float(q * q)), A, C);
    return {A[0], C[0]};
}

void Foam::nearField::add(const vector* Y, const vector* G, const label m,
                          const vector* X, const label n, vector* u) const
{
    const scalar factor = 1 / (8 * pi * mu_ * h_);
    for (label i = 0; i < n; i += nLanes)
    {
        const label some = std::min(label(nLanes), n - i);
        lanes x[3], v[3];
        for (direction d = 0; d < 3; ++d)
        {
            v[d].setZero();
            for (label k = 0; k < nLanes; ++k)
            {
                x[d][k] = (X[i + std::min(k, some - 1)][d] - X[0][d]) / h_;
            }
        }
        for (label j = 0; j < m; ++j)
        {
            lanes r[3], A, C;
            float g[3];
            for (direction d = 0; d < 3; ++d)
            {
                r[d] = x[d] - float((Y[j][d] - X[0][d]) / h_);
                g[d] = factor * G[j][d];
            }
            evaluate<lanes>(r[0] * r[0] + r[1] * r[1] + r[2] * r[2], A, C);
            C *= r[0] * g[0] + r[1] * g[1] + r[2] * g[2];
            for (direction d = 0; d < 3; ++d)
            {
                v[d] += A * g[d] + C * r[d];
            }
        }
        for (label k = 0; k < some; ++k)
        {
            u[i + k] += vector(v[0][k], v[1][k], v[2][k]);
        }
    }
}

void Foam::nearField::velocity(const vector* X, const vector* F, const label n,
                               vector* u) const
{
    // Arrays of components, padded with points without force to whole vectors
    const int m = (n + nLanes - 1) / nLanes * nLanes;
    std::vector<float> numbers(9 * m, 0);
    float* const x = numbers.data();
    float* const f = x + 3 * m;
    float* const v = f + 3 * m;
    const float self = fitted(0).A;
    const scalar factor = 1 / (8 * pi * mu_ * h_);
    for (label i = 0; i < n; ++i)
    {
        for (direction d = 0; d < 3; ++d)
        {
            x[d * m + i] = (X[i][d] - X[0][d]) / h_;
            f[d * m + i] = factor * F[i][d];
            v[d * m + i] = self * f[d * m + i];
        }
    }

    lanes number;
    for (int l = 0; l < nLanes; ++l)
    {
        number[l] = l;
    }
    for (int i = 0; i < n; ++i)
    {
        const float *const xi = x + i, *const fi = f + i;
        lanes vx = lanes::Zero(), vy = vx, vz = vx;
        for (int j = i / nLanes * nLanes; j < m; j += nLanes)
        {
            const lanes rx = lanesAt(x + j) - xi[0];
            const lanes ry = lanesAt(x + m + j) - xi[m];
            const lanes rz = lanesAt(x + 2 * m + j) - xi[2 * m];
            lanes A, C;
            evaluate<lanes>(rx * rx + ry * ry + rz * rz, A, C);
            if (j <= i)
            {
                const lanes later = (number > float(i - j)).cast<float>();
                A *= later;
                C *= later;
            }
            const lanes fx = lanesAt(f + j), fy = lanesAt(f + m + j),
                        fz = lanesAt(f + 2 * m + j);
            const lanes toI = C * (rx * fx + ry * fy + rz * fz);
            const lanes toJ = C * (rx * fi[0] + ry * fi[m] + rz * fi[2 * m]);
            vx += A * fx + toI * rx;
            vy += A * fy + toI * ry;
            vz += A * fz + toI * rz;
            lanesAt(v + j) += A * fi[0] + toJ * rx;
            lanesAt(v + m + j) += A * fi[m] + toJ * ry;
            lanesAt(v + 2 * m + j) += A * fi[2 * m] + toJ * rz;
        }
        v[i] += vx.sum();
        v[m + i] += vy.sum();
        v[2 * m + i] += vz.sum();
    }
    for (label i = 0; i < n; ++i)
    {
        u[i] = vector(v[i], v[m + i], v[2 * m + i]);
    }
}
