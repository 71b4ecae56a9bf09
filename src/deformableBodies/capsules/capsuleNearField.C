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

void Foam::capsuleNearField::add(const double* x, const double* load,
                                 double* velocity) const
{
    const label nCoeffs = 3 * harmonics().nCoeffs();
    const pointSum* used = usual_.get();
    std::vector<vector> X(used->points.size());
    used->points.values(x, X.data());
    if (stretched_)
    {
        vector mean(Zero);
        for (size_t k = 0; k < X.size(); ++k)
        {
            mean += used->points.weight(k) / (4 * pi) * X[k];
        }
        scalar longest = 0;
        for (const vector& p : X)
        {
            longest = max(longest, magSqr(p - mean));
        }

        if (longest > sqr(1.7 * extent_))
        {
            used = stretched_.get();
            X.resize(used->points.size());
            used->points.values(x, X.data());
        }
    }
    const surfacePoints& points = used->points;
    const label n = points.size();

    std::vector<double> coeffs(nCoeffs);
    std::vector<vector> F(n), u(n);
    for (label i = 0; i < nCoeffs; ++i)
    {
        coeffs[i] = taper_[i / 3] * load[i];
    }
    points.values(coeffs.data(), F.data());
    for (label k = 0; k < n; ++k)
    {
        F[k] *= points.weight(k);
    }

    used->sum.velocity(X.data(), F.data(), n, u.data());

    points.analysis(u.data(), coeffs.data());
    for (label i = 0; i < nCoeffs; ++i)
    {
        velocity[i] += taper_[i / 3] * coeffs[i];
    }
}
