// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "planeTransform.H"
#include <fftw3.h>
#include <cmath>

struct Foam::planeTransform::plans
{
    // Planes, one plane for work, whole lines
    double* planes = nullptr;
    double* work = nullptr;
    double* lines = nullptr;

    // Of one plane: along rows (both directions at once where modes are real), and
    // columns; along lines
    fftw_plan forward = nullptr, backward = nullptr;
    fftw_plan columns = nullptr, columnsBack = nullptr;
    fftw_plan third = nullptr;

    ~plans()
    {
        for (fftw_plan p : {forward, backward, columns, columnsBack, third})
        {
            if (p) fftw_destroy_plan(p);
        }
        if (lines != planes) fftw_free(lines);
        fftw_free(work);
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

fftw_complex* complexAt(double* x)
{
    return reinterpret_cast<fftw_complex*>(x);
}

//- Memory that FFTW likes, of zeros
double* zeros(const label n)
{
    double* x = fftw_alloc_real(std::max(n, label(1)));
    std::fill_n(x, n, 0.0);
    return x;
}

//- First of the items that rank holds when n are dealt to all ranks
label firstOf(const label n, const label rank)
{
    return planeTransform::firstDealt(n, rank, Pstream::nProcs());
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

//- The direction that leaves most cells where they are: those whose plane is dealt to
//  the rank that holds them. Of equal directions the given one (collective)
direction sweptByCut(const uniformGrid& grid, const List<labelVector>& cells,
                     const direction given)
{
    labelList own(3, Zero);
    const label me = Pstream::myProcNo();
    for (direction d = 0; d < 3; ++d)
    {
        const label n = grid.n()[d], begin = firstOf(n, me),
                    end = firstOf(n, me + 1);
        for (const labelVector& c : cells)
        {
            own[d] += c[d] >= begin && c[d] < end;
        }
        reduce(own[d], sumOp<label>());
    }
    direction best = given;
    for (const direction d : {2, 1, 0})
    {
        if (grid.n()[d] > 1 && own[d] > own[best]) best = d;
    }
    return best;
}
} // namespace

Foam::FixedList<Foam::sideConditions, 3> Foam::sidesOf(const uniformGrid& grid,
                                                       const bool zeroOnWalls)
{
    FixedList<sideConditions, 3> sides;
    for (direction d = 0; d < 3; ++d)
    {
        sides[d].periodic = grid.periodic(d);
        sides[d].lowerDirichlet = sides[d].upperDirichlet =
            zeroOnWalls && !grid.periodic(d);
    }
    return sides;
}

// A walled direction: its sine and cosine transforms cost twice a periodic one. y first,
// as walls usually are there
Foam::direction Foam::planeTransform::swept(const labelVector& n,
                                            const FixedList<bool, 3>& periodic)
{
    direction third = 0;
    for (const direction d : {2, 0, 1})
    {
        const bool walled = !periodic[d] && n[d] > 1;
        const bool longer = n[d] >= n[third];
        if (walled || (periodic[third] && longer)) third = d;
    }
    return third;
}

Foam::planeTransform::planeTransform(const uniformGrid& grid,
                                     const FixedList<sideConditions, 3>& sides,
                                     const labelUList& places)
    : plans_(new plans)
{
    const List<labelVector> cells(grid.cells());
    FixedList<bool, 3> periodic;
    for (direction d = 0; d < 3; ++d)
    {
        periodic[d] = sides[d].periodic;
    }
    third = swept(grid.n(), periodic);
    if (periodic[0] && periodic[1] && periodic[2] && Pstream::parRun())
    {
        third = sweptByCut(grid, cells, third);
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

    // Columns are transformed by twos: one of zeros follows an odd number
    complexModes = sides[slow].periodic && sides[fast].periodic;
    nColumns_ = nFast + nFast % 2;
    nSlowModes = complexModes ? nSlow / 2 + 1 : nSlow;
    rowLength = complexModes ? 2 * nColumns_ : rowOfValues();
    planeSize_ = max(nSlowModes * rowLength, nSlow * rowOfValues());

    const label me = Pstream::myProcNo();
    firstPlane = firstOf(nThird, me);
    nPlanes = firstOf(nThird, me + 1) - firstPlane;
    plans_->planes = zeros(nPlanes * planeSize_);

    // Memory of the values: [third][slow][fast], with room for the modes of a
    // plane. Those of this rank move plane by plane unless the planes lie across
    // the rows of memory
    std::vector<DynamicList<label>> ownSource(nPlanes), ownPlace(nPlanes);
    DynamicList<label> rank, place, source;
    forAll(cells, celli)
    {
        const labelVector& c = cells[celli];
        const label to = rankOf(nThird, c[third]);
        const label plane = c[third] - firstOf(nThird, to);
        const bool own = to == me && third != 0;
        const label from = places.size() ? places[celli] : celli;
        const label at =
            c[fast] + rowOfValues() * c[slow] + (own ? 0 : planeSize_ * plane);
        if (!own) rank.append(to);
        (own ? ownSource[plane] : source).append(from);
        (own ? ownPlace[plane] : place).append(at);
    }
    toPlanes_.reset(new indexExchange(rank, place, source));
    toPlane_.resize(nPlanes);
    for (label p = 0; p < nPlanes; ++p)
    {
        toPlane_[p].keep(ownSource[p], ownPlace[p]);
    }

    const realTransform s(sides[slow], nSlow), f(sides[fast], nFast);
    normalisation = s.normalisation * f.normalisation;
    eigenSlow = eigenvalues(sides[slow], nSlow);
    eigenFast = eigenvalues(sides[fast], nFast);
    eigenFast.resize(rowLength, 1);
    for (label i = 2 * nFast - 1; i > 0 && complexModes; --i)
    {
        eigenFast[i] = eigenFast[i / 2];
    }
    if (!nPlanes) return;

    fftw_plan &fwd = plans_->forward, &bwd = plans_->backward;
    double* x = plans_->planes;
    const int ns = nSlow, nf = nFast;
    const int row = rowOfValues();
    if (!complexModes)
    {
        const auto plan = [&](const fftw_r2r_kind slowKind,
                              const fftw_r2r_kind fastKind)
        {
            const int n[2] = {ns, nf}, rows[2] = {ns, row};
            const fftw_r2r_kind kinds[2] = {slowKind, fastKind};
            return fftw_plan_many_r2r(2, n, 1, x, rows, 1, 0, x, rows, 1, 0,
                                      kinds, FFTW_ESTIMATE);
        };
        fwd = plan(s.forward, f.forward);
        bwd = plan(s.backward, f.backward);
        return;
    }
    double* w = plans_->work = zeros(ns * row);
    const auto plan = [](const int n, const int number, const int stride,
                         const int next, double* from, double* to,
                         const int sign)
    {
        return fftw_plan_many_dft(1, &n, number, complexAt(from), nullptr,
                                  stride, next, complexAt(to), nullptr, stride,
                                  next, sign, FFTW_ESTIMATE);
    };
    const int pairs = nColumns_ / 2, modes = rowLength / 2;
    plans_->columns = plan(ns, pairs, row / 2, 1, x, w, FFTW_FORWARD);
    fwd = plan(nf, nSlowModes, 1, modes, x, x, FFTW_FORWARD);
    bwd = plan(nf, nSlowModes, 1, modes, x, x, FFTW_BACKWARD);
    plans_->columnsBack = plan(ns, pairs, row / 2, 1, w, x, FFTW_BACKWARD);
}

Foam::planeTransform::~planeTransform() {}

double* Foam::planeTransform::plane(const label k)
{
    return plans_->planes + k * planeSize_;
}

void Foam::planeTransform::transform(double* plane)
{
    if (!complexModes)
    {
        fftw_execute_r2r(plans_->forward, plane, plane);
        return;
    }
    fftw_execute_dft(plans_->columns, complexAt(plane),
                     complexAt(plans_->work));

    // C = A + i B of mode l and its conjugate n - l, A and B those of the columns
    for (label l = 0; l < nSlowModes; ++l)
    {
        const double* c = plans_->work + rowOfValues() * l;
        const double* d = plans_->work + rowOfValues() * ((nSlow - l) % nSlow);
        double* row = plane + rowLength * l;
#pragma GCC ivdep
        for (label i = 0; i < nColumns_; i += 2)
        {
            row[2 * i] = 0.5 * (c[i] + d[i]);
            row[2 * i + 1] = 0.5 * (c[i + 1] - d[i + 1]);
            row[2 * i + 2] = 0.5 * (c[i + 1] + d[i + 1]);
            row[2 * i + 3] = 0.5 * (d[i] - c[i]);
        }
        std::fill(row + 2 * nFast, row + rowLength, 0.0);
    }
    fftw_execute_dft(plans_->forward, complexAt(plane), complexAt(plane));
}

void Foam::planeTransform::transformBack(double* plane)
{
    if (!complexModes)
    {
        fftw_execute_r2r(plans_->backward, plane, plane);
        return;
    }
    fftw_execute_dft(plans_->backward, complexAt(plane), complexAt(plane));
    for (label l = 0; l < nSlowModes; ++l)
    {
        double* c = plans_->work + rowOfValues() * l;
        double* d = plans_->work + rowOfValues() * ((nSlow - l) % nSlow);
        const double* row = plane + rowLength * l;
#pragma GCC ivdep
        for (label i = 0; i < nColumns_; i += 2)
        {
            c[i] = row[2 * i] - row[2 * i + 3];
            c[i + 1] = row[2 * i + 1] + row[2 * i + 2];
            d[i] = row[2 * i] + row[2 * i + 3];
            d[i + 1] = row[2 * i + 2] - row[2 * i + 1];
        }
    }
    fftw_execute_dft(plans_->columnsBack, complexAt(plans_->work),
                     complexAt(plane));
}

void Foam::planeTransform::forward(const scalar* x)
{
    toPlanes_->forward(x, plans_->planes);

    // From the last plane on, which the last transform back has left in the cache
    for (label k = nPlanes - 1; k >= 0; --k)
    {
        toPlane_[k].forward(x, plane(k));
        transform(plane(k));
    }
}

void Foam::planeTransform::backward(scalar* x)
{
    for (label k = 0; k < nPlanes; ++k)
    {
        transformBack(plane(k));
        toPlane_[k].backward(plane(k), x);
    }
    toPlanes_->backward(plans_->planes, x);
}

Foam::planeTransform::rows Foam::planeTransform::dealtTo(const label rank) const
{
    const label first = firstOf(nSlowModes, rank);
    return {first, firstOf(nSlowModes, rank + 1) - first};
}

void Foam::planeTransform::transformThird()
{
    const int n[1] = {int(nThird)};
    const int number = dealtTo(Pstream::myProcNo()).n * rowLength;
    if (!plans_->lines)
    {
        thirdStride_ = Pstream::parRun() ? number : planeSize_;
        plans_->lines =
            Pstream::parRun() ? zeros(nThird * number) : plans_->planes;
        if (Pstream::parRun())
        {
            DynamicList<label> rank, place, source;
            for (label k = 0; k < nPlanes; ++k)
            {
                for (label to = 0; to < Pstream::nProcs(); ++to)
                {
                    const rows dealt(dealtTo(to));
                    const label each = dealt.n * rowLength;
                    for (label i = 0; i < each; ++i)
                    {
                        rank.append(to);
                        place.append((firstPlane + k) * each + i);
                        source.append(k * planeSize_ + dealt.first * rowLength +
                                      i);
                    }
                }
            }
            toLines_.reset(new indexExchange(rank, place, source));
        }
        const fftw_r2r_kind kind[1] = {FFTW_R2HC};
        double* r = plans_->lines;
        if (number)
        {
            plans_->third = fftw_plan_many_r2r(
                1, n, number, r, nullptr, thirdStride_, 1, r, nullptr,
                thirdStride_, 1, kind, FFTW_ESTIMATE);
        }
    }
    if (toLines_) toLines_->forward(plans_->planes, plans_->lines);
    if (plans_->third) fftw_execute(plans_->third);
}

const double* Foam::planeTransform::thirdMode(const label k) const
{
    return plans_->lines + k * thirdStride_;
}
