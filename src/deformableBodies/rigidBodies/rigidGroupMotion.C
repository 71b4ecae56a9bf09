// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Rigid bodies and the fluid within a time step

#include "rigidGroup.H"

namespace
{
// Rate at which the slowest swirl in a sphere decays, over nu/a^2: the square of the first root
// of tan x = x, 4.49
const Foam::scalar slowestSwirl = 20.2;
} // namespace

Foam::label Foam::rigidGroup::nMarkers() const
{
    return bodies_.size() * markers_.size();
}

// Light bodies: seen to diverge from nu dt/h^2 = 7 to 10 on, with the largest viscosity there
// is, that within or without the capsule around a nucleus
Foam::scalar Foam::rigidGroup::maxDeltaT() const
{
    const scalar mu = scene_.mu * max(scalar(1), 1 / scene_.viscosityAround);
    return densityRatio_ < 1 ? 5 * sqr(h_) * scene_.rho / mu : GREAT;
}

void Foam::rigidGroup::placeMarkers(vector* X, const scalar dt)
{
    for (body& x : bodies_)
    {
        x.expected = x.centre + dt * x.velocity;
        x.X = x.expected;
        if (isSphere())
        {
            x.X += markers_;
        }
        else
        {
            x.expectedTurn = rotationBy(dt * x.angularVelocity) * x.turn;
            x.X += x.expectedTurn.R() & markers_;
        }
        X = std::copy(x.X.begin(), x.X.end(), X);
    }
}

void Foam::rigidGroup::lines(label* line) const
{
    for (const label number : mine())
    {
        line = std::fill_n(line, markers_.size(), number);
    }
}

Foam::vectorField Foam::rigidGroup::surfaceVelocity(const label i,
                                                    const vector* U) const
{
    const body& x = bodies_[i];
    const label n = markers_.size();
    vectorField v(UList<vector>(const_cast<vector*>(U), n));
    if (nearField_)
    {
        const auto timing(scene_.effects.time("nearField"));
        vectorField own(n);
        nearField_->velocity(x.X.cdata(), x.forces.cdata(), n, own.data());
        v += own;
        if (exchanges())
        {
            std::vector<vector> ofOthers(n, vector(Zero));
            addExchanged(i, n, ofOthers.data());
            projection_->add(ofOthers, v.data());
        }
    }
    return v;
}

std::vector<Foam::vector> Foam::rigidGroup::nearDirections(const label) const
{
    std::vector<vector> directions;
    for (const vector& r : markers_)
    {
        const vector n(cmptDivide(r, shape_.semiAxes()));
        directions.push_back(n / mag(n));
    }
    return directions;
}

Foam::nearSurface::sources
Foam::rigidGroup::nearSourcesOf(const label i) const
{
    const body& x = bodies_[i];
    const tensor R(isSphere() ? tensor::I : x.turn.R());
    sources s;
    for (const vector& r : markers_)
    {
        s.X.push_back(x.centre + (R & r));
    }
    s.F = projection_->forces(x.forces.cdata());
    return s;
}

Foam::scalar Foam::rigidGroup::slipOf(const body& x, const vectorField& u)
{
    return max(mag(x.velocity + (x.angularVelocity ^ (x.X - x.centre)) - u));
}

Foam::scalar Foam::rigidGroup::fastest() const
{
    scalar speed = 0;
    for (const body& x : bodies_)
    {
        speed = max(speed, mag(x.velocity) + mag(x.angularVelocity) *
                                                 cmptMax(shape_.semiAxes()));
    }
    return speed;
}

void Foam::rigidGroup::recordSlip(const vector* U)
{
    forAll(mine(), i)
    {
        body& x = bodies_[i];
        x.slip = slipOf(x, surfaceVelocity(i, U));
        U += markers_.size();
    }
}

Foam::scalarField Foam::rigidGroup::gains(const scalar* lineDensity,
                                          const bodyStep& s) const
{
    scalarField c(overlap_.size());
    forAll(c, k)
    {
        c[k] = 1 / (overlap_[k] * lineDensity[k] * s.impulseFraction * s.dt /
                        (scene_.rho * pow3(h_)) +
                    nearMobility_);
    }
    return c;
}

Foam::rigidGroup::surroundings
Foam::rigidGroup::surround(const label i, const vector* U,
                           const scalar* lineDensity, const bodyStep& s)
{
    body& x = bodies_[i];
    surroundings around{surfaceVelocity(i, U), gains(lineDensity, s), Zero,
                        Zero};
    if (scene_.forces.actOn(name(), mine()[i]))
    {
        vectorField F(surface_.size(), Zero);
        scene_.forces.add(
            name(), mine()[i], [&]() { return points(i); }, s.time,
            scene_.effects, F);
        around.force = sum(F);
        around.torque = sum((x.turn.R() & surface_) ^ F);
    }

    // The change of the mesh's velocity only: the gains account for that of the near
    // field
    const vectorField change(x.takeVelocity(U, x.dt <= 0));
    if (!s.predicted) around.U += 0.5 * change;
    return around;
}

template<class Visit>
void Foam::rigidGroup::step(body& x, const surroundings& around,
                            const bodyStep& s, Visit visit) const
{
    const scalar fluidMass = scene_.rho * shape_.volume();
    const rigidStep::properties properties{
        densityRatio_, fluidMass, fluidMass * shape_.inertia(),
        sqr(shape_.radius()) * scene_.rho / (slowestSwirl * scene_.mu),
        meanNearMobility_};
    const vectorField r(x.X - x.expected);
    const tensor R(isSphere() ? tensor::I : x.expectedTurn.R());
    const vectorField w(R & perVolume_);
    const rigidStep step(properties, s.dt, r, around.U, around.gains, w);

    vector V, W;
    const auto load = [&](const scalar time)
    {
        if (velocity_.valid()) V = velocity_->value(time);
        if (angularVelocity_.valid()) W = angularVelocity_->value(time);
        return rigidStep::load{around.force, around.torque,
                               velocity_.valid() ? &V : nullptr,
                               angularVelocity_.valid() ? &W : nullptr};
    };
    if (x.starts) step.start(x, load(s.time - s.dt));
    visit(step, load(s.time));
}

std::vector<Foam::rigidStep::answer>
Foam::rigidGroup::freeMotions(const vector* U, const scalar* lineDensity,
                              const bodyStep& s)
{
    const auto timing(scene_.effects.time("rigid"));
    std::vector<rigidStep::answer> all;
    around_.clear();
    forAll(mine(), i)
    {
        body& x = bodies_[i];
        around_.push_back(surround(i, U, lineDensity, s));
        step(x, around_.back(), s,
             [&](const rigidStep& step, const rigidStep::load& load)
             { all.push_back(step.solve(x, x.forces, load)); });
        U += markers_.size();
        lineDensity += markers_.size();
    }
    return all;
}

Foam::string Foam::rigidGroup::move(const vector* U, const scalar* lineDensity,
                                    const bodyStep& s)
{
    const auto timing(scene_.effects.time("rigid"));
    string trouble;
    const bool known = around_.size();
    forAll(mine(), i)
    {
        body& x = bodies_[i];
        const label n = markers_.size(), number = mine()[i];
        surroundings around(known ? std::move(around_[i])
                                  : surround(i, U, lineDensity, s));
        if (!known) x.film = Zero;
        around.force += x.film;
        const vector before(x.velocity);
        const bool sameStep = mag(x.dt - s.dt) < 0.01 * s.dt;
        step(x, around, s,
             [&](const rigidStep& step, const rigidStep::load& load)
             { step.advance(x, x.forces, load); });
        x.dt = s.dt;
        x.starts = false;
        if (s.unsteady)
        {
            const string sentence(unsteady(
                number,
                s.dt * (mag(x.velocity) +
                        mag(x.angularVelocity) * cmptMax(shape_.semiAxes())),
                s.dt * mag(x.velocity + before),
                sameStep && !velocity_.valid() ? s.dt * mag(x.velocity - before)
                                               : 0,
                shape_.radius(), x.nUnsteady));
            if (s.unsteady->empty()) *s.unsteady = sentence;
        }

        // Beyond this slip the force grows without bound in a few steps
        const scalar cells = s.dt * slipOf(x, around.U) / h_;
        if (!(cells < 20))
        {
            OStringStream os;
            os << nameOfBody(mine()[i]).c_str() << " at " << x.centre
               << ": the fluid passes its surface by " << Foam::name(cells)
               << " cells in a step, limit 20; its velocity is " << x.velocity
               << ", the force on the fluid " << sum(x.forces);
            trouble = os.str();
        }
        U += n;
        lineDensity += n;
    }
    around_.clear();
    return trouble;
}
