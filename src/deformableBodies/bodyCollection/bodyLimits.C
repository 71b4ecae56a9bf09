// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyLimits.H"
#include "rangeCheck.H"
#include "sceneNumbers.H"

void Foam::bodyLimits::checkCorrectors(const dictionary& controls) const
{
    if (!system_.twoWay()) return;
    const scalar n = controls.getOrDefault<label>("nCorrectors", 1);
    const scalar diffusionNumber = system_.largestViscosity() *
                                   system_.mesh.time().deltaTValue() /
                                   sqr(cmptMin(system_.grid.h()));
    const scalar enough = diffusionNumber > 1.5 ? 4 : 2;
    checkRanges(
        controls,
        {{"nCorrectors", "nCorrectors", n, 0, GREAT, enough, GREAT,
          "beside bodies, at nu deltaT/h^2 = " + Foam::name(diffusionNumber) +
              ", velocity and pressure may swing until the run stops"}});
}

Foam::scalar Foam::bodyLimits::maxDeltaT(string* reason) const
{
    scalar limit = GREAT;
    for (const bodyGroup& group : system_.groups)
    {
        if (!group.twoWay() || group.maxDeltaT() >= limit) continue;
        limit = group.maxDeltaT();
        if (reason)
        {
            *reason = (group.forcing() == forcingType::none
                           ? "stiffest waves of group "
                           : "bodies lighter than the fluid in group ") +
                      group.name();
        }
    }
    return limit;
}

Foam::List<Foam::expectedErrors>
Foam::bodyLimits::errors() const
{
    List<expectedErrors> all(system_.groups.size());
    forAll(system_.groups, g)
    {
        all[g] = system_.groups[g].report().errors();
        if (usesPimple_ && system_.groups[g].twoWay())
        {
            all[g].parts.push_back(
                {"flow", 0.01, "pimple in place of staggered", nullptr});
        }
    }
    return all;
}

Foam::scalar Foam::bodyLimits::wantedDeltaT() const
{
    if (system_.empty() || system_.accuracy.wanted <= 0 ||
        !system_.adjustsStep() || !system_.solverBalances)
    {
        return GREAT;
    }
    if (wantedIsKnown_) return wantedDeltaT_;

    wantedIsKnown_ = true;
    const bool continues = wantedDeltaT_ < GREAT;
    List<expectedErrors> all(errors());
    forAll(all, g)
    {
        if (continues &&
            !returnReduce(system_.groups[g].startsAfresh(), orOp<bool>()))
        {
            continue;
        }
        wantedDeltaT_ =
            min(wantedDeltaT_, stepFor(all[g], system_.accuracy.wanted));
    }
    return wantedDeltaT_;
}

void Foam::bodyLimits::describe() const
{
    system_.effects.printEffects();
    if (system_.empty()) return;
    printSceneNumbers(system_);
    List<expectedErrors> all(errors());
    bool fresh = false;
    forAll(all, g)
    {
        if (wantedDeltaT() < GREAT) stepFor(all[g], system_.accuracy.wanted);
        fresh = fresh || system_.groups[g].startsAfresh();
    }

    // A run that was begun with an accuracy is not refused in the middle
    reduce(fresh, orOp<bool>());
    checkErrors(all, fresh ? system_.accuracy.wanted : 0,
                system_.mesh.time().constant() / "deformableBodies");
}

void Foam::bodyLimits::set(stepLimits& limits) const
{
    string group("bodies");
    const scalar stable = maxDeltaT(&group);
    limits.set("bodies", stable, group,
               stable < GREAT    ? string::null
               : system_.empty() ? string("none in the fluid")
                                 : string("stable at any step (stabilised, "
                                          "implicit or one-way)"));
    if (system_.interactions)
    {
        const scalar dt = system_.interactions->maxDeltaT();
        limits.set("contacts", dt, "forces between bodies in contact",
                   dt < GREAT ? "" : "no bodies are near each other");
    }
    const scalar accurate = wantedDeltaT();
    if (accurate < GREAT)
    {
        limits.set("accuracy", accurate, "accuracy",
                   "of constant/deformableBodies");
    }
}
