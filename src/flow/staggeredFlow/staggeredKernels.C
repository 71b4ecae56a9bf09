// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The arithmetic of a time step: one kernel for the three components

#include "staggeredFlow.H"
#include <numeric>

namespace
{
using namespace Foam;

//- Terms of the momentum equation at place i of a row of cells, component D
struct momentumRow
{
    //- One over h, nu/h^2 of explicit diffusion, and the steps to the next places in
    //  each direction
    double per[3], rate[3];
    label step[3];

    //- Velocity and pressure; nu and its values at the edges along each direction, what of
    //  nu is treated otherwise
    const double *u[3], *p, *nu, *nuEdge[3];
    double nu0;

    double laplacian(const int D, const label i) const
    {
        const double* x = u[D] + i;
        const auto along = [&](const int d)
        { return sqr(per[d]) * (x[step[d]] - 2 * x[0] + x[-step[d]]); };
        return along(0) + along(1) + along(2);
    }

    //- All nine fluxes have one form: the component that carries, averaged along D,
    //  times component D averaged along the direction of the carrying one. The sums of
    //  two neighbours that this needs serve explicit diffusion as well, in which
    //  x+ - 2 x + x- is (x + x-) + (x + x+) - 4 x
    template<bool WithDiffusion>
    double convection(const int D, const label i) const
    {
        const double* x = u[D] + i;
        const auto along = [&](const int d)
        {
            const double* carrier = u[d] + i;
            const label s = step[D], t = step[d];
            const double share = 0.25 * per[d];
            const double carryIn = carrier[0] + carrier[-s],
                         carryOut = carrier[t] + carrier[t - s];
            const double below = x[0] + x[-t], above = x[0] + x[t];
            return WithDiffusion ? (rate[d] + share * carryIn) * below +
                                       (rate[d] - share * carryOut) * above
                                 : share * (carryIn * below - carryOut * above);
        };
        const double sum = along(0) + along(1) + along(2);
        return WithDiffusion ? sum - 4 * (rate[0] + rate[1] + rate[2]) * x[0]
                             : sum;
    }

    //- The viscous force of nu - nu0
    double stress(const int D, const label i) const
    {
        const double *x = u[D] + i, *centre = nu + i;
        const label s = step[D];
        const auto across = [&](const int d)
        {
            const double *y = u[d] + i, *edge = nuEdge[3 - D - d] + i;
            const label t = step[d];
            return per[d] * ((edge[t] - nu0) * (per[d] * (x[t] - x[0]) +
                                                per[D] * (y[t] - y[t - s])) -
                             (edge[0] - nu0) * (per[d] * (x[0] - x[-t]) +
                                                per[D] * (y[0] - y[-s])));
        };
        return 2 * sqr(per[D]) *
                   ((centre[0] - nu0) * (x[s] - x[0]) -
                    (centre[-s] - nu0) * (x[0] - x[-s])) +
               across((D + 1) % 3) + across((D + 2) % 3);
    }
};
} // namespace

// Without the implicit factors, in place of the force; the new explicit terms replace the
// last ones. All increments are made from the velocity before: where they are added at
// once, those of a layer wait for the next layer's. The components of a cell follow each
// other: each flux that two of them share is computed once
template<bool Convection, bool Variable, bool Implicit>
void Foam::staggeredFlow::makeIncrements()
{
    // nu L u is among the explicit terms or among the others
    constexpr bool among = !Implicit && !Variable;
    const stage& s = stages_[stage_];
    const double now = stepDt_ * s.now, before = stepDt_ * s.before,
                 rest = stepDt_ * s.others, others = rest * nuMax_;
    momentumRow all;
    double *last[3], *out[3];
    for (direction d = 0; d < 3; ++d)
    {
        all.per[d] = 1 / grid_.h()[d];
        all.rate[d] = nuMax_ * sqr(all.per[d]);
        all.step[d] = block_.stride(d);
        all.u[d] = u_[d].data();
        all.nuEdge[d] = nuEdge_[d].data();
        last[d] = last_[d].data();
        out[d] = increment()[d].data();
    }
    all.nu = nu_.data();
    all.nu0 = Implicit ? nuMax_ : 0;
    all.p = pressure_.data();
    const label nx = box_.size.x();
    const auto makeRow = [=](const label q, const label n)
    {
        momentumRow row(all);
        for (direction d = 0; d < 3; ++d)
        {
            row.u[d] += q;
            if (Variable) row.nuEdge[d] += q;
        }
        if (Variable) row.nu += q;
        row.p += q;
#pragma GCC ivdep
        for (label i = 0; i < nx; ++i)
        {
            double diffusion[3], terms[3];
#pragma GCC unroll 3
            for (int d = 0; d < 3; ++d)
            {
                diffusion[d] =
                    Implicit || !Convection ? row.laplacian(d, i) : 0;
                terms[d] = (Convection ? row.convection<among>(d, i)
                            : among    ? nuMax_ * diffusion[d]
                                       : 0) +
                           (Variable ? row.stress(d, i) : 0);
            }
#pragma GCC unroll 3
            for (int d = 0; d < 3; ++d)
            {
                out[d][n + i] =
                    now * terms[d] + before * last[d][n + i] +
                    (Implicit ? others * diffusion[d] : 0) +
                    rest * (out[d][n + i] -
                            row.per[d] * (row.p[i] - row.p[i - row.step[d]]));
                last[d][n + i] = terms[d];
            }
        }
    };
    const label nz = box_.size.z();
    for (label k = 0; k < nz; ++k)
    {
        block_.rows(k, makeRow);
        if (addsAtOnce() && k) addIncrements(k - 1);
    }
    if (addsAtOnce()) addIncrements(nz - 1);
    stopOnWalls();
}

// The increments of AB2 lie in place of the force, which is zero after the step
void Foam::staggeredFlow::addIncrements(const label k)
{
    const auto addRow = [&](const label q, const label n)
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
    };
    block_.rows(k, addRow);
}

// The acceleration, uniform in space, that brings the mean of the velocity to what
// is held. Near walls the fluid answers to it through the implicit operator
void Foam::staggeredFlow::holdMean(const direction c, const scalar dt)
{
    const scalar nAll = scalar(grid_.n().x()) * grid_.n().y() * grid_.n().z();
    const label nx = box_.size.x();
    const scalar b = explicit_ ? 0 : 0.5 * nuMax_ * dt;
    if (b != responseTo_)
    {
        response_.assign(box_.nPlaces(), 0);
        block_.rows([&](const label, const label n)
                    { std::fill_n(&response_[n], nx, 1); });
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
    const auto timing(effects_.time("momentum"));
    if (RK3_) *increment_ = force_;
    updateVelocity();

    // What there is to do is chosen outside the loops
    using self = staggeredFlow;
    void (self::*const make[2][2][2])() = {
        {{&self::makeIncrements<0, 0, 0>, &self::makeIncrements<0, 0, 1>},
         {&self::makeIncrements<0, 1, 0>, &self::makeIncrements<0, 1, 1>}},
        {{&self::makeIncrements<1, 0, 0>, &self::makeIncrements<1, 0, 1>},
         {&self::makeIncrements<1, 1, 0>, &self::makeIncrements<1, 1, 1>}}};
    (this->*make[convection_][variable()][!explicit_])();
}

// Of AB2 with explicit diffusion the velocity, which has the increments; else these,
// without the implicit factors and as a share of those of the whole step, predict the
// velocity at its end
Foam::velocityPrediction Foam::staggeredFlow::prediction()
{
    const scalar others = stages_[stage_].others, dt = others * stepDt_;
    velocityPrediction p{{velocity()},
                         explicit_ ? 0 : grid_.diffusionNumber(nuMax_, stepDt_),
                         {}};
    if (addsAtOnce())
    {
        p.force.append(staggeredTarget(u_, block_.place(0, 0, 0),
                                       block_.stride(1), block_.stride(2), dt));
    }
    else
    {
        p.u.append(staggeredView(increment(), 1 / others));
        p.force.append(staggeredTarget(increment(), dt));
    }

    // Later stages of RK3 have the force as well
    if (RK3_) p.force.append(staggeredTarget(force_));
    return p;
}

void Foam::staggeredFlow::diffuse()
{
    const scalar dt = stages_[stage_].others * stepDt_;
    scalar passed = 0;
    for (label i = 0; i <= stage_; ++i)
    {
        passed += stages_[i].others;
    }
    wallVelocities change;
    for (direction d = 0; d < 3; ++d)
    {
        for (label side = 0; side < 2; ++side)
        {
            const vector ahead((1 - passed) * wallsBefore_[d][side] +
                               passed * wallsAfter_[d][side]);
            change[d][side] = ahead - walls_[d][side];
            walls_[d][side] = ahead;
        }
    }
    if (!explicit_)
    {
        const auto timing(effects_.time("diffusion"));
        staggeredField& x = increment();
        implicit_[transforms_]->solve({x[0].data(), x[1].data(), x[2].data()},
                                      0.5 * nuMax_ * dt, change);
    }

    const auto timing(effects_.time("momentum"));
    for (label k = 0; !addsAtOnce() && k < box_.size.z(); ++k)
    {
        addIncrements(k);
    }
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

    // Of walls above the velocity is zero since predict()
    block_.updateAbove({u_[0].data(), u_[1].data(), u_[2].data()});
    block_.rowsFromAbove(
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
    block_.updateBelow(correction_.data());
    // Beyond walls as inside: the velocity on a wall stays
    block_.extend(correction_.data());

    rates_.assign(nx, 0);
    steepness_.assign(nx, 0);
    const double d0 = dt / h.x(), d1 = dt / h.y(), d2 = dt / h.z();
    block_.rowsFromAbove(
        [&](const label q, const label)
        {
            double* a = u_[0].data() + q;
            double* b = u_[1].data() + q;
            double* c = u_[2].data() + q;
            double* p = pressure_.data() + q;
            const double* f = correction_.data() + q;
#pragma GCC ivdep
            for (label i = 0; i < nx; ++i)
            {
                a[i] -= d0 * (f[i] - f[i - 1]);
                b[i] -= d1 * (f[i] - f[i - s1]);
                c[i] -= d2 * (f[i] - f[i - s2]);
                p[i] += f[i];
            }
            takeRates(q);
        });
    for (direction d = 0; d < 3; ++d)
    {
        block_.layerPlaces(
            d, -1, [&](const label q) { pressure_[q] += correction_[q]; });
    }
    if (++stage_ < nStages()) return;
    gradient_ /= stepDt_;
    if (RK3_) force_.clear();
}
