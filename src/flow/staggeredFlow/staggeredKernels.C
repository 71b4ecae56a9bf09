// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The arithmetic of a time step: one kernel for the three components

#include "staggeredFlow.H"

// Increment of component D without the implicit factors, in delta_; the new
// convection replaces the last one in h_. All nine fluxes have one form: the
// component E that carries, averaged along D, times component D averaged
// along E
template<int D>
void Foam::staggeredFlow::increment(const scalar dt, const scalar c1,
                                    const scalar c0, const scalar* force)
{
    const label nx = box_.size.x(), ny = box_.size.y(), nz = box_.size.z();
    const label s0 = 1, s1 = stride_[1], s2 = stride_[2], sD = stride_[D];
    const vector& h = grid_.h();
    const double q0 = 0.25 / h.x(), q1 = 0.25 / h.y(), q2 = 0.25 / h.z();
    const double v0 = nu_ / sqr(h.x()), v1 = nu_ / sqr(h.y()),
                 v2 = nu_ / sqr(h.z());
    const double rh = 1 / h[D];

    for (label k = 0; k < nz; ++k)
    {
        for (label j = 0; j < ny; ++j)
        {
            const label q = place(0, j, k), n = nx * (j + ny * k);
            const double* __restrict__ u = u_[D].data() + q;
            const double* __restrict__ a = u_[0].data() + q;
            const double* __restrict__ b = u_[1].data() + q;
            const double* __restrict__ c = u_[2].data() + q;
            const double* __restrict__ p = p_halo_.data() + q;
            const double* __restrict__ f = force + n;
            double* __restrict__ last = h_[D].data() + n;
            double* __restrict__ out = delta_[D].data() + n;
            for (label i = 0; i < nx; ++i)
            {
                const double x = u[i];
                const double x0 = u[i - s0], X0 = u[i + s0];
                const double x1 = u[i - s1], X1 = u[i + s1];
                const double x2 = u[i - s2], X2 = u[i + s2];
                const double convection =
                    q0 * ((a[i] + a[i - sD]) * (x + x0) -
                          (a[i + s0] + a[i + s0 - sD]) * (x + X0)) +
                    q1 * ((b[i] + b[i - sD]) * (x + x1) -
                          (b[i + s1] + b[i + s1 - sD]) * (x + X1)) +
                    q2 * ((c[i] + c[i - sD]) * (x + x2) -
                          (c[i + s2] + c[i + s2 - sD]) * (x + X2));
                const double diffusion = v0 * (X0 - 2 * x + x0) +
                                         v1 * (X1 - 2 * x + x1) +
                                         v2 * (X2 - 2 * x + x2);
                out[i] = dt * (c1 * convection + c0 * last[i] + diffusion +
                               f[i] - rh * (p[i] - p[i - sD]));
                last[i] = convection;
            }
        }
    }

    // The velocity on a wall stays
    if (wallBelow(D))
    {
        labelVector l;
        const direction e = D == 0 ? 1 : 0, g = 3 - D - e;
        for (l[g] = 0; l[g] < box_.size[g]; ++l[g])
        {
            for (l[e] = 0; l[e] < box_.size[e]; ++l[e])
            {
                l[D] = 0;
                const label n = l.x() + nx * (l.y() + ny * l.z());
                delta_[D][n] = h_[D][n] = 0;
            }
        }
    }
}

void Foam::staggeredFlow::project(const scalar dt)
{
    const label nx = box_.size.x(), ny = box_.size.y(), nz = box_.size.z();
    const vector& h = grid_.h();
    const scalar r0 = 1 / (dt * h.x()), r1 = 1 / (dt * h.y()),
                 r2 = 1 / (dt * h.z());
    const label s1 = stride_[1], s2 = stride_[2];

    updateVelocity();
    label n = 0;
    for (label k = 0; k < nz; ++k)
    {
        for (label j = 0; j < ny; ++j)
        {
            const label q = place(0, j, k);
            const double* __restrict__ a = u_[0].data() + q;
            const double* __restrict__ b = u_[1].data() + q;
            const double* __restrict__ c = u_[2].data() + q;
            for (label i = 0; i < nx; ++i, ++n)
            {
                divergence_[n] =
                    -(r0 * (a[i + 1] - a[i]) + r1 * (b[i + s1] - b[i]) +
                      r2 * (c[i + s2] - c[i]));
            }
        }
    }

    FixedList<scalar, 3> inverseSqr;
    for (direction d = 0; d < 3; ++d)
    {
        inverseSqr[d] = 1 / sqr(h[d]);
    }
    poisson_->solve(divergence_.data(), divergence_.data(), 0, inverseSqr);

    n = 0;
    for (label k = 0; k < nz; ++k)
    {
        for (label j = 0; j < ny; ++j)
        {
            const label q = place(0, j, k);
            for (label i = 0; i < nx; ++i, ++n)
            {
                correction_[q + i] = divergence_[n];
                p_halo_[q + i] += divergence_[n];
            }
        }
    }
    updateHalo(correction_);
    updateHalo(p_halo_);

    for (direction d = 0; d < 3; ++d)
    {
        const label s = stride_[d], begin = wallBelow(d) ? 1 : 0;
        const double r = dt / h[d];
        for (label k = d == 2 ? begin : 0; k < nz; ++k)
        {
            for (label j = d == 1 ? begin : 0; j < ny; ++j)
            {
                const label q = place(0, j, k);
                double* __restrict__ u = u_[d].data() + q;
                const double* __restrict__ f = correction_.data() + q;
                for (label i = d == 0 ? begin : 0; i < nx; ++i)
                {
                    u[i] -= r * (f[i] - f[i - s]);
                }
            }
        }
    }
}

void Foam::staggeredFlow::step(const scalar dt, const scalar lastDt,
                               const staggeredField& force)
{
    const scalar c0 = hasConvection_ ? -0.5 * dt / lastDt : 0;
    hasConvection_ = true;

    {
        const auto timing(effects_.time("momentum"));
        updateVelocity();

        // All increments are made from u^n: they wait until the last is done
        for (direction d = 0; d < 3; ++d)
        {
            switch (d)
            {
            case 0:
                increment<0>(dt, 1 - c0, c0, force[0].cdata());
                break;
            case 1:
                increment<1>(dt, 1 - c0, c0, force[1].cdata());
                break;
            default:
                increment<2>(dt, 1 - c0, c0, force[2].cdata());
            }
            for (direction e = 0; e < 3; ++e)
            {
                diffusion_[d][e]->solve(delta_[d].data(),
                                        0.5 * dt * nu_ / sqr(grid_.h()[e]));
            }
        }
        for (direction d = 0; d < 3; ++d)
        {
            label n = 0;
            for (label k = 0; k < box_.size.z(); ++k)
            {
                for (label j = 0; j < box_.size.y(); ++j)
                {
                    double* u = u_[d].data() + place(0, j, k);
                    for (label i = 0; i < box_.size.x(); ++i, ++n)
                    {
                        u[i] += delta_[d][n];
                    }
                }
            }
        }
    }

    const auto timing(effects_.time("pressure"));
    project(dt);
}

Foam::scalar Foam::staggeredFlow::CourantNo(const scalar dt) const
{
    scalar largest = 0;
    for (label k = 0; k < box_.size.z(); ++k)
    {
        for (label j = 0; j < box_.size.y(); ++j)
        {
            const label q = place(0, j, k);
            for (label i = 0; i < box_.size.x(); ++i)
            {
                scalar sum = 0;
                for (direction d = 0; d < 3; ++d)
                {
                    sum += mag(u_[d][q + i]) / grid_.h()[d];
                }
                largest = max(largest, sum);
            }
        }
    }
    return dt * returnReduce(largest, maxOp<scalar>());
}

Foam::scalar Foam::staggeredFlow::divergence()
{
    updateVelocity();
    scalar largest = 0, speed = SMALL;
    for (label k = 0; k < box_.size.z(); ++k)
    {
        for (label j = 0; j < box_.size.y(); ++j)
        {
            const label q = place(0, j, k);
            for (label i = 0; i < box_.size.x(); ++i)
            {
                scalar sum = 0;
                for (direction d = 0; d < 3; ++d)
                {
                    sum += (u_[d][q + i + stride_[d]] - u_[d][q + i]) /
                           grid_.h()[d];
                    speed = max(speed, mag(u_[d][q + i]));
                }
                largest = max(largest, mag(sum));
            }
        }
    }
    reduce(largest, maxOp<scalar>());
    reduce(speed, maxOp<scalar>());
    return largest * cmptMin(grid_.h()) / speed;
}
