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
        const surfacePoints points(degree, latitudes);
        const scalar spacing = pi * extent / points.grid().nTheta();
        return new pointSum{points,
                            nearField(kernel, h, mu, max(h, 1.35 * spacing))};
    };
    const label byCells = std::ceil(pi * extent / (1.4 * h));
    usual_.reset(make(nTheta ? nTheta : max(label(12), byCells)));
    if (!nTheta && byCells < 16) stretched_.reset(make(16));
    taper_.resize(harmonics().nCoeffs());
    setTaper(8);
}

void Foam::capsuleNearField::setTaper(const scalar degree)
{
    const sphericalHarmonics& grid = harmonics();
    for (label n = 0; n <= grid.degree(); ++n)
    {
        for (label m = 0; m <= n; ++m)
        {
            taper_[grid.index(n, m, false)] = taper_[grid.index(n, m, m > 0)] =
                std::exp(-std::pow(n / degree, 8));
        }
    }
}

const Foam::capsuleNearField::pointSum&
Foam::capsuleNearField::placePoints(const double* x,
                                    std::vector<vector>& X) const
{
    const auto place = [&](const pointSum& s) -> const pointSum&
    {
        X.resize(s.points.size());
        s.points.values(x, X.data());
        return s;
    };
    place(*usual_);
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
    return longest > sqr(1.7 * extent_) ? place(*stretched_) : *usual_;
}

void Foam::capsuleNearField::forces(const double* x, const double* load,
                                    std::vector<vector>& X,
                                    std::vector<vector>& F) const
{
    forcesAt(placePoints(x, X).points, load, F);
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

void Foam::capsuleNearField::add(const double* x, const double* load,
                                 double* velocity, const others& more) const
{
    std::vector<vector> X, F;
    const pointSum& used = placePoints(x, X);
    forcesAt(used.points, load, F);
    std::vector<vector> u(X.size());
    used.sum.velocity(X.data(), F.data(), X.size(), u.data());
    if (more) more(X, u);

    std::vector<double> coeffs(3 * harmonics().nCoeffs());
    used.points.analysis(u.data(), coeffs.data());
    for (size_t i = 0; i < coeffs.size(); ++i)
    {
        velocity[i] += taper_[i / 3] * coeffs[i];
    }
}
