// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The capsules of a group: coming and going, geometry

#include "capsuleGroup.H"
#include "capsuleReport.H"
#include "dictionaryChecks.H"
#include "turnTo.H"

Foam::tensor Foam::capsuleGroup::turnOf(const label body) const
{
    if (start_.directions.empty()) return tensor::I;
    return turnTo(start_.directions[body]) & turnTo(axis_).T();
}

void Foam::capsuleGroup::insertBody(const label i, const label body)
{
    // The harmonic of degree 0 is 1/sqrt(4 pi)
    capsule c;
    c.x = initial_;
    const tensor turn(turnOf(body));
    for (size_t k = 0; k < c.x.size(); k += 3)
    {
        const vector x(turn & vector(c.x[k], c.x[k + 1], c.x[k + 2]));
        std::copy_n(&x[0], 3, &c.x[k]);
    }
    for (direction d = 0; d < 3; ++d)
    {
        c.x[d] += start_.positions[body][d] *
                  std::sqrt(4 * constant::mathematical::pi);
    }
    startAt(c);
    c.velocity.assign(c.x.size(), 0);
    capsules_.insert(capsules_.begin() + i, c);
}

void Foam::capsuleGroup::eraseBody(const label i)
{
    capsules_.erase(capsules_.begin() + i);
}

Foam::point Foam::capsuleGroup::initialCentre(const label body) const
{
    return start_.positions[body] +
           (turnOf(body) & vector(initial_[0], initial_[1], initial_[2])) /
               std::sqrt(4 * constant::mathematical::pi);
}

Foam::bodyPoints Foam::capsuleGroup::initialPoints(const label body) const
{
    bodyPoints p(points(-1));
    p.body = body;
    const tensor turn(turnOf(body));
    p.places = start_.positions[body] + (turn & p.places);
    p.areas = turn & p.areas;
    return p;
}

// By the addition theorem |sum over m of c_nm Y_nm| is at most |c_n| sqrt((2n + 1)/
// 4 pi): equal for a sphere, little more for what it becomes
Foam::boundBox Foam::capsuleGroup::bounds(const label i,
                                          const bool smallest) const
{
    const numbers& x = capsules_[i].x;
    if (smallest) return boundBox(capsules_[i].markers, false);
    vector reach(Zero);
    for (label n = 1; n <= harmonics().degree(); ++n)
    {
        vector squares(Zero);
        for (label m = 0; m <= n; ++m)
        {
            for (int sine = 0; sine <= (m ? 1 : 0); ++sine)
            {
                const double* c = &x[3 * harmonics().index(n, m, sine)];
                const vector v(c[0], c[1], c[2]);
                squares += cmptMultiply(v, v);
            }
        }
        for (direction d = 0; d < 3; ++d)
        {
            reach[d] += std::sqrt(
                (2 * n + 1) / (4 * constant::mathematical::pi) * squares[d]);
        }
    }
    return boundBox(centre(i) - reach, centre(i) + reach);
}

void Foam::capsuleGroup::checkStart(const label i, const dictionary& dict) const
{
    const label body = mine()[i];
    const boundBox bounds(capsules_[i].markers, false);
    const vector length(scene_.grid.length());
    for (direction d = 0; d < 3; ++d)
    {
        if (bounds.span()[d] >= length[d])
        {
            firstRankSpeaks();
            FatalIOErrorInFunction(dict)
                << "body " << body << " is larger than the box: it spans "
                << bounds.span()[d] << " in direction "
                << vector::componentNames[d] << nl << "    allowed: less than "
                << length[d] << exit(FatalIOError);
        }
    }
    groupEntries::checkWalls(dict, scene_.grid, body, bounds);
}

const Foam::bodyReport& Foam::capsuleGroup::report() const
{
    return *report_;
}

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
                 shell_->model().shearModulus()};
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

Foam::bodyGroup::makeList Foam::capsuleGroup::identify() const
{
    return {{"harmonics", scalar(harmonics().degree())},
            {"radius", radius_},
            {"area", referenceArea_}};
}

Foam::scalarList Foam::capsuleGroup::state(const label i) const
{
    return capsules_[i].state();
}

Foam::point Foam::capsuleGroup::centreOf(const scalarList& state,
                                         const label body,
                                         const dictionary& source) const
{
    if (capsule::degreeOf(state) != harmonics().degree())
    {
        firstRankSpeaks();
        FatalIOErrorInFunction(source)
            << "the saved state of body " << body << " of group " << name()
            << " has " << state.size() << " numbers where "
            << 2 + 2 * initial_.size()
            << " belong to its harmonics: was the entry harmonics changed?"
            << exit(FatalIOError);
    }
    return capsule::centreOf(state);
}

void Foam::capsuleGroup::setState(const label i, const scalarList& state,
                                  const dictionary& source)
{
    capsule& c = capsules_[i];
    centreOf(state, mine()[i], source);
    c.restore(state, motion_->hasPrevious(), motion_->hasLag(),
              bool(nearField_));
    startAt(c);
}
