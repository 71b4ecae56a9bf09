// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Shape, size and positions of capsules at the start

#include "capsuleGroup.H"
#include "dictionaryChecks.H"
#include "gridValues.H"
#include "initialShape.H"
#include "rangeCheck.H"
#include "turnTo.H"
#include <cmath>

namespace
{
//- Enclosed by a surface [m^3], whichever way it turns
Foam::scalar volumeOf(const Foam::sphericalHarmonics& grid,
                      const std::vector<double>& coeffs)
{
    using namespace Foam;
    const label n = grid.nPoints();
    std::vector<double> x(3 * n), t(3 * n), p(3 * n);
    grid.values(coeffs.data(), x.data());
    grid.gradient(coeffs.data(), t.data(), p.data());
    scalar volume = 0;
    for (label k = 0; k < n; ++k)
    {
        volume += grid.weight(k) / 3 *
                  (vectorAt(x, k) & (vectorAt(t, k) ^ vectorAt(p, k)));
    }
    return mag(volume);
}
} // namespace

// The ellipsoid around the shape: that of the shape's extents about its own axis,
// grown in proportion until all points are in it. Shape and volume are those of a
// series of fixed degree: random places do not depend on harmonics and markers
void Foam::capsuleGroup::readStart(const dictionary& dict)
{
    const vector axis(
        dict.subDict("shape").getOrDefault<vector>("axis", vector(0, 0, 1)));
    axis_ = axis / mag(axis);
    const sphericalHarmonics grid(32, 66);
    const coefficients shape(initialShape(dict.subDict("shape"), grid));
    const label n = grid.nPoints();
    coefficients x(3 * n);
    grid.values(shape.data(), x.data());
    vectorField X(n);
    forAll(X, k)
    {
        X[k] = turnTo(axis_).T() & vectorAt(x, k);
    }
    vector semiAxes(Zero);
    for (const vector& x : X)
    {
        semiAxes = max(semiAxes, cmptMag(x));
    }
    scalar furthest = 0;
    for (const vector& x : X)
    {
        furthest = max(furthest, mag(cmptDivide(x, semiAxes)));
    }
    semiAxes *= furthest;
    if (cmptMax(semiAxes) < 1.02 * cmptMin(semiAxes))
    {
        semiAxes = cmptMax(semiAxes) * vector::one;
    }
    start_ =
        groupEntries(name(), dict, scene_)
            .start({semiAxes, 0}, volumeOf(grid, shape), 0, axis_, twoWay());
}

// The kernel filters waves below some 2.6 cells, 2 pi a/N = 2.6 h
Foam::label Foam::capsuleGroup::degreeOfMesh(const dictionary& shape) const
{
    const sphericalHarmonics grid(12, 26);
    const scalar volume = volumeOf(grid, initialShape(shape, grid));
    const scalar a = std::cbrt(0.75 / constant::mathematical::pi * volume);
    const scalar byCells = 2.4 * a / cmptMax(scene_.grid.h()) * (1 + 1e-6);
    return max(label(round_ ? 6 : 12), label(min(scalar(64), byCells + 0.5)));
}

void Foam::capsuleGroup::checkSize(const dictionary& dict) const
{
    const label n = markers_->size();
    vectorField X(n);
    markers_->values(initial_.data(), X.data());
    const vector h(scene_.grid.h()), L(scene_.grid.length());
    scalar toImage = GREAT;
    const label nTurned = start_.directions.empty() ? 1 : nBodies();
    for (label body = 0; body < nTurned; ++body)
    {
        const vector span(boundBox(turnOf(body) & X, false).span());
        for (direction d = 0; d < 3; ++d)
        {
            if (scene_.grid.periodic(d))
            {
                toImage = min(toImage, (L[d] - span[d]) / h[d]);
            }
        }
    }
    List<rangeCheck> ratios({
        {"shape", "radius/h", radius_ / cmptMax(h), 1, GREAT, 2, GREAT,
         "the kernel spreads the membrane over three cells"},
    });
    if (scene_.flow.rate > 0)
    {
        ratios.append({"membrane", "mu rate a/Gs",
                       scene_.mu * scene_.flow.rate * radius_ /
                           shell_->model().shearModulus(),
                       0, GREAT, 0, 10,
                       "look whether the units of Gs, of the fluid and of the "
                       "mesh fit together"});
    }
    if (twoWay())
    {
        ratios.append({"viscosityRatio", "viscosityRatio", viscosityRatio_, 0,
                       GREAT, 0.1, 10,
                       "it has been validated from 0.2 to 5; beyond, the mesh "
                       "smooths the step of the viscosity"});
        ratios.append({"positions", "volume fraction",
                       nBodies() * referenceVolume_ / cmptProduct(L), 0, 1, 0,
                       0.7,
                       "the capsules do not fit into the box side by side"});
        // Larger than the box: an error of its own
        if (toImage > 0)
        {
            ratios.append({"shape", "distance to its own image/h", toImage, 0,
                           GREAT, 3, GREAT,
                           "a capsule in a periodic box acts on itself"});
        }
    }
    checkRanges(dict, ratios);
}

void Foam::capsuleGroup::declareEffects(const dictionary& dict) const
{
    scene_.effects.declare("membrane", true,
                           dict.subDict("membrane").get<word>("law") +
                               ", N = " + Foam::name(harmonics().degree()) +
                               ", " + Foam::name(nBodies()) + " capsules, " +
                               Foam::name(markers_->size()) + " markers each");
    const scalar modulus = shell_->bendingModulus();
    scene_.effects.declare("bending", modulus > 0,
                           modulus > 0 ? "modulus " + Foam::name(modulus)
                                       : string("no bending modulus given"));
}
