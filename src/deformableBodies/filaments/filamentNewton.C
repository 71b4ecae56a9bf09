// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Before other headers of Eigen
#include "quietEigen.H"

#include "filamentNewton.H"
#include "stepRatio.H"

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

#include "filamentNewtonEquations.H"

template<int Lanes>
void Foam::filamentNewton<Lanes>::resize(const filament::surroundings& around)
{
    for (auto* field : {&pastV_, &pastA_, &V_})
    {
        field->resize(N_ + 1);
    }
    force_.resize(around.force.size());
    stiffness_.resize(around.stiffness.size());
    for (auto* field : {&x_, &change_, &right_, &next_})
    {
        field->assign(4 * (N_ + 1), lanes::Zero());
    }
    drag_.resize(points_.size());
    U_.resize(points_.size());
    t_.resize(points_.size());
    couple_.resize(around.couple.size());
    shear_.resize(couple_.size());
}

// Lanes beyond the last filament repeat it. Fill all lanes of a list before reading it: scalar
// stores followed at once by vector loads stall. One list at a time fits into the first-level
// cache
template<int Lanes>
void Foam::filamentNewton<Lanes>::load(filament* const* lines,
                                       const filament::surroundings* around,
                                       const int n)
{
    first_ = lines[0];
    N_ = first_->all_->segments;
    points_ = around[0].points;
    resize(around[0]);
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
    take(&filament::surroundings::stiffness, around, stiffness_);
    take(&filament::surroundings::drag, around, drag_);
    take(&filament::surroundings::U, around, U_);
    take(&filament::surroundings::couple, around, couple_);
    if (couple_.size()) take(&filament::surroundings::shear, around, shear_);
}

// A step without a ratio to the last one is backward Euler
template<int Lanes>
void Foam::filamentNewton<Lanes>::extrapolate(const scalar dt,
                                              filament* const* lines,
                                              const int n)
{
    lanes c1, c2, r;
    for (int l = 0; l < Lanes; ++l)
    {
        r[l] = stepRatio(dt, lines[min(l, n - 1)]->lastDeltaT_);
        c0_[l] = (1 + 2 * r[l]) / ((1 + r[l]) * dt);
        c1[l] = -(1 + r[l]) / dt;
        c2[l] = sqr(r[l]) / ((1 + r[l]) * dt);
    }
    if (stiffness_.size()) startV_ = V_;
    for (lanes& k : stiffness_)
    {
        k *= dt;
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
            setPosition(l, i, lines[min(l, n - 1)]->heldPosition(i, dt));
        }
    }
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::scale()
{
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
auto Foam::filamentNewton<Lanes>::largestChange() -> lanes
{
    lanes largest = lanes::Zero();
    for (label i = 0; i <= N_; ++i)
    {
        const vectors change = node(next_, i) - node(change_, i);
        largest = largest.max(dot(change, change));
    }
    return largest;
}

template<int Lanes>
void Foam::filamentNewton<Lanes>::store(const int l, const scalar dt,
                                        filament& f) const
{
    f.VBefore_.swap(f.V_);
    f.XBefore_.swap(f.X_);
    forAll(f.X_, i)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const scalar X = x_[4 * i + d][l] + change_[4 * i + d][l];
            f.X_[i][d] = X;
            f.V_[i][d] = c0_[l] * X + pastV_[i](l, d);
        }
    }
    forAll(f.T_, i)
    {
        const label k = 4 * i + 7;
        f.T_[i] = unit_[l] * (x_[k][l] + change_[k][l]);
    }
    if (f.meanV_.size()) f.meanV_ += dt * f.V_;
    f.lastDeltaT_ = dt;
    f.timeLeft_ -= dt;
}

template<int Lanes>
std::array<bool, Lanes>
Foam::filamentNewton<Lanes>::step(const scalar dt, filament* const* lines,
                                  const filament::surroundings* around,
                                  const int n)
{
    // Work space shared by all calls
    static filamentNewton<Lanes> x;
    x.load(lines, around, n);
    x.extrapolate(dt, lines, n);
    x.scale();

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

        const lanes largest = x.largestChange();
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
        if (done[l]) x.store(l, dt, *lines[l]);
    }
    return advanced;
}

template class Foam::filamentNewton<1>;
template class Foam::filamentNewton<Foam::vectorLength>;
