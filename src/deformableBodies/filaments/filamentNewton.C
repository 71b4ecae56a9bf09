// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filamentNewton.H"

namespace
{
const Foam::filament& deref(const Foam::filament* f) { return *f; }
const Foam::filament::surroundings&
deref(const Foam::filament::surroundings& s)
{
    return s;
}
} // namespace

template<int Lanes>
void Foam::filamentNewton<Lanes>::load(const scalar dt, filament* const* lines,
                                       const filament::surroundings* around,
                                       const int n)
{
    first_ = lines[0];
    N_ = first_->all_->segments;
    points_ = around[0].points;
    for (auto* field : {&pastV_, &pastA_, &X_, &V_, &R_, &force_})
    {
        field->resize(N_ + 1);
    }
    T_.resize(N_);
    drag_.resize(points_.size());
    U_.resize(points_.size());
    t_.resize(points_.size());
    couple_.resize(around[0].couple.size());
    shear_.resize(couple_.size());
    change_.resize(4 * N_ + 3);

    // Lanes beyond the last filament repeat it. All numbers first: those that were
    // stored one by one a moment ago are slow to load together. List by list, as one of
    // all lanes fits into the first cache
    const auto take = [&](const auto& values, const auto& of, auto& to)
    {
        for (int l = 0; l < Lanes; ++l)
        {
            setLane(l, deref(of[min(l, n - 1)]).*values, to);
        }
    };
    take(&filament::X_, lines, X_);
    take(&filament::V_, lines, V_);
    take(&filament::XBefore_, lines, pastV_);
    take(&filament::VBefore_, lines, pastA_);
    take(&filament::T_, lines, T_);
    take(&filament::clamp_, lines, clamp_);
    take(&filament::surroundings::force, around, force_);
    take(&filament::surroundings::drag, around, drag_);
    take(&filament::surroundings::U, around, U_);
    take(&filament::surroundings::couple, around, couple_);
    if (couple_.size()) take(&filament::surroundings::shear, around, shear_);

    // BDF2; the first step is of first order
    lanes c1, c2, r;
    for (int l = 0; l < Lanes; ++l)
    {
        const scalar last = lines[min(l, n - 1)]->lastDeltaT_;
        r[l] = last > 0 ? dt / last : 0;
        c0_[l] = last > 0 ? (1 + 2 * r[l]) / ((1 + r[l]) * dt) : 1 / dt;
        c1[l] = last > 0 ? -(1 + r[l]) / dt : -1 / dt;
        c2[l] = last > 0 ? sqr(r[l]) / ((1 + r[l]) * dt) : 0;
    }
    for (label i = 0; i <= N_; ++i)
    {
        const vectors V = V_[i], VBefore = pastA_[i];
        pastV_[i] = X_[i].colwise() * c1 + pastV_[i].colwise() * c2;
        pastA_[i] = V.colwise() * c1 + VBefore.colwise() * c2;
        X_[i] += dt * (V + (V - VBefore).colwise() * (0.5 * r));
    }
    for (const label i : {label(0), N_})
    {
        for (int l = 0; l < Lanes && first_->held(i); ++l)
        {
            setLane(l, lines[min(l, n - 1)]->heldPlace(i, dt), X_[i]);
        }
    }

    // Drag across and along the extrapolated shape
    lanes meanDrag = lanes::Zero();
    forAll(points_, k)
    {
        const label i = points_[k].segment;
        t_[k] = X_[i + 1] - X_[i];
        t_[k].colwise() /= dot(t_[k], t_[k]).sqrt().eval();
        meanDrag += drag_[k] / (N_ + 1);
    }
    const filament::properties& all = *first_->all_;
    unit_ = all.ds() * all.mass * c0_.square() + meanDrag * c0_ +
            6 * all.rigidity / pow3(all.ds());
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::addInertia()
{
    const filament::properties& all = *first_->all_;
    for (label i = 0; i <= N_; ++i)
    {
        const scalar w = all.lengthOf(i);
        V_[i] = X_[i].colwise() * c0_ + pastV_[i];
        R_[i] =
            w * (all.mass * (V_[i].colwise() * c0_ + pastA_[i]) - force_[i]);
        for (direction d = 0; d < 3 && assembles_; ++d)
        {
            newA_(4 * i + d, 4 * i + d) += w * all.mass * c0_.square();
        }
    }
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::addDrag()
{
    const scalar along = 1 - first_->all_->dragRatio;
    forAll(points_, k)
    {
        const label i = points_[k].segment;
        const scalar share[2] = {1 - points_[k].at, points_[k].at};
        const vectors& t = t_[k];
        vectors F = share[0] * V_[i] + share[1] * V_[i + 1] - U_[k];
        F -= along * (t.colwise() * dot(t, F)).eval();
        F.colwise() *= drag_[k];
        R_[i] += share[0] * F;
        R_[i + 1] += share[1] * F;
        for (direction d = 0; d < 3 && assembles_; ++d)
        {
            for (direction e = 0; e < 3; ++e)
            {
                if (d != e && along == 0) continue;
                const lanes D = c0_ * drag_[k] *
                                (scalar(d == e) - along * t.col(d) * t.col(e));
                for (int a = 0; a < 2; ++a)
                {
                    for (int b = 0; b < 2; ++b)
                    {
                        newA_(4 * (i + a) + d, 4 * (i + b) + e) +=
                            share[a] * share[b] * D;
                    }
                }
            }
        }
    }
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::addBending()
{
    const scalar ds = first_->all_->ds();
    const scalar stiffness = first_->all_->rigidity / pow3(ds);
    first_->bends(
        [&](const scalar weight, const label k, const label* at,
            const scalar* factor)
        {
            const scalar w = weight * stiffness;
            vectors force = factor[0] * X_[at[0]] + factor[1] * X_[k] +
                            factor[2] * X_[at[2]];
            if (k == 0) force -= 2 * ds * clamp_[0];
            if (k == N_) force += 2 * ds * clamp_[1];
            for (int a = 0; a < 3; ++a)
            {
                R_[at[a]] += w * factor[a] * force;
                for (int b = 0; b < 3 && assembles_; ++b)
                {
                    for (direction d = 0; d < 3; ++d)
                    {
                        newA_(4 * at[a] + d, 4 * at[b] + d) +=
                            w * factor[a] * factor[b];
                    }
                }
            }
        });
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::addTension()
{
    const scalar ds = first_->all_->ds();
    for (label i = 0; i < N_; ++i)
    {
        const vectors t = (X_[i + 1] - X_[i]) / ds;
        vectors pull = t.colwise() * T_[i];
        lanes answer = T_[i] / ds;
        if (couple_.size())
        {
            pull +=
                (shear_[i] + (V_[i + 1] - V_[i]) / ds).colwise() * couple_[i];
            answer += couple_[i] * c0_ / ds;
        }
        R_[i] -= pull;
        R_[i + 1] += pull;
        for (direction d = 0; d < 3 && assembles_; ++d)
        {
            const label a = 4 * i + d, b = a + 4, k = 4 * i + 3;
            newA_(a, a) += answer;
            newA_(b, b) += answer;
            newA_(a, b) -= answer;
            newA_(b, a) -= answer;
            newA_(b, k) = newA_(k, b) = unit_ * t.col(d);
            newA_(a, k) = newA_(k, a) = -newA_(b, k);
        }
        change_[4 * i + 3] = -0.5 * ds * unit_ * (dot(t, t) - 1);
    }
}

// Held nodes do not change
template<int Lanes>
void Foam::filamentNewton<Lanes>::hold()
{
    const label n = 4 * N_ + 3;
    for (label i = 0; i <= N_; ++i)
    {
        const bool held = first_->held(i);
        for (direction d = 0; d < 3; ++d)
        {
            const label a = 4 * i + d;
            change_[a] = held ? lanes(lanes::Zero()) : lanes(-R_[i].col(d));
            if (!held || !assembles_) continue;
            for (label j = max(label(0), a - 8); j <= min(n - 1, a + 8); ++j)
            {
                newA_(a, j) = lanes::Zero();
            }
            newA_(a, a) = unit_;
        }
    }
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::assemble()
{
    assembles_ = fresh_.any();
    if (assembles_) newA_.clear(4 * N_ + 3);
    addInertia();
    addDrag();
    addBending();
    addTension();
    hold();
}

template<int Lanes>
std::array<bool, Lanes>
Foam::filamentNewton<Lanes>::step(const scalar dt, filament* const* lines,
                                  const filament::surroundings* around,
                                  const int n)
{
    // Work space of all filaments
    static filamentNewton<Lanes> x;
    x.load(dt, lines, around, n);
    x.fresh_.setConstant(true);

    const filament::properties& all = *lines[0]->all_;
    const scalar ds = all.ds();
    lanes before = lanes::Constant(sqr(ds));
    mask going, done = mask::Constant(false);
    for (int l = 0; l < Lanes; ++l)
    {
        going[l] = l < n;
    }
    for (label iteration = 0; iteration < 20 && going.any(); ++iteration)
    {
        for (int l = 0; l < n; ++l)
        {
            if (going[l]) ++lines[l]->iterations_;
        }
        x.assemble();
        if (x.assembles_)
        {
            const std::array<bool, Lanes> regular = x.newA_.factor();
            for (int l = 0; l < Lanes; ++l)
            {
                going[l] = going[l] && (regular[l] || !x.fresh_[l]);
            }
            if (x.fresh_.all())
                std::swap(x.A_, x.newA_);
            else
                x.A_.take(x.newA_, x.fresh_.data());
        }
        x.A_.solve(x.change_);

        // Square of the largest change of a place
        lanes largest = lanes::Zero();
        for (label i = 0; i <= x.N_; ++i)
        {
            lanes square = lanes::Zero();
            for (direction d = 0; d < 3; ++d)
            {
                square += x.change_[4 * i + d].square();
            }
            largest = largest.max(square);
        }
        going = going && largest < sqr(all.length);
        for (label i = 0; i <= x.N_; ++i)
        {
            for (direction d = 0; d < 3; ++d)
            {
                x.X_[i].col(d) += going.select(x.change_[4 * i + d], scalar(0));
            }
            if (i < x.N_)
            {
                x.T_[i] +=
                    going.select(x.unit_ * x.change_[4 * i + 3], scalar(0));
            }
        }

        // The lengths' error left is the square of the last change with a matrix
        // of its own, else that change times the rate of convergence
        const lanes change = largest / sqr(ds);
        const mask converged =
            (x.fresh_ && change < 1e-16) ||
            (!x.fresh_ && change * (largest / before).min(scalar(1)) < 1e-24);
        done = done || (going && converged);
        going = going && !done;
        x.fresh_ = going && largest > 0.01 * before;
        before = largest.max(sqr(1e-15 * ds));
    }

    std::array<bool, Lanes> advanced{};
    for (int l = 0; l < n; ++l)
    {
        advanced[l] = done[l];
        if (!done[l]) continue;
        filament& f = *lines[l];
        f.VBefore_.swap(f.V_);
        f.XBefore_.swap(f.X_);
        forAll(f.X_, i)
        {
            for (direction d = 0; d < 3; ++d)
            {
                f.X_[i][d] = x.X_[i](l, d);
                f.V_[i][d] = x.c0_[l] * x.X_[i](l, d) + x.pastV_[i](l, d);
            }
            if (i < x.N_) f.T_[i] = x.T_[i][l];
        }
        if (f.meanV_.size()) f.meanV_ += dt * f.V_;
        f.lastDeltaT_ = dt;
        f.timeLeft_ -= dt;
    }
    return advanced;
}

template class Foam::filamentNewton<1>;
template class Foam::filamentNewton<Foam::filament::together>;
