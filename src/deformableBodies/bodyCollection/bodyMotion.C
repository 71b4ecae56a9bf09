// This file is part of deformableBodies. License: GPL-3.0-or-later.

// A time step of the bodies: markers, motion, forces on the fluid

#include "bodyCollection.H"

void Foam::bodyCollection::advance(const surfaceScalarField& phi)
{
    const Time& time = mesh_.time();
    if (lastAdvanced_ == time.timeIndex()) return;

    staggeredField faces(grid_.box());
    if (!empty()) grid_.toStaggered(phi, faces);
    advance(faces, faces);
    if (!forceFlux_.valid())
    {
        forceFlux_.reset(new surfaceScalarField(
            IOobject("bodyForceFlux", time.timeName(), mesh_), mesh_,
            dimensionedScalar(dimAcceleration * dimArea, Zero)));
        forceFlux_->setOriented();
    }
    if (!empty()) grid_.toFlux(faces, *forceFlux_);
}

void Foam::bodyCollection::advance(const staggeredView& u,
                                   staggeredField& force)
{
    const Time& time = mesh_.time();
    if (lastAdvanced_ < 0) start();
    lastAdvanced_ = time.timeIndex();
    if (empty())
    {
        force.clear();
        return;
    }

    const labelList now(groupsThat(false));
    const scalar dt = time.deltaTValue();
    if (time.timeIndex() % sampleInterval_ == 0) observe(u);
    if (!alone_ && now.size())
    {
        const auto timing(effects_.time("interpolation"));
        X_.setSize(nMarkers(now));
        vector* X = X_.data();
        for (const label g : now)
        {
            groups_[g].markers(X, dt);
            X += groups_[g].nMarkers();
        }
        boundary_->interpolate(X_, {u}, U_);
    }

    if (contrast_) updateViscosity(force);

    // Diffusion in a solver of which no more is known
    const scalar number = nu_ * dt / std::pow(grid_.cellVolume(), 2.0 / 3);
    move(now, false, implicitDiffusion::kept(number));

    force.clear();
    collectLoads(now);
    spread(force);

    if (!waiting() && time.timeIndex() % sampleInterval_ == 0)
    {
        sample(time.value());
    }
}

void Foam::bodyCollection::correct(const staggeredFlow::prediction& p)
{
    const labelList later(groupsThat(true));
    const Time& time = mesh_.time();
    for (const label g : later)
    {
        X_.setSize(groups_[g].nMarkers());
        groups_[g].markers(X_.data(), time.deltaTValue());
    }
    const auto addForce = [&]()
    {
        for (const auto& force : p.force)
        {
            spread(*force.second, force.first);
        }
    };

    // The force of the last step, where the markers are now
    collectLoads(later);
    const vectorField before(F_);
    addForce();
    {
        const auto timing(effects_.time("interpolation"));
        boundary_->interpolate(X_, p.u, U_);
    }
    move(later, true, p.kept);

    // And what it has changed by
    collectLoads(later);
    F_ -= before;
    addForce();

    if (time.timeIndex() % sampleInterval_ == 0) sample(time.value());
}

Foam::labelList Foam::bodyCollection::groupsThat(const bool wait) const
{
    DynamicList<label> which;
    forAll(groups_, g)
    {
        if ((solverPredicts_ && groups_[g].forces()) == wait) which.append(g);
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

void Foam::bodyCollection::observe(const staggeredView& u)
{
    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        if (!group.forces()) continue;
        const auto timing(effects_.time("interpolation"));
        X_.setSize(group.nMarkers());
        group.markers(X_.data(), 0);
        boundary_->interpolate(X_, {u}, U_);
        group.observe(U_.cdata());
    }
}

void Foam::bodyCollection::move(const labelList& groups, const bool predicted,
                                const scalar kept)
{
    const Time& time = mesh_.time();
    const bodyStep step{time.value(), time.deltaTValue(), predicted, kept};
    const vector* U = U_.cdata();
    string trouble;
    for (const label g : groups)
    {
        const string t(groups_[g].move(U, step));
        if (trouble.empty()) trouble = t;
        U += groups_[g].nMarkers();
    }
    if (returnReduce(!trouble.empty(), orOp<bool>())) stop(trouble);
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

void Foam::bodyCollection::spread(staggeredField& force, const scalar factor)
{
    if (!returnReduce(X_.size(), maxOp<label>())) return;

    const auto timing(effects_.time("spreading"));
    const vectorField F(factor / rho_ * F_);
    boundary_->spread(X_, F, force);
    if (periodicBox()) removeMean(F, force);
}

void Foam::bodyCollection::updateViscosity(staggeredField& work)
{
    const auto timing(effects_.time("viscosityRatio"));
    label at = 0, used = 0;
    scalar excess = 0;
    vectorField X(X_.size()), G(X_.size());
    for (const label g : groupsThat(false))
    {
        const bodyGroup& group = groups_[g];
        const label n = group.nMarkers();
        const scalar more = group.viscosityRatio() - 1;
        if (more != 0)
        {
            SubField<vector>(X, n, used) = SubField<vector>(X_, n, at);
            SubField<vector> dS(G, n, used);
            group.areas(dS.data());
            dS *= -more;
            excess += more * group.volume();
            used += n;
        }
        at += n;
    }
    X.setSize(used);
    G.setSize(used);
    contrast_->update(*boundary_, X, G, excess, work);
}

bool Foam::bodyCollection::periodicBox() const
{
    return grid_.periodic(0) && grid_.periodic(1) && grid_.periodic(2);
}

void Foam::bodyCollection::removeMean(const vectorField& F,
                                      staggeredField& force) const
{
    const vector L(grid_.length());
    const vector mean(gSum(F) / (L.x() * L.y() * L.z()));
    for (direction d = 0; d < 3; ++d)
    {
        force[d] -= mean[d];
    }
}
