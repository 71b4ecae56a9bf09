// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactPoints.H"
#include <cmath>

void Foam::contactPoints::clear(const label nBodies)
{
    ranges_.clear();
    ranges_.setSize(nBodies, range{0, 0});
    surfaces_.clear();
    surfaces_.setSize(nBodies, nullptr);
    firstConnection_.clear();
    firstConnection_.setSize(nBodies, Zero);
    halved_.clear();
    body_.clear();
    X_.clear();
    V_.clear();
    points_.clear();
    parts_.clear();
    along_.clear();
    firstOfLines_ = 0;
}

void Foam::contactPoints::addBetween(const label index, const label number,
                                     const contactSurface& surface)
{
    const label first = points_.size(), firstConnection = halved_.size();
    halved_.setSize(firstConnection + surface.nConnections());
    surface.addPoints(X_.cdata() + first, halved_.data() + firstConnection,
                      points_);
    ranges_[index] = {first, points_.size() - first};
    surfaces_[index] = &surface;
    firstConnection_[index] = firstConnection;
    X_.setSize(points_.size());
    V_.setSize(points_.size());
    setBetween(index, X_.data() + first);
    setBetween(index, V_.data() + first);
    body_.setSize(points_.size(), number);
    firstOfLines_ = X_.size();
}

void Foam::contactPoints::addLine(const label index, const label number,
                                  const UList<vector>& x,
                                  const UList<vector>& v, const scalar radius,
                                  const bool folded,
                                  const FixedList<bool, 2>& held,
                                  const scalar reach)
{
    scalar whole = 0;
    for (label k = 0; k + 1 < x.size(); ++k)
    {
        whole += mag(x[k + 1] - x[k]);
    }

    ranges_[index].first = X_.size();
    interactingPoint point{0, radius, 0};
    const scalar apart = max(min(0.5 * h_, 2 * radius), 0.1 * h_);
    scalar before = 0;
    for (label k = 0; k + 1 < x.size(); ++k)
    {
        const scalar length = mag(x[k + 1] - x[k]);
        // One number of parts whatever the rounding of segments as long as a cell
        const label parts = label(std::ceil(length / apart * (1 - 1e-6)));
        for (label j = 0; j < parts; ++j)
        {
            point.size = length / parts * h_;
            const scalar onward = (j + 0.5) / parts;
            const scalar along = before + onward * length;
            parts_.append({k, onward, scalar(1) / parts,
                           (held[0] && along < reach) ||
                               (held[1] && whole - along < reach)});
            along_.append(folded ? along : -1);
            X_.append((1 - onward) * x[k] + onward * x[k + 1]);
            V_.append((1 - onward) * v[k] + onward * v[k + 1]);
            points_.append(point);
            body_.append(number);
        }
        before += length;
    }
    ranges_[index].size = X_.size() - ranges_[index].first;
}

void Foam::contactPoints::clearForces(const bool withArms)
{
    F_.F.setSize(X_.size());
    F_.F = Zero;
    stiffness_.setSize(X_.size());
    stiffness_ = Zero;
    if (withArms) F_.arms = F_.F;
}

Foam::labelList Foam::contactPoints::lineBodies() const
{
    labelList bodies(body_);
    for (label k = 0; k < firstOfLines_; ++k)
    {
        bodies[k] = -1 - bodies[k];
    }
    return bodies;
}

Foam::scalarField Foam::contactPoints::linesAlong() const
{
    scalarField along(X_.size(), -1);
    std::copy(along_.begin(), along_.end(), along.begin() + firstOfLines_);
    return along;
}

void Foam::contactPoints::moveLine(const label index, const UList<vector>& x,
                                   const UList<vector>& v,
                                   lineMotions& motions) const
{
    const scalar segments = x.size() - 1;
    const range& points = ranges_[index];
    for (label k = points.first; k < points.end(); ++k)
    {
        const partOfSegment& on = parts_[k - firstOfLines_];
        const label s = on.segment;
        const label number = k - points.first;
        motions.number[k] = on.rooted ? -1 - number : number;
        motions.along[k] = mag((s + on.onward) / segments - 0.5);
        motions.element[k] = on.part * (x[s + 1] - x[s]);
        motions.turn[k] = on.part * (v[s + 1] - v[s]);
        motions.velocity[k] = v[s] + on.onward * (v[s + 1] - v[s]);
    }
}

void Foam::contactPoints::addTo(const label index, vectorField& F) const
{
    const range& points = ranges_[index];
    if (surfaces_[index])
    {
        surfaces_[index]->addTo(halvedOf(index), F_.F.cdata() + points.first,
                                F);
        return;
    }
    for (label k = points.first; k < points.end(); ++k)
    {
        const partOfSegment& on = parts_[k - firstOfLines_];
        vector ahead(on.onward * F_.F[k]);
        if (F_.arms.size()) ahead += on.part * F_.arms[k];
        F[on.segment] += F_.F[k] - ahead;
        F[on.segment + 1] += ahead;
    }
}

void Foam::contactPoints::addStiffness(const label index, scalarField& K) const
{
    const range& points = ranges_[index];
    for (label k = points.first; k < points.end(); ++k)
    {
        const partOfSegment& on = parts_[k - firstOfLines_];
        K[on.segment] += (1 - on.onward) * stiffness_[k];
        K[on.segment + 1] += on.onward * stiffness_[k];
    }
}

Foam::scalar Foam::contactPoints::load(const label index) const
{
    const range& points = ranges_[index];
    return sum(mag(SubField<vector>(F_.F, points.size, points.first)));
}

Foam::vector Foam::contactPoints::force(const label index) const
{
    const range& points = ranges_[index];
    return sum(SubField<vector>(F_.F, points.size, points.first));
}

Foam::tensor Foam::contactPoints::moment(const label index,
                                         const point& about) const
{
    const range& points = ranges_[index];
    tensor sum(Zero);
    for (label k = points.first; k < points.end(); ++k)
    {
        sum += F_.F[k] * (X_[k] - about);
    }
    return sum;
}

Foam::scalar Foam::contactPoints::power() const
{
    scalar power = 0;
    forAll(X_, k)
    {
        power += F_.F[k] & V_[k];
    }
    return power;
}
