// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filament.H"
#include "filamentNewton.H"
#include "stepRatio.H"
#include <cmath>

const int Foam::filament::nLanes = vectorLength;

Foam::filament::filament(const properties& all, const point& first,
                         const vector& direction)
    : filament(all,
               [&]()
               {
                   vectorField X(all.segments + 1);
                   forAll(X, i)
                   {
                       X[i] = first + i * all.ds() / mag(direction) * direction;
                   }
                   return X;
               }())
{
}

Foam::filament::filament(const properties& all, const vectorField& nodes)
    : all_(&all),
      X_(nodes),
      V_(nodes.size(), Zero),
      XBefore_(nodes),
      VBefore_(nodes.size(), Zero),
      T_(nodes.size() - 1, Zero)
{
    const label N = all_->segments;
    base_[0] = X_[0];
    base_[1] = X_[N];
    clamp_[0] = (X_[1] - X_[0]) / mag(X_[1] - X_[0]);
    clamp_[1] = (X_[N] - X_[N - 1]) / mag(X_[N] - X_[N - 1]);
}

Foam::scalar Foam::filament::bendWeight(const label k) const
{
    if (k == 0) return all_->ends[0] == CLAMPED ? 0.5 : 0;
    if (k == all_->segments) return all_->ends[1] == CLAMPED ? 0.5 : 0;
    return 1;
}

// At a clamped end, the node beyond the end is placed along the clamp
Foam::vector Foam::filament::bend(const vectorField& X, const label k) const
{
    if (k == 0) return 2 * (X[1] - X[0] - all_->ds() * clamp_[0]);
    if (k == all_->segments)
    {
        return 2 * (X[k - 1] - X[k] + all_->ds() * clamp_[1]);
    }
    return X[k - 1] - 2 * X[k] + X[k + 1];
}

Foam::vector Foam::filament::heldPosition(const label i, const scalar dt) const
{
    return X_[i] +
           min(dt / timeLeft_, scalar(1)) * (base_[i == 0 ? 0 : 1] - X_[i]);
}

void Foam::filament::ahead(const scalar dt, vectorField& X) const
{
    const scalar r = stepRatio(dt, lastDeltaT_);
    X.setSize(X_.size());
    forAll(X, i)
    {
        X[i] = X_[i] + dt * (V_[i] + 0.5 * r * (V_[i] - VBefore_[i]));
    }
}

bool Foam::filament::tryStep(const scalar dt, const surroundings& s)
{
    filament* self = this;
    return filamentNewton<1>::step(dt, &self, &s, 1)[0];
}

// Each half is halved again if it fails
bool Foam::filament::halves(const scalar dt, const surroundings& s,
                            const label depth)
{
    for (int part = 0; part < 2; ++part)
    {
        if (!tryStep(0.5 * dt, s) &&
            (depth == 1 || !halves(0.5 * dt, s, depth - 1)))
        {
            return false;
        }
    }
    return true;
}

void Foam::filament::begin(const scalar dt)
{
    iterations_ = 0;
    timeLeft_ = dt;
    meanV_.clear();
}

Foam::List<bool> Foam::filament::step(const scalar dt,
                                      const UList<filament*>& lines,
                                      const UList<surroundings>& around)
{
    List<bool> advanced(lines.size(), false);
    if (lines.size() > 1 && lines[0]->all_->scheme == IMPLICIT)
    {
        for (filament* line : lines)
        {
            line->begin(dt);
        }
        for (label first = 0; first < lines.size(); first += nLanes)
        {
            const label n = min(nLanes, lines.size() - first);
            const auto done = filamentNewton<vectorLength>::step(
                dt, &lines[first], &around[first], n);
            std::copy_n(done.begin(), n, &advanced[first]);
        }
    }
    forAll(lines, l)
    {
        advanced[l] = advanced[l] || lines[l]->step(dt, around[l]);
    }
    return advanced;
}

bool Foam::filament::step(const scalar dt, const surroundings& s)
{
    begin(dt);
    if (all_->scheme != IMPLICIT || !tryStep(dt, s))
    {
        const filament before(*this);
        if (all_->scheme == IMPLICIT)
        {
            meanV_ = vectorField(X_.size(), Zero);
        }
        if (!(all_->scheme == IMPLICIT ? halves(dt, s, 6)
                                       : twoStep(dt, s.force)))
        {
            X_ = before.X_;
            V_ = before.V_;
            XBefore_ = before.XBefore_;
            VBefore_ = before.VBefore_;
            T_ = before.T_;
            lastDeltaT_ = before.lastDeltaT_;
            return false;
        }
    }
    if (meanV_.size()) meanV_ /= dt;
    return true;
}

// A line of given length lies within the spheroid whose foci are its ends
Foam::boundBox Foam::filament::roughBounds() const
{
    if (all_->scheme != IMPLICIT) return boundBox(X_, false);
    const point middle(0.5 * (X_.first() + X_.last()));
    const vector chord(X_.last() - X_.first());
    const scalar slack = max(sqr(all_->length) - magSqr(chord), scalar(0));
    vector half;
    for (direction d = 0; d < 3; ++d)
    {
        half[d] = 0.5 * std::sqrt(slack + sqr(chord[d]));
    }
    return boundBox(middle - half, middle + half);
}

Foam::scalar Foam::filament::lengthError() const
{
    scalar largest = 0;
    for (label i = 0; i < all_->segments; ++i)
    {
        largest = max(largest, mag(mag(X_[i + 1] - X_[i]) / all_->ds() - 1));
    }
    return largest;
}

Foam::scalar Foam::filament::kineticEnergy() const
{
    scalar sum = 0;
    forAll(V_, i)
    {
        sum += 0.5 * all_->lengthOf(i) * all_->mass * magSqr(V_[i]);
    }
    return sum;
}

Foam::scalar Foam::filament::bendingEnergy() const
{
    scalar sum = 0;
    forAll(X_, k)
    {
        const scalar w = bendWeight(k);
        if (w > 0) sum += w * magSqr(bend(X_, k));
    }
    return 0.5 * all_->rigidity / pow3(all_->ds()) * sum;
}

void Foam::filament::save(const vectorField& v, DynamicList<scalar>& state)
{
    for (const vector& x : v)
    {
        for (direction d = 0; d < 3; ++d)
        {
            state.append(x[d]);
        }
    }
}

const Foam::scalar* Foam::filament::restore(const scalar* state, vectorField& v)
{
    for (vector& x : v)
    {
        for (direction d = 0; d < 3; ++d)
        {
            x[d] = *state++;
        }
    }
    return state;
}

void Foam::filament::save(DynamicList<scalar>& state) const
{
    state.append(lastDeltaT_);
    for (const vectorField* v : {&X_, &V_, &XBefore_, &VBefore_})
    {
        save(*v, state);
    }
    state.append(T_);
    state.append(scalar(iterations_));
}

void Foam::filament::restore(const scalar* state)
{
    lastDeltaT_ = *state++;
    for (vectorField* v : {&X_, &V_, &XBefore_, &VBefore_})
    {
        state = restore(state, *v);
    }
    forAll(T_, i)
    {
        T_[i] = *state++;
    }
    iterations_ = label(*state);
}

Foam::vectorField Foam::filament::positionsOf(const scalar* state,
                                              const label segments)
{
    vectorField X(segments + 1);
    restore(state + 1, X);
    return X;
}
