// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyMotion.H"
#include "directForcing.H"

namespace
{
Foam::scalar impulseFractionOf(const Foam::forcingType forcing,
                               const Foam::scalar diffusionNumber)
{
    return forcing == Foam::forcingType::ofLines
               ? Foam::impulseFractionOfLine(diffusionNumber)
               : Foam::impulseFractionOfSurface(diffusionNumber);
}

//- Add a force to all faces of this rank in each direction
void addUniform(const Foam::vector& force, const Foam::labelVector& n,
                const Foam::staggeredTarget& field)
{
    using namespace Foam;
    for (direction d = 0; d < 3; ++d)
    {
        for (label k = 0; k < n.z(); ++k)
        {
            for (label j = 0; j < n.y(); ++j)
            {
                scalar* row = field.first[d] + k * field.layer + j * field.row;
                for (label i = 0; i < n.x(); ++i)
                {
                    row[i] += force[d];
                }
            }
        }
    }
}
} // namespace

void Foam::bodyMotion::moveWithVelocity(const staggeredView& u,
                                        staggeredField& force)
{
    const Time& time = system_.mesh.time();
    label nActing;
    const labelList groups(system_.groupsOf(forcingType::none, &nActing));
    const SubList<label> acting(groups, nActing),
        following(groups, groups.size() - nActing, nActing);
    markerValues markers;
    if (!system_.withoutFluid && groups.size())
    {
        const scalar dt = time.deltaTValue();
        markers = collect(groups, dt);
        const auto timing(system_.effects.time("interpolation"));
        system_.markers->interpolate({u}, markers.U);
    }
    if (system_.contrast) updateViscosity(groups);
    const bodyStep step{time.value(), time.deltaTValue(), false, 1,
                        &trouble_.unsteady};
    move(acting, markers, 0, step);
    if (trouble_.any) return;
    if (system_.interactions) system_.interactions->update();
    move(following, markers, system_.nMarkers(acting), step);
    if (trouble_.any) return;

    const bodySystem::markerLoads loads(system_.loads(groups));
    const vector* F = loads.F.cdata();
    for (const label g : groups)
    {
        if (!system_.groups[g].twoWay()) continue;
        system_.groups[g].recordLoads(F);
        F += system_.groups[g].nMarkers();
    }
    if (!returnReduce(loads.X.size(), maxOp<label>())) return;
    const auto spreading(system_.effects.time("spreading"));
    system_.markers->setPositions(loads.X);
    spread(loads.F, groups, force);
}

void Foam::bodyMotion::moveWithPrediction(const velocityPrediction& p)
{
    const labelList lines(system_.groupsOf(forcingType::ofLines));
    const labelList surfaces(system_.groupsOf(forcingType::ofSurfaces));
    labelList groups(lines);
    groups.append(surfaces);
    if (trouble_.any) return;
    if (groups.empty())
    {
        addForceByHeld(p);
        return;
    }

    // A prediction has the forces of the last step at the present markers, and those of
    // the lines in this step once they have moved
    const Time& time = system_.mesh.time();
    markerValues markers(collect(groups, time.deltaTValue()));
    vectorField before(markers.X.size(), Zero);
    const auto change = [&]()
    {
        vectorField F(system_.loads(groups).F), difference(F - before);
        before.transfer(F);
        return difference;
    };
    if (p.isOfLastStep)
    {
        const auto timing(system_.effects.time("interpolation"));
        system_.markers->interpolate(p.u, markers.U);
    }
    label first = 0;
    for (const labelList* some : {&lines, &surfaces})
    {
        if (some->empty()) continue;
        const scalar fraction = impulseFractionOf(
            system_.groups[some->first()].forcing(), p.diffusionNumber);
        if (!p.isOfLastStep) predict(p, fraction, change(), groups, markers);
        move(*some, markers, first,
             {time.value(), time.deltaTValue(), !p.isOfLastStep, fraction,
              &trouble_.unsteady});
        if (trouble_.any) return;
        first += system_.nMarkers(*some);
    }

    const vectorField last(change());
    const auto timing(system_.effects.time("spreading"));
    for (const staggeredTarget& force : p.force)
    {
        spread(last, groups, force);
    }
    addForceByHeld(p);
}

void Foam::bodyMotion::addForceByHeld(const velocityPrediction& p) const
{
    const vector F(system_.forceByHeld());
    if (mag(F) == 0) return;
    for (const staggeredTarget& force : p.force)
    {
        addUniform(force.factor / system_.rho * F / system_.grid.volume(),
                   system_.grid.box().size, force);
    }
}

void Foam::bodyMotion::predict(const velocityPrediction& p,
                               const scalar fraction, const vectorField& change,
                               const labelUList& groups, markerValues& markers)
{
    const auto timing(system_.effects.time("spreading"));
    for (label i = 1; i < p.force.size(); ++i)
    {
        spread(change, groups, p.force[i]);
    }
    subtractMean(p.force[0], change, groups);
    system_.markers->spreadAndInterpolate(change, perMass(p.force[0]),
                                          p.after(fraction), markers.U);
}

Foam::bodyMotion::markerValues
Foam::bodyMotion::collect(const labelUList& groups, const scalar dt)
{
    const auto timing(system_.effects.time("interpolation"));
    markerValues markers;
    markers.X.setSize(system_.nMarkers(groups));
    labelList line(markers.X.size(), -1);
    label first = 0, firstLine = 0, ofLines = 0;
    bool direct = false;
    for (const label g : groups)
    {
        bodyGroup& group = system_.groups[g];
        const label n = group.nMarkers();
        group.placeMarkers(markers.X.data() + first, dt);
        if (group.forcing() != forcingType::none)
        {
            direct = true;
            refCast<directForcing>(group).lines(line.data() + first);
            for (label k = first; k < first + n; ++k)
            {
                if (line[k] >= 0) line[k] += firstLine;
            }
            firstLine += group.nBodies();
        }
        first += n;
        if (group.forcing() == forcingType::ofLines) ofLines = first;
    }
    system_.markers->setPositions(markers.X);
    if (direct)
    {
        system_.markers->lineDensity(markers.X, line, ofLines,
                                     markers.lineDensity);
    }
    return markers;
}

void Foam::bodyMotion::recordSlip(const staggeredView& u)
{
    forAll(system_.groups, g)
    {
        bodyGroup& group = system_.groups[g];
        if (group.forcing() == forcingType::none) continue;
        const auto timing(system_.effects.time("interpolation"));
        vectorField X(group.nMarkers()), U;
        group.placeMarkers(X.data(), 0);
        system_.markers->setPositions(X);
        system_.markers->interpolate({u}, U);
        refCast<directForcing>(group).recordSlip(U.cdata());
    }
}

void Foam::bodyMotion::move(const labelUList& groups,
                            const markerValues& markers, const label first,
                            const bodyStep& step)
{
    const vector* U = markers.U.cdata() + first;
    const scalar* lineDensity = markers.lineDensity.cdata() + first;
    bodyInteractions* interactions = system_.interactions.get();
    const forcingType forcing = groups.empty()
                                    ? forcingType::none
                                    : system_.groups[groups[0]].forcing();
    if (interactions && forcing == forcingType::ofLines)
    {
        interactions->resist(groups, U, lineDensity, step);
    }
    if (system_.films && forcing == forcingType::ofSurfaces)
    {
        system_.films->act(groups, U, lineDensity, step);
    }
    for (const label g : groups)
    {
        trouble_.note(system_.groups[g].move(U, lineDensity, step));
        U += system_.groups[g].nMarkers();
        lineDensity += system_.groups[g].nMarkers();
    }
    if (trouble_.unsteadyFails) trouble_.note(trouble_.unsteady);
    trouble_.share();

    // Markers in the flow move by at most 1.5 dt max |U|, with Adams-Bashforth
    if (!interactions || groups.empty()) return;
    scalar fastest = markers.U.size() ? max(mag(markers.U)) : 0;
    for (const label g : groups)
    {
        fastest = max(fastest, system_.groups[g].fastest());
    }
    interactions->travel(1.5 * step.dt * fastest);
}

Foam::staggeredTarget
Foam::bodyMotion::perMass(const staggeredTarget& force) const
{
    staggeredTarget target(force);
    target.factor /= system_.rho;
    return target;
}

void Foam::bodyMotion::subtractMean(const staggeredTarget& force,
                                    const vectorField& F,
                                    const labelUList& groups) const
{
    if (!system_.periodicBox()) return;
    addUniform(-perMass(force).factor * system_.unbalanced(F, groups) /
                   system_.grid.volume(),
               system_.grid.box().size, force);
}

void Foam::bodyMotion::spread(const vectorField& F, const labelUList& groups,
                              const staggeredTarget& force) const
{
    subtractMean(force, F, groups);
    system_.markers->spread(F, perMass(force));
}

void Foam::bodyMotion::updateViscosity(const labelUList& groups)
{
    const auto timing(system_.effects.time("viscosityRatio"));
    scalar excess = 0;
    vectorField G(system_.nMarkers(groups), Zero);
    label first = 0;
    for (const label g : groups)
    {
        const bodyGroup& group = system_.groups[g];
        const label n = group.nMarkers();
        const scalar more = system_.excessViscosity(g);
        if (more != 0 && group.twoWay())
        {
            SubField<vector> dS(G, n, first);
            group.inside()->areas(dS.data());
            dS *= -more;
            excess += more * group.inside()->volume();
        }
        first += n;
    }
    staggeredField work(system_.grid.box());
    system_.contrast->update(*system_.markers, G, excess, work);
}
