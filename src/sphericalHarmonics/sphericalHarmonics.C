// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "sphericalHarmonics.H"

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Core>
#include <cmath>

namespace
{
using RowMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using ColMatrix = Eigen::MatrixXd;
template<class M>
using View = Eigen::Map<const M>;

//- Vector of four latitudes
using four = Eigen::Array<double, 4, 1>;

//- Largest number of latitudes of one hemisphere
const int maxHalf = 512;

//- sums (columns x h) = coefficients (n x columns) times table (n x h)
template<int columns>
void sumOfOrder(const double* table, const double* coeffs, const int n,
                const int h, double* sums)
{
    for (int i = 0; i < h; i += 4)
    {
        four s[columns];
        for (int q = 0; q < columns; ++q)
        {
            s[q].setZero();
        }
        const double* c = coeffs;
        for (int k = 0; k < n; ++k, c += columns)
        {
            const four t(View<four>(table + k * h + i));
            for (int q = 0; q < columns; ++q)
            {
                s[q] += c[q] * t;
            }
        }
        for (int q = 0; q < columns; ++q)
        {
            Eigen::Map<four>(sums + q * h + i) = s[q];
        }
    }
}

//- coefficients (n x columns) += table (n x h) times sums (columns x h)
template<int columns>
void addAdjointOfOrder(const double* table, const double* sums, const int n,
                       const int h, double* coeffs)
{
    for (int k = 0; k < n; ++k, coeffs += columns)
    {
        four s[columns];
        for (int q = 0; q < columns; ++q)
        {
            s[q].setZero();
        }
        for (int i = 0; i < h; i += 4)
        {
            const four t(View<four>(table + k * h + i));
            for (int q = 0; q < columns; ++q)
            {
                s[q] += t * View<four>(sums + q * h + i);
            }
        }
        for (int q = 0; q < columns; ++q)
        {
            coeffs[q] += s[q].sum();
        }
    }
}
} // namespace

// Coefficients to Fourier series on each latitude. fourier: one column for each cos and sin of
// m, each 3 x nTheta. A table is symmetric about the equator for even n - m, or for odd n - m
// if flip (derivatives in theta)
void Foam::sphericalHarmonics::legendreSum(const std::vector<double>& table,
                                           const bool flip,
                                           const double* coeffs,
                                           double* fourier) const
{
    double sums[2][6 * maxHalf];
    const int h = padded_;
    const double sign = flip ? -1 : 1;
    for (int m = 0; m <= degree_; ++m)
    {
        const int columns = m ? 6 : 3;
        const int nAll = degree_ - m + 1, nSymmetric = (degree_ - m) / 2 + 1;
        const double* c = coeffs + 3 * first_[m];
        const double* t = table.data() + firstP_[m];
        const auto sum = m ? sumOfOrder<6> : sumOfOrder<3>;
        sum(t, c, nSymmetric, h, sums[0]);
        sum(t + nSymmetric * h, c + nSymmetric * columns, nAll - nSymmetric, h,
            sums[1]);
        for (int q = 0; q < columns; ++q)
        {
            double* out = fourier + (row(m, q >= 3) * 3 + q % 3) * nTheta_;
            const double* even = sums[0] + q * h;
            const double* odd = sums[1] + q * h;
            for (int i = 0; i < half_; ++i)
            {
                out[i] = even[i] + odd[i];
                out[nTheta_ - 1 - i] = sign * (even[i] - odd[i]);
            }
        }
    }
}

void Foam::sphericalHarmonics::legendreSumAdjoint(
    const std::vector<double>& table, const bool flip, const double* fourier,
    double* coeffs) const
{
    double sums[2][6 * maxHalf];
    const int h = padded_;
    const double sign = flip ? -1 : 1;
    for (int m = 0; m <= degree_; ++m)
    {
        const int columns = m ? 6 : 3;
        const int nAll = degree_ - m + 1, nSymmetric = (degree_ - m) / 2 + 1;
        double* c = coeffs + 3 * first_[m];
        const double* t = table.data() + firstP_[m];
        for (int q = 0; q < columns; ++q)
        {
            const double* in = fourier + (row(m, q >= 3) * 3 + q % 3) * nTheta_;
            double* even = sums[0] + q * h;
            double* odd = sums[1] + q * h;
            for (int i = 0; i < half_; ++i)
            {
                const double south = sign * in[nTheta_ - 1 - i];
                even[i] = in[i] + south;
                odd[i] = in[i] - south;
            }
            std::fill(even + half_, even + h, 0.0);
            std::fill(odd + half_, odd + h, 0.0);
        }
        const auto add = m ? addAdjointOfOrder<6> : addAdjointOfOrder<3>;
        add(t, sums[0], nSymmetric, h, c);
        add(t + nSymmetric * h, sums[1], nAll - nSymmetric, h,
            c + nSymmetric * columns);
    }
}

// One matrix product for all longitudes; faster than an FFT at these sizes
void Foam::sphericalHarmonics::fourierSum(const std::vector<double>& trig,
                                          const double* fourier,
                                          double* values) const
{
    const int k = 2 * degree_ + 1;
    Eigen::Map<RowMatrix>(values, 3 * nTheta_, nPhi_).noalias() +=
        View<ColMatrix>(fourier, 3 * nTheta_, k) *
        View<RowMatrix>(trig.data(), k, nPhi_);
}

void Foam::sphericalHarmonics::fourierSumAdjoint(
    const std::vector<double>& trig, const double* values,
    double* fourier) const
{
    const int k = 2 * degree_ + 1;
    Eigen::Map<ColMatrix>(fourier, 3 * nTheta_, k).noalias() =
        View<RowMatrix>(values, 3 * nTheta_, nPhi_) *
        View<RowMatrix>(trig.data(), k, nPhi_).transpose();
}

void Foam::sphericalHarmonics::values(const double* coeffs, double* x) const
{
    std::fill(x, x + 3 * nPoints(), 0.0);
    legendreSum(p_, false, coeffs, fourier_.data());
    fourierSum(trig_, fourier_.data(), x);
}

void Foam::sphericalHarmonics::gradient(const double* coeffs, double* xt,
                                        double* xp) const
{
    std::fill(xt, xt + 3 * nPoints(), 0.0);
    std::fill(xp, xp + 3 * nPoints(), 0.0);
    legendreSum(dp_, true, coeffs, fourier_.data());
    fourierSum(trig_, fourier_.data(), xt);
    legendreSum(mp_, false, coeffs, fourier_.data());
    fourierSum(dtrig_, fourier_.data(), xp);
}

void Foam::sphericalHarmonics::valuesAdjoint(const double* f,
                                             double* coeffs) const
{
    std::fill(coeffs, coeffs + 3 * nCoeffs(), 0.0);
    fourierSumAdjoint(trig_, f, fourier_.data());
    legendreSumAdjoint(p_, false, fourier_.data(), coeffs);
}

void Foam::sphericalHarmonics::gradientAdjoint(const double* vt,
                                               const double* vp,
                                               double* coeffs) const
{
    std::fill(coeffs, coeffs + 3 * nCoeffs(), 0.0);
    fourierSumAdjoint(trig_, vt, fourier_.data());
    legendreSumAdjoint(dp_, true, fourier_.data(), coeffs);
    fourierSumAdjoint(dtrig_, vp, fourier_.data());
    legendreSumAdjoint(mp_, false, fourier_.data(), coeffs);
}

void Foam::sphericalHarmonics::hessian(const double* coeffs, double* xtt,
                                       double* xtp, double* xpp) const
{
    for (double* x : {xtt, xtp, xpp})
    {
        std::fill(x, x + 3 * nPoints(), 0.0);
    }
    legendreSum(tt_, false, coeffs, fourier_.data());
    fourierSum(trig_, fourier_.data(), xtt);
    legendreSum(tp_, true, coeffs, fourier_.data());
    fourierSum(dtrig_, fourier_.data(), xtp);
    legendreSum(pp_, false, coeffs, fourier_.data());
    fourierSum(trig_, fourier_.data(), xpp);
}

void Foam::sphericalHarmonics::addHessianAdjoint(const double* mtt,
                                                 const double* mtp,
                                                 const double* mpp,
                                                 double* coeffs) const
{
    fourierSumAdjoint(trig_, mtt, fourier_.data());
    legendreSumAdjoint(tt_, false, fourier_.data(), coeffs);
    fourierSumAdjoint(dtrig_, mtp, fourier_.data());
    legendreSumAdjoint(tp_, true, fourier_.data(), coeffs);
    fourierSumAdjoint(trig_, mpp, fourier_.data());
    legendreSumAdjoint(pp_, false, fourier_.data(), coeffs);
}

void Foam::sphericalHarmonics::analysis(const double* f, double* coeffs) const
{
    std::vector<double> weighted(f, f + 3 * nPoints());
    for (int c = 0, k = 0; c < 3; ++c)
    {
        for (int i = 0; i < nTheta_; ++i)
        {
            for (int j = 0; j < nPhi_; ++j, ++k)
            {
                weighted[k] *= weight_[i];
            }
        }
    }
    valuesAdjoint(weighted.data(), coeffs);
}
