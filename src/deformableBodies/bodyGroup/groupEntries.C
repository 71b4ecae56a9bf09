// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "groupEntries.H"
#include "periodicBox.H"
#include "placement.H"
#include "weight.H"

bool Foam::groupEntries::gravity() const
{
    const bool on = dict_.getOrDefault<bool>("gravity", false);
    if (on && scene_.g == vector::zero)
    {
        refuse(dict_, "gravity", "on",
               "off, or a file constant/g with a value");
    }
    return on;
}

void Foam::groupEntries::addWeight(const bool on, const scalar excess) const
{
    const bool acts = on && excess != 0;
    if (acts)
    {
        scene_.forces.append(
            new weight(group_, excess * scene_.rho * scene_.g));
    }
    scene_.effects.declare("gravity", acts,
                           acts ? "weight of " + group_
                           : on ? "as heavy as what is around them"
                                : "none on the bodies");
}

bool Foam::groupEntries::isSingleBody() const
{
    label nGroups = 0;
    for (const entry& e : dict_.parent())
    {
        nGroups += e.isDict();
    }
    return nGroups == 1 && !dict_.found("nucleus") &&
           dict_.found("positions") &&
           pointField(dict_.lookup("positions")).size() == 1;
}

Foam::groupEntries::nearField
Foam::groupEntries::readNearField(const string& never,
                                  const scalar errorWithout) const
{
    const word wanted(
        readWord(dict_, "nearField", {"auto", "on", "off"}, "auto"));
    string whyNot(never);
    const vector& h = scene_.grid.h();
    if (whyNot.empty() && cmptMax(h) > 1.001 * cmptMin(h))
    {
        whyNot = "cells that are not cubes";
    }
    if (whyNot.empty() && !scene_.forceAtFaces)
    {
        whyNot = "the solver takes the force as an average of each cell";
    }
    if (wanted == "on" && !whyNot.empty())
    {
        refuse(dict_, "nearField", "on", "auto or off: " + whyNot);
    }
    if (wanted == "off") whyNot = "off";
    const scalar error = scene_.accuracy.wanted;
    if (wanted == "auto" && whyNot.empty() && errorWithout >= 0 &&
        errorWithout <= 0.6 * error && isSingleBody())
    {
        whyNot = "accuracy " + Foam::name(error) + " needs none";
    }
    return {wanted == "on", wanted == "auto" && whyNot.empty(), whyNot};
}

Foam::bodyStart Foam::groupEntries::random(const solidForm& form,
                                           const scalar volume,
                                           const scalar fromCentre) const
{
    const placement placed(dict_, group_, form, volume, scene_.grid,
                           scene_.placed);
    bodyStart start{
        pointField(placed.centres() + fromCentre * placed.directions()),
        placed.directions(), true};
    for (point& x : start.positions)
    {
        x = intoBox(scene_.grid, x);
    }
    return start;
}

Foam::pointField Foam::groupEntries::positions() const
{
    const vector lo(scene_.grid.origin());
    const boundBox box(lo, lo + scene_.grid.length());
    const pointField positions(
        dict_.getOrDefault<pointField>("positions", pointField()));
    if (positions.empty())
    {
        refuse(dict_, "positions", dict_.found("positions") ? "()" : "none",
               "at least one point, ((x y z) ...), or placement { type random; "
               "number N; }");
    }
    forAll(positions, i)
    {
        if (box.contains(positions[i])) continue;
        waitForMaster();
        FatalIOErrorInFunction(dict_)
            << "entry positions: body " << i << " at " << positions[i]
            << " lies outside the box" << nl << "    allowed: points in "
            << box.min() << " to " << box.max() << exit(FatalIOError);
    }
    return positions;
}

Foam::vectorField Foam::groupEntries::directions(const label n) const
{
    if (!dict_.found("directions")) return vectorField();
    vectorField directions(dict_.lookup("directions"));
    if (directions.size() != n)
    {
        refuse(dict_, "directions", Foam::name(directions.size()) + " vectors",
               "as many as positions, " + Foam::name(n));
    }
    for (vector& t : directions)
    {
        if (!(mag(t) > 0))
        {
            refuse(dict_, "directions", "(0 0 0)",
                   "directions of any length but 0, such as (1 0 0)");
        }
        t /= mag(t);
    }
    return directions;
}

Foam::bodyStart Foam::groupEntries::start(const solidForm& form,
                                          const scalar volume,
                                          const scalar fromCentre,
                                          const vector& otherwise,
                                          const bool solid) const
{
    if (dict_.found("placement")) return random(form, volume, fromCentre);
    bodyStart start;
    start.positions = positions();
    start.directions = directions(start.positions.size());
    for (label i = 0; solid && i < start.positions.size(); ++i)
    {
        const vector t(start.directions.empty() ? otherwise
                                                : start.directions[i]);
        scene_.placed.add({form, start.positions[i] - fromCentre * t, t});
    }
    return start;
}
