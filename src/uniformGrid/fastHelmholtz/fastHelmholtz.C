// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fastHelmholtz.H"

namespace Foam
{
defineTypeNameAndDebug(fastHelmholtzCache, 0);
}

Foam::fastHelmholtz::fastHelmholtz(const uniformGrid& grid,
                                   const FixedList<sideConditions, 3>& sides,
                                   const List<labelVector>& cells,
                                   const labelUList& places)
    : sides_(sides),
      transform_(grid, sides, cells, places),
      work_(2 * transform_.nThird * transform_.nFast),
      constant_(2 * transform_.nThird)
{
}

bool Foam::fastHelmholtz::singular(const scalar sigma) const
{
    return sigma == 0 && sides_[0].constantAllowed() &&
           sides_[1].constantAllowed() && sides_[2].constantAllowed();
}

// The tridiagonal systems of one slow mode and all fast modes together, so
// that the inner loop runs over neighbours in memory. Where the direction is
// periodic the last unknown is eliminated: x_j = y_j + z_j x_last.
void Foam::fastHelmholtz::sweepRow(double* row, const label slowMode,
                                   const scalar sigma,
                                   const FixedList<scalar, 3>& a)
{
    const sideConditions& ends = sides_[transform_.third];
    const double at = a[transform_.third];
    const label n = transform_.nThird, m = transform_.nFast,
                stride = m * transform_.nRows;
    const label last = ends.periodic ? n - 2 : n - 1;
    const bool cyclic = ends.periodic;

    double* __restrict__ c = work_.data();
    double* __restrict__ z = c + n * m;
    const double* __restrict__ eigen = transform_.eigenFast.data();
    const double base =
        sigma + a[transform_.slow] * transform_.eigenSlow[slowMode] + 2 * at;
    const double af = a[transform_.fast];
    const double scale = 1 / transform_.normalisation;

    for (label j = 0; j <= last; ++j)
    {
        double diag = base;
        if (!cyclic && !ends.faces)
        {
            if (j == 0) diag += ends.lowerDirichlet ? at : -at;
            if (j == n - 1) diag += ends.upperDirichlet ? at : -at;
        }

        double* __restrict__ x = row + j * stride;
        const double* __restrict__ xm = x - stride;
        double* __restrict__ cj = c + j * m;
        const double* __restrict__ cm = cj - m;
        if (j == 0)
        {
            // A value on the wall is zero
            const double open = ends.faces ? 0 : 1;
            for (label i = 0; i < m; ++i)
            {
                const double r = open / (diag + af * eigen[i]);
                cj[i] = at * r;
                x[i] = scale * x[i] * r;
            }
        }
        else
        {
            for (label i = 0; i < m; ++i)
            {
                const double r = 1 / (diag + af * eigen[i] - at * cm[i]);
                cj[i] = at * r;
                x[i] = (scale * x[i] + at * xm[i]) * r;
            }
        }
        if (cyclic)
        {
            // Right-hand side a (e_first + e_last) of z; cj/at is 1/pivot
            double* __restrict__ zj = z + j * m;
            const double* __restrict__ zm = zj - m;
            const double b = (j == 0 ? 1 : 0) + (j == last ? 1 : 0);
            for (label i = 0; i < m; ++i)
            {
                zj[i] = cj[i] * (b + (j ? zm[i] : 0));
            }
        }
    }

    for (label j = last - 1; j >= 0; --j)
    {
        double* __restrict__ x = row + j * stride;
        const double* __restrict__ xp = x + stride;
        const double* __restrict__ cj = c + j * m;
        for (label i = 0; i < m; ++i)
        {
            x[i] += cj[i] * xp[i];
        }
        if (cyclic)
        {
            double* __restrict__ zj = z + j * m;
            const double* __restrict__ zp = zj + m;
            for (label i = 0; i < m; ++i)
            {
                zj[i] += cj[i] * zp[i];
            }
        }
    }

    if (cyclic)
    {
        double* __restrict__ xl = row + (n - 1) * stride;
        const double* __restrict__ x0 = row;
        const double* __restrict__ xm = row + (n - 2) * stride;
        const double* __restrict__ z0 = z;
        const double* __restrict__ zm = z + (n - 2) * m;
        for (label i = 0; i < m; ++i)
        {
            xl[i] = (scale * xl[i] + at * (xm[i] + x0[i])) /
                    (base + af * eigen[i] - at * (zm[i] + z0[i]));
        }
        for (label j = 0; j < n - 1; ++j)
        {
            double* __restrict__ x = row + j * stride;
            const double* __restrict__ zj = z + j * m;
            for (label i = 0; i < m; ++i)
            {
                x[i] += zj[i] * xl[i];
            }
        }
    }
}

// The singular column of the constant mode, in constant_, by two summations:
// first the differences, then the values; the means of b and x are taken out.
void Foam::fastHelmholtz::sweepConstant(const scalar a)
{
    const label n = transform_.nThird;
    double* b = constant_.data();
    double* x = b + n;
    const double scale = 1 / transform_.normalisation;
    double mean = 0;
    for (label j = 0; j < n; ++j)
    {
        mean += b[j] / n;
    }

    double slope = 0, value = 0, sum = 0, sumSlope = 0;
    for (label j = 0; j < n; ++j)
    {
        x[j] = value;
        sum += value;
        slope -= scale * (b[j] - mean) / a;
        sumSlope += slope;
        value += slope;
    }
    // Once round a periodic direction the value must come back to itself
    const double closing = sides_[transform_.third].periodic ? sumSlope / n : 0;
    sum -= closing * 0.5 * n * (n - 1);
    for (label j = 0; j < n; ++j)
    {
        b[j] = x[j] - closing * j - sum / n;
    }
}

void Foam::fastHelmholtz::solve(scalar* x, const scalar* b, const scalar sigma,
                                const FixedList<scalar, 3>& a)
{
    transform_.forward(b);
    double* const rows = transform_.rows();

    const bool skipConstant =
        singular(sigma) && transform_.firstRow == 0 && transform_.nRows > 0;
    const label stride = transform_.nFast * transform_.nRows;
    const double eigenOfConstant = transform_.eigenFast[0];
    if (skipConstant)
    {
        for (label j = 0; j < transform_.nThird; ++j)
        {
            constant_[j] = rows[j * stride];
        }
        sweepConstant(a[transform_.third]);

        // Keep the general sweep away from a zero pivot (a trapped exception)
        transform_.eigenFast[0] = 1;
    }
    for (label r = 0; r < transform_.nRows; ++r)
    {
        sweepRow(rows + r * transform_.nFast, transform_.firstRow + r, sigma,
                 a);
        transform_.eigenFast[0] = eigenOfConstant;
    }
    if (skipConstant)
    {
        for (label j = 0; j < transform_.nThird; ++j)
        {
            rows[j * stride] = constant_[j];
        }
    }

    transform_.backward(x);
}

Foam::fastHelmholtz&
Foam::fastHelmholtzCache::get(const FixedList<sideConditions, 3>& sides) const
{
    const label code =
        sides[0].code() + 6 * (sides[1].code() + 6 * sides[2].code());
    for (auto& entry : kept_)
    {
        if (entry.first == code) return *entry.second;
    }
    const uniformGrid& grid = uniformGrid::New(this->mesh_);
    kept_.emplace_back(code, std::unique_ptr<fastHelmholtz>(
                                 new fastHelmholtz(grid, sides, grid.cells())));
    return *kept_.back().second;
}
