// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Transform of the difference of the mobilities, its integrals and its fit

#include "nearField.H"
#include "mathematicalConstants.H"
#include "quietEigen.H"
#include <Eigen/QR>
#include <algorithm>

namespace
{
const double pi = Foam::constant::mathematical::pi;

//- Integral of f from a to b, by three Gauss points in each of n intervals
template<class Function>
auto integral(const double a, const double b, const int n, Function f)
{
    const double half = 0.5 * (b - a) / n;
    decltype(f(a)) sum = 0 * f(a);
    for (int i = 0; i < n; ++i)
    {
        const double middle = a + (2 * i + 1) * half;
        const double x = std::sqrt(0.6) * half;
        sum += 5 * f(middle - x) + 8 * f(middle) + 5 * f(middle + x);
    }
    sum *= half / 9;
    return sum;
}

//- Fourier transform of a kernel, tabulated
class transformOf
{
    static constexpr double step = 0.01;
    std::vector<double> values_;

public:
    transformOf(const Foam::deltaKernel& kernel, const double largest)
    {
        for (int i = 0; i < largest / step + 2; ++i)
        {
            // Kernels are smooth between multiples of 1/2, the ends of intervals
            values_.push_back(
                2 * integral(0, kernel.reach(), int(8 * kernel.reach()),
                             [&](const double r) {
                                 return kernel.phi(r) * std::cos(i * step * r);
                             }));
        }
    }

    double operator()(const double K) const
    {
        const double x = std::abs(K) / step;
        const int i = int(x);
        return values_[i] + (x - i) * (values_[i + 1] - values_[i]);
    }
};

//- Spherical Bessel functions of order 0, and of order 2 over x^2
void bessel(const double x, double& j0, double& j2)
{
    const double xx = x * x;
    if (x < 0.1)
    {
        j0 = 1 - xx / 6 * (1 - xx / 20);
        j2 = 1 / 15.0 - xx / 210 * (1 - xx / 36);
        return;
    }
    j0 = std::sin(x) / x;
    j2 = (3 * (j0 - std::cos(x)) / xx - j0) / xx;
}
} // namespace

Foam::nearField::nearField(const deltaKernel::kernelType kernel, const scalar h,
                           const scalar mu, const scalar d, const surface where)
    : h_(h),
      mu_(mu),
      d_(d)
{
    setNodes();
    transform(deltaKernel(kernel), where == OWN);
    fit();
}

Foam::nearField::nearField(const scalar h, const scalar mu, const scalar d,
                           const scalar longer)
    : h_(h),
      mu_(mu),
      d_(d)
{
    setNodes();
    for (size_t i = 0; i < K_.size(); ++i)
    {
        const double lost = 2 * (1 - filter(i, longer, false));
        trace_.push_back(weight_ * (2 * filter(i, d, false) - 2 + lost));
        along_.push_back(0);
        unresolved_.push_back(lost);
    }
    fit();
}

void Foam::nearField::setNodes()
{
    // Cut-off of K [1/h]: the rest of the integral is 1e-6 of A
    const double largest = 25;
    const int n = 250;
    weight_ = 4 / pi * largest / n;
    for (int i = 0; i < n; ++i)
    {
        K_.push_back((i + 0.5) * largest / n);
    }
}

double Foam::nearField::filter(const size_t i, const scalar d,
                               const bool own) const
{
    const double x = 0.25 * sqr(K_[i] * d / h_);
    return (1 + x + (own ? x * x * (6 - 4 * x + 8 * x * x) / 15 : 0)) *
           std::exp(-x);
}

void Foam::nearField::transform(const deltaKernel& kernel, const bool own)
{
    const int nAzimuth = 16, nPolar = 8;
    const transformOf phi(kernel, K_.back());
    for (size_t i = 0; i < K_.size(); ++i)
    {
        // Transform of G_h averaged over an octant of directions: trace, part along K
        const double K = K_[i];
        const auto ring = [&](const double z)
        {
            Eigen::Vector2d sum(0, 0);
            for (int j = 0; j < nAzimuth; ++j)
            {
                const double azimuth = 0.5 * pi * (j + 0.5) / nAzimuth;
                const double s = std::sqrt(1 - z * z);
                double kk = 0, ek = 0, filter = 1;
                for (const double e :
                     {s * std::cos(azimuth), s * std::sin(azimuth), z})
                {
                    const double kappa = 2 * std::sin(0.5 * K * e);
                    kk += kappa * kappa;
                    ek += e * kappa;
                    filter *= sqr(phi(K * e));
                }
                sum += K * K * filter / (kk * nAzimuth) *
                       Eigen::Vector2d(2, 1 - ek * ek / kk);
            }
            return sum;
        };
        const Eigen::Vector2d smoothed(integral(0, 1, nPolar, ring));
        trace_.push_back(weight_ * (2 * filter(i, d_, own) - smoothed[0]));
        along_.push_back(weight_ * -smoothed[1]);
        unresolved_.push_back(2 - smoothed[0]);
    }
}

Foam::nearField::mobility Foam::nearField::exact(const scalar q) const
{
    mobility m{0, 0};
    for (size_t i = 0; i < K_.size(); ++i)
    {
        double j0, j2; // bessel() returns j2/(K q)^2
        bessel(K_[i] * q, j0, j2);
        j2 *= sqr(K_[i]);
        const double C = 0.5 * j2 * (trace_[i] - 3 * along_[i]);
        m.C += C;
        m.A +=
            trace_[i] / 3 * (j0 + sqr(q) * j2) - sqr(q) * (along_[i] * j2 + C);
    }
    return m;
}

// Mean over directions at a wave number near 0
Foam::scalar Foam::nearField::unresolvedFlow() const
{
    const size_t nearZero = 2;
    return unresolved_[nearZero] / sqr(K_[nearZero]) / 3 * sqr(h_) / mu_;
}

// Least squares over distances up to last, beyond which the difference decays as q^-3, and
// from there to 20 times as far. Weights grow with the distance, as errors there act on more
// points
void Foam::nearField::fit()
{
    const double last = max(8.0, 6 * d_ / h_);
    const mobility atLast(exact(last));
    c_ = 10 * sqr(d_ / h_);

    // In terms of x the distances are q/last = x up to x = 1, then 1/(1 - inverse (x - 1)),
    // which is 20 at the largest x
    const int n = 300;
    const double largestX = 1.25, inverse = 3.8;
    Eigen::MatrixXd A(n, nFar + nNear), C(A);
    Eigen::VectorXd valuesA(n), valuesC(n);
    for (int i = 0; i < n; ++i)
    {
        const double x = largestX * (i + 0.5) / n;
        const double q = last * (x < 1 ? x : 1 / (1 - inverse * (x - 1)));
        const mobility m(q < last ? exact(q)
                                  : mobility{atLast.A * std::pow(last / q, 3),
                                             atLast.C * std::pow(last / q, 5)});
        const double t = 1 / (1 + q * q / c_);
        double far = std::pow(t, 1.5), near = std::pow(t, nearPower);
        for (int k = nFar - 1; k >= 0; --k, far *= t)
        {
            A(i, k) = far;
            C(i, k) = far * t;
        }
        const double v = nearScale * t - nearShift;
        for (int k = nFar + nNear - 1; k >= nFar; --k, near *= v)
        {
            A(i, k) = C(i, k) = near;
        }
        const double weightA = 1 + q, weightC = weightA * (0.3 + q * q);
        A.row(i) *= weightA;
        C.row(i) *= weightC;
        valuesA[i] = weightA * m.A;
        valuesC[i] = weightC * m.C;
    }
    const auto solve =
        [](const Eigen::MatrixXd& terms, const Eigen::VectorXd& values)
    {
        const Eigen::VectorXd x(terms.colPivHouseholderQr().solve(values));
        coefficients a;
        std::copy(x.data(), x.data() + x.size(), a.begin());
        return a;
    };
    A_ = solve(A, valuesA);
    C_ = solve(C, valuesC);
}

// The correction is an integral over wave numbers z along the normal, each of which follows
// the forces at the rate nu (k^2 + z^2). The integral is divided into n equal shares, from
// the lowest z on; the rate of a share is the inverse of its mean time
std::vector<double> Foam::nearField::rates(const scalar k, const scalar nu,
                                           const int n) const
{
    const double wave = k * h_, step = 0.1 * (K_[1] - K_[0]);
    std::vector<double> squares, added;
    double sum = 0;
    for (double z = 0.5 * step; z < K_.back(); z += step)
    {
        const double K = std::sqrt(sqr(wave) + sqr(z));
        const size_t i = min(size_t(K / K_.back() * K_.size()), K_.size() - 1);
        squares.push_back(sqr(K));
        added.push_back(max(unresolved_[i], 0.0) / sqr(K));
        sum += added.back();
    }
    std::vector<double> share(n, 0), time(n, 0);
    double before = 0;
    for (size_t i = 0; i < added.size(); ++i)
    {
        const int j = min(int((before + 0.5 * added[i]) / sum * n), n - 1);
        before += added[i];
        share[j] += added[i];
        time[j] += added[i] * sqr(h_) / (nu * squares[i]);
    }
    for (int j = 0; j < n; ++j)
    {
        time[j] = share[j] / time[j];
    }
    return time;
}
