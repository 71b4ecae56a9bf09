// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filament.H"

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
      T_(nodes.size() - 1, Zero),
      meanV_(nodes.size(), Zero)
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

// At a clamped end the neighbour beyond it lies along the clamp
Foam::vector Foam::filament::bend(const vectorField& X, const label k) const
{
    if (k == 0) return 2 * (X[1] - X[0] - all_->ds() * clamp_[0]);
    if (k == all_->segments)
    {
        return 2 * (X[k - 1] - X[k] + all_->ds() * clamp_[1]);
    }
    return X[k - 1] - 2 * X[k] + X[k + 1];
}

Foam::vector Foam::filament::heldPlace(const label i, const scalar dt) const
{
    return X_[i] +
           min(dt / timeLeft_, scalar(1)) * (base_[i == 0 ? 0 : 1] - X_[i]);
}

void Foam::filament::ahead(const scalar dt, vectorField& X) const
{
    const scalar r = lastDeltaT_ > 0 ? dt / lastDeltaT_ : 0;
    X.setSize(X_.size());
    forAll(X, i)
    {
        X[i] = X_[i] + dt * (V_[i] + 0.5 * r * (V_[i] - VBefore_[i]));
    }
}

bool Foam::filament::tryStep(const scalar dt, const surroundings& s)
{
    const label N = all_->segments, n = 4 * N + 3;
    const scalar ds = all_->ds(), stiffness = all_->rigidity / pow3(ds);

    // BDF2; the first step is of first order
    const bool first = lastDeltaT_ == 0;
    const scalar r = first ? 0 : dt / lastDeltaT_;
    const scalar c0 = first ? 1 / dt : (1 + 2 * r) / ((1 + r) * dt);
    const scalar c1 = first ? -1 / dt : -(1 + r) / dt;
    const scalar c2 = first ? 0 : sqr(r) / ((1 + r) * dt);

    // Newton's method from an extrapolation, with the first matrix for as long as
    // that converges well,
    // in work space that all filaments share
    static bandedMatrix<8> A;
    static vectorField X, V, R;
    static scalarField T;
    static std::vector<double> change;
    static List<symmTensor> drag;
    ahead(dt, X);
    T = T_;
    V.setSize(X.size());
    R.setSize(X.size());
    change.resize(n);
    drag.setSize(s.points.size());
    bool fresh = true;
    scalar before = GREAT;

    // Drag across and along the extrapolated shape
    scalar meanDrag = 0;
    forAll(drag, k)
    {
        const label i = s.points[k].segment;
        vector t(X[i + 1] - X[i]);
        t /= mag(t);
        drag[k] = s.drag[k] * (symmTensor::I - (1 - all_->dragRatio) * sqr(t));
        meanDrag += s.drag[k] / (N + 1);
    }

    // Tension in units that make its rows as large as those of the places
    const scalar unit =
        ds * all_->mass * sqr(c0) + meanDrag * c0 + 6 * stiffness;

    forAll(X, i)
    {
        if (held(i)) X[i] = heldPlace(i, dt);
    }

    for (label iteration = 0; iteration < 20; ++iteration)
    {
        ++iterations_;
        if (fresh) A.clear(n);
        forAll(X, i)
        {
            const scalar w = all_->lengthOf(i);
            V[i] = c0 * X[i] + c1 * X_[i] + c2 * XBefore_[i];
            const vector acceleration(c0 * V[i] + c1 * V_[i] +
                                      c2 * VBefore_[i]);
            R[i] = w * (all_->mass * acceleration - s.force[i]);
            for (direction d = 0; d < 3 && fresh; ++d)
            {
                A(4 * i + d, 4 * i + d) += w * all_->mass * sqr(c0);
            }
        }
        forAll(drag, k)
        {
            const linePoint& p = s.points[k];
            const vector F(drag[k] & (p(V) - s.U[k]));
            const scalar share[2] = {1 - p.at, p.at};
            for (int a = 0; a < 2; ++a)
            {
                R[p.segment + a] += share[a] * F;
                for (int b = 0; b < 2 && fresh; ++b)
                {
                    const tensor D(share[a] * share[b] * c0 * drag[k]);
                    for (direction d = 0; d < 9; ++d)
                    {
                        A(4 * (p.segment + a) + d / 3,
                          4 * (p.segment + b) + d % 3) += D[d];
                    }
                }
            }
        }
        bends(
            [&](const scalar weight, const label k, const label* at,
                const scalar* factor)
            {
                const scalar w = weight * stiffness;
                const vector force(w * bend(X, k));
                for (int a = 0; a < 3; ++a)
                {
                    R[at[a]] += factor[a] * force;
                    for (int b = 0; b < 3 && fresh; ++b)
                    {
                        for (direction d = 0; d < 3; ++d)
                        {
                            A(4 * at[a] + d, 4 * at[b] + d) +=
                                w * factor[a] * factor[b];
                        }
                    }
                }
            });
        for (label i = 0; i < N; ++i)
        {
            const vector t((X[i + 1] - X[i]) / ds);
            vector pull(T[i] * t);
            scalar answer = T[i] / ds;
            if (s.couple.size())
            {
                pull += s.couple[i] * (s.shear[i] + (V[i + 1] - V[i]) / ds);
                answer += s.couple[i] * c0 / ds;
            }
            R[i] -= pull;
            R[i + 1] += pull;
            for (direction d = 0; d < 3 && fresh; ++d)
            {
                const label a = 4 * i + d, b = a + 4, k = 4 * i + 3;
                A(a, a) += answer;
                A(b, b) += answer;
                A(a, b) -= answer;
                A(b, a) -= answer;
                A(a, k) = A(k, a) = -unit * t[d];
                A(b, k) = A(k, b) = unit * t[d];
            }
            change[4 * i + 3] = -0.5 * unit * ds * (magSqr(t) - 1);
        }
        forAll(X, i)
        {
            for (direction d = 0; d < 3; ++d)
            {
                const label a = 4 * i + d;
                change[a] = held(i) ? 0 : -R[i][d];
                if (!held(i) || !fresh) continue;
                for (label j = max(label(0), a - 8); j <= min(n - 1, a + 8);
                     ++j)
                {
                    A(a, j) = 0;
                }
                A(a, a) = unit;
            }
        }
        if (fresh && !A.factor()) return false;
        A.solve(change);

        scalar largest = 0;
        forAll(X, i)
        {
            const vector dX(change[4 * i], change[4 * i + 1],
                            change[4 * i + 2]);
            X[i] += dX;
            largest = max(largest, mag(dX));
            if (i < N) T[i] += unit * change[4 * i + 3];
        }
        if (!(largest < all_->length)) return false;

        // The lengths' error left is the square of the last change with a matrix
        // of its own, else that change times the rate of convergence
        const scalar left =
            fresh ? sqr(largest / ds)
                  : largest / ds * min(largest / before, scalar(1));
        if (left < 1e-12)
        {
            forAll(X, i)
            {
                VBefore_[i] = V_[i];
                V_[i] = c0 * X[i] + c1 * X_[i] + c2 * XBefore_[i];
                XBefore_[i] = X_[i];
                X_[i] = X[i];
                meanV_[i] += dt * V_[i];
            }
            T_ = T;
            lastDeltaT_ = dt;
            timeLeft_ -= dt;
            return true;
        }
        fresh = largest > 0.1 * (iteration == 0 ? ds : before);
        before = largest;
    }
    return false;
}

// Two steps of half the size, and so on
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

bool Foam::filament::step(const scalar dt, const surroundings& s)
{
    iterations_ = 0;
    timeLeft_ = dt;
    meanV_ = Zero;
    if (all_->scheme != IMPLICIT || !tryStep(dt, s))
    {
        const filament before(*this);
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
    meanV_ /= dt;
    return true;
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

Foam::vectorField Foam::filament::placesOf(const scalar* state,
                                           const label segments)
{
    vectorField X(segments + 1);
    restore(state + 1, X);
    return X;
}
