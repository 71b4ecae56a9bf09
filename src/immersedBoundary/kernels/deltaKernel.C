// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "deltaKernel.H"
#include "dictionaryChecks.H"
#include "quietEigen.H"
#include <cmath>

const Foam::Enum<Foam::deltaKernel::kernelType> Foam::deltaKernel::names({
    {kernelType::Roma3, "Roma3"},
    {kernelType::Peskin4, "Peskin4"},
});

namespace
{
using namespace Foam;

// Multiply the weights by a + b r, so that the sum is 1 and the first moment 0
void correctMoments(const scalar position, kernelStencil& s)
{
    scalar s0 = 0, s1 = 0, s2 = 0;
    for (label k = 0; k < s.size; ++k)
    {
        const scalar r = s.index[k] - position, w = s.weight[k];
        s0 += w;
        s1 += w * r;
        s2 += w * r * r;
    }
    // If one point has all the weight, b is not defined and is set to 0
    const scalar det = s0 * s2 - s1 * s1;
    const bool line = det > 1e-9 * s0 * s2;
    const scalar a = line ? s2 / det : 1;
    const scalar b = line ? -s1 / det : 0;
    scalar sum = 0;
    for (label k = 0; k < s.size; ++k)
    {
        s.weight[k] *= a + b * (s.index[k] - position);
        sum += s.weight[k];
    }
    // Normalise: the sum, and so the force, is exact to round-off even if det is small
    for (label k = 0; k < s.size; ++k)
    {
        s.weight[k] /= sum;
    }
}
} // namespace

Foam::deltaKernel::deltaKernel(const dictionary& dict)
    : type_(readEnum(names, dict, "kernel", kernelType::Roma3))
{
}

// One square root per marker: the other weights follow from it, the unit sum and the zero
// first moment
void Foam::deltaKernel::weights(const label n, const scalar* position,
                                scalar* lowest, scalar* const weight[4]) const
{
    using values = Eigen::Map<Eigen::ArrayXd>;
    const Eigen::Map<const Eigen::ArrayXd> x(position, n);
    values first(lowest, n), w0(weight[0], n), w1(weight[1], n),
        w2(weight[2], n), w3(weight[3], n);
    if (type_ == Roma3)
    {
        first = (x + 0.5).floor() - 1;
        w3 = x - first - 1; // distance from the middle point
        w1 = (1 + (1 - 3 * w3.square()).sqrt()) * (1.0 / 3);
        w0 = 0.5 * (1 - w1 - w3);
        w2 = 0.5 * (1 - w1 + w3);
        w3 = 0;
        return;
    }
    first = x.floor() - 1;
    w3 = x - first - 1; // distance from the second point
    w2 = 0.125 * (1 + 4 * w3 * (1 - w3)).sqrt();
    w1 = 0.125 * (3 - 2 * w3) + w2;
    w0 = 0.125 * (3 - 2 * w3) - w2;
    w3 = 0.125 * (1 + 2 * w3) - w2;
    w2 = w3 + 2 * w2;
}

Foam::kernelStencil Foam::deltaKernel::stencil(const scalar x,
                                               const scalar offset,
                                               const label first,
                                               const label last) const
{
    // A marker at or beyond a wall acts on the cell at the wall
    const scalar position =
        min(max(x - offset, first - scalar(0.5)), last + scalar(0.5));
    scalar lowestPoint, weight[4];
    scalar* const pointers[4] = {weight, weight + 1, weight + 2, weight + 3};
    weights(1, &position, &lowestPoint, pointers);

    kernelStencil s;
    const label lowest = label(lowestPoint), nPoints = this->nPoints();
    for (label k = 0; k < nPoints; ++k)
    {
        const label i = lowest + k;
        if (i < first || i > last) continue;
        s.index[s.size] = i;
        s.weight[s.size] = weight[k];
        ++s.size;
    }
    if (s.size < nPoints) correctMoments(position, s);
    return s;
}
