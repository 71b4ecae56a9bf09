// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "layerVolumes.H"
#include "sumOverRanks.H"
#include <cmath>

namespace
{
using namespace Foam;

//- Layers across a direction
struct layers
{
    label n;
    scalar origin, h;
    bool periodic;

    label of(const scalar y) const
    {
        return label(std::floor((y - origin) / h));
    }
    label index(const label j) const
    {
        return periodic ? ((j % n) + n) % n : min(max(j, label(0)), n - 1);
    }
};

//- Mean velocity of the volume in a closed surface [m/s]: INT x u.dS/V
vector velocityOfVolume(const bodyPoints& p)
{
    const point centre(average(p.positions));
    vector flux(Zero);
    scalar volume = 0;
    forAll(p.positions, k)
    {
        const vector r(p.positions[k] - centre);
        flux += (p.velocities[k] & p.areas[k]) * r;
        volume += (r & p.areas[k]) / 3;
    }
    return flux / volume;
}

void addSurface(const bodyPoints& p, const layers& all, const direction g,
                scalarField& volume, vectorField& momentum)
{
    scalar least = GREAT, most = -GREAT;
    for (const vector& x : p.positions)
    {
        least = min(least, x[g]);
        most = max(most, x[g]);
    }
    const vector velocity(p.velocities.size() ? velocityOfVolume(p)
                                              : vector::zero);
    for (label j = all.of(least); j <= all.of(most); ++j)
    {
        const scalar from = all.origin + j * all.h;
        scalar inside = 0;
        forAll(p.positions, k)
        {
            inside += min(max(p.positions[k][g] - from, scalar(0)), all.h) *
                      p.areas[k][g];
        }
        volume[all.index(j)] += inside;
        momentum[all.index(j)] += inside * velocity;
    }
}

void addLine(const bodyPoints& p, const layers& all, const direction g,
             scalarField& volume, vectorField& momentum)
{
    for (label k = 0; k + 1 < p.positions.size(); ++k)
    {
        const vector a(p.positions[k]), b(p.positions[k + 1]);
        const scalar v = p.crossSection * mag(b - a);
        const label j = all.index(all.of(0.5 * (a[g] + b[g])));
        volume[j] += v;
        momentum[j] += 0.5 * v * (p.velocities[k] + p.velocities[k + 1]);
    }
}
} // namespace

void Foam::layerVolumes(const bodyGroup& group, const uniformGrid& grid,
                        const direction g, scalarField& volume,
                        vectorField& momentum)
{
    const layers all{grid.n()[g], grid.origin()[g], grid.h()[g],
                     grid.periodic(g)};
    volume = scalarField(all.n, Zero);
    momentum = vectorField(all.n, Zero);
    forAll(group.mine(), i)
    {
        const bodyPoints p(group.points(i));
        if (p.isSurface())
            addSurface(p, all, g, volume, momentum);
        else
            addLine(p, all, g, volume, momentum);
    }
    sumOverRanks(volume);
    sumOverRanks(momentum);
}
