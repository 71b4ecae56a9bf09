// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "rigidReport.H"
#include "mathematicalConstants.H"
#include <cmath>

Foam::string Foam::rigidReport::describe() const
{
    const flowScales& flow = group_.scene_.flow;
    const scalar a = group_.shape_.radius();
    OStringStream os;
    os.precision(4);
    os << group_.nBodies() << " of radius a " << a << ", a/h " << a / group_.h_
       << ", density ratio " << group_.densityRatio_ << ", volume fraction "
       << group_.nBodies() * group_.shape_.volume() /
              cmptProduct(group_.scene_.grid.length());
    const scalar g = mag(group_.scene_.g),
                 excess = group_.densityRatio_ - group_.scene_.densityAround;
    if (group_.heavy_ && excess != 0)
    {
        os << ", Galileo number "
           << std::sqrt(mag(excess) * g * pow3(2 * a)) * group_.scene_.rho /
                  group_.scene_.mu;
    }
    if (flow.rate > 0)
    {
        os << ", Re "
           << group_.scene_.rho * flow.rate * sqr(a) / group_.scene_.mu;
    }
    else if (flow.speed > 0)
    {
        os << ", Re " << group_.scene_.rho * flow.speed * a / group_.scene_.mu;
    }
    return os.str();
}

Foam::expectedErrors Foam::rigidReport::errors() const
{
    const flowScales& flow = group_.scene_.flow;
    expectedErrors e{group_.name(), "drag", {}};
    const scalar radius = group_.shape_.radius() / group_.h_;
    e.parts.push_back(
        {"cells", group_.errorOfCells(bool(group_.nearField_)),
         "a/h " + Foam::name(radius) +
             (group_.scene_.insideBodies ? ", not measured inside a capsule"
              : group_.isSphere()        ? ""
                                         : ", not measured on ellipsoids") +
             (group_.nearField_ ? " with near field" : " without near field"),
         [this](const scalar left) -> string
         {
             return "cells of " +
                    atMost(group_.shape_.radius() /
                           (group_.nearField_ ? 3 * std::sqrt(0.003 / left)
                                              : 0.064 / left)) +
                    " m and smaller";
         }});
    e.parts.push_back(ofForcing(
        group_.scene_.mu / group_.scene_.rho, group_.scene_.likelyDeltaT, group_.h_,
        group_.scene_.duration,
        group_.nBodies() > 1 || !group_.isSphere() ? flow.rate : 0));
    return e;
}

std::vector<Foam::errorIndicator> Foam::rigidReport::indicators() const
{
    scalar slip = 0;
    for (const auto& x : group_.bodies_)
    {
        // Bodies that are held or lie still: the speed that their force would cause
        const scalar a = group_.shape_.radius();
        const scalar speed = mag(x.velocity) + mag(x.angularVelocity) * a;
        const scalar ofForce =
            mag(sum(x.forces) - x.film) /
            (6 * constant::mathematical::pi * group_.scene_.mu * a);
        slip = max(slip, x.slip / max(max(speed, ofForce), VSMALL));
    }
    return {{"slip over speed", slip, 0.05, smallerSteps(group_.scene_)}};
}

std::vector<Foam::bodyColumn> Foam::rigidReport::columns() const
{
    return {{"x", "m"},
            {"y", "m"},
            {"z", "m"},
            {"velocityX", "m/s"},
            {"velocityY", "m/s"},
            {"velocityZ", "m/s"},
            {"angularVelocityX", "1/s"},
            {"angularVelocityY", "1/s"},
            {"angularVelocityZ", "1/s"},
            {"axisX", "1"},
            {"axisY", "1"},
            {"axisZ", "1"},
            {"forceX", "N"},
            {"forceY", "N"},
            {"forceZ", "N"},
            {"torqueX", "N-m"},
            {"torqueY", "N-m"},
            {"torqueZ", "N-m"},
            {"stressletXX", "N-m"},
            {"stressletXY", "N-m"},
            {"stressletXZ", "N-m"},
            {"stressletYY", "N-m"},
            {"stressletYZ", "N-m"},
            {"stressletZZ", "N-m"},
            {"slip", "m/s", true}};
}

// Force and torque are those on the fluid, films included; the stresslet over the volume of the box
// is the body's part of the stress
Foam::scalarList Foam::rigidReport::sample(const label i) const
{
    const auto& x = group_.bodies_[i];
    const vector force(sum(x.forces) - x.film);
    vector torque(Zero);
    symmTensor stresslet(Zero);
    const tensor R(x.turn.R());
    forAll(group_.markers_, k)
    {
        const vector r(group_.isSphere() ? group_.markers_[k]
                                         : R & group_.markers_[k]);
        torque += r ^ x.forces[k];
        stresslet -= symm(r * x.forces[k]);
    }
    scalarList values;
    for (const vector& v : {vector(x.centre), x.velocity, x.angularVelocity,
                            vector(R & vector(0, 0, 1)), force, torque})
    {
        values.append(scalarList({v.x(), v.y(), v.z()}));
    }
    values.append(
        scalarList({stresslet.xx(), stresslet.xy(), stresslet.xz(),
                    stresslet.yy(), stresslet.yz(), stresslet.zz(), x.slip}));
    return values;
}

Foam::vectorField Foam::rigidReport::tractions(const label i,
                                               const vectorField& points,
                                               const scalarField& areas) const
{
    const auto& x = group_.bodies_[i];
    const tensor R(group_.isSphere() ? tensor::I : x.turn.R());
    const scalar width = group_.nearSpacing();
    vectorField t(points.size(), Zero);
    scalarField weights(points.size());
    forAll(x.forces, k)
    {
        const vector marker(R & group_.markers_[k]);
        forAll(points, j)
        {
            weights[j] = areas[j] * std::exp(-0.5 * magSqr(points[j] - marker) /
                                             sqr(width));
        }
        t += weights / sum(weights) * x.forces[k];
    }
    return vectorField(t / areas);
}

// Rings around the axis, and one polygon over each pole
Foam::bodySurface Foam::rigidReport::surface(const label i) const
{
    const auto& x = group_.bodies_[i];
    const tensor R(x.turn.R());
    const label nTheta = 16, nPhi = 32;
    const scalar pi = constant::mathematical::pi;
    bodySurface s;
    s.points.setSize(nTheta * nPhi);
    scalarField areas(s.points.size());
    const vector& axes = group_.shape_.semiAxes();
    for (label r = 0; r < nTheta; ++r)
    {
        const scalar t = pi * (r + 0.5) / nTheta;
        const scalar share =
            (std::cos(pi * r / nTheta) - std::cos(pi * (r + 1) / nTheta)) * 2 *
            pi / nPhi;
        for (label j = 0; j < nPhi; ++j)
        {
            const scalar p = 2 * pi * j / nPhi;
            const vector e(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p),
                           std::cos(t));
            s.points[r * nPhi + j] = R & vector(cmptMultiply(axes, e));
            areas[r * nPhi + j] =
                share * cmptProduct(axes) * mag(cmptDivide(e, axes));
        }
    }
    s.faces = ringFaces(nTheta, nPhi);
    s.vectorNames = {"velocity", "traction"};
    s.vectors.setSize(2);
    s.vectors[0] = x.velocity + (x.angularVelocity ^ s.points);
    s.vectors[1] = tractions(i, s.points, areas);
    s.scalarNames = {"area"};
    s.scalars.setSize(1, areas);
    s.points += x.centre;
    return s;
}
