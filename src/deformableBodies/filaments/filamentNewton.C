// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filamentNewton.H"

namespace
{
const Foam::filament& deref(const Foam::filament* f)
{
    return *f;
}
const Foam::filament::surroundings& deref(const Foam::filament::surroundings& s)
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
    for (auto* field : {&pastV_, &pastA_, &V_})
    {
        field->resize(N_ + 1);
    }
    force_.resize(around[0].force.size());
    for (auto* field : {&x_, &change_, &right_, &next_})
    {
        field->assign(4 * (N_ + 1), lanes::Zero());
    }
    drag_.resize(points_.size());
    U_.resize(points_.size());
    t_.resize(points_.size());
    couple_.resize(around[0].couple.size());
    shear_.resize(couple_.size());

    // Lanes beyond the last filament repeat it. Fill all lanes of a list before reading it:
    // scalar stores followed at once by vector loads stall. One list at a time fits into the
    // first-level cache
    const auto take = [&](const auto& values, const auto& of, auto& to)
    {
        for (int l = 0; l < Lanes; ++l)
        {
            setLane(l, deref(of[min(l, n - 1)]).*values, to);
        }
    };
    for (int l = 0; l < Lanes; ++l)
    {
        const filament& f = *lines[min(l, n - 1)];
        forAll(f.X_, i)
        {
            setPosition(l, i, f.X_[i]);
        }
        forAll(f.T_, i)
        {
            x_[4 * i + 7][l] = f.T_[i];
        }
    }
    take(&filament::V_, lines, V_);
    take(&filament::XBefore_, lines, pastV_);
    take(&filament::VBefore_, lines, pastA_);
    take(&filament::clamp_, lines, clamp_);
    take(&filament::surroundings::force, around, force_);
    take(&filament::surroundings::drag, around, drag_);
    take(&filament::surroundings::U, around, U_);
    take(&filament::surroundings::couple, around, couple_);
    if (couple_.size()) take(&filament::surroundings::shear, around, shear_);

    // BDF2; the first step is backward Euler
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
        pastV_[i] = node(x_, i).colwise() * c1 + pastV_[i].colwise() * c2;
        pastA_[i] = V.colwise() * c1 + VBefore.colwise() * c2;
        node(x_, i) += dt * (V + (V - VBefore).colwise() * (0.5 * r));
    }
    for (const label i : {label(0), N_})
    {
        for (int l = 0; l < Lanes && first_->held(i); ++l)
        {
            setPosition(l, i, lines[min(l, n - 1)]->heldPlace(i, dt));
        }
    }

    // Directions of the segments of the extrapolated shape, for the drag
    lanes meanDrag = lanes::Zero();
    forAll(points_, k)
    {
        const label i = points_[k].segment;
        t_[k] = node(x_, i + 1) - node(x_, i);
        t_[k].colwise() /= dot(t_[k], t_[k]).sqrt().eval();
        meanDrag += drag_[k] / (N_ + 1);
    }
    const filament::properties& all = *first_->all_;
    unit_ = all.ds() * all.mass * c0_.square() + meanDrag * c0_ +
            6 * all.rigidity / pow3(all.ds());
    for (label i = 0; i < N_; ++i)
    {
        x_[4 * i + 7] /= unit_;
    }
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::addInertia()
{
    const filament::properties& all = *first_->all_;
    for (label i = 0; i <= N_; ++i)
    {
        const scalar w = all.lengthOf(i);
        V_[i] = node(x_, i).colwise() * c0_ + pastV_[i];
        node(right_, i) = (-w * all.mass) * (V_[i].colwise() * c0_ + pastA_[i]);
        if (force_.size()) node(right_, i) += w * force_[i];
        for (direction d = 0; d < 3; ++d)
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
        node(right_, i) -= share[0] * F;
        node(right_, i + 1) -= share[1] * F;
        for (direction d = 0; d < 3; ++d)
        {
            for (direction e = 0; e < 3; ++e)
            {
                if (d != e && along == 0) continue;
                const lanes D = c0_ * drag_[k] *
                                (scalar(d == e) - along * t.col(d) * t.col(e));
                newA_(4 * i + d, 4 * i + 4 + e) += share[0] * share[1] * D;
                if (d > e) continue;
                for (int a = 0; a < 2; ++a)
                {
                    const label first = 4 * (i + a);
                    newA_(first + d, first + e) += sqr(share[a]) * D;
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
        [&](const scalar weight, const label k, const label* nodes,
            const scalar* factor)
        {
            const scalar w = weight * stiffness;
            vectors force = factor[0] * node(x_, nodes[0]) +
                            factor[1] * node(x_, k) +
                            factor[2] * node(x_, nodes[2]);
            if (k == 0) force -= 2 * ds * clamp_[0];
            if (k == N_) force += 2 * ds * clamp_[1];
            for (int a = 0; a < 3; ++a)
            {
                node(right_, nodes[a]) -= w * factor[a] * force;
                for (int b = 0; b < 3; ++b)
                {
                    if (nodes[a] > nodes[b]) continue;
                    for (direction d = 0; d < 3; ++d)
                    {
                        newA_(4 * nodes[a] + d, 4 * nodes[b] + d) +=
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
        const label k = 4 * i + 7;
        const vectors t = (node(x_, i + 1) - node(x_, i)) / ds;
        const lanes T = unit_ * x_[k];
        vectors pull = t.colwise() * T;
        lanes answer = T / ds;
        if (couple_.size())
        {
            pull +=
                (shear_[i] + (V_[i + 1] - V_[i]) / ds).colwise() * couple_[i];
            answer += couple_[i] * c0_ / ds;
        }
        node(right_, i) += pull;
        node(right_, i + 1) -= pull;
        for (direction d = 0; d < 3; ++d)
        {
            const label a = 4 * i + d, b = a + 4;
            newA_(a, a) += answer;
            newA_(b, b) += answer;
            newA_(a, b) -= answer;
            newA_(b, k) = unit_ * t.col(d);
            newA_(a, k) = -newA_(b, k);
        }
        right_[k] = -0.5 * ds * unit_ * (dot(t, t) - 1);
    }
}

// Rows of held nodes are replaced by: change = 0
template<int Lanes>
void Foam::filamentNewton<Lanes>::hold()
{
    const label n = 4 * (N_ + 1);
    for (const label i : {label(0), N_})
    {
        for (label a = 4 * i; a < 4 * i + 3 && first_->held(i); ++a)
        {
            for (label b = max(label(0), a - 8); b <= min(n - 1, a + 8); ++b)
            {
                newA_(min(a, b), max(a, b)) = lanes::Zero();
            }
            newA_(a, a) = unit_;
            right_[a] = lanes::Zero();
        }
    }
}

// Fresh lanes are linearised about their present unknowns. Other lanes keep their matrix and
// the unknowns at which it was computed
template<int Lanes>
auto Foam::filamentNewton<Lanes>::linearise(const mask& fresh) -> mask
{
    const label n = 4 * (N_ + 1);
    for (label j = 0; j < n; ++j)
    {
        x_[j] += fresh.select(change_[j], scalar(0));
        change_[j] = fresh.select(scalar(0), change_[j]);
    }
    newA_.clear(n);
    newA_(3, 3) = unit_;
    addInertia();
    addDrag();
    addBending();
    addTension();
    hold();

    mask regular;
    const auto result = newA_.factor();
    for (int l = 0; l < Lanes; ++l)
    {
        regular[l] = result[l] || !fresh[l];
    }
    if (fresh.all())
        std::swap(A_, newA_);
    else
        A_.take(newA_, fresh.data());
    return regular;
}

// Quadratic terms of the change: tension times direction, and the square of a segment's length
template<int Lanes>
void Foam::filamentNewton<Lanes>::addQuadratic()
{
    const scalar ds = first_->all_->ds();
    for (label i = 0; i < N_; ++i)
    {
        const label k = 4 * i + 7;
        const vectors t = (node(change_, i + 1) - node(change_, i)) / ds;
        const vectors pull = t.colwise() * (unit_ * change_[k]);
        if (!first_->held(i)) node(next_, i) += pull;
        if (!first_->held(i + 1)) node(next_, i + 1) -= pull;
        next_[k] -= 0.5 * ds * unit_ * dot(t, t);
    }
}

template<int Lanes>
std::array<bool, Lanes>
Foam::filamentNewton<Lanes>::step(const scalar dt, filament* const* lines,
                                  const filament::surroundings* around,
                                  const int n)
{
    // Work space shared by all calls
    static filamentNewton<Lanes> x;
    x.load(dt, lines, around, n);

    const filament::properties& all = *lines[0]->all_;
    const scalar ds = all.ds();
    lanes lastChange = lanes::Constant(sqr(ds));
    mask going, done = mask::Constant(false), fresh = mask::Constant(true);
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
        if (fresh.any()) going = going && x.linearise(fresh);
        x.next_ = x.right_;
        x.addQuadratic();
        x.A_.solve(x.next_);

        // Square of the largest change of a position
        lanes largest = lanes::Zero();
        for (label i = 0; i <= x.N_; ++i)
        {
            const vectors change = node(x.next_, i) - node(x.change_, i);
            largest = largest.max(dot(change, change));
        }
        going = going && largest < sqr(all.length);
        for (size_t j = 0; j < x.change_.size(); ++j)
        {
            x.change_[j] = going.select(x.next_[j], x.change_[j]);
        }

        // Remaining relative error of the lengths: square of the last change if the matrix is
        // new (Newton), otherwise that change times the rate of convergence
        const lanes change = largest / sqr(ds);
        const mask converged =
            (fresh && change < 1e-16) ||
            (!fresh && change * (largest / lastChange).min(scalar(1)) < 1e-24);
        done = done || (going && converged);
        going = going && !done;
        fresh = going && largest > 0.01 * lastChange;
        lastChange = largest.max(sqr(1e-15 * ds));
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
                const scalar X = x.x_[4 * i + d][l] + x.change_[4 * i + d][l];
                f.X_[i][d] = X;
                f.V_[i][d] = x.c0_[l] * X + x.pastV_[i](l, d);
            }
        }
        forAll(f.T_, i)
        {
            const label k = 4 * i + 7;
            f.T_[i] = x.unit_[l] * (x.x_[k][l] + x.change_[k][l]);
        }
        if (f.meanV_.size()) f.meanV_ += dt * f.V_;
        f.lastDeltaT_ = dt;
        f.timeLeft_ -= dt;
    }
    return advanced;
}

template class Foam::filamentNewton<1>;
template class Foam::filamentNewton<Foam::vectorLength>;
