// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsuleNearField.H"
#include "mathematicalConstants.H"
#include <cmath>

using Foam::constant::mathematical::pi;

Foam::capsuleNearField::capsuleNearField(const label degree,
                                         const deltaKernel::kernelType kernel,
                                         const scalar h, const scalar mu,
                                         const scalar extent,
                                         const label nTheta)
    : extent_(extent)
{
    const auto make = [&](const label latitudes)
    {
        const surfacePoints points(degree, latitudes,
                                   min(degree, label(fullDegree) + 1));
        const scalar spacing = pi * extent / points.grid().nTheta();
        return new pointSum{points,
                            nearField(kernel, h, mu, max(h, 1.35 * spacing))};
    };
    const label byCells = std::ceil(pi * extent / (1.4 * h));
    usual_.reset(make(nTheta ? nTheta : max(label(12), byCells)));
    if (!nTheta && byCells < 16) stretched_.reset(make(16));
    taper_.resize(harmonics().nCoeffs());
    setTaper(fullDegree);
}

void Foam::capsuleNearField::setInertia(const scalar nu, const scalar radius)
{
    for (label n = 0; n <= harmonics().degree(); ++n)
    {
        rates_.push_back(
            usual_->sum.rates(max(n, label(1)) / radius, nu, nRates));
    }
}

void Foam::capsuleNearField::setTaper(const scalar degree)
{
    reduced_ = degree < fullDegree;
    for (size_t i = 0; i < taper_.size(); ++i)
    {
        taper_[i] = std::exp(-std::pow(harmonics().degreeOf(i) / degree, 8));
    }
}

std::vector<Foam::vector>
Foam::capsuleNearField::directions(const label n) const
{
    const surfacePoints& points =
        n == nPoints() ? usual_->points : stretched_->points;
    std::vector<vector> e;
    for (label k = 0; k < points.size(); ++k)
    {
        e.push_back(points.onUnitSphere(k));
    }
    return e;
}

const Foam::capsuleNearField::pointSum&
Foam::capsuleNearField::setPoints(const double* x, std::vector<vector>& X) const
{
    const auto setSources = [&](const pointSum& s) -> const pointSum&
    {
        X.resize(s.points.size());
        s.points.values(x, X.data());
        return s;
    };
    setSources(*usual_);
    if (!stretched_) return *usual_;
    vector mean(Zero);
    for (size_t k = 0; k < X.size(); ++k)
    {
        mean += usual_->points.weight(k) / (4 * pi) * X[k];
    }
    scalar longest = 0;
    for (const vector& p : X)
    {
        longest = max(longest, magSqr(p - mean));
    }
    return longest > sqr(1.7 * extent_) ? setSources(*stretched_) : *usual_;
}

void Foam::capsuleNearField::forces(const double* x, const double* load,
                                    std::vector<vector>& X,
                                    std::vector<vector>& F) const
{
    forcesAt(setPoints(x, X).points, load, F);
}

void Foam::capsuleNearField::forcesAt(const surfacePoints& points,
                                      const double* load,
                                      std::vector<vector>& F) const
{
    std::vector<double> coeffs(3 * harmonics().nCoeffs());
    for (size_t i = 0; i < coeffs.size(); ++i)
    {
        coeffs[i] = taper_[i / 3] * load[i];
    }
    F.resize(points.size());
    points.values(coeffs.data(), F.data());
    for (label k = 0; k < points.size(); ++k)
    {
        F[k] *= points.weight(k);
    }
}

std::vector<double> Foam::capsuleNearField::inSlowFlow(const double* x,
                                                       const double* load,
                                                       const others& more) const
{
    std::vector<vector> X, F;
    const pointSum& used = setPoints(x, X);
    forcesAt(used.points, load, F);
    std::vector<vector> u(X.size());
    used.sum.velocity(X.data(), F.data(), X.size(), u.data());
    if (more) more(u);

    std::vector<double> coeffs(3 * harmonics().nCoeffs());
    used.points.analysis(u.data(), coeffs.data());
    return coeffs;
}

void Foam::capsuleNearField::addTapered(const std::vector<double>& coeffs,
                                        double* velocity) const
{
    for (size_t i = 0; i < coeffs.size(); ++i)
    {
        velocity[i] += taper_[i / 3] * coeffs[i];
    }
}

void Foam::capsuleNearField::add(const double* x, const double* load,
                                 double* velocity, const others& more) const
{
    addTapered(inSlowFlow(x, load, more), velocity);
}

// The equation of w_j is integrated exactly, with M F linear in time within the step
void Foam::capsuleNearField::add(const double* x, const double* load,
                                 double* velocity, std::vector<double>& memory,
                                 const scalar dt, const others& more) const
{
    const std::vector<double> slow(inSlowFlow(x, load, more));
    const size_t n = slow.size();
    while (memory.size() < memorySize * n)
    {
        memory.insert(memory.end(), slow.begin(), slow.end());
    }
    std::vector<double> keep(rates_.size()), mean(rates_.size()), sum(n, 0);
    for (int j = 0; j < nRates; ++j)
    {
        for (size_t k = 0; k < rates_.size(); ++k)
        {
            const double step = dt * rates_[k][j];
            keep[k] = std::exp(-step);
            mean[k] = -std::expm1(-step) / step;
        }
        double* w = memory.data() + (1 + j) * n;
        for (size_t i = 0; i < n; ++i)
        {
            const int k = harmonics().degreeOf(i / 3);
            w[i] = keep[k] * w[i] + (mean[k] - keep[k]) * memory[i] +
                   (1 - mean[k]) * slow[i];
            sum[i] += w[i] / nRates;
        }
    }
    std::copy(slow.begin(), slow.end(), memory.begin());
    addTapered(sum, velocity);
}
