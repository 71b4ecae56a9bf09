// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "penaltyMotion.H"
#include <cmath>

void Foam::penaltyMotion::apply(std::vector<double>& lag,
                                std::vector<double>& before,
                                std::vector<double>& load, const scalar dt,
                                const scalar ratio) const
{
    const double toLag = dt * dt / mass_;
    for (size_t j = 0; j < lag.size(); ++j)
    {
        const double change = ratio * (lag[j] - before[j]);
        const double force = share_ * (lag[j] + change);
        before[j] = lag[j];
        lag[j] += change - toLag * load[j] - force;
        const double after = share_ * (2 * lag[j] - before[j]);
        load[j] = -0.5 * (force + after) / toLag;
    }
}

Foam::scalar Foam::penaltyMotion::maxDeltaT(const scalar stiffness) const
{
    // y_tt = -stiffness/mass y beside the spring: z^2 = (1 - k) z - 0.5 with
    // k = stiffness dt^2/mass stays below 1 for k < 2.5
    return std::sqrt(2.5 * mass_ / stiffness);
}
