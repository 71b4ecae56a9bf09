// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "planeTransform.H"
#include <fftw3.h>
#include <cmath>

// FFTW_ESTIMATE: measured plans cost seconds, change the last bits from run to
// run and gained nothing reliable here
struct Foam::planeTransform::plans
{
    double* planes = nullptr;
    double* rows = nullptr;
    fftw_plan forward = nullptr;
    fftw_plan backward = nullptr;
    fftw_plan third = nullptr;

    ~plans()
    {
        if (forward) fftw_destroy_plan(forward);
        if (backward) fftw_destroy_plan(backward);
        if (third) fftw_destroy_plan(third);
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

Foam::planeTransform::planeTransform(const uniformGrid& grid,
                                     const FixedList<sideConditions, 3>& sides,
                                     const List<labelVector>& cells,
                                     const labelUList& places)
    : plans_(new plans)
{
    // A walled direction is the third: its sine and cosine transforms cost
    // twice a periodic one. y first, as walls usually are there
    third = 0;
    for (const direction d : {2, 0, 1})
    {
        const bool walled = !sides[d].periodic && grid.n()[d] > 1;
        const bool longer = grid.n()[d] >= grid.n()[third];
        if (walled || (sides[third].periodic && longer)) third = d;
    }
    for (direction d = 0; d < 3; ++d)
    {
        if (sides[d].faces) third = d;
    }
    fast = third == 0 ? 2 : 0;
    slow = 3 - third - fast;
    nFast = grid.n()[fast];
    nSlow = grid.n()[slow];
    nThird = grid.n()[third];

    const label me = Pstream::myProcNo();
    const label firstPlane = firstOf(nThird, me);
    const label nPlanes = firstOf(nThird, me + 1) - firstPlane;
    firstRow = firstOf(nSlow, me);
    nRows = firstOf(nSlow, me + 1) - firstRow;

    // Memory of the planes: [third][slow][fast]
    labelList rank(cells.size()), place(cells.size());
    forAll(rank, celli)
    {
        const labelVector& c = cells[celli];
        rank[celli] = rankOf(nThird, c[third]);
        place[celli] =
            c[fast] +
            nFast *
                (c[slow] + nSlow * (c[third] - firstOf(nThird, rank[celli])));
    }
    toPlanes_.reset(new indexExchange(rank, place, places));

    const label nPlaneValues = nPlanes * nSlow * nFast;
    plans_->planes = fftw_alloc_real(std::max(nPlaneValues, label(1)));
    plans_->rows = plans_->planes;

    if (Pstream::parRun())
    {
        // Memory of the rows: [third][slow][fast] with this rank's slow modes
        rank.setSize(nPlaneValues);
        place.setSize(nPlaneValues);
        for (label i = 0; i < nPlaneValues; ++i)
        {
            const label f = i % nFast;
            const label s = (i / nFast) % nSlow;
            const label p = firstPlane + i / (nFast * nSlow);
            rank[i] = rankOf(nSlow, s);
            const label first = firstOf(nSlow, rank[i]);
            const label n = firstOf(nSlow, rank[i] + 1) - first;
            place[i] = f + nFast * (s - first + n * p);
        }
        toRows_.reset(new indexExchange(rank, place));
        plans_->rows =
            fftw_alloc_real(std::max(nThird * nRows * nFast, label(1)));
    }

    const realTransform s(sides[slow], nSlow), f(sides[fast], nFast);
    const int n[2] = {int(nSlow), int(nFast)};
    if (nPlanes)
    {
        double* p = plans_->planes;
        const fftw_r2r_kind fwd[2] = {s.forward, f.forward};
        const fftw_r2r_kind bwd[2] = {s.backward, f.backward};
        const int dist = n[0] * n[1];
        plans_->forward =
            fftw_plan_many_r2r(2, n, nPlanes, p, nullptr, 1, dist, p, nullptr,
                               1, dist, fwd, FFTW_ESTIMATE);
        plans_->backward =
            fftw_plan_many_r2r(2, n, nPlanes, p, nullptr, 1, dist, p, nullptr,
                               1, dist, bwd, FFTW_ESTIMATE);
    }
    normalisation = s.normalisation * f.normalisation;
    eigenSlow = eigenvalues(sides[slow], nSlow);
    eigenFast = eigenvalues(sides[fast], nFast);
}

Foam::planeTransform::~planeTransform() {}

double* Foam::planeTransform::rows()
{
    return plans_->rows;
}

void Foam::planeTransform::forward(const scalar* x)
{
    toPlanes_->forward(x, plans_->planes);
    if (plans_->forward) fftw_execute(plans_->forward);
    if (toRows_) toRows_->forward(plans_->planes, plans_->rows);
}

void Foam::planeTransform::backward(scalar* x)
{
    if (toRows_) toRows_->backward(plans_->rows, plans_->planes);
    if (plans_->backward) fftw_execute(plans_->backward);
    toPlanes_->backward(plans_->planes, x);
}

void Foam::planeTransform::transformThird()
{
    const int n[1] = {int(nThird)};
    const int stride = nRows * nFast;
    const fftw_r2r_kind kind[1] = {FFTW_R2HC};
    double* r = rows();
    if (!plans_->third && stride)
    {
        plans_->third =
            fftw_plan_many_r2r(1, n, stride, r, nullptr, stride, 1, r, nullptr,
                               stride, 1, kind, FFTW_ESTIMATE);
    }
    if (plans_->third) fftw_execute(plans_->third);
}
