// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Sums over the points of surfaces

#include "nearField.H"
#include "floatLanes.H"
#include "mathematicalConstants.H"
#include <algorithm>

namespace
{
const double pi = Foam::constant::mathematical::pi;
using namespace Foam::floatLanes;
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
    static_assert(nearPower == 8, "t8 is t^nearPower");
    const float scale = nearScale, shift = nearShift;
    const Lanes v = scale * t - shift, tt = t * t, t4 = tt * tt, t8 = t4 * t4;
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

Foam::nearField::pointSet::pointSet(const std::vector<vector>& X,
                                    const std::vector<vector>& forces)
    : n(X.size())
{
    const label m = floatLanes::padded(n);
    fromOrigin.assign(3 * m, 0);
    F.assign(3 * m, 0);
    if (n) origin = X[0];
    for (label i = 0; i < n; ++i)
    {
        for (direction d = 0; d < 3; ++d)
        {
            fromOrigin[d * m + i] = X[i][d] - origin[d];
            F[d * m + i] = forces[i][d];
        }
    }
}

Foam::nearField::pointSet::pointSet(const pointSet& all,
                                    const std::vector<label>& which)
    : origin(all.origin),
      n(which.size())
{
    const label m = floatLanes::padded(n);
    fromOrigin.assign(3 * m, 0);
    F.assign(3 * m, 0);
    for (direction d = 0; d < 3; ++d)
    {
        for (label i = 0; i < n; ++i)
        {
            const label from = d * all.padded() + which[i];
            fromOrigin[d * m + i] = all.fromOrigin[from];
            F[d * m + i] = all.F[from];
        }
    }
}

std::vector<Foam::label>
Foam::nearField::pointSet::foremost(const vector& e, const scalar depth) const
{
    const label m = padded();
    std::vector<double> along(n);
    for (label i = 0; i < n; ++i)
    {
        along[i] = e.x() * fromOrigin[i] + e.y() * fromOrigin[m + i] +
                   e.z() * fromOrigin[2 * m + i];
    }
    std::vector<label> which;
    if (n == 0) return which;
    const double least = *std::max_element(along.begin(), along.end()) - depth;
    for (label i = 0; i < n; ++i)
    {
        if (along[i] >= least) which.push_back(i);
    }
    return which;
}

void Foam::nearField::exchange(const pointSet& a, const pointSet& b,
                               const vector& apart, std::vector<vector>& u,
                               std::vector<vector>& v) const
{
    const label n = a.padded(), m = b.padded();
    const double perCell = 1 / h_;
    std::vector<float> numbers(9 * m, 0);
    float* const y = numbers.data();
    float* const rest = y + 3 * m;
    float* const w = rest + 3 * m;
    for (direction d = 0; d < 3; ++d)
    {
        for (label j = 0; j < m; ++j)
        {
            const double at = perCell * (b.fromOrigin[d * m + j] + apart[d]);
            y[d * m + j] = at;
            rest[d * m + j] = at - y[d * m + j];
        }
    }
    const scalar factor = 1 / (8 * pi * mu_ * h_);
    u.resize(a.n);
    for (label i = 0; i < a.n; ++i)
    {
        float x[3], xRest[3];
        for (direction d = 0; d < 3; ++d)
        {
            const double at = perCell * a.fromOrigin[d * n + i];
            x[d] = at;
            xRest[d] = at - x[d];
        }
        const float f[] = {a.F[i], a.F[n + i], a.F[2 * n + i]};
        lanes ux = lanes::Zero(), uy = ux, uz = ux;
        for (label j = 0; j < m; j += nLanes)
        {
            const auto difference = [&](const direction d) -> lanes
            {
                return (x[d] - lanesOf(y + d * m + j)) +
                       (xRest[d] - lanesOf(rest + d * m + j));
            };
            const lanes rx = difference(0), ry = difference(1),
                        rz = difference(2);
            lanes A, C;
            evaluate<lanes>(rx * rx + ry * ry + rz * rz, A, C);
            const lanes gx = lanesOf(&b.F[j]), gy = lanesOf(&b.F[m + j]),
                        gz = lanesOf(&b.F[2 * m + j]);
            const lanes toA = C * (rx * gx + ry * gy + rz * gz);
            const lanes toB = C * (rx * f[0] + ry * f[1] + rz * f[2]);
            ux += A * gx + toA * rx;
            uy += A * gy + toA * ry;
            uz += A * gz + toA * rz;
            lanesAt(w + j) += A * f[0] + toB * rx;
            lanesAt(w + m + j) += A * f[1] + toB * ry;
            lanesAt(w + 2 * m + j) += A * f[2] + toB * rz;
        }
        u[i] = factor * vector(ux.sum(), uy.sum(), uz.sum());
    }
    v.resize(b.n);
    for (label j = 0; j < b.n; ++j)
    {
        v[j] = factor * vector(w[j], w[m + j], w[2 * m + j]);
    }
}

void Foam::nearField::velocity(const vector* X, const vector* F, const label n,
                               vector* u) const
{
    // Arrays of components, padded with points without force to whole vectors
    const int m = padded(n);
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
