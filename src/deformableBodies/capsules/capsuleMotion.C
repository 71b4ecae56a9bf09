// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsuleMotion.H"
#include "capsuleNearField.H"
#include "dictionaryChecks.H"
#include "Enum.H"
#include "penaltyMotion.H"
#include "stabilisedMotion.H"

namespace
{
using namespace Foam;

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

//- Largest inertia Re/Ca, whatever the rate, that stabilised motion bears
const scalar maxInertia = 30;

//- Motion by steps and inertia, and the reason
motionType automatic(const bodyScene& scene,
                     const stabilisedMotion::waves& waves,
                     const scalar explicitLimit, string& note)
{
    // The motion that allows the larger step is the cheaper one
    if (max(scene.deltaT, scene.flowDeltaT) <= explicitLimit)
    {
        note = "not needed up to deltaT = " + Foam::name(explicitLimit) +
               (scene.deltaT > 0 ? "" : ", which adjustTimeStep keeps to");
        return EXPLICIT;
    }
    const scalar inertia = waves.inertia();
    if (inertia < maxInertia) return STABILISED;
    note = "too much inertia: Re/Ca = " + Foam::name(inertia) +
           " by the stiffest modulus over the viscosity ratio, limit " +
           Foam::name(maxInertia);
    return EXPLICIT;
}

//- Above its limit, explicit motion bears a step up to `smoothed` with fewer degrees of
//  the near field
scalar reduceNearField(capsuleNearField& nearField, const scalar limit,
                       const scalar smoothed, const scalar deltaT, string& note)
{
    const scalar step = min(deltaT, smoothed);
    const label full = capsuleNearField::fullDegree;
    const scalar degree = full * limit / step;
    nearField.setTaper(degree);
    note += ", near field up to degree " + Foam::name(degree) +
            " in place of " + Foam::name(full) + ": deltaT above " +
            Foam::name(limit);
    return step;
}
} // namespace

std::unique_ptr<Foam::capsuleMotion>
Foam::capsuleMotion::New(const dictionary& dict, const setting& s,
                         const bodyScene& scene, capsuleNearField* nearField)
{
    // Limit of Adams-Bashforth 2 for the fastest harmonic. The mesh smooths that
    // harmonic, which makes at least four times the limit stable
    // (tests/bench/stability); half of it where the near field undoes the smoothing
    const stabilisedMotion::waves waves(s);
    const scalar smoothed = 4 / waves.fastest();
    scalar limit = s.passive ? GREAT : nearField ? 0.5 * smoothed : smoothed;

    motionType motion = readEnum(words, dict, "motion", AUTO);
    string note("motion " + words[motion]);
    if (s.passive && motion != AUTO && motion != EXPLICIT)
    {
        refuse(
            dict, "motion", words[motion],
            "auto or explicit with coupling oneWay: the fluid takes no load");
    }
    if (s.passive) note = "the capsules move with the fluid";
    if (motion == AUTO && !s.passive)
        motion = automatic(scene, waves, limit, note);
    const word name(words[motion]);

    const scalar thickness = dict.found("thickness")
                                 ? readPositive(dict, "thickness", dimless)
                                 : 0.01;
    if (motion != PENALTY && dict.found("thickness"))
    {
        refuse(dict, "thickness", Foam::name(thickness),
               "motion penalty; with it, the others have none");
    }
    std::unique_ptr<capsuleMotion> selected;
    if (motion == STABILISED)
    {
        note = "steps larger than explicit motion bears";
        selected.reset(new stabilisedMotion(s, waves));
    }
    else if (motion == PENALTY)
    {
        selected.reset(new penaltyMotion(s, thickness * scene.rho * s.radius));
    }
    else
    {
        if (nearField && scene.deltaT > limit && !scene.adjusted)
        {
            limit = reduceNearField(*nearField, limit, smoothed, scene.deltaT,
                                    note);
        }
        selected.reset(new capsuleMotion(s.shell, limit));
    }
    scene.effects.declare("stabilised", motion == STABILISED, note);
    scene.effects.declare("penalty", motion == PENALTY,
                          motion == PENALTY
                              ? "elastic points beside those of the fluid"
                              : "motion " + name);
    return selected;
}

void Foam::capsuleMotion::start(capsule& c) const
{
    shell_.load(c.x, c.load);
}

void Foam::capsuleMotion::setLoad(capsule& c) const
{
    shell_.load(c.xMid, c.load);
}
