// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Nodes, order of the coefficients and tables of a grid

#include "sphericalHarmonics.H"

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Core>
#include <cmath>

namespace
{
using RowMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

const double pi = 3.14159265358979323846;

//- Gauss-Legendre nodes (as angles, increasing) and weights by Newton
void gaussLegendre(const int n, std::vector<double>& theta,
                   std::vector<double>& weight)
{
    theta.resize(n);
    weight.resize(n);
    for (int i = 0; i < (n + 1) / 2; ++i)
    {
        // Newton's method for the angle keeps all digits near the poles
        double t = pi * (i + 0.75) / (n + 0.5), dp = 0;
        for (int pass = 0; pass < 20; ++pass)
        {
            double p0 = 1, p1 = std::cos(t);
            for (int k = 2; k <= n; ++k)
            {
                const double p2 =
                    ((2 * k - 1) * std::cos(t) * p1 - (k - 1) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            // dP/dtheta
            dp = n * (std::cos(t) * p1 - p0) / std::sin(t);
            const double step = p1 / dp;
            t -= step;
            if (std::abs(step) < 1e-16) break;
        }
        theta[i] = t;
        theta[n - 1 - i] = pi - t;
        weight[i] = weight[n - 1 - i] = 2 / (dp * dp);
    }
}

//- P_nm of one latitude, normalised over cos(theta); c, s: cosine and sine of theta
void legendre(const int N, const double c, const double s, RowMatrix& P)
{
    P(0, 0) = std::sqrt(0.5);
    for (int m = 1; m <= N; ++m)
    {
        P(m, m) = std::sqrt((2 * m + 1.0) / (2 * m)) * s * P(m - 1, m - 1);
    }
    for (int m = 0; m <= N; ++m)
    {
        for (int n = m + 1; n <= N; ++n)
        {
            const double nn = double(n) * n, mm = double(m) * m;
            const double k = (n - 1.0) * (n - 1.0);
            P(n, m) =
                std::sqrt((4 * nn - 1) / (nn - mm)) *
                (c * P(n - 1, m) -
                 (n - 2 < m ? 0
                            : std::sqrt((k - mm) / (4 * k - 1)) * P(n - 2, m)));
        }
    }
}
} // namespace

Foam::sphericalHarmonics::sphericalHarmonics(const int degree, int nTheta)
    : degree_(degree),
      nTheta_(nTheta + nTheta % 2),
      nPhi_(2 * nTheta_),
      half_(nTheta_ / 2),
      padded_((half_ + 3) / 4 * 4)
{
    gaussLegendre(nTheta_, theta_, weight_);
    for (double& w : weight_)
    {
        w *= 2 * pi / nPhi_;
    }
    orderCoefficients();
    makeLatitudeTables();
    makeLongitudeTables();
    fourier_.resize(3 * nTheta_ * (2 * degree_ + 1));
}

// For each m first degrees that are symmetric about the equator (n - m even), then
// antisymmetric ones
void Foam::sphericalHarmonics::orderCoefficients()
{
    int next = 0, nextP = 0;
    for (int m = 0; m <= degree_; ++m)
    {
        first_.push_back(next);
        firstP_.push_back(nextP);
        next += (degree_ - m + 1) * (m ? 2 : 1);
        nextP += (degree_ - m + 1) * padded_;
    }
    for (std::vector<double>* table : {&p_, &dp_, &mp_, &tt_, &tp_, &pp_})
    {
        table->resize(nextP);
    }
    degrees_.resize(nCoeffs());
    for (int n = 0; n <= degree_; ++n)
    {
        for (int m = 0; m <= n; ++m)
        {
            degrees_[index(n, m, false)] = n;
            if (m) degrees_[index(n, m, true)] = n;
        }
    }
}

void Foam::sphericalHarmonics::makeLatitudeTables()
{
    const int N = degree_;
    RowMatrix P = RowMatrix::Zero(N + 2, N + 2); // (n, m)
    for (int i = 0; i < half_; ++i)
    {
        const double c = std::cos(theta_[i]), s = std::sin(theta_[i]);
        legendre(N, c, s, P);
        for (int m = 0; m <= N; ++m)
        {
            int k = 0;
            for (const int parity : {0, 1})
            {
                for (int n = m + parity; n <= N; n += 2, ++k)
                {
                    // dP/dtheta from orders m - 1 and m + 1, without cancellation
                    const double up =
                        std::sqrt((n - m) * (n + m + 1.0)) * P(n, m + 1);
                    const double down =
                        m ? std::sqrt((n + m) * (n - m + 1.0)) * P(n, m - 1)
                          : -up;
                    const int e = firstP_[m] + k * padded_ + i;
                    p_[e] = P(n, m);
                    dp_[e] = 0.5 * (down - up);
                    mp_[e] = m * P(n, m) / s;
                    tp_[e] = m / s * (dp_[e] - c / s * p_[e]);
                    pp_[e] = (c * dp_[e] - m * mp_[e]) / s;
                    tt_[e] = -double(n) * (n + 1) * p_[e] - pp_[e];
                }
            }
        }
    }
}

void Foam::sphericalHarmonics::makeLongitudeTables()
{
    const int N = degree_;
    trig_.resize((2 * N + 1) * nPhi_);
    dtrig_.resize((2 * N + 1) * nPhi_);
    for (int j = 0; j < nPhi_; ++j)
    {
        for (int m = 0; m <= N; ++m)
        {
            const double norm = 1 / std::sqrt(m ? pi : 2 * pi);
            const double c = norm * std::cos(m * phi(j));
            const double s = norm * std::sin(m * phi(j));
            trig_[row(m, false) * nPhi_ + j] = c;
            dtrig_[row(m, false) * nPhi_ + j] = -s;
            if (m)
            {
                trig_[row(m, true) * nPhi_ + j] = s;
                dtrig_[row(m, true) * nPhi_ + j] = c;
            }
        }
    }
}

double Foam::sphericalHarmonics::phi(const int j) const
{
    return 2 * pi * j / nPhi_;
}

int Foam::sphericalHarmonics::index(const int n, const int m,
                                    const bool sine) const
{
    const int nSymmetric = (degree_ - m) / 2 + 1;
    const int k = (n - m) % 2 ? nSymmetric + (n - m) / 2 : (n - m) / 2;
    return first_[m] + (m ? 2 * k + sine : k);
}
