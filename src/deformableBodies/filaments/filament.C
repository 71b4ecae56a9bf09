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
    : all_(all),
      X_(nodes),
      V_(nodes.size(), Zero),
      XBefore_(nodes),
      VBefore_(nodes.size(), Zero),
      T_(nodes.size() - 1, Zero),
      meanV_(nodes.size(), Zero)
{
    const label N = all_.segments;
    base_[0] = X_[0];
    base_[1] = X_[N];
    clamp_[0] = (X_[1] - X_[0]) / mag(X_[1] - X_[0]);
    clamp_[1] = (X_[N] - X_[N - 1]) / mag(X_[N] - X_[N - 1]);
}

Foam::scalar Foam::filament::bendWeight(const label k) const
{
    if (k == 0) return all_.ends[0] == CLAMPED ? 0.5 : 0;
    if (k == all_.segments) return all_.ends[1] == CLAMPED ? 0.5 : 0;
    return 1;
}

// At a clamped end the neighbour beyond it lies along the clamp
Foam::vector Foam::filament::bend(const vectorField& X, const label k) const
{
    if (k == 0) return 2 * (X[1] - X[0] - all_.ds() * clamp_[0]);
    if (k == all_.segments)
    {
        return 2 * (X[k - 1] - X[k] + all_.ds() * clamp_[1]);
    }
    return X[k - 1] - 2 * X[k] + X[k + 1];
}

template<class Visit>
void Foam::filament::bends(Visit visit) const
{
    const label N = all_.segments;
    for (label k = 0; k <= N; ++k)
    {
        const scalar w = bendWeight(k);
        if (w == 0) continue;
        const bool end = k == 0 || k == N;
        const label at[3] = {k == 0 ? 1 : k - 1, k, k == N ? N - 1 : k + 1};
        const scalar factor[3] = {end ? 2.0 : 1.0, -2.0, end ? 0.0 : 1.0};
        visit(w, k, at, factor);
    }
}

Foam::vector Foam::filament::heldPlace(const label i, const scalar dt) const
{
    return X_[i] +
           min(dt / timeLeft_, scalar(1)) * (base_[i == 0 ? 0 : 1] - X_[i]);
}

Foam::vectorField Foam::filament::ahead(const scalar dt) const
{
    const scalar r = lastDeltaT_ > 0 ? dt / lastDeltaT_ : 0;
    vectorField X(X_.size());
    forAll(X, i)
    {
        X[i] = X_[i] + dt * (V_[i] + 0.5 * r * (V_[i] - VBefore_[i]));
    }
    return X;
}

bool Foam::filament::tryStep(const scalar dt, const surroundings& s)
{
    const label N = all_.segments, n = 4 * N + 3;
    const scalar ds = all_.ds(), stiffness = all_.rigidity / pow3(ds);

    // BDF2; the first step is of first order
    const bool first = lastDeltaT_ == 0;
    const scalar r = first ? 0 : dt / lastDeltaT_;
    const scalar c0 = first ? 1 / dt : (1 + 2 * r) / ((1 + r) * dt);
    const scalar c1 = first ? -1 / dt : -(1 + r) / dt;
    const scalar c2 = first ? 0 : sqr(r) / ((1 + r) * dt);

    // Newton's method from an extrapolation, with the first matrix for as long as
    // that converges well
    vectorField X(ahead(dt)), V(X.size()), R(X.size());
    scalarField T(T_);
    static bandedMatrix<8> A;
    std::vector<double> change(n);
    bool fresh = true;
    scalar before = GREAT;

    // Drag across and along the extrapolated shape
    List<symmTensor> drag(s.points.size());
    scalar meanDrag = 0;
    forAll(drag, k)
    {
        const label i = s.points[k].segment;
        vector t(X[i + 1] - X[i]);
        t /= mag(t);
        drag[k] = s.drag[k] * (symmTensor::I - (1 - all_.dragRatio) * sqr(t));
        meanDrag += s.drag[k] / (N + 1);
    }

    // Tension in units that make its rows as large as those of the places
    const scalar unit =
        ds * all_.mass * sqr(c0) + meanDrag * c0 + 6 * stiffness;

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
            const scalar w = weight(i) * ds;
            V[i] = c0 * X[i] + c1 * X_[i] + c2 * XBefore_[i];
            const vector acceleration(c0 * V[i] + c1 * V_[i] +
                                      c2 * VBefore_[i]);
            R[i] = w * (all_.mass * acceleration - s.force[i]);
            for (direction d = 0; d < 3 && fresh; ++d)
            {
                A(4 * i + d, 4 * i + d) += w * all_.mass * sqr(c0);
            }
        }
        forAll(drag, k)
        {
            const place& p = s.points[k];
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
        if (!(largest < all_.length)) return false;

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

bool Foam::filament::twoStep(const scalar dt, const vectorField& f)
{
    const label N = all_.segments;
    const scalar ds = all_.ds(), stiffness = all_.rigidity / pow3(ds);
    const bool centred = all_.scheme == TWO_STEP_CENTRED;

    // (X^{n+1} - X*)/toSquare is the acceleration for any ratio of steps, and at
    // the first, which starts from places and velocities
    const scalar last = lastDeltaT_ > 0 ? lastDeltaT_ : dt;
    const scalar toSquare = 0.5 * dt * (dt + lastDeltaT_);
    const vectorField old(lastDeltaT_ > 0 ? XBefore_
                                          : vectorField(X_ - dt * V_));
    const vectorField ahead(X_ + dt / last * (X_ - old));
    const vectorField& shape = centred ? X_ : ahead;

    vectorField force(N + 1);
    forAll(force, i)
    {
        force[i] = weight(i) * ds * f[i];
    }
    vectorField loaded(force);
    bends(
        [&](const scalar w, const label k, const label* at,
            const scalar* factor)
        {
            const vector b(w * stiffness * bend(shape, k));
            for (int a = 0; a < 3; ++a)
            {
                loaded[at[a]] -= factor[a] * b;
            }
        });

    // Tension that keeps the lengths: t.(a_{i+1} - a_i)/ds as below
    bandedMatrix<1> tension;
    tension.clear(N);
    std::vector<double> T(N);
    scalarField inverse(N + 1);
    forAll(inverse, i)
    {
        inverse[i] = held(i) ? 0 : 1 / (weight(i) * ds * all_.mass);
    }
    const auto along = [&](const vectorField& X, const label i)
    { return vector((X[i + 1] - X[i]) / ds); };
    for (label i = 0; i < N; ++i)
    {
        const vector t(along(shape, i));
        tension(i, i) = -(inverse[i] + inverse[i + 1]) / ds * magSqr(t);
        if (i > 0)
        {
            tension(i, i - 1) = inverse[i] / ds * (t & along(shape, i - 1));
        }
        if (i + 1 < N)
        {
            tension(i, i + 1) = inverse[i + 1] / ds * (t & along(shape, i + 1));
        }
        const vector rate((along(X_, i) - along(old, i)) / last);
        T[i] = (0.5 - magSqr(along(X_, i)) + 0.5 * magSqr(along(old, i))) /
                   toSquare -
               magSqr(rate) -
               (t & (inverse[i + 1] * loaded[i + 1] - inverse[i] * loaded[i])) /
                   ds;
    }
    if (!tension.factor()) return false;
    tension.solve(T);

    // Places: tension and bending at n+1, or on the mean of n+1 and n-1
    const scalar part = centred ? 0.5 : 1;
    bandedMatrix<2> A;
    A.clear(N + 1);
    std::vector<double> X(3 * (N + 1));
    vectorField b(force);
    const auto add = [&](const label i, const label j, const scalar value)
    {
        A(i, j) += part * value;
        if (centred) b[i] -= 0.5 * value * old[j];
    };
    forAll(b, i)
    {
        const scalar inertia = weight(i) * ds * all_.mass / toSquare;
        A(i, i) += inertia;
        b[i] += inertia * ahead[i];
    }
    for (label i = 0; i < N; ++i)
    {
        const scalar k = T[i] / ds;
        add(i, i, k);
        add(i + 1, i + 1, k);
        add(i, i + 1, -k);
        add(i + 1, i, -k);
    }
    bends(
        [&](const scalar w, const label k, const label* at,
            const scalar* factor)
        {
            // What a clamp adds to the difference of places
            const vector given(bend(vectorField(N + 1, Zero), k));
            for (int a = 0; a < 3; ++a)
            {
                b[at[a]] -= w * stiffness * factor[a] * given;
                for (int c = 0; c < 3; ++c)
                {
                    if (factor[a] * factor[c] != 0)
                    {
                        add(at[a], at[c],
                            w * stiffness * factor[a] * factor[c]);
                    }
                }
            }
        });
    forAll(b, i)
    {
        if (held(i))
        {
            for (label j = max(i - 2, label(0)); j <= min(i + 2, N); ++j)
            {
                A(i, j) = 0;
            }
            A(i, i) = 1;
            b[i] = heldPlace(i, dt);
        }
        for (direction d = 0; d < 3; ++d)
        {
            X[3 * i + d] = b[i][d];
        }
    }
    if (!A.factor()) return false;
    A.solve<3>(X);

    XBefore_ = X_;
    VBefore_ = V_;
    forAll(X_, i)
    {
        X_[i] = vector(X[3 * i], X[3 * i + 1], X[3 * i + 2]);
    }
    V_ = (X_ - XBefore_) / dt;
    meanV_ = dt * V_;
    std::copy(T.begin(), T.end(), T_.begin());
    lastDeltaT_ = dt;
    iterations_ = 1;
    return lengthError() < 0.5;
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
    if (all_.scheme == IMPLICIT && tryStep(dt, s))
    {
        meanV_ /= dt;
        return true;
    }
    const filament before(*this);
    if (all_.scheme == IMPLICIT ? halves(dt, s, 6) : twoStep(dt, s.force))
    {
        meanV_ /= dt;
        return true;
    }
    X_ = before.X_;
    V_ = before.V_;
    XBefore_ = before.XBefore_;
    VBefore_ = before.VBefore_;
    T_ = before.T_;
    lastDeltaT_ = before.lastDeltaT_;
    return false;
}

Foam::scalar Foam::filament::lengthError() const
{
    scalar largest = 0;
    for (label i = 0; i < all_.segments; ++i)
    {
        largest = max(largest, mag(mag(X_[i + 1] - X_[i]) / all_.ds() - 1));
    }
    return largest;
}

Foam::scalar Foam::filament::kineticEnergy() const
{
    scalar sum = 0;
    forAll(V_, i)
    {
        sum += 0.5 * weight(i) * all_.ds() * all_.mass * magSqr(V_[i]);
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
    return 0.5 * all_.rigidity / pow3(all_.ds()) * sum;
}

void Foam::filament::save(DynamicList<scalar>& state) const
{
    state.append(lastDeltaT_);
    for (const vectorField* v : {&X_, &V_, &XBefore_, &VBefore_})
    {
        for (const vector& x : *v)
        {
            for (direction d = 0; d < 3; ++d)
            {
                state.append(x[d]);
            }
        }
    }
    state.append(T_);
    state.append(scalar(iterations_));
}

void Foam::filament::restore(const scalar* state)
{
    lastDeltaT_ = *state++;
    for (vectorField* v : {&X_, &V_, &XBefore_, &VBefore_})
    {
        for (vector& x : *v)
        {
            for (direction d = 0; d < 3; ++d)
            {
                x[d] = *state++;
            }
        }
    }
    forAll(T_, i)
    {
        T_[i] = *state++;
    }
    iterations_ = label(*state);
}
