// This file is part of deformableBodies. License: GPL-3.0-or-later.

// How a capsule moves with the fluid

#include "capsuleReport.H"
#include "dictionaryChecks.H"

namespace
{
// Up to where the near field was measured to be better than none
// (tests/validation/nearField)
const Foam::scalar maxInertia = 20, maxViscosityRatio = 2;
} // namespace

void Foam::capsuleGroup::setMotion(const dictionary& dict)
{
    const membraneModel& law = membrane_->model();
    const scalar modulus = bending_ ? bending_->modulus() : 0;

    // Waves of shape and, where the area is far stiffer than the shear, waves of area
    const scalar tension = max(0.25 * (law.shearModulus() + law.areaModulus()),
                               0.5 * (law.areaModulus() - law.shearModulus()));
    stabilised_.reset(
        new stabilisedMotion(harmonics(), tension, modulus,
                             0.5 * (1 + viscosityRatio_) * scene_.mu, radius_));

    // Of Adams-Bashforth 2 and the fastest harmonic; as the mesh smooths it, at
    // least four times that is stable (tests/bench/stability), unless the near field
    // gives it back
    const scalar smoothed = 4 / stabilised_->fastest();
    maxDeltaT_ = nearField_ ? 0.5 * smoothed : smoothed;

    enum motionType
    {
        AUTO,
        EXPLICIT,
        STABILISED,
        PENALTY
    };
    const Enum<motionType> words({{AUTO, "auto"},
                                  {EXPLICIT, "explicit"},
                                  {STABILISED, "stabilised"},
                                  {PENALTY, "penalty"}});
    motionType motion = readEnum(words, dict, "motion", AUTO);
    string note("motion " + words[motion]);
    if (motion == AUTO)
    {
        // Re/Ca, whatever the rate
        const scalar inertia =
            scene_.rho * radius_ * stiffness() / sqr(scene_.mu);
        if (scene_.deltaT <= maxDeltaT_)
        {
            motion = EXPLICIT;
            note = "not needed up to deltaT = " + Foam::name(maxDeltaT_) +
                   (scene_.deltaT > 0 ? "" : ", which adjustTimeStep keeps to");
        }
        else if (inertia < 30)
        {
            motion = STABILISED;
        }
        else
        {
            motion = EXPLICIT;
            note = "too much inertia: Re/Ca = " + Foam::name(inertia) +
                   ", limit 30";
        }
    }
    const scalar thickness = dict.found("thickness")
                                 ? readPositive(dict, "thickness", dimless)
                                 : 0.01;
    if (motion != PENALTY && dict.found("thickness"))
    {
        refuse(dict, "thickness", Foam::name(thickness),
               "motion penalty; with it, the others have none");
    }
    if (motion == STABILISED)
    {
        maxDeltaT_ = GREAT;
        note = "steps larger than explicit motion bears";
    }
    else if (motion == EXPLICIT)
    {
        stabilised_.reset();
        if (nearField_ && scene_.deltaT > maxDeltaT_ && !scene_.adjusted)
        {
            const scalar step = min(scene_.deltaT, smoothed);
            const scalar degree = 8 * maxDeltaT_ / step;
            nearField_->setTaper(degree);
            nearFieldError_ = 0.015; // measured with bending at Re 10
            note += ", near field up to degree " + Foam::name(degree) +
                    " in place of 8: deltaT above " + Foam::name(maxDeltaT_);
            maxDeltaT_ = step;
        }
    }
    else if (motion == PENALTY)
    {
        stabilised_.reset();
        penalty_.reset(
            new penaltyMotion(thickness * scene_.rho * radius_, radius_));

        // Waves of area are the stiffest in the plane
        const scalar N = harmonics().degree(), bend = N * (N + 3) / radius_;
        maxDeltaT_ = penalty_->maxDeltaT(
            (law.shearModulus() + law.areaModulus()) * N * (N + 1) +
            modulus * bend * bend);
    }
    scene_.effects.declare("stabilised", bool(stabilised_), note);
    scene_.effects.declare("penalty", bool(penalty_),
                           penalty_ ? "elastic points beside those of the fluid"
                                    : "motion " + words[motion]);
}

// What is known of its limits: doc/choosing.md
void Foam::capsuleGroup::setNearField(const dictionary& dict,
                                      const scalar extent)
{
    string never;
    if (!twoWay())
        never = "coupling oneWay: no load acts on the fluid";
    else if (dict.getOrDefault<word>("motion", "auto") == "penalty")
        never = "motion penalty";
    const groupEntries::nearField entry(
        groupEntries(name(), dict, scene_)
            .readNearField(never, report_->errorOfCells(false)));

    // Where it is not known to be better
    const scalar h = scene_.grid.h().x();
    const scalar inertia =
        scene_.rho * stiffness() * sqr(h / scene_.mu) / radius_;
    string unknown;
    if (inertia > maxInertia)
        unknown = "rho K h^2/(mu^2 a) = " + Foam::name(inertia) +
                  " (K: Gs, or a third of the area modulus), known up to " +
                  Foam::name(maxInertia);
    else if (viscosityRatio_ > maxViscosityRatio)
        unknown = "viscosityRatio " + Foam::name(viscosityRatio_) +
                  ", known up to " + Foam::name(maxViscosityRatio);

    const bool on = entry.on || (entry.automatic && unknown.empty());
    string note(entry.whyNot.empty() ? unknown : entry.whyNot);
    if (on)
    {
        nearField_.reset(new capsuleNearField(
            harmonics().degree(), scene_.kernel.type(), h, scene_.mu, extent));
        nearField_->setInertia(scene_.mu / scene_.rho, radius_);
        nearFieldKnown_ = unknown.empty();
        note = Foam::name(nearField_->nPoints()) + " points" +
               (unknown.empty() ? string("") : "; beyond what is known: ") +
               unknown;
    }
    scene_.effects.declare("nearField", on, note);
}

void Foam::capsuleGroup::volumeGradient(const numbers& x, numbers& g) const
{
    membrane_->harmonics().gradient(x.data(), xt_.data(), xp_.data());
    volumeGradient(xt_, xp_, g);
}

void Foam::capsuleGroup::volumeGradient(const numbers& xt, const numbers& xp,
                                        numbers& g) const
{
    const sphericalHarmonics& grid = membrane_->harmonics();
    const label n = grid.nPoints();
    g.resize(coeffs_.size());
    for (label k = 0; k < n; ++k)
    {
        for (label c = 0; c < 3; ++c)
        {
            const label a = ((c + 1) % 3) * n + k, b = ((c + 2) % 3) * n + k;
            onGrid_[c * n + k] = xt[a] * xp[b] - xt[b] * xp[a];
        }
    }
    grid.analysis(onGrid_.data(), g.data());
}

Foam::string Foam::capsuleGroup::move(const vector* U, const scalar*,
                                      const bodyStep& s)
{
    const scalar dt = s.dt;
    const auto timing(scene_.effects.time("membrane"));
    const label n = markers_->size();
    numbers velocity(coeffs_.size());
    vectorField F(nearField_ ? n : 0);
    string trouble;

    for (size_t i = 0; i < capsules_.size(); ++i, U += n)
    {
        capsule& c = capsules_[i];
        markers_->analysis(U, velocity.data());
        if (nearField_)
        {
            const auto timing(scene_.effects.time("nearField"));
            if (c.onFluid.empty())
            {
                forcesOnFluid(i, s.time - dt, F.data());
                nearLoad(c, F.cdata());
                setNearSources(c);
            }
            nearField_->add(
                c.x.data(), c.onFluid.data(), velocity.data(), c.nearMemory,
                c.lastDeltaT > 0 ? c.lastDeltaT : dt,
                [&](const std::vector<vector>& X, std::vector<vector>& u)
                { Foam::add(corrections_, i, X.data(), X.size(), u.data()); });
        }

        // Zero net flow through the membrane, int U.n dS = 0: the change of
        // the enclosed volume is g.v
        const numbers& g = c.volumeGradient;
        double gv = 0, gg = 0;
        for (size_t j = 0; j < g.size(); ++j)
        {
            gv += g[j] * velocity[j];
            gg += g[j] * g[j];
        }
        const double r = c.lastDeltaT > 0 ? dt / c.lastDeltaT : 0;
        bool finite = true;
        for (size_t j = 0; j < g.size(); ++j)
        {
            velocity[j] -= gv / gg * g[j];
            const double step =
                dt * ((1 + 0.5 * r) * velocity[j] - 0.5 * r * c.velocity[j]);
            finite = finite && std::abs(step) < GREAT;
            coeffs_[j] = c.x[j] + step;
        }
        if (stabilised_ && finite)
        {
            const auto timing(scene_.effects.time("stabilised"));
            stabilised_->apply(
                c.x, c.previous, coeffs_, dt, r, referenceVolume_,
                [&](const numbers& x, numbers& dV) { volumeGradient(x, dV); },
                harmonics());
        }

        for (size_t j = 0; j < filter_.size(); ++j)
        {
            coeffs_[j] *= filter_[j];
        }

        // The last good state stays in place where the new one is none. What is
        // checked has the derivatives on the grid
        const string wrong(finite ? check(coeffs_)
                                  : string("marker velocity is not finite"));
        if (!wrong.empty())
        {
            trouble = nameOfBody(mine()[i]) + ": " + wrong;
            startAt(c);
            continue;
        }
        volumeGradient(membrane_->xTheta(), membrane_->xPhi(),
                       c.volumeGradient);
        if (penalty_)
        {
            const auto timing(scene_.effects.time("penalty"));
            numbers elastic(c.x);
            for (size_t j = 0; j < elastic.size(); ++j)
            {
                elastic[j] += c.lag[j];
            }
            load(elastic, c.load);
            penalty_->apply(c.lag, c.lagBefore, c.load, dt, r);
        }
        if (stabilised_) c.previous = c.x;
        moveTo(c, coeffs_);
        if (!penalty_ && twoWay()) load(c.xMid, c.load);
        c.velocity = velocity;
        c.lastDeltaT = dt;
    }
    return trouble;
}

void Foam::capsuleGroup::startAt(capsule& c) const
{
    c.xMid = c.x;
    c.markers.setSize(markers_->size());
    markers_->values(c.x.data(), c.markers.data());
    c.markersMid = c.markers;
    volumeGradient(c.x, c.volumeGradient);
    c.load.resize(c.x.size());
    if (!penalty_ && twoWay()) load(c.x, c.load);
    setNearSources(c);
}

void Foam::capsuleGroup::moveTo(capsule& c, const numbers& x) const
{
    for (size_t j = 0; j < x.size(); ++j)
    {
        c.xMid[j] = 0.5 * (c.x[j] + x[j]);
    }
    c.x = x;
    c.markersMid = c.markers;
    markers_->values(c.x.data(), c.markers.data());
    c.markersMid = 0.5 * (c.markersMid + c.markers);
}

Foam::string Foam::capsuleGroup::check(const numbers& x) const
{
    const membrane::extremes e(membrane_->stretches(x.data()));
    if (!(e.stretch < 50))
    {
        return "largest stretch " + Foam::name(e.stretch) + ", limit 50";
    }
    if (!(e.area > 0.01))
    {
        const sphericalHarmonics& grid = membrane_->harmonics();
        const label n = grid.nPoints();
        grid.values(x.data(), onGrid_.data());
        OStringStream where;
        where << vector(onGrid_[e.where], onGrid_[n + e.where],
                        onGrid_[2 * n + e.where]);
        return "the membrane collapses at " + where.str() + ": its area is " +
               Foam::name(e.area) + " of the stress-free one, limit 0.01";
    }
    return "";
}

Foam::scalar Foam::capsuleGroup::maxDeltaT() const
{
    return maxDeltaT_;
}
