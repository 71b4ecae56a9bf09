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
    : points_(degree, nTheta ? nTheta : max(label(14), latitudes(radius / h))),
      sum_(kernel, h, mu,
           max(h, 1.5 * constant::mathematical::pi * radius / grid().nTheta())),
      taper_(grid().nCoeffs())
{
    setTaper(8);
}

void Foam::capsuleNearField::setTaper(const scalar degree)
{
    for (label n = 0; n <= grid().degree(); ++n)
    {
        for (label m = 0; m <= n; ++m)
        {
            taper_[grid().index(n, m, false)] =
                taper_[grid().index(n, m, m > 0)] =
                    std::exp(-std::pow(n / degree, 8));
        }
    }
}

void Foam::capsuleNearField::add(const double* x, const double* load,
                                 double* velocity) const
{
    const label n = nPoints(), nCoeffs = 3 * grid().nCoeffs();
    std::vector<double> coeffs(nCoeffs);
    std::vector<vector> X(n), F(n), u(n);
    points_.values(x, X.data());
    for (label i = 0; i < nCoeffs; ++i)
    {
        coeffs[i] = taper_[i / 3] * load[i];
    }
    points_.values(coeffs.data(), F.data());
    for (label k = 0; k < n; ++k)
    {
        F[k] *= points_.weight(k);
    }

    sum_.velocity(X.data(), F.data(), n, u.data());

    points_.analysis(u.data(), coeffs.data());
    for (label i = 0; i < nCoeffs; ++i)
    {
        velocity[i] += taper_[i / 3] * coeffs[i];
    }
}
