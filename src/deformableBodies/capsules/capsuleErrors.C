// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The error of D that is to be expected of a capsule, measured in shear with
// neo-Hookean and Skalak's law at Ca_G 0.0375 to 2 (doc/accuracy-and-cost.md)

#include "capsuleGroup.H"
#include <cmath>

namespace
{
Foam::scalar ofHarmonics(const Foam::label degree)
{
    return degree < 5 ? 0.015 : 0.003 * Foam::sqr(6.0 / degree);
}

// Of Adams-Bashforth 2; rate times step
Foam::scalar ofStep(const Foam::scalar step)
{
    return 6 * Foam::sqr(step);
}

// From here on the laws hold
const Foam::scalar leastRadius = 3;

// Of a sphere, by the smoothing of the kernel; the largest, of stiff capsules
Foam::scalar ofCells(const Foam::scalar radius)
{
    return 0.115 * std::pow(4 / radius, 1.3);
}

// Error of the stress of a suspension without near field: the kernel enlarges the volume
// that the fluid feels. With near field it is 0.5 % in slow flow
Foam::scalar ofStress(const Foam::scalar radius)
{
    return Foam::pow3(1 + 0.53 / radius) - 1;
}

// With near field: what the kernel smooths of a flow with inertia, of first order in
// h; Re = rho rate a^2/mu from 3 to 30
Foam::scalar ofInertia(const Foam::scalar Re, const Foam::scalar radius)
{
    return 0.005 * Re * 4 / radius;
}

// Of markers that are so many cells apart where the shape is stretched by a quarter;
// measured from 0.9 to 1.6
Foam::scalar ofMarkers(const Foam::scalar spacing)
{
    return 3e-4 * std::pow(Foam::max(spacing, Foam::scalar(0.9)), 6);
}

Foam::string number(const Foam::scalar x)
{
    Foam::OStringStream os;
    os.precision(2);
    os << x;
    return os.str();
}
} // namespace

Foam::label Foam::capsuleGroup::enoughHarmonics(const scalar error) const
{
    label degree = isMeasured() ? 5 : 12;
    while (ofHarmonics(degree) > error)
        ++degree;
    return degree;
}

Foam::scalar Foam::capsuleGroup::enoughMarkers(const scalar error) const
{
    return min(1.6, max(0.9, std::pow(error / ofMarkers(1), 1.0 / 6)));
}

Foam::scalar Foam::capsuleGroup::errorOfCells(const bool nearField) const
{
    const scalar radius = radius_ / cmptMax(scene_.grid.h());
    if (!scene_.forceAtFaces || !isMeasured() ||
        radius < leastRadius * (1 - 1e-6) ||
        !(nearField ? nearFieldKnown_ : sphere_ && viscosityRatio_ == 1))
    {
        return -1;
    }
    return nearField ? (viscosityRatio_ == 1 ? 0.003 : 0.007) + nearFieldError_
                     : ofCells(radius);
}

Foam::expectedErrors Foam::capsuleGroup::errors(const flowScales& flow) const
{
    expectedErrors e{name(), "D", {}};
    const scalar radius = radius_ / cmptMax(scene_.grid.h());
    if (twoWay())
    {
        string by("a/h " + number(radius) +
                  (nBodies() > 1 ? ", each as if alone" : ""));
        std::function<string(scalar)> remedy;
        if (!scene_.forceAtFaces)
            by += ", force as an average of each cell";
        else if (!round_)
            by += ", not measured on such shapes";
        else if (nucleated_)
            by += ", not measured with a nucleus";
        else if (scene_.insideBodies)
            by += ", not measured inside a capsule";
        else if (radius < leastRadius * (1 - 1e-6))
            by += ", not measured below " + number(leastRadius);
        else if (nearField_)
        {
            by += nearFieldKnown_ ? " with near field"
                                  : ", near field beyond what is known";
        }
        else
        {
            by += string(sphere_ ? "" : ", measured on spheres only") +
                  " without near field, which makes stresses " +
                  number(100 * ofStress(radius)) + " % too high";
            remedy = [this](const scalar left)
            {
                scalar cells = leastRadius;
                while (ofCells(cells) > left)
                    cells *= 1.01;
                return "cells of " + atMost(radius_ / cells) + " m and smaller";
            };
        }
        e.parts.push_back(
            {"cells", errorOfCells(bool(nearField_)), by, remedy});

        const scalar Re = scene_.rho * flow.rate * sqr(radius_) / scene_.mu;
        if (nearField_ && ofInertia(Re, radius) > 1e-3)
        {
            e.parts.push_back(
                {"inertia", isMeasured() ? ofInertia(Re, radius) : -1,
                 "Re " + number(Re) + ", of the stress twice that",
                 [=](const scalar left)
                 {
                     return "cells of " +
                            atMost(radius_ * left /
                                   (radius * ofInertia(Re, radius))) +
                            " m and smaller";
                 }});
        }
    }
    const label degree = harmonics().degree();
    e.parts.push_back({"harmonics", isMeasured() ? ofHarmonics(degree) : -1,
                       "N = " + Foam::name(degree),
                       [=](const scalar left)
                       {
                           const label more = enoughHarmonics(left);
                           return more > degree && more <= 64
                                      ? "harmonics " + Foam::name(more)
                                      : string();
                       }});
    e.parts.push_back({"markers", ofMarkers(markerSpacing_),
                       "up to " + number(markerSpacing_) + " cells apart",
                       [this](const scalar left)
                       {
                           const scalar enough = enoughMarkers(left);
                           return enough < markerSpacing_ &&
                                          ofMarkers(enough) <= left * (1 + 1e-9)
                                      ? "markerSpacing " + atMost(enough)
                                      : string();
                       }});

    // Adjusted steps of deformableBodyFoam keep to the limit of explicit motion
    const membraneModel& law = membrane_->model();
    const scalar rate = flow.rate;
    const scalar limit = twoWay() && scene_.forceAtFaces ? maxDeltaT_ : GREAT;
    const scalar dt = !scene_.adjusted             ? scene_.deltaT
                      : scene_.deltaT > 0          ? min(scene_.deltaT, limit)
                      : scene_.accuracy.wanted > 0 ? GREAT // stepFor() chooses
                                                   : limit;
    const bool stiffArea =
        stabilised_ && law.areaModulus() > 4 * law.shearModulus();
    const bool known = rate > 0 && dt > 0 && dt < GREAT && !stiffArea;
    const auto largest = [rate](const scalar error)
    { return std::sqrt(error / ofStep(1)) / rate; };
    e.parts.push_back(
        {"step", known ? ofStep(rate * dt) : -1,
         stiffArea
             ? string("stabilised, not measured where the area is so stiff")
         : known ? "deltaT times the rate of the flow is " + number(rate * dt)
         : rate > 0 ? string("deltaT is adjusted")
                    : string("the flow has no rate at the start"),
         nullptr,
         rate > 0 && !stiffArea ? std::function<scalar(scalar)>(largest)
                                : nullptr,
         [rate](const scalar dt) { return ofStep(rate * dt); }});
    return e;
}

// Of the amplitude of all degrees, that of the two highest
std::vector<Foam::errorIndicator> Foam::capsuleGroup::indicators() const
{
    const sphericalHarmonics& grid = harmonics();
    scalar highest = 0, change = 0;
    for (const capsule& c : capsules_)
    {
        scalar all = 0, last = 0;
        for (label n = 1; n <= grid.degree(); ++n)
        {
            scalar square = 0;
            for (label m = 0; m <= n; ++m)
            {
                for (int sine = 0; sine <= (m ? 1 : 0); ++sine)
                {
                    const double* x = &c.x[3 * grid.index(n, m, sine)];
                    square += x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
                }
            }
            all += square;
            if (n >= grid.degree() - 1) last += square;
        }
        highest = max(highest, std::sqrt(last / all));
        change = max(change, mag(measure(c.x).volume / referenceVolume_ - 1));
    }
    return {
        {"highest harmonics", highest, 0.03,
         "entry harmonics to more (on finer cells, where they are as many as "
         "the cells move), or " +
             smallerSteps() + " if the membrane wrinkles"},
        {"change of volume", change, 1e-3, smallerSteps()}};
}
