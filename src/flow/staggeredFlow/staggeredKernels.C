// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The arithmetic of a time step: one kernel for the three components

#include "staggeredFlow.H"
#include <numeric>

// Increments of a row of cells, component D, without the implicit factors, in
// place of the force; the new explicit terms replace the last ones. All nine
// convective fluxes have one form: the component E that carries, averaged along D,
// times component D averaged along E
template<int D, bool Convection, bool Variable>
void Foam::staggeredFlow::makeIncrement(const vector& r, const scalar dt,
                                        const stage& s, const label q,
                                        const label n)
{
    const label nx = box_.size.x();
    constexpr int E = (D + 1) % 3, G = (D + 2) % 3;
    const label s0 = 1, s1 = block_.stride(1), s2 = block_.stride(2);
    const label sD = block_.stride(D), sE = block_.stride(E),
                sG = block_.stride(G);
    const double r0 = r[0], r1 = r[1], r2 = r[2];
    const double q0 = 0.25 * r0, q1 = 0.25 * r1, q2 = 0.25 * r2;
    const double L0 = r0 * r0, L1 = r1 * r1, L2 = r2 * r2;
    const double rD = r[D], rE = r[E], rG = r[G];

    // nu L u is among the explicit terms or among the others
    const double among = explicit_ ? nuMax_ : 0, nu0 = nuMax_ - among;
    const double now = s.now, before = s.before, rest = s.others,
                 others = rest * nu0;
    const double* u = u_[D].data() + q;
    const double* a = u_[0].data() + q;
    const double* b = u_[1].data() + q;
    const double* c = u_[2].data() + q;
    const double* e = u_[E].data() + q;
    const double* g = u_[G].data() + q;
    const double* p = pressure_.data() + q;
    const double* nu = Variable ? nu_.data() + q : nullptr;
    const double* nuDE = Variable ? nuEdge_[G].data() + q : nullptr;
    const double* nuDG = Variable ? nuEdge_[E].data() + q : nullptr;
    double* last = last_[D].data() + n;
    double* out = increment()[D].data() + n;
#pragma GCC ivdep
    for (label i = 0; i < nx; ++i)
    {
        const double x = u[i];
        const double x0 = u[i - s0], X0 = u[i + s0];
        const double x1 = u[i - s1], X1 = u[i + s1];
        const double x2 = u[i - s2], X2 = u[i + s2];
        const double diffusion = L0 * (X0 - 2 * x + x0) +
                                 L1 * (X1 - 2 * x + x1) +
                                 L2 * (X2 - 2 * x + x2);
        double terms = 0;
        if (Convection)
        {
            terms = q0 * ((a[i] + a[i - sD]) * (x + x0) -
                          (a[i + s0] + a[i + s0 - sD]) * (x + X0)) +
                    q1 * ((b[i] + b[i - sD]) * (x + x1) -
                          (b[i + s1] + b[i + s1 - sD]) * (x + X1)) +
                    q2 * ((c[i] + c[i - sD]) * (x + x2) -
                          (c[i + s2] + c[i + s2 - sD]) * (x + X2));
        }
        if (Variable)
        {
            const auto strain = [](const double* w, const label i,
                                   const label s) { return w[i] - w[i - s]; };
            terms += 2 * sqr(rD) *
                         ((nu[i] - nu0) * strain(u, i + sD, sD) -
                          (nu[i - sD] - nu0) * strain(u, i, sD)) +
                     rE * ((nuDE[i + sE] - nu0) * (rE * strain(u, i + sE, sE) +
                                                   rD * strain(e, i + sE, sD)) -
                           (nuDE[i] - nu0) * (rE * strain(u, i, sE) +
                                              rD * strain(e, i, sD))) +
                     rG * ((nuDG[i + sG] - nu0) * (rG * strain(u, i + sG, sG) +
                                                   rD * strain(g, i + sG, sD)) -
                           (nuDG[i] - nu0) *
                               (rG * strain(u, i, sG) + rD * strain(g, i, sD)));
        }
        else
        {
            terms += among * diffusion;
        }
        out[i] = dt * (now * terms + before * last[i] + others * diffusion +
                       rest * (out[i] - rD * (p[i] - p[i - sD])));
        last[i] = terms;
    }
}

// All increments are made from the velocity before: they wait until the last is
// done. The three components of a row follow each other, while it is in the cache
template<bool Convection, bool Variable>
void Foam::staggeredFlow::makeIncrements(const scalar dt, const stage& s)
{
    const vector r(1 / grid_.h().x(), 1 / grid_.h().y(), 1 / grid_.h().z());
    block_.rows(
        [&](const label q, const label n)
        {
            makeIncrement<0, Convection, Variable>(r, dt, s, q, n);
            makeIncrement<1, Convection, Variable>(r, dt, s, q, n);
            makeIncrement<2, Convection, Variable>(r, dt, s, q, n);
        });

    // The velocity on a wall stays
    for (direction d = 0; d < 3; ++d)
    {
        const auto stay = [&](const label i)
        { increment()[d][i] = last_[d][i] = 0; };
        if (block_.wallBelow(d)) box_.layer(d, 0, stay);
    }
}

// The acceleration, uniform in space, that brings the mean of the velocity to what
// is held. Near walls the fluid answers to it through the implicit operator
void Foam::staggeredFlow::holdMean(const direction c, const scalar dt)
{
    const scalar nAll = scalar(grid_.n().x()) * grid_.n().y() * grid_.n().z();
    const scalar b = explicit_ ? 0 : 0.5 * nuMax_ * dt;
    if (b != responseTo_ || response_.empty())
    {
        response_.assign(box_.count(), 1);
        FixedList<scalar*, 3> x({nullptr, nullptr, nullptr});
        x[c] = response_.data();
        if (b > 0)
        {
            implicit_[transforms_]->solve(
                x, b, wallVelocities(FixedList<vector, 2>(Zero)));
        }
        const scalar sum =
            std::accumulate(response_.begin(), response_.end(), 0.0);
        meanResponse_ = returnReduce(sum, sumOp<scalar>()) / nAll;
        responseTo_ = b;
    }

    const label nx = box_.size.x();
    scalar sum = 0;
    block_.rows(
        [&](const label q, const label)
        {
            const double* u = u_[c].data() + q;
            sum += std::accumulate(u, u + nx, 0.0);
        });
    meanBefore_ = returnReduce(sum, sumOp<scalar>()) / nAll;

    const scalar push = (heldMean_ - meanBefore_) / meanResponse_;
    block_.rows(
        [&](const label q, const label n)
        {
            for (label i = 0; i < nx; ++i)
            {
                u_[c][q + i] += push * response_[n + i];
            }
        });
    gradient_ += push;
}

void Foam::staggeredFlow::predict()
{
    const stage& s = stages_[stage_];
    const auto timing(effects_.time("momentum"));
    added_ = false;

    scalar passed = 0;
    for (label i = 0; i <= stage_; ++i)
    {
        passed += stages_[i].others;
    }
    for (direction d = 0; d < 3; ++d)
    {
        for (label side = 0; side < 2 && stages_.size() > 1; ++side)
        {
            wallsAhead_[d][side] = (1 - passed) * wallsBefore_[d][side] +
                                   passed * wallsAfter_[d][side];
        }
        if (RK3_) (*increment_)[d] = force_[d];
    }
    updateVelocity();

    if (convection_ && variable()) makeIncrements<true, true>(stepDt_, s);
    if (convection_ && !variable()) makeIncrements<true, false>(stepDt_, s);
    if (!convection_ && variable()) makeIncrements<false, true>(stepDt_, s);
    if (!convection_ && !variable()) makeIncrements<false, false>(stepDt_, s);
}

// Of AB2 with explicit diffusion the velocity with the increments added; else these,
// without the implicit factors and as a share of those of the whole step, predict the
// velocity at its end
Foam::velocityPrediction Foam::staggeredFlow::prediction()
{
    const scalar others = stages_[stage_].others, dt = others * stepDt_;
    velocityPrediction p;
    if (explicit_ && !RK3_)
    {
        const auto timing(effects_.time("momentum"));
        addIncrements();
        staggeredTarget u;
        u.row = block_.stride(1);
        u.layer = block_.stride(2);
        u.factor = dt;
        for (direction d = 0; d < 3; ++d)
        {
            u.first[d] = u_[d].data() + block_.place(0, 0, 0);
        }
        p = {{velocity()}, 0, {u}};
    }
    else
    {
        const scalar number =
            explicit_ ? 0 : grid_.diffusionNumber(nuMax_, stepDt_);
        p = {{velocity(), {increment(), 1 / others}},
             number,
             {{increment(), dt}}};
    }

    // Later stages of RK3 have the force as well
    if (RK3_) p.force.append(staggeredTarget(force_));
    return p;
}

// The increments of AB2 lie in place of the force, which is zero after the step
void Foam::staggeredFlow::addIncrements()
{
    if (added_) return;
    added_ = true;
    block_.rows(
        [&](const label q, const label n)
        {
            for (direction d = 0; d < 3; ++d)
            {
                double* u = u_[d].data() + q;
                double* change = increment()[d].data() + n;
#pragma GCC ivdep
                for (label i = 0; i < box_.size.x(); ++i)
                {
                    u[i] += change[i];
                    change[i] = 0;
                }
            }
        });
}

void Foam::staggeredFlow::diffuse()
{
    const scalar dt = stages_[stage_].others * stepDt_;
    if (!explicit_)
    {
        const auto timing(effects_.time("diffusion"));
        wallVelocities change;
        for (direction d = 0; d < 3; ++d)
        {
            for (label side = 0; side < 2; ++side)
            {
                change[d][side] = wallsAhead_[d][side] - walls_[d][side];
            }
        }
        staggeredField& x = increment();
        implicit_[transforms_]->solve({x[0].data(), x[1].data(), x[2].data()},
                                      0.5 * nuMax_ * dt, change);
    }
    walls_ = wallsAhead_;

    const auto timing(effects_.time("momentum"));
    addIncrements();
    if (holdsMean_) holdMean(heldComponent_, dt);
}

void Foam::staggeredFlow::project()
{
    const auto timing(effects_.time("pressure"));
    const scalar dt = stages_[stage_].others * stepDt_;
    const label nx = box_.size.x();
    const vector& h = grid_.h();
    const scalar r0 = 1 / (dt * h.x()), r1 = 1 / (dt * h.y()),
                 r2 = 1 / (dt * h.z());
    const label s1 = block_.stride(1), s2 = block_.stride(2);

    updateVelocity();
    block_.rows(
        [&](const label q, const label)
        {
            const double* a = u_[0].data() + q;
            const double* b = u_[1].data() + q;
            const double* c = u_[2].data() + q;
            double* source = correction_.data() + q;
#pragma GCC ivdep
            for (label i = 0; i < nx; ++i)
            {
                source[i] = -(r0 * (a[i + 1] - a[i]) + r1 * (b[i + s1] - b[i]) +
                              r2 * (c[i + s2] - c[i]));
            }
        });

    const FixedList<scalar, 3> inverseSqr(
        {1 / sqr(h.x()), 1 / sqr(h.y()), 1 / sqr(h.z())});
    poisson_->solve(correction_.data(), correction_.data(), 0, inverseSqr);
    block_.update(correction_.data());
    // Beyond walls as inside: the velocity on a wall stays
    block_.extend(correction_.data());

    const double d0 = dt / h.x(), d1 = dt / h.y(), d2 = dt / h.z();
    block_.rows(
        [&](const label q, const label)
        {
            double* a = u_[0].data() + q;
            double* b = u_[1].data() + q;
            double* c = u_[2].data() + q;
            const double* f = correction_.data() + q;
#pragma GCC ivdep
            for (label i = 0; i < nx; ++i)
            {
                a[i] -= d0 * (f[i] - f[i - 1]);
                b[i] -= d1 * (f[i] - f[i - s1]);
                c[i] -= d2 * (f[i] - f[i - s2]);
            }
        });
    const label size = block_.size();
    double* p = pressure_.data();
    const double* change = correction_.data();
#pragma GCC ivdep
    for (label q = 0; q < size; ++q)
    {
        p[q] += change[q];
    }
    if (++stage_ < nStages()) return;
    gradient_ /= stepDt_;
    if (RK3_) force_.clear();
}
