// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Filaments and the fluid within a time step, and between runs

#include "filaments.H"
#include <cmath>

Foam::label Foam::filaments::nMarkers() const
{
    return filaments_.size() * markersEach();
}

void Foam::filaments::makePoints(const label n, const scalar inset)
{
    points_.setSize(n);
    const scalar ds = properties_.ds();
    forAll(points_, k)
    {
        const scalar s =
            (inset + k * (properties_.length - 2 * inset) / (n - 1)) / ds;
        points_[k].segment = min(label(s), properties_.segments - 1);
        points_[k].at = s - points_[k].segment;
    }
}

// Where the filament is expected at the end of the step: there the fluid is to
// move with it
void Foam::filaments::markers(vector* X, const scalar dt)
{
    if (alone()) return;
    for (fibre& x : filaments_)
    {
        x.ahead = x.line.ahead(dt);
        forAll(points_, k)
        {
            x.markers[k] = points_[k](x.ahead);
        }
        if (couple_) couple_->markers(x.ahead, &x.markers[points_.size()]);
        X = std::copy(x.markers.begin(), x.markers.end(), X);
    }
}

void Foam::filaments::loads(vector* X, vector* F, scalar)
{
    for (const fibre& x : filaments_)
    {
        X = std::copy(x.markers.begin(), x.markers.end(), X);
        F = std::copy(x.forces.begin(), x.forces.end(), F);
    }
}

void Foam::filaments::observe(const vector* U)
{
    for (fibre& x : filaments_)
    {
        x.slip = 0;
        forAll(points_, k)
        {
            x.slip = max(x.slip, mag(points_[k](x.line.velocities()) - U[k]));
        }
        U += markersEach();
    }
}

// A point moves the fluid of this cross-section over its length, per step with
// what diffusion leaves of it
Foam::scalar Foam::filaments::directForcing(const bodyStep& s) const
{
    const scalar squares = scene_.kernel.sumOfSquares();

    // Points far apart move less than a line does
    const scalar length =
        min(properties_.length / points_.size(), h_ / squares);
    return scene_.rho * length * sqr(h_ / squares) / (s.kept * s.dt);
}

bool Foam::filaments::moveOne(fibre& x, const vector* U, const bodyStep& s,
                              filament::surroundings& around)
{
    const label n = points_.size();
    around.force = weight_;
    for (const filamentLoad& load : loads_)
    {
        load.add(x.line.ahead(s.dt), properties_.ds(), s.time, around.force);
    }
    if (base_.valid())
    {
        x.line.moveEnd(movedEnd(), x.start + base_->value(s.time));
    }

    const bool first = !x.line.started();
    for (label k = 0; k < n; ++k)
    {
        const vector change(first ? vector(Zero) : vector(U[k] - x.U[k]));
        x.U[k] = U[k];
        around.U[k] = U[k];
        if (twoWay())
        {
            // The velocity at the start of the step stands for that at its end;
            // half of its last change damps what this delay excites. The force
            // of the last step stays on
            if (!s.predicted) around.U[k] += 0.5 * change;
            around.U[k] -= x.forces[k] / around.drag[k];
        }
        else
        {
            // The fluid in its place would accelerate like this
            const vector inertia(displaced_ * properties_.length / n / x.dt *
                                 change);
            const label i = points_[k].segment;
            const scalar at = points_[k].at;
            around.force[i] += (1 - at) / properties_.lengthOf(i) * inertia;
            around.force[i + 1] += at / properties_.lengthOf(i + 1) * inertia;
        }
    }
    if (couple_) around.shear = couple_->shear(x.ahead, U + n);

    if (!x.line.step(s.dt, around)) return false;
    x.dt = s.dt;

    if (twoWay())
    {
        const vectorField& V = x.line.meanVelocities();
        for (label k = 0; k < n; ++k)
        {
            x.forces[k] = around.drag[k] * (points_[k](V) - around.U[k]);
        }
        if (couple_) couple_->forces(x.ahead, V, around.shear, &x.forces[n]);
    }
    return true;
}

Foam::string Foam::filaments::move(const vector* U, const bodyStep& s)
{
    const auto timing(scene_.effects.time("filament"));
    const label n = points_.size();
    const scalar drag =
        twoWay() ? directForcing(s) : drag_ * properties_.length / max(n, 1);
    filament::surroundings around{vectorField(properties_.segments + 1),
                                  points_, scalarField(n, drag),
                                  vectorField(n)};
    if (couple_) around.couple = couple_->K();

    string trouble;
    for (label i = 0; i < label(filaments_.size()); ++i)
    {
        if (!moveOne(filaments_[i], U, s, around))
        {
            trouble = "body " + Foam::name(mine()[i]) + " of group " + name() +
                      ": no tension holds its length, even in a 64th of the "
                      "step (a floppy filament as light as the fluid needs "
                      "segments no shorter than a cell)";
        }
        U += markersEach();
    }
    return trouble;
}

void Foam::filaments::addLoad(const word&, const dictionary& dict)
{
    loads_.append(new filamentLoad(dict));
}

Foam::scalarList Foam::filaments::state(const label i) const
{
    const fibre& x = filaments_[i];
    DynamicList<scalar> s;
    x.line.save(s);
    s.append(x.slip);
    s.append(x.dt);
    filament::save(x.U, s);
    filament::save(x.forces, s);
    return scalarList(std::move(s));
}

void Foam::filaments::setState(const label i, const scalarList& state,
                               const dictionary& source)
{
    fibre& x = filaments_[i];
    const label own = x.line.stateSize();
    const label all = own + 2 + 3 * (x.U.size() + x.forces.size());
    if (state.size() != all)
    {
        FatalIOErrorInFunction(source)
            << "the saved state of body " << mine()[i] << " has "
            << state.size() << " numbers where " << all
            << " belong to its segments and coupling: was one of the entries "
            << "segments, coupling, thicknessCouple, kernel or the size of the "
            << "cells changed?" << exit(FatalIOError);
    }
    x.line.restore(state.cdata());
    if (properties_.scheme == filament::IMPLICIT && x.line.lengthError() > 1e-6)
    {
        FatalIOErrorInFunction(source)
            << "the saved state of body " << mine()[i]
            << " has segments of another length: was the entry length changed?"
            << exit(FatalIOError);
    }
    const scalar* at = state.cdata() + own;
    x.slip = *at++;
    x.dt = *at++;
    at = filament::restore(at, x.U);
    filament::restore(at, x.forces);
}
