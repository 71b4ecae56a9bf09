// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactLoad.H"
#include "bodyGroup.H"
#include "mathematicalConstants.H"

namespace
{
using namespace Foam;
const scalar pi = constant::mathematical::pi;

//- Weight and loads of the first body of a group [N]: largest at 101 times of the run, which
//  have no period in common with a load (golden ratio)
scalar weightAndLoads(const bodyPoints& p, const word& group,
                      const bodyScene& scene)
{
    scalar largest = 0;
    for (label i = 0; i <= 100 && scene.forces.actOn(group, 0); ++i)
    {
        vectorField F(p.positions.size(), Zero);
        scene.forces.add(
            group, 0, [&]() { return p; },
            scene.startTime +
                (0.61803399 * i - label(0.61803399 * i)) * scene.duration,
            scene.effects, F);
        largest = max(largest, max(mag(sum(F)), 0.5 * sum(mag(F))));
    }
    return largest;
}
} // namespace

Foam::contactLoad Foam::contactLoad::of(const PtrList<bodyGroup>& groups,
                                        const label g, const bodyScene& scene)
{
    const bodyGroup& group = groups[g];
    const bodyPoints p(group.points(-1));
    contactLoad load{p.isSurface(), 0, 0, 0, 0, 0, 0, GREAT, ""};
    scalar volume, size, square; // drag = load.drag U + square U^2
    if (p.isSurface())
    {
        volume = sum(p.positions & p.areas) / 3;
        size = load.radius = std::cbrt(0.75 * volume / pi);
        load.drag = 6 * pi * scene.mu * size;
        square = 0.2 * pi * scene.rho * sqr(size);
        load.mass = (p.densityRatio + 0.5) * scene.rho * volume;
        for (label soft = g; soft >= 0; soft = groups[soft].host())
        {
            const scalar stiffness = groups[soft].points(-1).stiffness;
            if (stiffness < GREAT)
                load.softness = min(load.softness, stiffness / size);
        }
    }
    else
    {
        const scalar L = sum(p.lengths);
        load.radius = std::sqrt(p.crossSection / pi);
        volume = p.crossSection * L;
        size = 0.5 * L;
        load.drag = 4 * pi * scene.mu * L /
                    (std::log(max(L / load.radius, scalar(3))) + 0.193);
        square = scene.rho * load.radius * L;
        load.mass = (p.densityRatio + 1) * scene.rho * volume;
    }

    // A restart goes on with the load of the first start, unless loads have grown
    scalar& own = scene.firstLoads(group.name(), 0);
    const scalar now = weightAndLoads(p, group.name(), scene);
    if (now > 1.1 * own)
    {
        own = now;
    }
    else if (own > 1.1 * now)
    {
        Info << "Contacts of group " << group.name()
             << " keep the load of the first start, " << Foam::name(own)
             << " N, now " << Foam::name(now) << " N" << endl;
    }
    load.own = own;
    const flowScales& flow = scene.flow;
    const scalar most = flow.speed > 0 ? flow.speed : GREAT;
    const scalar byFlow = flow.rate > 0    ? min(flow.rate * size, most)
                          : flow.speed > 0 ? flow.speed
                          : load.own > 0   ? 0
                                           : scene.mu / (scene.rho * size);
    load.force = load.own + load.drag * byFlow + square * sqr(byFlow);
    const scalar falling =
        (std::sqrt(sqr(load.drag) + 4 * square * load.own) - load.drag) /
        (2 * square);
    load.speed = byFlow + (load.isSurface ? 1 : 2) * falling;
    OStringStream os;
    os.precision(3);
    os << group.name().c_str() << ": weight and loads " << load.own
       << " N, flow " << load.force - load.own << " N, speed " << load.speed
       << " m/s";
    load.reason = os.str();
    return load;
}
