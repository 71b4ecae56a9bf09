// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "repulsion.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"

namespace Foam
{
defineTypeNameAndDebug(repulsion, 0);
addToRunTimeSelectionTable(contactForce, repulsion, dictionary);
} // namespace Foam

namespace
{
using namespace Foam;
const scalar pi = constant::mathematical::pi;

//- S with which a sphere on a plane, on which it exerts 2 pi a int P, stops within a
//  quarter of the range, and carries its load at half the range (Morse)
contactStrength strengthFor(const contactLoad& load,
                            const interactionScene& scene, const scalar range)
{
    const scalar a = load.radius;
    scalar S = (load.force / 0.81 + 1.5 * load.energy() / range) / (a * range);
    string reason(load.reason);

    // Membranes give way until their own stress carries the load
    const scalar soft = max(20 * load.softness, load.own / (pi * sqr(a)));
    if (soft < S)
    {
        S = soft;
        reason = "20 Gs/a";
    }

    // F = 2 pi a P R/6 at high loads, and 2 pi a P is its stiffness
    const scalar dt = scene.deltaT;
    const scalar most = max((2 * load.own + load.force) / (a * range),
                            0.5 * (load.mass / dt + load.drag) / (pi * a * dt));
    return {S, reason, nullptr, most};
}

contactLaw lawOf(const dictionary& dict, const interactionScene& scene)
{
    if (scene.softest == 0)
    {
        refuse(dict.parent(), "repulsion", "{...}",
               "scenes with capsules or rigid bodies that act on the fluid; "
               "between fibres collision and lubrication act");
    }
    for (const contactLoad& load : scene.loads)
    {
        if (!load.isSurface || load.softness < GREAT) continue;
        if (load.stokesNumber() <= 10) continue;
        IOWarningInFunction(dict)
            << "bodies strike others or walls at Stokes numbers up to "
            << load.stokesNumber() << " (" << load.reason.c_str() << ')' << nl
            << "    Above 10 they rebound. How far depends on this contact and "
               "on deltaT, as the film of fluid that damps it is not resolved"
            << endl;
    }
    const auto strength = [&](const scalar range)
    {
        contactStrength all{0, "20 Gs/a", scene.deltaTOf(true, range), 0};
        for (const contactLoad& load : scene.loads)
        {
            if (!load.isSurface) continue;
            const contactStrength s(strengthFor(load, scene, range));
            all.most = max(all.most, s.most);
            if (s.value <= all.value) continue;
            all.value = s.value;
            all.reason = s.reason;
        }
        if (all.value == 0) all.value = 20 * scene.softest;
        if (all.most == 0) all.most = GREAT;
        return all;
    };

    // At 0.6 h some membranes of a fifth of the volume cross. Nuclei sink into soft ones, of
    // Ca_G = force/(6 pi Gs a) above 1
    bool light = true, fast = false;
    for (const contactLoad& load : scene.loads)
    {
        fast = fast || load.stokesNumber() > 10;
        if (!load.isSurface) continue;
        const scalar soft = 6 * pi * load.softness * sqr(load.radius);
        light = light && load.own == 0 && load.force < soft;
    }
    const scalar cells = scene.films                   ? (fast ? 1 : 0.6)
                         : !scene.nearField            ? 1.5
                         : scene.share < 0.05 && light ? 0.6
                                                       : 1;
    return contactLaw(dict, scene.grid, cells * cmptMax(scene.grid.h()),
                      strength, dimPressure, scene.adjusted ? 0 : scene.deltaT,
                      0.25 * scene.mu / scene.deltaT);
}
} // namespace

Foam::repulsion::repulsion(const dictionary& dict,
                           const interactionScene& scene)
    : law_(lawOf(dict, scene)),
      thickest_(scene.thickest),
      description_(law_.describe("Pa", scene.grid))
{
    tabulate();
}

void Foam::repulsion::tabulate()
{
    table_.setSize(2000);
    forAll(table_, i)
    {
        const scalar r = law_.range() * std::sqrt(i / (table_.size() - 1.0));
        table_[i] = between(r, r) / max(r, 0.01 * law_.range());
    }
}

Foam::scalar Foam::repulsion::between(const scalar apart,
                                      const scalar gap) const
{
    // Elements that are closer feel the force at this gap
    const scalar d = max(gap, 0.05 * law_.range());
    return law_.between(max(apart, d), d);
}

void Foam::repulsion::add(const closePairs& pairs,
                          const UList<interactingPoint>& points,
                          pairForces& forces) const
{
    const scalar perSquare = (table_.size() - 1) / sqr(law_.range());
    for (const closePairs::pair& p : pairs.pairs())
    {
        const scalar t = points[p.first].radius + points[p.second].radius;
        scalar perDistance; // f/r
        if (t == 0)
        {
            const scalar at = perSquare * magSqr(p.r);
            const label i = label(at);
            if (i + 1 >= table_.size()) continue;
            perDistance = table_[i] + (at - i) * (table_[i + 1] - table_[i]);
        }
        else
        {
            // Not between two fibres
            if (points[p.first].radius > 0 && points[p.second].radius > 0)
            {
                continue;
            }
            const scalar apart = mag(p.r);
            perDistance =
                between(apart, apart - t) / max(apart, SMALL * law_.range());
        }
        forces.add(
            p, perDistance * points[p.first].size * points[p.second].size * p.r,
            law_.steepness(mag(p.r) - t));
    }
}
