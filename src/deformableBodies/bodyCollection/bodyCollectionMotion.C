// This file is part of deformableBodies. License: GPL-3.0-or-later.

// A time step of the bodies: markers, motion, forces on the fluid

#include "bodyCollection.H"

namespace
{
Foam::scalar impulseFractionOf(const Foam::forcingType forcing,
                               const Foam::scalar diffusionNumber)
{
    return forcing == Foam::forcingType::ofLines
               ? Foam::impulseFractionOfLine(diffusionNumber)
               : Foam::impulseFractionOfSurface(diffusionNumber);
}
} // namespace

void Foam::bodyCollection::advance(const surfaceScalarField& phi)
{
    const Time& time = mesh_.time();
    if (lastMoved_ == time.timeIndex()) return;
    takeFlowFromFaces();

    staggeredField force(grid_.box());
    if (!empty() && !alone_ && !solverBalances_)
    {
        if (!guard_)
        {
            guard_.reset(new stepGuard(phi));
            guard_->expect(1,
                           "bodies, which move with the velocity of the last "
                           "step",
                           true);
        }
        guard_->check(stepGuard::CourantNo(phi), [&]() { diverged_ = true; });
    }
    if (!empty())
    {
        staggeredField u(grid_.box());
        grid_.toStaggered(phi, u);
        const scalar dt = time.deltaTValue();
        moveWithVelocity(u, force);
        for (const forcingType forcing :
             {forcingType::ofLines, forcingType::ofSurfaces})
        {
            const labelList direct(groupsThat(forcing));
            if (direct.empty() || diverged_) continue;
            place(direct, dt);
            {
                const auto timing(effects_.time("interpolation"));
                markers_->interpolate({u}, U_);
            }
            // Diffusion in a solver of which no more is known
            move(direct, false,
                 impulseFractionOf(forcing,
                                   grid_.diffusionNumber(nu_->value(), dt)));
            collectLoads(direct);
            spread(force);
        }
        if (diverged_) stop();
    }
    else
    {
        moveWithVelocity(force, force);
    }
    if (!forceFlux_.valid())
    {
        forceFlux_.reset(new surfaceScalarField(
            IOobject("bodyForceFlux", time.timeName(), mesh_), mesh_,
            dimensionedScalar(dimAcceleration * dimArea, Zero)));
        forceFlux_->setOriented();
    }
    if (!empty()) grid_.toFlux(force, *forceFlux_);
    sample();
    if (diverged_) stop();
}

void Foam::bodyCollection::moveWithVelocity(const staggeredView& u,
                                            staggeredField& force)
{
    const Time& time = mesh_.time();
    if (lastMoved_ < 0) start();
    checkDeltaT();
    lastMoved_ = time.timeIndex();
    if (empty()) return;

    const auto rest(effects_.time("places"));
    ownership_->migrate(groups_);
    const labelList groups(groupsThat(forcingType::none));
    if (sampleDue()) observe(u);
    if (!alone_ && groups.size())
    {
        place(groups, time.deltaTValue());
        const auto timing(effects_.time("interpolation"));
        markers_->interpolate({u}, U_);
    }
    if (contrast_) updateViscosity(groups, force);
    move(groups, false, 1);
    if (diverged_) return;
    if (interactions_) interactions_->update();

    collectLoads(groups);
    if (!returnReduce(X_.size(), maxOp<label>())) return;
    const auto timing(effects_.time("spreading"));
    markers_->place(X_);
    spread(force);
}

void Foam::bodyCollection::moveWithPrediction(const velocityPrediction& p)
{
    moveWithPrediction(p, forcingType::ofLines);
    moveWithPrediction(p, forcingType::ofSurfaces);
}

void Foam::bodyCollection::moveWithPrediction(const velocityPrediction& p,
                                              const forcingType forcing)
{
    const labelList groups(groupsThat(forcing));
    if (groups.empty() || diverged_) return;
    const scalar fraction = impulseFractionOf(forcing, p.diffusionNumber);

    // The force of the last step, where the markers are now
    place(groups, mesh_.time().deltaTValue());
    collectLoads(groups);
    const vectorField before(F_);
    for (label i = 1; i < p.force.size(); ++i)
    {
        spread(p.force[i]);
    }
    spread(p.force[0], p.after(fraction));
    move(groups, true, fraction);
    if (diverged_) return;

    // And what it has changed by
    collectLoads(groups);
    F_ -= before;
    for (const staggeredTarget& force : p.force)
    {
        spread(force);
    }
}

Foam::labelList
Foam::bodyCollection::groupsThat(const forcingType forcing) const
{
    DynamicList<label> which;
    forAll(groups_, g)
    {
        if (groups_[g].forcing() == forcing) which.append(g);
    }
    return labelList(std::move(which));
}

Foam::label Foam::bodyCollection::nMarkers(const labelList& groups) const
{
    label n = 0;
    for (const label g : groups)
    {
        n += groups_[g].nMarkers();
    }
    return n;
}

void Foam::bodyCollection::place(const labelList& groups, const scalar dt)
{
    const auto timing(effects_.time("interpolation"));
    const forcingType forcing = groups_[groups[0]].forcing();
    const bool haveLines = forcing != forcingType::none;
    X_.setSize(nMarkers(groups));
    labelList line(haveLines ? X_.size() : 0, -1);
    label at = 0, firstLine = 0;
    for (const label g : groups)
    {
        bodyGroup& group = groups_[g];
        const label n = group.nMarkers();
        group.markers(X_.data() + at, dt);
        if (haveLines)
        {
            group.lines(line.data() + at);
            for (label k = at; k < at + n; ++k)
            {
                if (line[k] >= 0) line[k] += firstLine;
            }
            firstLine += group.nBodies();
        }
        at += n;
    }
    markers_->place(X_);
    if (!haveLines) return;
    markers_->lineDensity(X_, line, forcing == forcingType::ofLines,
                          lineDensity_);
}

void Foam::bodyCollection::observe(const staggeredView& u)
{
    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        if (group.forcing() == forcingType::none) continue;
        const auto timing(effects_.time("interpolation"));
        X_.setSize(group.nMarkers());
        group.markers(X_.data(), 0);
        markers_->place(X_);
        markers_->interpolate({u}, U_);
        group.observe(U_.cdata());
    }
}

void Foam::bodyCollection::move(const labelList& groups, const bool predicted,
                                const scalar impulseFraction)
{
    const Time& time = mesh_.time();
    const bodyStep step{time.value(), time.deltaTValue(), predicted,
                        impulseFraction};
    const vector* U = U_.cdata();
    const scalar* lineDensity = lineDensity_.cdata();
    if (interactions_ && groups.size() &&
        groups_[groups[0]].forcing() == forcingType::ofLines)
    {
        interactions_->resist(groups, U, lineDensity, step);
    }
    for (const label g : groups)
    {
        const string trouble(groups_[g].move(U, lineDensity, step));
        if (trouble_.empty()) trouble_ = trouble;
        U += groups_[g].nMarkers();
        lineDensity += groups_[g].nMarkers();
    }
    diverged_ = diverged_ || returnReduce(!trouble_.empty(), orOp<bool>());

    // Bodies go with the fluid, by what it did in this step and the last
    if (interactions_ && U_.size())
    {
        interactions_->travel(1.5 * time.deltaTValue() * max(mag(U_)));
    }
}

void Foam::bodyCollection::collectLoads(const labelList& groups)
{
    DynamicList<label> acting;
    for (const label g : groups)
    {
        if (groups_[g].twoWay()) acting.append(g);
    }
    X_.setSize(nMarkers(acting));
    F_.setSize(X_.size());
    const scalar middle =
        mesh_.time().value() - 0.5 * mesh_.time().deltaTValue();
    label at = 0;
    for (const label g : acting)
    {
        groups_[g].loads(X_.data() + at, F_.data() + at, middle);
        at += groups_[g].nMarkers();
    }
}

void Foam::bodyCollection::spread(const staggeredTarget& force,
                                  const List<staggeredView>& u)
{
    const auto timing(effects_.time("spreading"));
    staggeredTarget perMass(force);
    perMass.factor /= rho_;
    if (periodicBox()) removeMean(perMass);
    if (u.empty())
        markers_->spread(F_, perMass);
    else
        markers_->spreadAndInterpolate(F_, perMass, u, U_);
}

void Foam::bodyCollection::updateViscosity(const labelList& groups,
                                           staggeredField& work)
{
    const auto timing(effects_.time("viscosityRatio"));
    scalar excess = 0;
    vectorField G(nMarkers(groups), Zero);
    label at = 0;
    for (const label g : groups)
    {
        const bodyGroup& group = groups_[g];
        const label n = group.nMarkers();
        const scalar around =
            group.host() < 0 ? 1 : groups_[group.host()].viscosityRatio();
        const scalar more = group.viscosityRatio() - around;
        if (more != 0 && group.twoWay())
        {
            SubField<vector> dS(G, n, at);
            group.areas(dS.data());
            dS *= -more;
            excess += more * group.volume();
        }
        at += n;
    }
    contrast_->update(*markers_, G, excess, work);
    work.clear();
}

bool Foam::bodyCollection::periodicBox() const
{
    return grid_.periodic(0) && grid_.periodic(1) && grid_.periodic(2);
}

void Foam::bodyCollection::removeMean(const staggeredTarget& force) const
{
    const vector L(grid_.length());
    const vector mean(force.factor * gSum(F_) / (L.x() * L.y() * L.z()));
    const labelVector& n = grid_.box().size;
    for (direction d = 0; d < 3; ++d)
    {
        for (label k = 0; k < n.z(); ++k)
        {
            for (label j = 0; j < n.y(); ++j)
            {
                scalar* row = force.first[d] + k * force.layer + j * force.row;
                for (label i = 0; i < n.x(); ++i)
                {
                    row[i] -= mean[d];
                }
            }
        }
    }
}
