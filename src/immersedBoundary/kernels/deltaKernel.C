// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "deltaKernel.H"
#include "dictionary.H"
#include <cmath>

const Foam::Enum<Foam::deltaKernel::kernelType> Foam::deltaKernel::names({
    {kernelType::Roma3, "Roma3"},
    {kernelType::Peskin4, "Peskin4"},
});

Foam::deltaKernel::deltaKernel(const dictionary& dict)
    : type_(names.getOrDefault("kernel", dict, kernelType::Roma3))
{
}

void Foam::deltaKernel::stencil(const scalar x, const scalar offset,
                                const label first, const label last,
                                const label n, const bool periodic,
                                kernelStencil& s) const
{
    // A marker that has crept up to a wall, or past it, acts on the cell there
    const scalar position = periodic ? x - offset
                                     : min(max(x - offset, first - scalar(0.5)),
                                           last + scalar(0.5));
    const label nPoints = this->nPoints();
    scalar lowestPoint, weights1[1][4];
    weights<1>(&position, &lowestPoint, weights1);
    const scalar* weight = weights1[0];
    const label lowest = label(lowestPoint);

    if (lowest >= (periodic ? 0 : first) &&
        lowest + nPoints - 1 <= (periodic ? n - 1 : last))
    {
        s.size = nPoints;
        for (label k = 0; k < nPoints; ++k)
        {
            s.at[k] = lowest + k;
            s.weight[k] = weight[k];
        }
        return;
    }

    s.size = 0;
    bool cut = false;
    label i = lowest;
    if (periodic && (i < 0 || i >= n)) i = ((i % n) + n) % n;
    for (label k = 0; k < nPoints; ++k, ++i)
    {
        if (periodic)
        {
            if (i == n) i = 0;
        }
        else if (i < first || i > last)
        {
            cut = true;
            continue;
        }
        s.at[s.size] = i;
        s.weight[s.size] = weight[k];
        ++s.size;
    }
    if (!cut) return;

    // weight (a + b r) with unit sum and zero first moment
    scalar s0 = 0, s1 = 0, s2 = 0;
    for (label k = 0; k < s.size; ++k)
    {
        const scalar r = s.at[k] - position, w = s.weight[k];
        s0 += w;
        s1 += w * r;
        s2 += w * r * r;
    }
    // Where one point has all the weight the line through it is left out
    const scalar det = s0 * s2 - s1 * s1;
    const bool line = det > 1e-9 * s0 * s2;
    const scalar a = line ? s2 / det : 1;
    const scalar b = line ? -s1 / det : 0;
    scalar sum = 0;
    for (label k = 0; k < s.size; ++k)
    {
        s.weight[k] *= a + b * (s.at[k] - position);
        sum += s.weight[k];
    }
    // The force to round-off, however ill-conditioned the line
    for (label k = 0; k < s.size; ++k)
    {
        s.weight[k] /= sum;
    }
}
