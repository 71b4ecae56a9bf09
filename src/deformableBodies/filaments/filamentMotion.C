// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Filaments and the fluid within a time step, and between runs

#include "filaments.H"
#include <cmath>

Foam::label Foam::filaments::nMarkers() const
{
    return filaments_.size() * markersEach();
}

// Where the filament is expected at the end of the step: there the fluid is to
// move with it
void Foam::filaments::markers(vector* X, const scalar dt)
{
    if (alone()) return;
    for (fibre& x : filaments_)
    {
        const vectorField ahead(x.line.ahead(dt));
        std::copy(ahead.begin(), ahead.end(), x.markers.begin());
        if (couple_) couple_->markers(ahead, x.markers.data() + nNodes());
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
        forAll(x.line.velocities(), k)
        {
            x.slip = max(x.slip, mag(x.line.velocities()[k] - U[k]));
        }
        U += markersEach();
    }
}

// A line of markers moves fluid of this cross-section, per step with what
// diffusion leaves of it
Foam::scalar Foam::filaments::directForcing(const bodyStep& s) const
{
    const scalar h = std::cbrt(scene_.grid.cellVolume());
    const scalar squares = scene_.kernel.sumOfSquares();

    // Markers far apart move less than a line does
    const scalar apart = max(scalar(1), squares * properties_.ds() / h);
    return scene_.rho * sqr(h / squares) / (apart * s.kept * s.dt);
}

bool Foam::filaments::moveOne(fibre& x, const vector* U, const bodyStep& s)
{
    const label n = nNodes();
    filament::surroundings around{vectorField(n, weight_),
                                  scalarField(n, drag_), vectorField(n, Zero)};
    vectorField& f = around.force;
    for (const filamentLoad& load : loads_)
    {
        load.add(x.line.ahead(s.dt), properties_.ds(), s.time, f);
    }
    if (base_.valid())
    {
        x.line.moveEnd(movedEnd(), x.start + base_->value(s.time));
    }
    if (alone()) return x.line.step(s.dt, around);

    const bool first = !x.line.started();
    std::copy_n(U, n, around.U.begin());
    const vectorField change(around.U - x.U);
    x.U = around.U;
    const auto share = [&](const label k)
    { return (k == 0 || k == n - 1 ? 0.5 : 1.0) * properties_.ds(); };
    if (twoWay())
    {
        // The velocity at the start of the step stands for that at its end; half
        // of its last change damps what this delay excites
        if (!s.predicted && !first) around.U += 0.5 * change;
        around.drag = directForcing(s);
        for (label k = 0; k < n; ++k)
        {
            f[k] -= x.forces[k] / share(k);
        }
    }
    else if (!first)
    {
        // The fluid in its place would accelerate like this
        f += displaced_ / s.dt * change;
    }
    if (couple_)
    {
        around.couple = couple_->K();
        around.shear = couple_->shear(SubField<vector>(x.markers, n), U + n);
    }

    if (!x.line.step(s.dt, around)) return false;

    if (twoWay())
    {
        const vectorField& V = x.line.meanVelocities();
        for (label k = 0; k < n; ++k)
        {
            x.forces[k] += share(k) * around.drag[k] * (V[k] - around.U[k]);
        }
        if (couple_)
        {
            couple_->forces(SubField<vector>(x.markers, n), V, around.shear,
                            x.forces.data() + n);
        }
    }
    return true;
}

Foam::string Foam::filaments::move(const vector* U, const bodyStep& s)
{
    const auto timing(scene_.effects.time("filament"));
    string trouble;
    for (label i = 0; i < label(filaments_.size()); ++i)
    {
        if (!moveOne(filaments_[i], U, s))
        {
            trouble = "body " + Foam::name(mine()[i]) + " of group " + name() +
                      ": no tension holds its length, even in a 64th of the "
                      "step";
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
    for (const vectorField* v : {&x.U, &x.forces})
    {
        for (const vector& y : *v)
        {
            for (direction d = 0; d < 3; ++d)
            {
                s.append(y[d]);
            }
        }
    }
    return scalarList(std::move(s));
}

void Foam::filaments::setState(const label i, const scalarList& state,
                               const dictionary& source)
{
    fibre& x = filaments_[i];
    const label own = x.line.stateSize();
    const label all = own + 1 + 3 * (x.U.size() + x.forces.size());
    if (state.size() != all)
    {
        FatalIOErrorInFunction(source)
            << "the saved state of body " << mine()[i] << " has "
            << state.size() << " numbers where " << all
            << " belong to its segments and coupling: was one of the entries "
            << "segments, coupling, thicknessCouple changed?"
            << exit(FatalIOError);
    }
    x.line.restore(state.cdata());
    const scalar* at = state.cdata() + own;
    x.slip = *at++;
    for (vectorField* v : {&x.U, &x.forces})
    {
        for (vector& y : *v)
        {
            for (direction d = 0; d < 3; ++d)
            {
                y[d] = *at++;
            }
        }
    }
}
