// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsuleNearField.H"
#include "mathematicalConstants.H"
#include <cmath>

namespace
{
Foam::label latitudes(const Foam::scalar cells)
{
    return std::ceil(Foam::constant::mathematical::pi * cells / 1.4);
}
} // namespace

Foam::capsuleNearField::capsuleNearField(const label degree,
                                         const deltaKernel::kernelType kernel,
                                         const scalar h, const scalar mu,
                                         const scalar radius,
                                         const label nTheta)
    : grid_(degree, nTheta ? nTheta : max(label(14), latitudes(radius / h))),
      sum_(kernel, h, mu,
           max(h, 1.5 * constant::mathematical::pi * radius / grid_.nTheta())),
      taper_(grid_.nCoeffs())
{
    // Near the poles every second or fourth point of a latitude is enough
    for (label i = 0, k = 0; i < grid_.nTheta(); ++i)
    {
        label step = 1;
        while (grid_.nPhi() % (2 * step) == 0 &&
               2 * step * std::sin(grid_.theta(i)) < 1.15)
        {
            step *= 2;
        }
        for (label j = 0; j < grid_.nPhi(); ++j, ++k)
        {
            if (j % step) continue;
            points_.push_back(k);
            weights_.push_back(step * grid_.weight(k));
        }
    }
    for (label n = 0; n <= degree; ++n)
    {
        for (label m = 0; m <= n; ++m)
        {
            taper_[grid_.index(n, m, false)] =
                taper_[grid_.index(n, m, m > 0)] =
                    std::exp(-std::pow(n / 8.0, 8));
        }
    }
}

void Foam::capsuleNearField::add(const double* x, const double* load,
                                 double* velocity) const
{
    const label nAll = grid_.nPoints(), n = nPoints();
    const label nCoeffs = 3 * grid_.nCoeffs();
    std::vector<double> values(3 * nAll), coeffs(nCoeffs);
    std::vector<vector> X(n), F(n), u(n);
    const auto evaluate = [&](const double* c, std::vector<vector>& v)
    {
        grid_.values(c, values.data());
        for (label k = 0; k < n; ++k)
        {
            for (direction d = 0; d < 3; ++d)
            {
                v[k][d] = values[d * nAll + points_[k]];
            }
        }
    };
    evaluate(x, X);
    for (label i = 0; i < nCoeffs; ++i)
    {
        coeffs[i] = taper_[i / 3] * load[i];
    }
    evaluate(coeffs.data(), F);
    for (label k = 0; k < n; ++k)
    {
        F[k] *= weights_[k];
    }

    sum_.velocity(X.data(), F.data(), n, u.data());

    std::fill(values.begin(), values.end(), 0);
    for (label k = 0; k < n; ++k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            values[d * nAll + points_[k]] = weights_[k] * u[k][d];
        }
    }
    grid_.valuesAdjoint(values.data(), coeffs.data());
    for (label i = 0; i < nCoeffs; ++i)
    {
        velocity[i] += taper_[i / 3] * coeffs[i];
    }
}
