// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Expected error of the deformation D of a capsule, measured in shear with neo-Hookean
// and Skalak's law at Ca_G 0.0375 to 2 (doc/choosing.md)

#include "capsuleReport.H"
#include <cmath>

namespace
{
// Error of a series up to a degree
Foam::scalar errorOfHarmonics(const Foam::label degree)
{
    return degree < 5 ? 0.015 : 0.003 * Foam::sqr(6.0 / degree);
}

// Error of Adams-Bashforth 2. step: time step times the rate of the flow. A thicker fluid
// inside lags by more (doc/stability.md)
Foam::scalar errorOfStep(const Foam::scalar step)
{
    return 6 * Foam::sqr(step);
}

// Error of stabilised motion over that of Adams-Bashforth 2, where the area is far stiffer
// than the shear: the shape follows late. Measured at C = 500
Foam::scalar lagOfStiffArea(const Foam::scalar areaOverShear)
{
    return 11.5 * std::sqrt(areaOverShear) / 6;
}

// Error of a near field of fewer degrees than capsuleNearField::fullDegree, with bending at Re 10
const Foam::scalar errorOfFewerDegrees = 0.015;

// Least radius in cells and largest Ca_G for which these laws hold
const Foam::scalar leastRadius = 3, largestCa = 2;

// Error of a sphere due to the smoothing of the kernel: the largest, found for stiff
// capsules
Foam::scalar errorOfSmoothing(const Foam::scalar radius)
{
    return 0.115 * std::pow(4 / radius, 1.3);
}

// Error of the stress of a suspension without near field: the kernel enlarges the volume
// that the fluid feels. With near field it is 0.5 % in slow flow
Foam::scalar errorOfStress(const Foam::scalar radius)
{
    return Foam::pow3(1 + 0.53 / radius) - 1;
}

// Error with a near field in a flow with inertia, due to the smoothing of the kernel:
// first order in h. Measured for Re = rho rate a^2/mu from 3 to 30
Foam::scalar errorOfInertia(const Foam::scalar Re, const Foam::scalar radius)
{
    return 0.005 * Re * 4 / radius;
}

// Error of the distance between markers, in cells, where the shape is stretched by a
// quarter. Measured from 0.9 to 1.6
Foam::scalar errorOfMarkers(const Foam::scalar spacing)
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

Foam::label Foam::capsuleReport::enoughHarmonics(const scalar error) const
{
    label degree = group_.isMeasured() ? 5 : 12;
    while (errorOfHarmonics(degree) > error)
        ++degree;
    return degree;
}

Foam::scalar Foam::capsuleReport::enoughMarkers(const scalar error) const
{
    return min(1.6, max(0.9, std::pow(error / errorOfMarkers(1), 1.0 / 6)));
}

Foam::scalar Foam::capsuleReport::errorOfCells(const bool nearField) const
{
    const scalar radius = cellsOfRadius();
    if (!group_.scene_.forceAtFaces || !group_.isMeasured() ||
        radius < leastRadius * (1 - 1e-6) ||
        !(nearField ? group_.nearFieldKnown_
                    : group_.sphere_ && group_.viscosityRatio_ == 1))
    {
        return -1;
    }
    if (!nearField) return errorOfSmoothing(radius);
    const bool fewer = group_.nearField_ && group_.nearField_->isReduced();
    return (group_.viscosityRatio_ == 1 ? 0.003 : 0.007) +
           (fewer ? errorOfFewerDegrees : 0);
}

Foam::scalar Foam::capsuleReport::cellsOfRadius() const
{
    return group_.radius_ / cmptMax(group_.scene_.grid.h());
}

Foam::expectedError Foam::capsuleReport::cellError() const
{
    const scalar radius = cellsOfRadius();
    string by("a/h " + number(radius) +
              (group_.nBodies() > 1 ? ", each as if alone" : ""));
    std::function<string(scalar)> remedy;
    bool known = false;
    if (!group_.scene_.forceAtFaces)
        by += ", force as an average of each cell";
    else if (!group_.round_)
        by += ", not measured on such shapes";
    else if (group_.nucleated_)
        by += ", not measured with a nucleus";
    else if (group_.scene_.insideBodies)
        by += ", not measured inside a capsule";
    else if (radius < leastRadius * (1 - 1e-6))
        by += ", not measured below " + number(leastRadius);
    else if (!group_.nearField_ && group_.viscosityRatio_ != 1)
        by += ", not measured with a viscosityRatio";
    else
        known = true;
    if (group_.nearField_)
    {
        if (known)
            by += group_.nearFieldKnown_ ? " with near field"
                                         : ", near field beyond what is known";
    }
    else
    {
        by += string(group_.sphere_ ? "" : ", measured on spheres only") +
              " without near field, which makes stresses " +
              number(100 * errorOfStress(radius)) + " % too high";
        if (known)
            remedy = [this](const scalar left)
            {
                scalar cells = leastRadius;
                while (errorOfSmoothing(cells) > left)
                    cells *= 1.01;
                return "cells of " + atMost(group_.radius_ / cells) +
                       " m and smaller";
            };
    }
    return {"cells", errorOfCells(bool(group_.nearField_)), by, remedy};
}

Foam::expectedError Foam::capsuleReport::inertiaError(const scalar Re) const
{
    const scalar radius = cellsOfRadius();
    return {"inertia", group_.isMeasured() ? errorOfInertia(Re, radius) : -1,
            "Re " + number(Re) + ", of the stress twice that",
            [=](const scalar left)
            {
                return "cells of " +
                       atMost(group_.radius_ * left /
                              (radius * errorOfInertia(Re, radius))) +
                       " m and smaller";
            }};
}

Foam::expectedError Foam::capsuleReport::harmonicsError() const
{
    const label degree = group_.harmonics().degree();
    return {"harmonics", group_.isMeasured() ? errorOfHarmonics(degree) : -1,
            "N = " + Foam::name(degree),
            [=](const scalar left)
            {
                const label more = enoughHarmonics(left);
                const scalar h = 2.4 * group_.radius_ / more;
                if (more <= degree || more > 64) return string();
                return cmptMax(group_.scene_.grid.h()) > h
                           ? string("cells of " + atMost(h) + " m and smaller")
                           : string("harmonics " + Foam::name(more));
            }};
}

Foam::expectedError Foam::capsuleReport::markerError() const
{
    return {"markers", errorOfMarkers(group_.markerSpacing_),
            "up to " + number(group_.markerSpacing_) + " cells apart",
            [this](const scalar left)
            {
                const scalar enough = enoughMarkers(left);
                return enough < group_.markerSpacing_ &&
                               errorOfMarkers(enough) <= left * (1 + 1e-9)
                           ? "markerSpacing " + atMost(enough)
                           : string();
            }};
}

// Adjusted steps of deformableBodyFoam keep to the limit of explicit motion
Foam::expectedError Foam::capsuleReport::stepError(const scalar rate) const
{
    const membraneModel& law = group_.shell_->model();
    const scalar limit = group_.twoWay() && group_.scene_.forceAtFaces
                             ? group_.maxDeltaT()
                             : GREAT;
    const scalar dt =
        !group_.scene_.adjusted ? group_.scene_.deltaT
        : group_.scene_.deltaT == 0 && group_.scene_.accuracy.wanted > 0
            ? GREAT // stepFor() chooses
            : min(group_.scene_.likelyDeltaT, limit);
    const bool stiffArea = group_.motion_->hasPrevious() &&
                           law.areaModulus() > 4 * law.shearModulus();
    const bool known = rate > 0 && dt > 0 && dt < GREAT;
    const scalar lag =
        max(scalar(1), 0.25 * group_.viscosityRatio_) *
        (stiffArea ? lagOfStiffArea(law.areaModulus() / law.shearModulus())
                   : 1);
    const auto error = [rate, lag](const scalar dt)
    { return lag * errorOfStep(rate * dt); };
    const auto largest = [rate, lag](const scalar error)
    { return std::sqrt(error / (lag * errorOfStep(1))) / rate; };
    return {"step",
            known ? error(dt) : -1,
            (known
                 ? "deltaT times the rate of the flow is " + number(rate * dt)
             : rate > 0 ? string("deltaT is adjusted")
                        : string("the flow has no rate at the start")) +
                (stiffArea ? ", stabilised, and the area is stiff" : ""),
            nullptr,
            rate > 0 ? std::function<scalar(scalar)>(largest) : nullptr, error};
}

Foam::expectedErrors Foam::capsuleReport::errors() const
{
    const flowScales& flow = group_.scene_.flow;
    expectedErrors e{group_.name(), "D", {}};
    if (group_.twoWay())
    {
        e.parts.push_back(cellError());
        const scalar Re = group_.scene_.rho * flow.rate * sqr(group_.radius_) /
                          group_.scene_.mu;
        if (group_.nearField_ && errorOfInertia(Re, cellsOfRadius()) > 1e-3)
        {
            e.parts.push_back(inertiaError(Re));
        }
    }
    const scalar Ca = group_.scene_.mu * flow.rate * group_.radius_ /
                      group_.shell_->model().shearModulus();
    if (Ca > largestCa * (1 + 1e-6))
    {
        e.parts.push_back({"softness", -1,
                           "Ca_G " + number(Ca) + ", measured up to " +
                               number(largestCa),
                           nullptr});
    }
    e.parts.push_back(harmonicsError());
    e.parts.push_back(markerError());
    e.parts.push_back(stepError(flow.rate));
    return e;
}

std::vector<Foam::errorIndicator> Foam::capsuleReport::indicators() const
{
    scalar highest = 0, change = 0;
    label worst = -1;
    forAll(group_.mine(), k)
    {
        const capsule& c = group_.capsules_[k];
        const scalar share = group_.shareOfHighest(c.x);
        if (worst < 0 || share > highest) worst = k;
        highest = max(highest, share);
        change = max(change, mag(group_.shell_->measure(c.x).volume /
                                     group_.referenceVolume_ -
                                 1));
    }
    OStringStream body;
    if (worst >= 0)
    {
        body << group_.nameOfBody(group_.mine()[worst]).c_str() << " at "
             << group_.centre(worst);
    }
    return {
        {"highest harmonics", highest, capsuleGroup::mostOfHighest,
         "entry harmonics to more (on finer cells, where they are as many as "
         "the cells resolve), or, where the membrane wrinkles, bending or " +
             smallerSteps(group_.scene_),
         true, body.str()},
        {"change of volume", change, 1e-3, smallerSteps(group_.scene_)}};
}
