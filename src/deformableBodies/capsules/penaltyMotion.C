// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "penaltyMotion.H"
#include <cmath>

namespace
{
//- Stiffness of the fastest harmonic [N/m]: waves of area are the stiffest in the plane
Foam::scalar stiffnessOf(const Foam::capsuleMotion::setting& s)
{
    using namespace Foam;
    const membraneModel& law = s.shell.model();
    const scalar N = s.harmonics.degree(), bend = N * (N + 3) / s.radius;
    return (law.shearModulus() + law.areaModulus()) * N * (N + 1) +
           s.shell.bendingModulus() * bend * bend;
}
} // namespace

Foam::penaltyMotion::penaltyMotion(const setting& s,
                                   const scalar surfaceDensity)
    : capsuleMotion(s.shell,
                    limit(surfaceDensity * sqr(s.radius), stiffnessOf(s))),
      effects_(s.effects),
      mass_(surfaceDensity * sqr(s.radius))
{
}

void Foam::penaltyMotion::start(capsule& c) const
{
    if (c.lag.empty()) c.lagBefore = c.lag = coefficients(c.x.size(), 0);
    if (!c.load.empty()) return;

    // The part of the end of the last step
    c.load.assign(c.x.size(), 0);
    for (size_t j = 0; j < c.lag.size() && c.lastDeltaT > 0; ++j)
    {
        c.load[j] = -share_ * (2 * c.lag[j] - c.lagBefore[j]) * mass_ /
                    sqr(c.lastDeltaT);
    }
}

void Foam::penaltyMotion::beforeMove(capsule& c, const scalar dt) const
{
    const auto timing(effects_.time("penalty"));

    // The stiffness of the spring is as 1/dt^2: the lag that carries the same force
    const double same = c.lastDeltaT > 0 ? sqr(dt / c.lastDeltaT) : 1;
    for (size_t j = 0; j < c.lag.size(); ++j)
    {
        c.lag[j] *= same;
        c.lagBefore[j] *= same;
    }
    coefficients elastic(c.x);
    for (size_t j = 0; j < elastic.size(); ++j)
    {
        elastic[j] += c.lag[j];
    }
    shell_.load(elastic, c.load);
    advance(mass_, c.lag, c.lagBefore, c.load, dt);
}

void Foam::penaltyMotion::advance(const scalar mass, coefficients& lag,
                                  coefficients& before, coefficients& load,
                                  const scalar dt)
{
    const double toLag = dt * dt / mass;
    for (size_t j = 0; j < lag.size(); ++j)
    {
        const double change = lag[j] - before[j];
        const double force = share_ * (lag[j] + change);
        before[j] = lag[j];
        lag[j] += change - toLag * load[j] - force;
        const double after = share_ * (2 * lag[j] - before[j]);
        load[j] = -0.5 * (force + after) / toLag;
    }
}

Foam::scalar Foam::penaltyMotion::limit(const scalar mass,
                                        const scalar stiffness)
{
    // y_tt = -stiffness/mass y beside the spring: z^2 = (1 - k) z - 0.5 with
    // k = stiffness dt^2/mass stays below 1 for k < 2.5
    return std::sqrt(2.5 * mass / stiffness);
}
