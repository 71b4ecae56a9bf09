// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The schemes that are kept for comparison: tension first, then positions

#include "bandedMatrix.H"
#include "filament.H"

bool Foam::filament::twoStep(const scalar dt, const vectorField& f)
{
    const label N = all_->segments;
    const scalar ds = all_->ds(), stiffness = all_->rigidity / pow3(ds);
    const bool centred = all_->scheme == TWO_STEP_CENTRED;

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
        force[i] = all_->lengthOf(i) * f[i];
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
    alignedVector<scalar> T(N);
    scalarField inverse(N + 1);
    forAll(inverse, i)
    {
        inverse[i] = held(i) ? 0 : 1 / (all_->lengthOf(i) * all_->mass);
    }
    const auto along = [&](const vectorField& X, const label i)
    { return vector((X[i + 1] - X[i]) / ds); };
    for (label i = 0; i < N; ++i)
    {
        const vector t(along(shape, i));
        tension(i, i) = -(inverse[i] + inverse[i + 1]) / ds * magSqr(t);
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
    if (!tension.factor()[0]) return false;
    tension.solve(T);

    // Positions: tension and bending at n+1, or on the mean of n+1 and n-1
    const scalar part = centred ? 0.5 : 1;
    bandedMatrix<2> A;
    A.clear(N + 1);
    vectorField b(force);
    const auto add = [&](const label i, const label j, const scalar value)
    {
        if (i <= j) A(i, j) += part * value;
        if (centred) b[i] -= 0.5 * value * old[j];
    };
    forAll(b, i)
    {
        const scalar inertia = all_->lengthOf(i) * all_->mass / toSquare;
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
            // Difference of positions due to a clamp: that of nodes at the origin
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
    for (const label i : {label(0), N})
    {
        if (!held(i)) continue;
        b[i] = heldPosition(i, dt);
        for (label j = max(i - 2, label(0)); j <= min(i + 2, N); ++j)
        {
            scalar& a = A(min(i, j), max(i, j));
            if (j != i) b[j] -= a * b[i];
            a = j == i ? 1 : 0;
        }
    }
    if (!A.factor()[0]) return false;

    XBefore_ = X_;
    VBefore_ = V_;
    for (direction d = 0; d < 3; ++d)
    {
        alignedVector<scalar> x(N + 1);
        forAll(X_, i)
        {
            x[i] = b[i][d];
        }
        A.solve(x);
        forAll(X_, i)
        {
            X_[i][d] = x[i];
        }
    }
    V_ = (X_ - XBefore_) / dt;
    std::copy(T.begin(), T.end(), T_.begin());
    lastDeltaT_ = dt;
    iterations_ = 1;
    return lengthError() < 0.5;
}
