// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Numbers, errors, columns and pictures of filaments

#include "filamentReport.H"
#include "mathematicalConstants.H"
#include <cmath>

Foam::string Foam::filamentReport::describe() const
{
    const flowScales& flow = group_.scene_.flow;
    const scalar L = group_.properties_.length, B = group_.properties_.rigidity;
    OStringStream os;
    os.precision(4);
    os << group_.nBodies() << " of length L " << L << ", L/h " << L / group_.h_
       << ", diameter/h " << group_.effectiveDiameter_ / group_.h_
       << ", L/diameter " << L / group_.effectiveDiameter_
       << ", volume fraction "
       << group_.nBodies() * L * 0.25 * constant::mathematical::pi *
              sqr(group_.effectiveDiameter_) /
              cmptProduct(group_.scene_.grid.length());
    if (group_.withoutFluid()) return os.str();
    const scalar nL3 =
        group_.nBodies() * pow3(L) / cmptProduct(group_.scene_.grid.length());
    os << ", n L^3 " << nL3
       << (nL3 < 1                               ? " (dilute)"
           : nL3 < L / group_.effectiveDiameter_ ? " (semi-dilute)"
                                                 : " (concentrated)")
       << ", density ratio " << group_.points(-1).densityRatio;
    if (flow.rate > 0)
    {
        os << ", Re "
           << group_.scene_.rho * flow.rate * sqr(L) / group_.scene_.mu;
        if (B > 0)
            os << ", mu rate L^4/B "
               << group_.scene_.mu * flow.rate * pow4(L) / B;
    }
    else if (flow.speed > 0)
    {
        os << ", Re " << group_.scene_.rho * flow.speed * L / group_.scene_.mu;
        if (B > 0)
            os << ", mu U L^3/B "
               << group_.scene_.mu * flow.speed * pow3(L) / B;
    }
    return os.str();
}

// Step of filaments without fluid that swing in gravity: largest error of the tip over a
// few swings, measured on a pendulum, a chain and a cantilever (tests/stability, fibresAlone).
// rate: root of g/L [1/s]
Foam::expectedError Foam::filamentReport::ofSwing(const scalar rate) const
{
    const scalar dt = group_.scene_.deltaT;
    const auto error = [=](const scalar step) { return 2.3 * rate * step; };
    const auto largest = [=](const scalar wanted)
    { return wanted / (2.3 * rate); };
    const bool fixed = dt > 0 && dt < GREAT;
    return {"step",
            fixed ? error(dt) : -1,
            fixed ? "of swings; deltaT sqrt(g/L) is " + Foam::name(rate * dt)
                  : string("deltaT is adjusted"),
            nullptr,
            largest,
            error};
}

// Measured on cantilevers, chains and swings, and by the drag of straight ones
// (doc/validation.md)
Foam::expectedErrors Foam::filamentReport::errors() const
{
    const flowScales& flow = group_.scene_.flow;
    expectedErrors e{group_.name(), "shape", {}};
    const label n = group_.properties_.segments;
    // Flow bends a fibre within the length at which drag and bending balance
    const scalar segment = group_.properties_.ds();
    const scalar bend = group_.twoWay() && flow.rate > 0
                            ? std::pow(group_.properties_.rigidity /
                                           (group_.scene_.mu * flow.rate),
                                       0.25)
                            : GREAT;
    const bool resolved = segment < 0.25 * bend;
    e.parts.push_back(
        {"segments", resolved ? 4.0 / (n * n) : -1,
         Foam::name(n) +
             (resolved
                  ? ""
                  : " of " + Foam::name(segment) + " m, longer than " +
                        Foam::name(0.25 * bend) + " m = (B/(mu rate))^(1/4)/4"),
         [](const scalar left) {
             return "segments " +
                    Foam::name(label(std::ceil(2 / std::sqrt(left))));
         }});
    if (group_.twoWay())
    {
        e.parts.push_back(
            {"drag", 0.03, "of a fibre of the kernel's thickness", nullptr});
        e.parts.push_back(ofForcing(group_.scene_.mu / group_.scene_.rho,
                                    group_.scene_.likelyDeltaT, group_.h_,
                                    group_.scene_.duration,
                                    group_.nBodies() > 1 ? flow.rate : 0));
    }
    else if (group_.isPendulum_)
    {
        e.parts.push_back(ofSwing(std::sqrt(mag(group_.scene_.g) /
                                            group_.properties_.length)));
    }
    return e;
}

std::vector<Foam::errorIndicator> Foam::filamentReport::indicators() const
{
    const label N = group_.properties_.segments;
    scalar bend = 0, length = 0, slip = 0;
    for (const auto& x : group_.bodies_)
    {
        const vectorField& X = x.line.positions();
        for (label k = 1; k < N; ++k)
        {
            const vector before(X[k] - X[k - 1]), after(X[k + 1] - X[k]);
            bend = max(bend, 1 - (before & after) / (mag(before) * mag(after)));
        }
        length = max(length, x.line.lengthError());
        if (!group_.twoWay()) continue;
        // Filaments that are held or lie still: the speed that their force would cause
        const scalar speed = max(mag(x.line.velocities()));
        const scalar ofForce = mag(sum(x.forces)) / (10 * group_.scene_.mu *
                                                     group_.properties_.length);
        slip = max(slip, x.slip / max(max(speed, ofForce), VSMALL));
    }
    std::vector<errorIndicator> all(
        {{"1 - cosine of the angle between segments", bend, 0.05,
          group_.twoWay() && group_.properties_.ds() < 1.1 * group_.h_
              ? "cells to smaller ones, with more segments, or "
                "bendingRigidity to more: segments are as short as a cell"
              : "entry segments to more"},
         {"change of length", length, 1e-3, smallerSteps(group_.scene_)}});
    if (group_.twoWay())
    {
        all.push_back(
            {"slip over speed", slip, 0.05, smallerSteps(group_.scene_)});
    }
    return all;
}

std::vector<Foam::bodyColumn> Foam::filamentReport::columns() const
{
    return {{"x", "m"},           {"y", "m"},
            {"z", "m"},           {"tipX", "m"},
            {"tipY", "m"},        {"tipZ", "m"},
            {"endToEnd", "m"},    {"lengthError", "of-a-segment"},
            {"energy", "J"},      {"maxTension", "N"},
            {"angle", "degrees"}, {"iterations", "Newton-per-step", true},
            {"forceX", "N"},      {"forceY", "N"},
            {"forceZ", "N"},      {"slip", "m/s", true},
            {"velocityX", "m/s"}, {"velocityY", "m/s"},
            {"velocityZ", "m/s"}, {"axisX", "1"},
            {"axisY", "1"},       {"axisZ", "1"},
            {"spin", "1/s"},      {"curvature", "1/m"},
            {"endsAlong", "m/s"}, {"endsAcross", "m/s"},
            {"power", "W"}};
}

Foam::scalarList Foam::filamentReport::sample(const label i) const
{
    const filament& x = group_.bodies_[i].line;
    const vectorField& X = x.positions();
    const label N = group_.properties_.segments;
    const vector force(sum(group_.bodies_[i].forces));
    vector centre(Zero);
    for (label k = 0; k < N; ++k)
    {
        centre += 0.5 / N * (X[k] + X[k + 1]);
    }
    const vector across(X[N] - X[0]), axis(across / max(mag(across), VSMALL));

    // Rate at which the direction of the ends turns in the shear plane, and the root mean
    // square of the curvature
    const vectorField& V = x.velocities();
    vector velocity(Zero);
    for (label k = 0; k < N; ++k)
    {
        velocity += 0.5 / N * (V[k] + V[k + 1]);
    }
    const direction f = group_.shearPlane_[0], g = group_.shearPlane_[1];
    const vector apart(V[N] - V[0]);
    const scalar spin = (across[f] * apart[g] - across[g] * apart[f]) /
                        max(sqr(across[f]) + sqr(across[g]), VSMALL);
    scalar bend = 0;
    for (label k = 1; k < N; ++k)
    {
        bend += magSqr(X[k + 1] - 2 * X[k] + X[k - 1]);
    }
    bend =
        std::sqrt(bend / max(N - 1, label(1))) / sqr(group_.properties_.ds());
    return {centre.x(),
            centre.y(),
            centre.z(),
            X[N].x(),
            X[N].y(),
            X[N].z(),
            mag(across),
            x.lengthError(),
            x.kineticEnergy() + x.bendingEnergy(),
            max(x.tensions()),
            180 / constant::mathematical::pi *
                std::atan2(across[group_.shearPlane_[1]],
                           across[group_.shearPlane_[0]]),
            scalar(x.iterations()),
            force.x(),
            force.y(),
            force.z(),
            group_.bodies_[i].slip,
            velocity.x(),
            velocity.y(),
            velocity.z(),
            axis.x(),
            axis.y(),
            axis.z(),
            spin,
            bend,
            apart & axis,
            mag(apart - (apart & axis) * axis),
            group_.bodies_[i].power};
}

Foam::label Foam::filamentReport::nCoupleMarkers() const
{
    return group_.markersEach() - group_.points_.size();
}

void Foam::filamentReport::loads(const label i, vectorField& forces,
                                 vectorField& couples) const
{
    const auto& x = group_.bodies_[i];
    const label n = group_.points_.size();
    for (label k = 0; k < n; ++k)
    {
        const filament::linePoint& on = group_.points_[k];
        forces[on.segment] += (1 - on.at) * x.forces[k];
        forces[on.segment + 1] += on.at * x.forces[k];
    }

    if (!group_.couple_) return;

    // Three forces without resultant around each station
    const label nStations = group_.couple_->nMarkers() / 3;
    List<thicknessCouple::frame> frames;
    vectorField X(3 * nStations);
    group_.couple_->markers(x.line.positions(), frames, X.data());
    for (label station = 0; station < nStations; ++station)
    {
        vector couple(Zero);
        for (label k = 3 * station; k < 3 * station + 3; ++k)
        {
            couple += X[k] ^ x.forces[n + k];
        }
        couples[label((station + 0.5) / nStations * (couples.size() - 1))] +=
            couple;
    }
}

// A line along the nodes
Foam::bodySurface Foam::filamentReport::surface(const label i) const
{
    const filament& x = group_.bodies_[i].line;
    const vectorField& X = x.positions();
    const label N = group_.properties_.segments;

    bodySurface s;
    s.lines = true;
    s.points = X;
    s.faces.setSize(1, face(Foam::identity(N + 1)));
    s.vectorNames = {"velocity", "force", "couple"};
    s.vectors.setSize(3, vectorField(N + 1, Zero));
    s.vectors[0] = x.velocities();
    if (group_.twoWay()) loads(i, s.vectors[1], s.vectors[2]);
    s.scalarNames = {"tension", "curvature"};
    s.scalars.setSize(2, scalarField(N + 1, Zero));
    forAll(X, k)
    {
        s.scalars[0][k] = 0.5 * (x.tensions()[max(k - 1, label(0))] +
                                 x.tensions()[min(k, N - 1)]);
        if (k > 0 && k < N)
        {
            s.scalars[1][k] = mag(X[k + 1] - 2 * X[k] + X[k - 1]) /
                              sqr(group_.properties_.ds());
        }
    }
    return s;
}
