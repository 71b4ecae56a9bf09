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
      work_((2 * transform_.nThird + 3) * transform_.rowLength, 0),
      constant_(2 * transform_.nThird)
{
    std::fill_n(work_.data() + (transform_.nThird + 1) * transform_.rowLength,
                transform_.rowLength, 1.0);
}

bool Foam::fastHelmholtz::singular(const scalar sigma) const
{
    return sigma == 0 && sides_[0].constantAllowed() &&
           sides_[1].constantAllowed() && sides_[2].constantAllowed();
}

// The tridiagonal systems of one slow mode and all fast modes together, so that the
// inner loops run over neighbours in memory. Where the direction is periodic, rows
// before the last have its unknown as well, and the last one is freed of all others
// on the way:
//     x_j = y_j + c_j x_{j+1} + e_j x_last
void Foam::fastHelmholtz::sweepRow(double* row, const label slowMode,
                                   const scalar sigma,
                                   const FixedList<scalar, 3>& a)
{
    const sideConditions& ends = sides_[transform_.third];
    const bool cyclic = ends.periodic;
    const double at = a[transform_.third], af = a[transform_.fast];
    const label n = transform_.nThird, m = transform_.rowLength,
                stride = m * transform_.nRows, last = n - (cyclic ? 2 : 1);
    const double* eigen = transform_.eigenFast.data();
    const double base =
        sigma + a[transform_.slow] * transform_.eigenSlow[slowMode] + 2 * at;
    const double scale = 1 / transform_.normalisation;

    // Before c_0 and y_0 come zeros, before e_0 ones
    const double* zero = work_.data();
    double* c = work_.data() + m;
    double* e = c + (n + 1) * m;
    double* diagLast = e + n * m;
    double* xLast = row + (n - 1) * stride;
    if (cyclic)
    {
        for (label i = 0; i < m; ++i)
        {
            diagLast[i] = base + af * eigen[i];
            xLast[i] *= scale;
        }
    }

    for (label j = 0; j <= last; ++j)
    {
        double diag = base;
        if (!cyclic && !ends.faces)
        {
            if (j == 0) diag += ends.lowerDirichlet ? at : -at;
            if (j == n - 1) diag += ends.upperDirichlet ? at : -at;
        }
        // A value on the wall is zero
        const double open = ends.faces && j == 0 ? 0 : 1;

        double* x = row + j * stride;
        const double* xm = j ? x - stride : zero;
        double* cj = c + j * m;
        const double* cm = cj - m;
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            const double r = open / (diag + af * eigen[i] - at * cm[i]);
            cj[i] = at * r;
            x[i] = (scale * x[i] + at * xm[i]) * r;
        }
        if (!cyclic) continue;

        double* ej = e + j * m;
        const double* em = ej - m;
        const double next = j == last ? 1 : 0;
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            const double inLast = at * (em[i] + next);
            ej[i] = cj[i] * em[i];
            xLast[i] += inLast * x[i];
            diagLast[i] -= inLast * (ej[i] + next * cj[i]);
        }
    }

    if (cyclic)
    {
        for (label i = 0; i < m; ++i)
        {
            xLast[i] /= diagLast[i];
        }
    }
    for (label j = n - 2; j >= 0; --j)
    {
        double* x = row + j * stride;
        const double* xp = x + stride;
        const double* cj = c + j * m;
        const double* ej = e + j * m;
        if (cyclic)
        {
#pragma GCC ivdep
            for (label i = 0; i < m; ++i)
            {
                x[i] += cj[i] * xp[i] + ej[i] * xLast[i];
            }
            continue;
        }
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            x[i] += cj[i] * xp[i];
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
    const label stride = transform_.rowLength * transform_.nRows;
    const label nConstant = transform_.complexModes ? 2 : 1;
    double* const eigenOfConstant = transform_.eigenFast.data();
    if (skipConstant)
    {
        for (label j = 0; j < transform_.nThird; ++j)
        {
            constant_[j] = rows[j * stride];
        }
        sweepConstant(a[transform_.third]);

        // Keep the general sweep away from a zero pivot (a trapped exception)
        std::fill_n(eigenOfConstant, nConstant, 1.0);
    }
    for (label r = 0; r < transform_.nRows; ++r)
    {
        sweepRow(rows + r * transform_.rowLength, transform_.firstRow + r,
                 sigma, a);
        if (skipConstant) std::fill_n(eigenOfConstant, nConstant, 0.0);
    }
    if (skipConstant)
    {
        for (label j = 0; j < transform_.nThird; ++j)
        {
            rows[j * stride] = constant_[j];
            if (transform_.complexModes) rows[j * stride + 1] = 0;
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
