// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Filaments and the fluid within a time step

#include "filamentGroup.H"
#include <cmath>

Foam::label Foam::filamentGroup::nMarkers() const
{
    return bodies_.size() * markersEach();
}

// Positions extrapolated to the end of the step
void Foam::filamentGroup::placeMarkers(vector* X, const scalar dt)
{
    if (withoutFluid()) return;
    vectorField ahead;
    for (body& x : bodies_)
    {
        x.line.ahead(dt, ahead);
        forAll(points_, k)
        {
            x.X[k] = points_[k](ahead);
        }
        if (couple_)
        {
            couple_->markers(ahead, x.frames, &x.X[points_.size()]);
        }
        X = std::copy(x.X.begin(), x.X.end(), X);
    }
}

void Foam::filamentGroup::lines(label* line) const
{
    for (const label number : mine())
    {
        line = std::fill_n(line, points_.size(), number);
        line = std::fill_n(line, markersEach() - points_.size(), -1);
    }
}

// Mass of the fluid that a marker moves, over the step and the part of an impulse that
// diffusion leaves in place: see filamentGroup.H
Foam::scalar Foam::filamentGroup::forcingGain(const bodyStep& s) const
{
    const scalar squares = scene_.kernel.sumOfSquares();

    // Points far apart move less than a line does
    const scalar length =
        min(properties_.length / points_.size(), h_ / squares);
    return scene_.rho * length * sqr(h_ / squares) / (s.impulseFraction * s.dt);
}

void Foam::filamentGroup::addLoads(const label i, const scalar gain,
                                   const bodyStep& s,
                                   filament::surroundings& around) const
{
    const body& x = bodies_[i];
    const auto ahead = [&]()
    {
        vectorField X;
        x.line.ahead(s.dt, X);
        return pointsOf(mine()[i], X, x.line.velocities());
    };
    scene_.forces.add(name(), mine()[i], ahead, s.time, scene_.effects,
                      around.force);
    scene_.forces.addStiffness(name(), mine()[i], around.stiffness);

    // Stiffness above what an explicit step allows: a quarter of what the fluid near a
    // marker resists with, as the fluid gives way as well
    const scalar borne = gain * points_.size() / (properties_.length * s.dt);
    forAll(around.force, k)
    {
        const scalar length = properties_.lengthOf(k);
        around.force[k] /= length;
        around.stiffness[k] =
            max(scalar(0), around.stiffness[k] / length - 0.25 * borne);
    }
}

// Forces, drag and velocity of the fluid that a body feels during the step
void Foam::filamentGroup::surround(const label i, const vector* U,
                                   const scalar* lineDensity, const bodyStep& s,
                                   filament::surroundings& around)
{
    body& x = bodies_[i];
    const label n = points_.size();
    around.force = Zero;
    around.stiffness = Zero;
    const scalar gain =
        twoWay() ? forcingGain(s)
                 : dragAcross_ * properties_.length / max(n, label(1));
    around.drag = gain;
    if (couple_) around.couple = couple_->K();
    if (twoWay()) shareAmongLines(lineDensity, around);
    if (scene_.forces.actOn(name(), mine()[i]))
    {
        addLoads(i, n ? min(around.drag) : gain, s, around);
    }
    if (base_.valid())
    {
        x.line.moveEnd(movedEnd(), x.start + base_->value(s.time));
    }
    const vectorField change(x.takeVelocity(U, !x.line.started()));
    for (label k = 0; k < n; ++k)
    {
        around.U[k] = U[k];
        if (twoWay())
        {
            // The force F of the last step stays on: F + c (V - U) = c (V - (U - F/c))
            if (!s.predicted) around.U[k] += 0.5 * change[k];
            around.U[k] -= x.forces[k] / around.drag[k];
        }
        else
        {
            // The fluid in its place would accelerate like this
            const vector inertia(crossSection_ * scene_.rho *
                                 properties_.length / n / x.dt * change[k]);
            const label node = points_[k].segment;
            const scalar at = points_[k].at;
            around.force[node] +=
                (1 - at) / properties_.lengthOf(node) * inertia;
            around.force[node + 1] +=
                at / properties_.lengthOf(node + 1) * inertia;
        }
    }
    if (couple_)
    {
        couple_->shear(x.frames, around.couple, U + n,
                       twoWay() ? x.forces.cdata() + n : nullptr, around.shear);
    }
}

// Forces on the fluid: gain times slip, and the couple
void Foam::filamentGroup::force(body& x,
                                const filament::surroundings& around) const
{
    const vectorField& V = x.line.meanVelocities();
    forAll(points_, k)
    {
        x.forces[k] = around.drag[k] * (points_[k](V) - around.U[k]);
    }
    if (couple_)
    {
        couple_->forces(x.frames, V, around.shear, around.couple,
                        &x.forces[points_.size()]);
    }
}

// Where several lines of markers lie in one place each answers to the fluid with
// its share: together they are as stable, and as thick, as one
void Foam::filamentGroup::shareAmongLines(const scalar* lineDensity,
                                          filament::surroundings& around) const
{
    forAll(points_, k)
    {
        around.drag[k] /= lineDensity[k];
    }
    label k = 0;
    forAll(around.couple, i)
    {
        // The nearest marker before the end of the segment
        while (k + 1 < points_.size() && points_[k + 1].segment <= i)
            ++k;
        around.couple[i] /= lineDensity[k];
    }
}

Foam::scalar Foam::filamentGroup::freeVelocities(const label i, const vector* U,
                                                 const scalar* lineDensity,
                                                 const bodyStep& s,
                                                 vectorField& V) const
{
    // Velocity of the fluid at the markers (see surround()), linear between markers and
    // beyond the last
    const body& x = bodies_[i];
    const label n = points_.size(), N = properties_.segments;
    const scalar ds = properties_.ds();
    const auto arc = [&](const label k)
    { return points_[k].segment + points_[k].at; };
    const auto velocity = [&](const label k)
    {
        return s.predicted || !x.line.started()
                   ? U[k]
                   : vector(1.5 * U[k] - 0.5 * x.U[k]);
    };
    V.setSize(N + 1);
    label k = 0;
    forAll(V, node)
    {
        while (k + 2 < n && arc(k + 1) < node)
            ++k;
        const scalar t = (node - arc(k)) / (arc(k + 1) - arc(k));
        V[node] = (1 - t) * velocity(k) + t * velocity(k + 1);
    }

    // Mobility of a push in the middle: of the whole rod, or of the length that an
    // implicit step bends, 2.8 (B dt L/drag)^(1/4), if that is shorter
    scalar drag = 0;
    for (label m = 0; m < n; ++m)
    {
        drag += forcingGain(s) / lineDensity[m];
    }
    const scalar L = properties_.length;
    const scalar bent =
        2.8 * std::pow(properties_.rigidity * s.dt * L / drag, 0.25);
    return max(scalar(1), L / max(bent, ds)) / drag;
}

Foam::string Foam::filamentGroup::move(const vector* U,
                                       const scalar* lineDensity,
                                       const bodyStep& s)
{
    const auto timing(scene_.effects.time("filament"));
    ++steps_;
    lastTime_ = s.time;
    lastDeltaT_ = s.dt;
    const label all = mine().size(), some = min(all, filament::nLanes);
    List<filament::surroundings> around(some);
    // In one-way coupling the inertia of the fluid in its place is a force
    const bool loaded = !twoWay() || scene_.forces.actOn(name());
    for (filament::surroundings& x : around)
    {
        x.force.setSize(loaded ? properties_.segments + 1 : 0);
        x.stiffness.setSize(x.force.size());
        x.points = points_;
        x.drag.setSize(points_.size());
        x.U.setSize(points_.size());
    }
    List<filament*> lines(some);
    string trouble;
    for (label i = 0; i < all; i += some)
    {
        const label n = min(some, all - i);
        for (label l = 0; l < n; ++l)
        {
            surround(i + l, U, lineDensity, s, around[l]);
            lines[l] = &bodies_[i + l].line;
            U += markersEach();
            lineDensity += markersEach();
        }
        const List<bool> advanced(
            filament::step(s.dt, SubList<filament*>(lines, n),
                           SubList<filament::surroundings>(around, n)));
        for (label l = 0; l < n; ++l)
        {
            if (!advanced[l])
            {
                trouble =
                    nameOfBody(mine()[i + l]) +
                    ": no tension holds its length, even in a 64th of the "
                    "step (a floppy filament as light as the fluid needs "
                    "segments no shorter than a cell)";
                continue;
            }
            body& x = bodies_[i + l];
            x.dt = s.dt;
            if (twoWay())
            {
                force(x, around[l]);
                continue;
            }
            x.slip = 0;
            forAll(points_, k)
            {
                x.slip = max(x.slip, mag(points_[k](x.line.meanVelocities()) -
                                         around[l].U[k]));
            }
        }
    }
    return trouble;
}
