// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The arithmetic of a time step: one kernel for the three components

#include "staggeredFlow.H"
#include "momentumRow.H"

// The increments replace the force, and the new explicit terms the last ones. All
// increments are made from the velocity before: where they are added at once, a layer is
// added after the next one is made. The components of a cell follow each other, so that a
// flux that two of them share is computed once
template<bool Convection, bool Variable, bool Implicit>
void Foam::staggeredFlow::makeIncrements()
{
    // True if nu L u is among the explicit terms
    constexpr bool among = !Implicit && !Variable;
    const explicitScheme::stage& s = scheme_.now();
    const double dt = scheme_.deltaT(), nu = nu_.max();
    const double weightNow = dt * s.weightNow, weightLast = dt * s.weightLast,
                 dtStage = dt * s.dtFraction, nuDt = dtStage * nu;
    momentumRow all;
    staggeredField& change = increment();
    double *last[3], *out[3];
    for (direction d = 0; d < 3; ++d)
    {
        all.per[d] = 1 / grid_.h()[d];
        all.rate[d] = nu * sqr(all.per[d]);
        all.step[d] = block_.stride(d);
        all.u[d] = u_[d].data();
        all.nuEdge[d] = nu_.edges(d);
        last[d] = scheme_.last()[d].data();
        out[d] = change[d].data();
    }
    all.nu = nu_.cells();
    all.nu0 = Implicit ? nu : 0;
    all.p = pressure_.data();
    const label nx = block_.box().size.x();
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
                            : among    ? nu * diffusion[d]
                                       : 0) +
                           (Variable ? row.stress(d, i) : 0);
            }
#pragma GCC unroll 3
            for (int d = 0; d < 3; ++d)
            {
                out[d][n + i] =
                    weightNow * terms[d] + weightLast * last[d][n + i] +
                    (Implicit ? nuDt * diffusion[d] : 0) +
                    dtStage *
                        (out[d][n + i] -
                         row.per[d] * (row.p[i] - row.p[i - row.step[d]]));
                last[d][n + i] = terms[d];
            }
        }
    };
    const label nz = block_.box().size.z();
    for (label k = 0; k < nz; ++k)
    {
        block_.rows(k, makeRow);
        if (addsAtOnce() && k) addIncrements(k - 1);
    }
    if (addsAtOnce()) addIncrements(nz - 1);
    stopOnWalls();
}

// Adds the increments and sets them to zero, as the force of AB2 shares the array
void Foam::staggeredFlow::addIncrements(const label k)
{
    const label nx = block_.box().size.x();
    staggeredField& x = increment();
    const auto addRow = [&](const label q, const label n)
    {
        for (direction d = 0; d < 3; ++d)
        {
            double* u = u_[d].data() + q;
            double* change = x[d].data() + n;
#pragma GCC ivdep
            for (label i = 0; i < nx; ++i)
            {
                u[i] += change[i];
                change[i] = 0;
            }
        }
    };
    block_.rows(k, addRow);
}

void Foam::staggeredFlow::predict()
{
    const auto timing(effects_.time("momentum"));
    if (scheme_.RK3()) increment() = force_;
    updateVelocity();

    // The terms are chosen outside the loops
    using self = staggeredFlow;
    void (self::*const make[2][2][2])() = {
        {{&self::makeIncrements<0, 0, 0>, &self::makeIncrements<0, 0, 1>},
         {&self::makeIncrements<0, 1, 0>, &self::makeIncrements<0, 1, 1>}},
        {{&self::makeIncrements<1, 0, 0>, &self::makeIncrements<1, 0, 1>},
         {&self::makeIncrements<1, 1, 0>, &self::makeIncrements<1, 1, 1>}}};
    (this->*make[convection_][!nu_.uniform()][!diffusion_.isExplicit()])();
}

// With AB2 and explicit diffusion the increments are already in the velocity, which is
// the prediction. Otherwise u + increment/fraction predicts the end of the step, before
// implicit diffusion
Foam::velocityPrediction Foam::staggeredFlow::prediction()
{
    const scalar fraction = scheme_.now().dtFraction;
    const scalar dt = scheme_.deltaTOfStage();
    velocityPrediction p{
        {velocity()},
        diffusion_.isExplicit()
            ? 0
            : grid_.diffusionNumber(nu_.max(), scheme_.deltaT()),
        {},
        false};
    if (addsAtOnce())
    {
        p.force.append(staggeredTarget(u_, block_.index(0, 0, 0),
                                       block_.stride(1), block_.stride(2), dt));
    }
    else
    {
        p.u.append(staggeredView(increment(), 1 / fraction));
        p.force.append(staggeredTarget(increment(), dt));
    }

    // Later stages of RK3 have the force as well
    if (scheme_.RK3()) p.force.append(staggeredTarget(force_));
    return p;
}

Foam::scalar Foam::staggeredFlow::implicitDiffusivity() const
{
    return diffusion_.isExplicit()
               ? 0
               : 0.5 * nu_.max() * scheme_.deltaTOfStage();
}

void Foam::staggeredFlow::diffuse()
{
    const wallVelocities change(walls_.advance(scheme_.passed()));
    const scalar b = implicitDiffusivity();
    if (b > 0)
    {
        const auto timing(effects_.time("diffusion"));
        staggeredField& x = increment();
        diffusion_.solve({x[0].data(), x[1].data(), x[2].data()}, b, change);

        // Walls that change add to their whole layer, other walls included
        stopOnWalls();
    }

    const auto timing(effects_.time("momentum"));
    for (label k = 0; !addsAtOnce() && k < block_.box().size.z(); ++k)
    {
        addIncrements(k);
    }
    if (!mean_.active()) return;
    mean_.correct(u_, b,
                  [this, b](const direction c, scalar* x)
                  {
                      const FixedList<vector, 2> rest(Zero);
                      FixedList<scalar*, 3> one({nullptr, nullptr, nullptr});
                      one[c] = x;
                      diffusion_.solve(one, b, wallVelocities(rest));
                  });
}

void Foam::staggeredFlow::project()
{
    const auto timing(effects_.time("pressure"));
    const scalar dt = scheme_.deltaTOfStage();
    const label nx = block_.box().size.x();
    const vector& h = grid_.h();
    const scalar r0 = 1 / (dt * h.x()), r1 = 1 / (dt * h.y()),
                 r2 = 1 / (dt * h.z());
    const label s1 = block_.stride(1), s2 = block_.stride(2);

    // A gradient that enters before diffusion leaves with it: the pressure changes by the
    // correction - b L correction (Brown, Cortez, Minion 2001,
    // doi:10.1006/jcph.2001.6715), where - L correction is the source
    const scalar b = implicitDiffusivity();

    // On upper walls the velocity is zero since predict()
    block_.updateAbove({u_[0].data(), u_[1].data(), u_[2].data()});
    block_.rowsFromAbove(
        [&](const label q, const label)
        {
            const double* u = u_[0].data() + q;
            const double* v = u_[1].data() + q;
            const double* w = u_[2].data() + q;
            double* source = correction_.data() + q;
            double* p = pressure_.data() + q;
#pragma GCC ivdep
            for (label i = 0; i < nx; ++i)
            {
                source[i] = -(r0 * (u[i + 1] - u[i]) + r1 * (v[i + s1] - v[i]) +
                              r2 * (w[i + s2] - w[i]));
                p[i] += b * source[i];
            }
        });

    const FixedList<scalar, 3> inverseSqr(
        {1 / sqr(h.x()), 1 / sqr(h.y()), 1 / sqr(h.z())});
    poisson_.solve(correction_.data(), correction_.data(), 0, inverseSqr);
    block_.updateBelow<2>({correction_.data(), pressure_.data()});
    // Equal beyond walls and inside: the velocity on a wall stays
    block_.extend(correction_.data());
    block_.extend(pressure_.data());

    rates_.begin();
    const double d0 = dt / h.x(), d1 = dt / h.y(), d2 = dt / h.z();
    block_.rowsFromAbove(
        [&](const label q, const label)
        {
            double* u = u_[0].data() + q;
            double* v = u_[1].data() + q;
            double* w = u_[2].data() + q;
            double* p = pressure_.data() + q;
            const double* f = correction_.data() + q;
#pragma GCC ivdep
            for (label i = 0; i < nx; ++i)
            {
                u[i] -= d0 * (f[i] - f[i - 1]);
                v[i] -= d1 * (f[i] - f[i - s1]);
                w[i] -= d2 * (f[i] - f[i - s2]);
                p[i] += f[i];
            }
            rates_.take(u_, q);
        });
    for (direction d = 0; d < 3; ++d)
    {
        block_.layerPlaces(
            d, -1, [&](const label q) { pressure_[q] += correction_[q]; });
    }
    if (scheme_.next()) return;
    mean_.end(scheme_.deltaT());
    if (scheme_.RK3()) force_.clear();
}
