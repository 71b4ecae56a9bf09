// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Markers of capsules and the forces there

#include "capsuleGroup.H"

Foam::label Foam::capsuleGroup::nMarkers() const
{
    return label(capsules_.size()) * markerGrid_->nPoints();
}

void Foam::capsuleGroup::atMarkers(const numbers& coeffs, vector* v,
                                   const scalar factor) const
{
    const label n = markerGrid_->nPoints();
    markerGrid_->values(coeffs.data(), onMarkers_.data());
    for (label k = 0; k < n; ++k)
    {
        v[k] = factor *
               vector(onMarkers_[k], onMarkers_[n + k], onMarkers_[2 * n + k]);
    }
}

void Foam::capsuleGroup::markers(vector* X, scalar)
{
    for (const capsule& c : capsules_)
    {
        atMarkers(c.x, X, 1);
        X += markerGrid_->nPoints();
    }
}

void Foam::capsuleGroup::areas(const numbers& coeffs, vector* dS) const
{
    const label n = markerGrid_->nPoints();
    numbers t(3 * n), p(3 * n);
    markerGrid_->gradient(coeffs.data(), t.data(), p.data());
    for (label k = 0; k < n; ++k)
    {
        const vector xt(t[k], t[n + k], t[2 * n + k]);
        const vector xp(p[k], p[n + k], p[2 * n + k]);
        dS[k] = markerGrid_->weight(k) * (xt ^ xp);
    }
}

void Foam::capsuleGroup::areas(vector* dS) const
{
    for (const capsule& c : capsules_)
    {
        areas(c.x, dS);
        dS += markerGrid_->nPoints();
    }
}

void Foam::capsuleGroup::load(const numbers& x, numbers& q) const
{
    membrane_->load(x.data(), q.data());
    if (bending_)
    {
        const auto timing(scene_.effects.time("bending"));
        bending_->addLoad(x.data(), q.data());
    }
}

Foam::bodyPoints Foam::capsuleGroup::pointsOf(const label body,
                                              const numbers& x,
                                              const numbers& velocity) const
{
    const label n = markerGrid_->nPoints();
    bodyPoints p{name(),
                 body,
                 vectorField(n),
                 vectorField(n),
                 vectorField(n),
                 scalarField(),
                 0,
                 membrane_->model().shearModulus()};
    atMarkers(x, p.places.data(), 1);
    atMarkers(velocity, p.velocities.data(), 1);
    areas(x, p.areas.data());
    return p;
}

Foam::bodyPoints Foam::capsuleGroup::points(const label i) const
{
    if (i < 0) return pointsOf(-1, initial_, numbers(initial_.size(), 0));
    return pointsOf(mine()[i], capsules_[i].xMid, capsules_[i].velocity);
}

void Foam::capsuleGroup::loads(vector* X, vector* F, const scalar time)
{
    const auto timing(scene_.effects.time("membrane"));
    const label n = markerGrid_->nPoints();
    forAll(mine(), i)
    {
        capsule& c = capsules_[i];
        atMarkers(c.xMid, X, 1);
        forcesOnFluid(i, time, F);
        if (nearField_) loadOnFluid(F, c.onFluid);
        X += n;
        F += n;
    }
}

void Foam::capsuleGroup::forcesOnFluid(const label i, const scalar time,
                                       vector* F)
{
    const capsule& c = capsules_[i];
    if (penalty_)
        coeffs_ = c.load;
    else
        load(c.xMid, coeffs_);
    atMarkers(coeffs_, F, -1);
    const label n = markerGrid_->nPoints();
    for (label k = 0; k < n; ++k)
    {
        F[k] *= markerGrid_->weight(k);
    }
    if (!scene_.forces.actOn(name(), mine()[i])) return;
    vectorField more(n, Zero);
    scene_.forces.add(
        name(), mine()[i], [&]() { return points(i); }, time, scene_.effects,
        more);
    for (label k = 0; k < n; ++k)
    {
        F[k] += more[k];
    }
}

void Foam::capsuleGroup::loadOnFluid(const vector* F, numbers& q) const
{
    const label n = markerGrid_->nPoints();
    q.resize(coeffs_.size());
    for (label k = 0; k < n; ++k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            onMarkers_[d * n + k] = F[k][d];
        }
    }
    // Forces have the solid angles in them
    markerGrid_->valuesAdjoint(onMarkers_.data(), q.data());
}
