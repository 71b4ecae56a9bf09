// This file is part of deformableBodies. License: GPL-3.0-or-later.

// How the capsules of a group move with the fluid, and their forces on it

#include "capsuleGroup.H"
#include "stepRatio.H"

namespace
{
using namespace Foam;
using coefficients = capsule::coefficients;

//- Change the velocity v so that the enclosed volume comes back to `volume`, by a tenth of
//  what it lacks in a step: INT v.n dS = g.v, with g the gradient of the volume
void keepVolume(const capsule& c, const scalar volume, const scalar dt,
                coefficients& v)
{
    const coefficients& g = c.volumeGradient;
    double gv = 0, gg = 0;
    for (size_t j = 0; j < g.size(); ++j)
    {
        gv += g[j] * v[j];
        gg += g[j] * g[j];
    }
    gv -= 0.1 * (volume - c.volume()) / dt;
    for (size_t j = 0; j < g.size(); ++j)
    {
        v[j] -= gv / gg * g[j];
    }
}

//- Restore the volume of a shape along its gradient g, if it is off by more than 1e-4, as after
//  a large first step
bool restoreVolume(const coefficients& g, const scalar volume, coefficients& x)
{
    double now = 0, gg = 0;
    for (size_t j = 0; j < g.size(); ++j)
    {
        now += g[j] * x[j] / 3;
        gg += g[j] * g[j];
    }
    if (!(mag(volume - now) > 1e-4 * volume)) return false;
    for (size_t j = 0; j < g.size(); ++j)
    {
        x[j] += (volume - now) / gg * g[j];
    }
    return true;
}

//- Coefficients of the shape after dt, by Adams-Bashforth 2: x + dt ((1 + r/2) v - r/2 v_last).
//  v: velocity; r: dt over the last step. False if some are not finite
bool extrapolate(const capsule& c, const coefficients& v, const scalar dt,
                 const double r, coefficients& next)
{
    bool finite = true;
    for (size_t j = 0; j < next.size(); ++j)
    {
        const double step =
            dt * ((1 + 0.5 * r) * v[j] - 0.5 * r * c.velocity[j]);
        finite = finite && std::abs(step) < GREAT;
        next[j] = c.x[j] + step;
    }
    return finite;
}
} // namespace

void Foam::capsuleGroup::addNearField(const label i, const bodyStep& s,
                                      coefficients& velocity)
{
    const auto timing(scene_.effects.time("nearField"));
    capsule& c = capsules_[i];
    if (c.onFluid.empty())
    {
        vectorField F(markers_->size());
        forcesOnFluid(i, s.time - s.dt, F.data());
        nearLoad(c, F.cdata());
        setNearSources(c);
    }
    nearField_->add(c.x.data(), c.onFluid.data(), velocity.data(), c.nearMemory,
                    c.lastDeltaT > 0 ? c.lastDeltaT : s.dt,
                    [&](std::vector<vector>& u)
                    { addExchanged(i, u.size(), u.data()); });
}

Foam::string Foam::capsuleGroup::move(const vector* U, const scalar*,
                                      const bodyStep& s)
{
    const scalar dt = s.dt;
    const auto timing(scene_.effects.time("membrane"));
    const label n = markers_->size();
    coefficients next(initial_.size()), velocity(next.size());
    string trouble;

    for (size_t i = 0; i < capsules_.size(); ++i, U += n)
    {
        capsule& c = capsules_[i];
        markers_->analysis(U, velocity.data());
        if (nearField_) addNearField(i, s, velocity);
        keepVolume(c, referenceVolume_, dt, velocity);
        const double r = stepRatio(dt, c.lastDeltaT);
        const bool finite = extrapolate(c, velocity, dt, r, next);
        if (finite) motion_->correct(c, next, dt, r, referenceVolume_);
        for (size_t j = 0; j < filter_.size(); ++j)
        {
            next[j] *= filter_[j];
        }
        if (finite && twoWay()) relaxHighest(next, dt);

        // A capsule that fails keeps its last state. check() leaves the derivatives of a
        // good shape on the grid
        string wrong(finite ? shell_->check(next)
                            : string("marker velocity is not finite"));
        if (wrong.empty())
        {
            shell_->volumeGradientLast(c.volumeGradient);
            if (restoreVolume(c.volumeGradient, referenceVolume_, next))
            {
                wrong = shell_->check(next);
                shell_->volumeGradientLast(c.volumeGradient);
            }
        }
        if (!wrong.empty())
        {
            trouble = nameOfBody(mine()[i]) + ": " + wrong;
            startAt(c);
            continue;
        }
        motion_->beforeMove(c, dt);
        const scalar displacement = moveTo(c, next);
        if (twoWay()) motion_->setLoad(c);
        if (s.unsteady)
        {
            const string sentence(unsteady(i, displacement, velocity, dt));
            if (s.unsteady->empty()) *s.unsteady = sentence;
        }
        c.velocity = velocity;
        c.lastDeltaT = dt;
    }
    return trouble;
}

Foam::scalar Foam::capsuleGroup::shareOfHighest(const coefficients& x) const
{
    scalar all = 0, highest = 0;
    for (size_t i = 0; i < x.size(); ++i)
    {
        const int n = harmonics().degreeOf(i / 3);
        if (n > 0) all += sqr(x[i]);
        if (n >= harmonics().degree() - 1) highest += sqr(x[i]);
    }
    return std::sqrt(highest / all);
}

void Foam::capsuleGroup::relaxHighest(coefficients& x, const scalar dt) const
{
    const scalar share = shareOfHighest(x), N = harmonics().degree();
    if (share <= relaxesAbove_ || N < 2 * radius_ / cmptMax(scene_.grid.h()))
        return;
    const scalar ratio = viscosityRatio_ / scene_.viscosityAround;
    const scalar mu = 0.5 * (1 + ratio) * scene_.mu;
    const scalar rate = shell_->model().shearModulus() * N * (N + 1) /
                        ((2 * N + 1) * mu * radius_);
    const scalar s = dt * rate * (1 - sqr(relaxesAbove_ / share));
    for (size_t i = 0; i < x.size(); ++i)
    {
        x[i] *= std::exp(-s * std::pow(harmonics().degreeOf(i / 3) / N, 8));
    }
}

void Foam::capsuleGroup::startAt(capsule& c) const
{
    c.xMid = c.x;
    c.markers.setSize(markers_->size());
    markers_->values(c.x.data(), c.markers.data());
    c.markersMid = c.markers;
    shell_->volumeGradient(c.x, c.volumeGradient);
    if (twoWay()) motion_->start(c);
    setNearSources(c);
}

// By the harmonics of degree 1 and higher: without translation
Foam::string Foam::capsuleGroup::unsteady(const label i,
                                          const scalar displacement,
                                          const coefficients& velocity,
                                          const scalar dt)
{
    capsule& c = capsules_[i];
    const scalar change = c.volume() / referenceVolume_ - 1;
    if (!(mag(change) < 0.01))
    {
        return nameOfBody(mine()[i]) + " has changed its volume by " +
               Foam::name(100 * change) + " %, limit 1 %";
    }
    scalar sum = 0, difference = 0;
    const bool sameStep = mag(c.lastDeltaT - dt) < 0.01 * dt;
    for (size_t j = 3; j < velocity.size() && sameStep; ++j)
    {
        sum += sqr(velocity[j] + c.velocity[j]);
        difference += sqr(velocity[j] - c.velocity[j]);
    }
    const scalar rms = dt / std::sqrt(4 * constant::mathematical::pi);
    return bodyGroup::unsteady(mine()[i], displacement, rms * std::sqrt(sum),
                               rms * std::sqrt(difference), radius_,
                               c.nUnsteady);
}

Foam::scalar Foam::capsuleGroup::moveTo(capsule& c, const coefficients& x) const
{
    for (size_t j = 0; j < x.size(); ++j)
    {
        c.xMid[j] = 0.5 * (c.x[j] + x[j]);
    }
    c.x = x;
    c.markersMid = c.markers;
    markers_->values(c.x.data(), c.markers.data());
    const scalar displacement = max(mag(c.markers - c.markersMid));
    c.markersMid = 0.5 * (c.markersMid + c.markers);
    return displacement;
}

void Foam::capsuleGroup::loads(vector* X, vector* F, const scalar time) const
{
    const auto timing(scene_.effects.time("membrane"));
    const label n = markers_->size();
    forAll(mine(), i)
    {
        const capsule& c = capsules_[i];
        std::copy(c.markersMid.begin(), c.markersMid.end(), X);
        forcesOnFluid(i, time, F);
        X += n;
        F += n;
    }
}

void Foam::capsuleGroup::recordLoads(const vector* F)
{
    if (!nearField_) return;
    const auto timing(scene_.effects.time("membrane"));
    for (capsule& c : capsules_)
    {
        nearLoad(c, F);
        setNearSources(c);
        F += markers_->size();
    }
}

void Foam::capsuleGroup::forcesOnFluid(const label i, const scalar time,
                                       vector* F) const
{
    const capsule& c = capsules_[i];
    const label n = markers_->size();
    markers_->values(c.load.data(), F);
    for (label k = 0; k < n; ++k)
    {
        F[k] *= -markers_->weight(k);
    }
    if (!scene_.forces.actOn(name(), mine()[i])) return;
    vectorField more(n, Zero);
    scene_.forces.add(
        name(), mine()[i], [&]() { return points(i); }, time, scene_.effects,
        more);
    for (label k = 0; k < n; ++k)
    {
        F[k] += more[k];
    }
}

std::vector<Foam::vector>
Foam::capsuleGroup::nearDirections(const label n) const
{
    return nearField_->directions(n);
}

Foam::nearSurface::sources
Foam::capsuleGroup::nearSourcesOf(const label i) const
{
    return capsules_[i].near;
}

void Foam::capsuleGroup::setNearSources(capsule& c) const
{
    if (!nearField_ || !exchanges() || c.onFluid.empty()) return;
    nearField_->forces(c.x.data(), c.onFluid.data(), c.near.X, c.near.F);
}

// Forces have the solid angles in them, and the opposite sign of loads
void Foam::capsuleGroup::nearLoad(capsule& c, const vector* F) const
{
    coefficients now;
    shell_->load(c.x, now);
    c.onFluid.resize(now.size());
    markers_->valuesAdjoint(F, c.onFluid.data());
    for (size_t j = 0; j < now.size(); ++j)
    {
        c.onFluid[j] += 0.5 * (c.load[j] - now[j]);
    }
}
