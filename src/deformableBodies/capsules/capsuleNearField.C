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
    const label n = grid_.nPoints(), nCoeffs = 3 * grid_.nCoeffs();
    std::vector<double> values(3 * n), coeffs(nCoeffs);
    std::vector<vector> X(n), F(n), u(n);
    const auto evaluate = [&](const double* c, std::vector<vector>& v)
    {
        grid_.values(c, values.data());
        for (label k = 0; k < n; ++k)
        {
            v[k] = vector(values[k], values[n + k], values[2 * n + k]);
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
        F[k] *= grid_.weight(k);
    }

    sum_.velocity(X.data(), F.data(), n, u.data());

    for (label k = 0; k < n; ++k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            values[d * n + k] = u[k][d];
        }
    }
    grid_.analysis(values.data(), coeffs.data());
    for (label i = 0; i < nCoeffs; ++i)
    {
        velocity[i] += taper_[i / 3] * coeffs[i];
    }
}
