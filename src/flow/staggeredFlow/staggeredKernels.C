// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The arithmetic of a time step: one kernel for the three components

#include "staggeredFlow.H"

// Increment of component D without the implicit factors, in place of the
// force; the new explicit terms replace the last ones. All nine convective
// fluxes have one form: the component E that carries, averaged along D, times
// component D averaged along E
template<int D, bool Convection, bool Variable>
void Foam::staggeredFlow::explicitTerms(const scalar dt, const stage& weight,
                                        scalar* force)
{
    const label nx = box_.size.x();
    constexpr int E = (D + 1) % 3, G = (D + 2) % 3;
    const label s0 = 1, s1 = block_.stride(1), s2 = block_.stride(2);
    const label sD = block_.stride(D), sE = block_.stride(E),
                sG = block_.stride(G);
    const vector& h = grid_.h();
    const double q0 = 0.25 / h.x(), q1 = 0.25 / h.y(), q2 = 0.25 / h.z();

    // nu L u is among the explicit terms or among the others
    const scalar among = nuMax_ * (explicit_ ? 1 : 0);
    const double now = weight.now, before = weight.before, rest = weight.others;
    const double vRest = rest * (nuMax_ - among);
    const double L0 = 1 / sqr(h.x()), L1 = 1 / sqr(h.y()), L2 = 1 / sqr(h.z());
    const double rD = 1 / h[D], rE = 1 / h[E], rG = 1 / h[G];
    const double nu0 = explicit_ ? 0 : nuMax_;

    block_.rows(
        [&](const label q, const label n)
        {
            const double* __restrict__ u = u_[D].data() + q;
            const double* __restrict__ a = u_[0].data() + q;
            const double* __restrict__ b = u_[1].data() + q;
            const double* __restrict__ c = u_[2].data() + q;
            const double* __restrict__ e = u_[E].data() + q;
            const double* __restrict__ g = u_[G].data() + q;
            const double* __restrict__ p = pressure_.data() + q;
            const double* __restrict__ nu = Variable ? nu_.data() + q : nullptr;
            const double* __restrict__ nuDE =
                Variable ? nuEdge_[G].data() + q : nullptr;
            const double* __restrict__ nuDG =
                Variable ? nuEdge_[E].data() + q : nullptr;
            double* __restrict__ last = last_[D].data() + n;
            double* __restrict__ out = force + n;
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
                    const auto strain =
                        [](const double* w, const label i, const label s)
                    { return w[i] - w[i - s]; };
                    terms += 2 * sqr(rD) *
                                 ((nu[i] - nu0) * strain(u, i + sD, sD) -
                                  (nu[i - sD] - nu0) * strain(u, i, sD)) +
                             rE * ((nuDE[i + sE] - nu0) *
                                       (rE * strain(u, i + sE, sE) +
                                        rD * strain(e, i + sE, sD)) -
                                   (nuDE[i] - nu0) * (rE * strain(u, i, sE) +
                                                      rD * strain(e, i, sD))) +
                             rG * ((nuDG[i + sG] - nu0) *
                                       (rG * strain(u, i + sG, sG) +
                                        rD * strain(g, i + sG, sD)) -
                                   (nuDG[i] - nu0) * (rG * strain(u, i, sG) +
                                                      rD * strain(g, i, sD)));
                }
                else
                {
                    terms += among * diffusion;
                }
                out[i] =
                    dt * (now * terms + before * last[i] + vRest * diffusion +
                          rest * (out[i] - rD * (p[i] - p[i - sD])));
                last[i] = terms;
            }
        });

    // The velocity on a wall stays
    if (block_.wallBelow(D))
    {
        box_.layer(D, 0, [&](const label i) { force[i] = last_[D][i] = 0; });
    }
}

template<int D>
void Foam::staggeredFlow::makeIncrement(const scalar dt, const stage& s,
                                        scalar* force)
{
    if (convection_ && variable()) explicitTerms<D, true, true>(dt, s, force);
    if (convection_ && !variable()) explicitTerms<D, true, false>(dt, s, force);
    if (!convection_ && variable()) explicitTerms<D, false, true>(dt, s, force);
    if (!convection_ && !variable())
    {
        explicitTerms<D, false, false>(dt, s, force);
    }
}

// The acceleration, uniform in space, that brings the mean of the velocity
// after this increment to what is held. Near walls the fluid answers to it
// through the implicit operator
void Foam::staggeredFlow::holdMean(const direction c, scalar* increment,
                                   const scalar dt)
{
    const scalar nAll = scalar(grid_.n().x()) * grid_.n().y() * grid_.n().z();
    const scalar b = explicit_ ? 0 : 0.5 * nuMax_ * dt;
    if (b != responseTo_ || response_.empty())
    {
        response_.assign(box_.count(), 1);
        if (b > 0)
            implicit_[transforms_]->solve(
                c, response_.data(), b,
                wallVelocities(FixedList<vector, 2>(Zero)));
        scalar sum = 0;
        for (const scalar r : response_)
        {
            sum += r;
        }
        meanResponse_ = returnReduce(sum, sumOp<scalar>()) / nAll;
        responseTo_ = b;
    }

    scalar sum = 0;
    block_.rows(
        [&](const label q, const label n)
        {
            for (label i = 0; i < box_.size.x(); ++i)
            {
                sum += u_[c][q + i] + increment[n + i];
            }
        });
    meanBefore_ = returnReduce(sum, sumOp<scalar>()) / nAll;

    const scalar push = (heldMean_ - meanBefore_) / meanResponse_;
    for (label i = 0; i < box_.count(); ++i)
    {
        increment[i] += push * response_[i];
    }
    gradient_ += push;
}

void Foam::staggeredFlow::predict()
{
    const stage& s = stages_[stage_];
    const auto timing(effects_.time("momentum"));

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

    // All increments are made from the velocity before: they wait until the last
    // is done
    makeIncrement<0>(stepDt_, s, increment()[0].data());
    makeIncrement<1>(stepDt_, s, increment()[1].data());
    makeIncrement<2>(stepDt_, s, increment()[2].data());
}

// The increments of a stage without the implicit factors, as a share of those of
// the whole step, predict the velocity at its end
Foam::velocityPrediction Foam::staggeredFlow::prediction()
{
    const scalar others = stages_[stage_].others;
    const scalar fraction =
        explicit_ ? 1
                  : impulseFractionOf(grid_.diffusionNumber(nuMax_, stepDt_));
    const scalar part = (explicit_ ? 1 : 0.7 * fraction) / others;
    velocityPrediction p{{velocity(), {increment(), part}},
                         fraction,
                         {{others * stepDt_, &increment()}}};

    // Later stages of RK3 have the force as well
    if (RK3_) p.force.append({1, &force_});
    return p;
}

void Foam::staggeredFlow::diffuse()
{
    const scalar dt = stages_[stage_].others * stepDt_;
    staggeredField& increments = increment();
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
        for (direction d = 0; d < 3; ++d)
        {
            implicit_[transforms_]->solve(d, increments[d].data(),
                                          0.5 * nuMax_ * dt, change);
        }
    }
    walls_ = wallsAhead_;

    const auto timing(effects_.time("momentum"));
    if (holdsMean_)
    {
        holdMean(heldComponent_, increments[heldComponent_].data(), dt);
    }

    block_.rows(
        [&](const label q, const label n)
        {
            for (direction d = 0; d < 3; ++d)
            {
                double* __restrict__ u = u_[d].data() + q;
                const double* __restrict__ increment =
                    increments[d].cdata() + n;
                for (label i = 0; i < box_.size.x(); ++i)
                {
                    u[i] += increment[i];
                }
            }
        });
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
            const double* __restrict__ a = u_[0].data() + q;
            const double* __restrict__ b = u_[1].data() + q;
            const double* __restrict__ c = u_[2].data() + q;
            double* __restrict__ source = correction_.data() + q;
            for (label i = 0; i < nx; ++i)
            {
                source[i] = -(r0 * (a[i + 1] - a[i]) + r1 * (b[i + s1] - b[i]) +
                              r2 * (c[i + s2] - c[i]));
            }
        });

    FixedList<scalar, 3> inverseSqr;
    for (direction d = 0; d < 3; ++d)
    {
        inverseSqr[d] = 1 / sqr(h[d]);
    }
    poisson_->solve(correction_.data(), correction_.data(), 0, inverseSqr);
    block_.update(correction_.data());
    // Beyond walls as inside: the velocity on a wall stays
    block_.extend(correction_.data());

    const double d0 = dt / h.x(), d1 = dt / h.y(), d2 = dt / h.z();
    block_.rows(
        [&](const label q, const label)
        {
            double* __restrict__ a = u_[0].data() + q;
            double* __restrict__ b = u_[1].data() + q;
            double* __restrict__ c = u_[2].data() + q;
            const double* __restrict__ f = correction_.data() + q;
            for (label i = 0; i < nx; ++i)
            {
                a[i] -= d0 * (f[i] - f[i - 1]);
                b[i] -= d1 * (f[i] - f[i - s1]);
                c[i] -= d2 * (f[i] - f[i - s2]);
            }
        });
    for (label q = 0; q < block_.size(); ++q)
    {
        pressure_[q] += correction_[q];
    }
    if (++stage_ == nStages()) gradient_ /= stepDt_;
}
