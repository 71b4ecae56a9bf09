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

void Foam::capsuleGroup::insertBody(const label i, const label body,
                                    const scalarList& state,
                                    const dictionary& source)
{
    capsule c;
    c.x = initial_;
    c.velocity.assign(c.x.size(), 0);
    if (state.size())
    {
        centreOf(state, body, source);
        c.restore(state, motion_->hasPrevious(), motion_->hasLag(),
                  bool(nearField_));
    }
    else
    {
        setToStart(c, body);
    }
    startAt(c);
    capsules_.insert(capsules_.begin() + i, c);
}

void Foam::capsuleGroup::setToStart(capsule& c, const label body) const
{
    const tensor turn(turnOf(body));
    for (size_t k = 0; k < c.x.size(); k += 3)
    {
        const vector x(turn & vector(c.x[k], c.x[k + 1], c.x[k + 2]));
        std::copy_n(&x[0], 3, &c.x[k]);
    }

    // The harmonic of degree 0 is 1/sqrt(4 pi)
    for (direction d = 0; d < 3; ++d)
    {
        c.x[d] += start_.positions[body][d] *
                  std::sqrt(4 * constant::mathematical::pi);
    }
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
    p.positions = start_.positions[body] + (turn & p.positions);
    p.areas = turn & p.areas;
    return p;
}

// By the addition theorem |sum over m of c_nm Y_nm| is at most |c_n| sqrt((2n + 1)/
// 4 pi): equal for a sphere, little more for what it becomes
Foam::boundBox Foam::capsuleGroup::bounds(const label i,
                                          const bool smallest) const
{
    const coefficients& x = capsules_[i].x;
    if (smallest) return boundBox(capsules_[i].markers, false);
    vectorField squares(harmonics().degree() + 1, Zero);
    for (size_t j = 0; j < x.size(); ++j)
    {
        squares[harmonics().degreeOf(j / 3)][j % 3] += sqr(x[j]);
    }
    vector reach(Zero);
    for (label n = 1; n < squares.size(); ++n)
    {
        for (direction d = 0; d < 3; ++d)
        {
            reach[d] += std::sqrt(
                (2 * n + 1) / (4 * constant::mathematical::pi) * squares[n][d]);
        }
    }
    return boundBox(centre(i) - reach, centre(i) + reach);
}

const Foam::bodyReport& Foam::capsuleGroup::report() const
{
    return *report_;
}

Foam::label Foam::capsuleGroup::nMarkers() const
{
    return label(capsules_.size()) * markers_->size();
}

void Foam::capsuleGroup::placeMarkers(vector* X, scalar)
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
        markers_->values(initial_.data(), p.positions.data());
        markers_->areas(initial_.data(), p.areas.data());
        return p;
    }
    contactPoints(i, p.positions.data(), p.velocities.data());
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

Foam::scalarList Foam::capsuleGroup::state(const label i) const
{
    return capsules_[i].state();
}

Foam::point Foam::capsuleGroup::centreOf(const scalarList& state,
                                         const label body,
                                         const dictionary& source) const
{
    const label degree = capsule::degreeOf(state);
    if (degree != harmonics().degree())
    {
        waitForMaster();
        FatalIOErrorInFunction(source)
            << "the saved state of body " << body << " of group " << name()
            << (degree < 0
                    ? string(" is not that of a capsule")
                    : " has harmonics " + Foam::name(degree) + ", the group " +
                          Foam::name(harmonics().degree()) +
                          ": was the entry harmonics changed?")
                   .c_str()
            << exit(FatalIOError);
    }
    return capsule::centreOf(state);
}
