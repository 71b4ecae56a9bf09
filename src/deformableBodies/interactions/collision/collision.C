// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "collision.H"
#include "addToRunTimeSelectionTable.H"

namespace Foam
{
defineTypeNameAndDebug(collision, 0);
addToRunTimeSelectionTable(contactForce, collision, dictionary);
} // namespace Foam

namespace
{
using namespace Foam;

contactLaw lawOf(const dictionary& dict, const interactionScene& scene)
{
    const scalar h = cmptMax(scene.grid.h());
    scene.needFibres(dict.parent(), "collision");
    const scalar borne = 0.25 * scene.mu * sqr(h) / scene.deltaT;

    // A fibre that crosses another stops within a quarter of the range, and rests at half
    // the range, or at a twentieth where the flow presses with all its drag (Morse). Drag
    // leaves coast/(coast + R) of its energy. The step bears R (m/dt + c)/(3 dt) with a
    // quarter of mass and drag (see contactLoad::borne): all of it stops a fibre, a quarter
    // holds several contacts at once
    const auto strength = [&](const scalar range)
    {
        contactStrength all{0, "mu h^2/(4 deltaT)",
                            scene.deltaTOf(false, range), 0};
        for (const contactLoad& load : scene.loads)
        {
            if (load.isSurface) continue;
            const scalar byFlow = load.force - load.own, dt = scene.deltaT;
            const scalar coast = load.mass * load.speed / load.drag;
            const scalar stopping =
                1.3 * load.energy() / (coast + range) * (coast / range);
            const scalar bears =
                range * (load.mass / dt + load.drag) / (12 * dt);
            all.most = max(
                all.most, max(3 * load.own + byFlow,
                              max(0.25 * bears, min(3 * stopping, bears))));
            const scalar S = load.own + byFlow / 20 + stopping;
            if (S <= all.value) continue;
            all.value = S;
            all.reason = load.reason;
        }
        if (all.value == 0) all.value = borne;
        if (all.most == 0) all.most = GREAT;
        return all;
    };
    return contactLaw(dict, scene.grid, h, strength, dimForce,
                      scene.adjusted ? 0 : scene.deltaT, borne);
}
} // namespace

Foam::collision::collision(const dictionary& dict,
                           const interactionScene& scene)
    : h_(cmptMax(scene.grid.h())),
      thickest_(scene.thickest),
      law_(lawOf(dict, scene)),
      description_(law_.describe("N", scene.grid))
{
}

void Foam::collision::add(const closePairs& pairs,
                          const UList<interactingPoint>& points,
                          pairForces& forces) const
{
    for (const closePairs::pair& p : pairs.pairs())
    {
        const scalar a = points[p.first].radius, b = points[p.second].radius;
        if (a == 0 || b == 0) continue;
        const scalar r = mag(p.r), gap = r - a - b;
        if (gap >= law_.range() || r == 0) continue;
        const scalar lengths =
            points[p.first].size * points[p.second].size / sqr(h_);

        // Fibres that are closer feel the force at this distance
        const scalar least = 0.5 * (a + b);
        const scalar f = law_.between(max(r, least), max(gap, least - a - b));
        forces.add(p, f * lengths / max(r, SMALL * h_) * p.r);
    }
}

Foam::scalar Foam::collision::ofWall(const scalar distance,
                                     const bool surface) const
{
    return surface ? 0 : law_.at(distance) / sqr(h_);
}
