// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The schemes that are kept for comparison: tension first, then positions

#include "bandedMatrix.H"
#include "filament.H"

// Equations of one step. Shapes at the times n-1, n and n+1: X^{n-1} ... X^{n+1};
// extrapolated shape: X* = X^n + dt/dt_last (X^n - X^{n-1})
class Foam::filament::twoStepEquations
{
    const filament& line_;
    const properties& all_;
    const label N_;
    const scalar dt_, ds_;

    //- B/ds^3 [N/m]
    const scalar stiffness_;
    const bool centred_;

    //- Length of the last step; dt at the first, which starts from positions and velocities
    const scalar last_;

    //- (X^{n+1} - X*)/toSquare is the acceleration for any ratio of steps [s^2]
    const scalar toSquare_;

    //- X^{n-1} and X* [m]
    const vectorField old_, ahead_;

    //- Matrix [N/m] and right side [N] of the equations for X^{n+1}
    bandedMatrix<2> A_;
    vectorField b_;

    //- X_s of segment i
    vector along(const vectorField& X, const label i) const
    {
        return vector((X[i + 1] - X[i]) / ds_);
    }

    //- 1/(m ds) of each node [1/kg]; 0 where it is held
    scalarField inverseMass() const;

    //- Add the bending forces -B X_ssss ds of a shape to the forces on the nodes [N]
    void addBending(const vectorField& shape, vectorField& F) const;

    //- Add value X_j to the equation of node i: at n+1, or on the mean of n+1 and n-1
    void add(const label i, const label j, const scalar value)
    {
        if (i <= j) A_(i, j) += (centred_ ? 0.5 : 1) * value;
        if (centred_) b_[i] -= 0.5 * value * old_[j];
    }

    //- Terms of the equations for X^{n+1}: m ds X_tt, -(T X_s)_s ds and B X_ssss ds
    void addInertia();
    void addTension(const UList<scalar>& T);
    void addBending();

    //- Replace the equations of held ends by their positions
    void holdEnds();

public:
    twoStepEquations(const filament& line, scalar dt);

    //- Tensions T [N] that keep the lengths under the forces f ds on the nodes [N]; false if
    //  there are none
    bool tensions(const vectorField& force, alignedVector<scalar>& T) const;

    //- Positions X^{n+1} [m] under tensions T [N] and forces f ds [N]; false if there are
    //  none
    bool positions(const vectorField& force, const UList<scalar>& T,
                   vectorField& X);
};

Foam::filament::twoStepEquations::twoStepEquations(const filament& line,
                                                   const scalar dt)
    : line_(line),
      all_(*line.all_),
      N_(all_.segments),
      dt_(dt),
      ds_(all_.ds()),
      stiffness_(all_.rigidity / pow3(ds_)),
      centred_(all_.scheme == TWO_STEP_CENTRED),
      last_(line.lastDeltaT_ > 0 ? line.lastDeltaT_ : dt),
      toSquare_(0.5 * dt * (dt + line.lastDeltaT_)),
      old_(line.lastDeltaT_ > 0 ? line.XBefore_
                                : vectorField(line.X_ - dt * line.V_)),
      ahead_(line.X_ + dt / last_ * (line.X_ - old_))
{
}

Foam::scalarField Foam::filament::twoStepEquations::inverseMass() const
{
    scalarField inverse(N_ + 1);
    forAll(inverse, i)
    {
        inverse[i] = line_.held(i) ? 0 : 1 / (all_.lengthOf(i) * all_.mass);
    }
    return inverse;
}

void Foam::filament::twoStepEquations::addBending(const vectorField& shape,
                                                  vectorField& F) const
{
    line_.bends(
        [&](const scalar w, const label k, const label* at,
            const scalar* factor)
        {
            const vector b(w * stiffness_ * line_.bend(shape, k));
            for (int a = 0; a < 3; ++a)
            {
                F[at[a]] -= factor[a] * b;
            }
        });
}

// From |X_s| = 1 at n+1, with the acceleration a of the nodes on either side of a segment:
//     X_s.(a_{i+1} - a_i)/ds = (1 - 2 |X_s^n|^2 + |X_s^{n-1}|^2)/(2 toSquare) - |X_st|^2
bool Foam::filament::twoStepEquations::tensions(const vectorField& force,
                                                alignedVector<scalar>& T) const
{
    const vectorField& shape = centred_ ? line_.X_ : ahead_;
    vectorField loaded(force);
    addBending(shape, loaded);
    const scalarField inverse(inverseMass());
    bandedMatrix<1> A;
    A.clear(N_);
    for (label i = 0; i < N_; ++i)
    {
        const vector t(along(shape, i));
        A(i, i) = -(inverse[i] + inverse[i + 1]) / ds_ * magSqr(t);
        if (i + 1 < N_)
        {
            A(i, i + 1) = inverse[i + 1] / ds_ * (t & along(shape, i + 1));
        }
        const vector now(along(line_.X_, i)), before(along(old_, i));
        const vector rate((now - before) / last_);
        T[i] = (0.5 - magSqr(now) + 0.5 * magSqr(before)) / toSquare_ -
               magSqr(rate) -
               (t & (inverse[i + 1] * loaded[i + 1] - inverse[i] * loaded[i])) /
                   ds_;
    }
    if (!A.factor()[0]) return false;
    A.solve(T);
    return true;
}

void Foam::filament::twoStepEquations::addInertia()
{
    forAll(b_, i)
    {
        const scalar inertia = all_.lengthOf(i) * all_.mass / toSquare_;
        A_(i, i) += inertia;
        b_[i] += inertia * ahead_[i];
    }
}

void Foam::filament::twoStepEquations::addTension(const UList<scalar>& T)
{
    for (label i = 0; i < N_; ++i)
    {
        const scalar k = T[i] / ds_;
        add(i, i, k);
        add(i + 1, i + 1, k);
        add(i, i + 1, -k);
        add(i + 1, i, -k);
    }
}

void Foam::filament::twoStepEquations::addBending()
{
    line_.bends(
        [&](const scalar w, const label k, const label* at,
            const scalar* factor)
        {
            // Difference of positions due to a clamp: that of nodes at the origin
            const vector given(line_.bend(vectorField(N_ + 1, Zero), k));
            for (int a = 0; a < 3; ++a)
            {
                b_[at[a]] -= w * stiffness_ * factor[a] * given;
                for (int c = 0; c < 3; ++c)
                {
                    if (factor[a] * factor[c] != 0)
                    {
                        add(at[a], at[c],
                            w * stiffness_ * factor[a] * factor[c]);
                    }
                }
            }
        });
}

void Foam::filament::twoStepEquations::holdEnds()
{
    for (const label i : {label(0), N_})
    {
        if (!line_.held(i)) continue;
        b_[i] = line_.heldPosition(i, dt_);
        for (label j = max(i - 2, label(0)); j <= min(i + 2, N_); ++j)
        {
            scalar& a = A_(min(i, j), max(i, j));
            if (j != i) b_[j] -= a * b_[i];
            a = j == i ? 1 : 0;
        }
    }
}

bool Foam::filament::twoStepEquations::positions(const vectorField& force,
                                                 const UList<scalar>& T,
                                                 vectorField& X)
{
    A_.clear(N_ + 1);
    b_ = force;
    addInertia();
    addTension(T);
    addBending();
    holdEnds();
    if (!A_.factor()[0]) return false;

    alignedVector<scalar> x(N_ + 1);
    for (direction d = 0; d < 3; ++d)
    {
        forAll(X, i)
        {
            x[i] = b_[i][d];
        }
        A_.solve(x);
        forAll(X, i)
        {
            X[i][d] = x[i];
        }
    }
    return true;
}

bool Foam::filament::twoStep(const scalar dt, const vectorField& f)
{
    vectorField force(X_.size());
    forAll(force, i)
    {
        force[i] = all_->lengthOf(i) * f[i];
    }
    twoStepEquations equations(*this, dt);
    alignedVector<scalar> T(T_.size());
    vectorField X(X_.size());
    if (!equations.tensions(force, T)) return false;
    std::copy(T.begin(), T.end(), T_.begin());
    if (!equations.positions(force, T_, X)) return false;

    XBefore_ = X_;
    VBefore_ = V_;
    X_ = X;
    V_ = (X_ - XBefore_) / dt;
    lastDeltaT_ = dt;
    iterations_ = 1;
    return lengthError() < 0.5;
}
