// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Markers of capsules and the forces there

#include "capsuleGroup.H"

Foam::label Foam::capsuleGroup::nMarkers() const
{
    return label(capsules_.size()) * markers_->size();
}

void Foam::capsuleGroup::markers(vector* X, scalar)
{
    for (const capsule& c : capsules_)
    {
        X = std::copy(c.markers.begin(), c.markers.end(), X);
    }
}

void Foam::capsuleGroup::areas(vector* dS) const
{
    for (const capsule& c : capsules_)
    {
        markers_->areas(c.x.data(), dS);
        dS += markers_->size();
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

Foam::bodyPoints Foam::capsuleGroup::points(const label i) const
{
    const label n = markers_->size();
    bodyPoints p{name(),
                 i < 0 ? -1 : mine()[i],
                 vectorField(n),
                 vectorField(n, Zero),
                 vectorField(n),
                 scalarField(),
                 0,
                 membrane_->model().shearModulus()};
    if (i < 0)
    {
        markers_->values(initial_.data(), p.places.data());
        markers_->areas(initial_.data(), p.areas.data());
        return p;
    }
    contactPoints(i, p.places.data(), p.velocities.data());
    markers_->areas(capsules_[i].xMid.data(), p.areas.data());
    return p;
}

void Foam::capsuleGroup::contactPoints(const label i, vector* X,
                                       vector* V) const
{
    const capsule& c = capsules_[i];
    const scalar perStep = c.lastDeltaT > 0 ? 2 / c.lastDeltaT : 0;
    for (label k = 0; k < markers_->size(); ++k)
    {
        X[k] = c.markersMid[k];
        V[k] = perStep * (c.markers[k] - X[k]);
    }
}

void Foam::capsuleGroup::loads(vector* X, vector* F, const scalar time) const
{
    const auto timing(scene_.effects.time("membrane"));
    const label n = markers_->size();
    forAll(mine(), i)
    {
        const capsule& c = capsules_[i];
        std::copy(c.markersMid.begin(), c.markersMid.end(), X);
        forcesOnFluid(i, time, F);
        X += n;
        F += n;
    }
}

void Foam::capsuleGroup::recordLoads(const vector* F)
{
    if (!nearField_) return;
    const auto timing(scene_.effects.time("membrane"));
    for (capsule& c : capsules_)
    {
        nearLoad(c, F);
        setNearSources(c);
        F += markers_->size();
    }
}

void Foam::capsuleGroup::forcesOnFluid(const label i, const scalar time,
                                       vector* F) const
{
    const capsule& c = capsules_[i];
    const label n = markers_->size();
    markers_->values(c.load.data(), F);
    for (label k = 0; k < n; ++k)
    {
        F[k] *= -markers_->weight(k);
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

const Foam::nearSurface::sources&
Foam::capsuleGroup::nearSources(const label i) const
{
    return capsules_[i].near;
}

void Foam::capsuleGroup::setNearSources(capsule& c) const
{
    if (corrections_.empty() || c.onFluid.empty()) return;
    nearField_->forces(c.x.data(), c.onFluid.data(), c.near.X, c.near.F);
}

// Forces have the solid angles in them, and the opposite sign of loads
void Foam::capsuleGroup::nearLoad(capsule& c, const vector* F) const
{
    numbers now(coeffs_.size());
    load(c.x, now);
    c.onFluid.resize(coeffs_.size());
    markers_->valuesAdjoint(F, c.onFluid.data());
    for (size_t j = 0; j < now.size(); ++j)
    {
        c.onFluid[j] += 0.5 * (c.load[j] - now[j]);
    }
}
