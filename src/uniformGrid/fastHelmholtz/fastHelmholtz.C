// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fastHelmholtz.H"
#include <fftw3.h>
#include <cmath>

namespace Foam
{
defineTypeNameAndDebug(fastHelmholtzCache, 0);
}

// FFTW_ESTIMATE: measured plans cost seconds, change the last bits from run to
// run and gained nothing reliable here
struct Foam::fastHelmholtz::plans
{
    double* planes = nullptr;
    double* rows = nullptr;
    fftw_plan forward = nullptr;
    fftw_plan backward = nullptr;

    ~plans()
    {
        if (forward) fftw_destroy_plan(forward);
        if (backward) fftw_destroy_plan(backward);
        if (rows != planes) fftw_free(rows);
        fftw_free(planes);
    }
};

namespace
{
using namespace Foam;

struct realTransform
{
    fftw_r2r_kind forward, backward;
    double normalisation;

    realTransform(const sideConditions& s, const label n)
    {
        normalisation = 2.0 * n;
        switch (s.code())
        {
        case 4:
            forward = FFTW_R2HC;
            backward = FFTW_HC2R;
            normalisation = n;
            break;
        case 3:
            forward = FFTW_RODFT10;
            backward = FFTW_RODFT01;
            break;
        case 2:
            forward = backward = FFTW_RODFT11;
            break;
        case 1:
            forward = backward = FFTW_REDFT11;
            break;
        default:
            forward = FFTW_REDFT10;
            backward = FFTW_REDFT01;
        }
    }
};

//- Eigenvalues of minus the second difference in the order of FFTW's output
std::vector<double> eigenvalues(const sideConditions& s, const label n)
{
    std::vector<double> lambda(n);
    for (label k = 0; k < n; ++k)
    {
        const double mode = s.code() == 4   ? 2.0 * std::min(k, n - k)
                            : s.code() == 3 ? k + 1.0
                            : s.code() == 0 ? double(k)
                                            : k + 0.5;
        const double sine =
            std::sin(0.5 * constant::mathematical::pi * mode / n);
        lambda[k] = 4 * sine * sine;
    }
    return lambda;
}

//- First of the items that rank holds when n are dealt to all ranks
label firstOf(const label n, const label rank)
{
    return (n * rank) / Pstream::nProcs();
}

//- The rank that holds item i of n
label rankOf(const label n, const label i)
{
    label rank = (i * Pstream::nProcs()) / n;
    while (firstOf(n, rank) > i)
    {
        --rank;
    }
    while (firstOf(n, rank + 1) <= i)
    {
        ++rank;
    }
    return rank;
}
} // namespace

Foam::fastHelmholtz::fastHelmholtz(const uniformGrid& grid,
                                   const FixedList<sideConditions, 3>& sides,
                                   const List<labelVector>& cells,
                                   const labelUList& places)
    : sides_(sides),
      plans_(new plans)
{
    // Sweep along a walled direction: its sine and cosine transforms cost
    // twice a periodic one. y first, as walls usually are there
    swept_ = 0;
    for (const direction d : {2, 0, 1})
    {
        const bool walled = !sides[d].periodic && grid.n()[d] > 1;
        const bool longer = grid.n()[d] >= grid.n()[swept_];
        if (walled || (sides[swept_].periodic && longer)) swept_ = d;
    }
    for (direction d = 0; d < 3; ++d)
    {
        if (sides[d].faces) swept_ = d;
    }
    fast_ = swept_ == 0 ? 2 : 0;
    slow_ = 3 - swept_ - fast_;
    nFast_ = grid.n()[fast_];
    nSlow_ = grid.n()[slow_];
    nSwept_ = grid.n()[swept_];

    const label me = Pstream::myProcNo();
    const label firstPlane = firstOf(nSwept_, me);
    planes_ = firstOf(nSwept_, me + 1) - firstPlane;
    firstRow_ = firstOf(nSlow_, me);
    rows_ = firstOf(nSlow_, me + 1) - firstRow_;

    // Memory of the planes: [swept][slow][fast]
    labelList rank(cells.size()), place(cells.size());
    forAll(rank, celli)
    {
        const labelVector& c = cells[celli];
        rank[celli] = rankOf(nSwept_, c[swept_]);
        place[celli] =
            c[fast_] +
            nFast_ * (c[slow_] +
                      nSlow_ * (c[swept_] - firstOf(nSwept_, rank[celli])));
    }
    toPlanes_.reset(new indexExchange(rank, place, places));

    const label nPlaneValues = planes_ * nSlow_ * nFast_;
    plans_->planes = fftw_alloc_real(std::max(nPlaneValues, label(1)));
    plans_->rows = plans_->planes;

    if (Pstream::parRun())
    {
        // Memory of the rows: [swept][slow][fast] with this rank's slow modes
        rank.setSize(nPlaneValues);
        place.setSize(nPlaneValues);
        for (label i = 0; i < nPlaneValues; ++i)
        {
            const label f = i % nFast_;
            const label s = (i / nFast_) % nSlow_;
            const label p = firstPlane + i / (nFast_ * nSlow_);
            rank[i] = rankOf(nSlow_, s);
            const label first = firstOf(nSlow_, rank[i]);
            const label nRows = firstOf(nSlow_, rank[i] + 1) - first;
            place[i] = f + nFast_ * (s - first + nRows * p);
        }
        toRows_.reset(new indexExchange(rank, place));
        plans_->rows =
            fftw_alloc_real(std::max(nSwept_ * rows_ * nFast_, label(1)));
    }

    const realTransform slow(sides[slow_], nSlow_), fast(sides[fast_], nFast_);
    const int n[2] = {int(nSlow_), int(nFast_)};
    if (planes_)
    {
        double* p = plans_->planes;
        const fftw_r2r_kind fwd[2] = {slow.forward, fast.forward};
        const fftw_r2r_kind bwd[2] = {slow.backward, fast.backward};
        const int dist = n[0] * n[1];
        plans_->forward =
            fftw_plan_many_r2r(2, n, planes_, p, nullptr, 1, dist, p, nullptr,
                               1, dist, fwd, FFTW_ESTIMATE);
        plans_->backward =
            fftw_plan_many_r2r(2, n, planes_, p, nullptr, 1, dist, p, nullptr,
                               1, dist, bwd, FFTW_ESTIMATE);
    }
    scale_ = 1 / (slow.normalisation * fast.normalisation);
    eigenSlow_ = eigenvalues(sides[slow_], nSlow_);
    eigenFast_ = eigenvalues(sides[fast_], nFast_);
    work_.resize(2 * nSwept_ * nFast_);
    constant_.resize(2 * nSwept_);
}

Foam::fastHelmholtz::~fastHelmholtz() {}

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
    const sideConditions& ends = sides_[swept_];
    const double at = a[swept_];
    const label n = nSwept_, m = nFast_, stride = m * rows_;
    const label last = ends.periodic ? n - 2 : n - 1;
    const bool cyclic = ends.periodic;

    double* __restrict__ c = work_.data();
    double* __restrict__ z = c + n * m;
    const double* __restrict__ eigen = eigenFast_.data();
    const double base = sigma + a[slow_] * eigenSlow_[slowMode] + 2 * at;
    const double af = a[fast_], scale = scale_;

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
    const label n = nSwept_;
    double* b = constant_.data();
    double* x = b + n;
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
        slope -= scale_ * (b[j] - mean) / a;
        sumSlope += slope;
        value += slope;
    }
    // Once round a periodic direction the value must come back to itself
    const double closing = sides_[swept_].periodic ? sumSlope / n : 0;
    sum -= closing * 0.5 * n * (n - 1);
    for (label j = 0; j < n; ++j)
    {
        b[j] = x[j] - closing * j - sum / n;
    }
}

void Foam::fastHelmholtz::solve(scalar* x, const scalar* b, const scalar sigma,
                                const FixedList<scalar, 3>& a)
{
    toPlanes_->forward(b, plans_->planes);
    if (plans_->forward) fftw_execute(plans_->forward);
    if (toRows_) toRows_->forward(plans_->planes, plans_->rows);

    const bool skipConstant = singular(sigma) && firstRow_ == 0 && rows_ > 0;
    const label stride = nFast_ * rows_;
    const double eigenOfConstant = eigenFast_[0];
    if (skipConstant)
    {
        for (label j = 0; j < nSwept_; ++j)
        {
            constant_[j] = plans_->rows[j * stride];
        }
        sweepConstant(a[swept_]);

        // Keep the general sweep away from a zero pivot (a trapped exception)
        eigenFast_[0] = 1;
    }
    for (label r = 0; r < rows_; ++r)
    {
        sweepRow(plans_->rows + r * nFast_, firstRow_ + r, sigma, a);
        eigenFast_[0] = eigenOfConstant;
    }
    if (skipConstant)
    {
        for (label j = 0; j < nSwept_; ++j)
        {
            plans_->rows[j * stride] = constant_[j];
        }
    }

    if (toRows_) toRows_->backward(plans_->rows, plans_->planes);
    if (plans_->backward) fftw_execute(plans_->backward);
    toPlanes_->backward(plans_->planes, x);
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
    List<labelVector> cells(grid.index().size());
    forAll(cells, celli)
    {
        cells[celli] = grid.ijk(celli);
    }
    kept_.emplace_back(code, std::unique_ptr<fastHelmholtz>(
                                 new fastHelmholtz(grid, sides, cells)));
    return *kept_.back().second;
}
