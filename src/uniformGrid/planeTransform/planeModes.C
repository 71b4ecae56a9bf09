// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Plans of FFTW, and the transforms between values and modes

#include "planePlans.H"
#include <cmath>

namespace
{
using namespace Foam;

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
} // namespace

void Foam::planeTransform::makePlans(const sideConditions& slowSides,
                                     const sideConditions& fastSides)
{
    const realTransform s(slowSides, nSlow), f(fastSides, nFast);
    normalisation = s.normalisation * f.normalisation;
    eigenSlow = eigenvalues(slowSides, nSlow);
    eigenFast = eigenvalues(fastSides, nFast);
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
        const auto plan =
            [&](const fftw_r2r_kind slowKind, const fftw_r2r_kind fastKind)
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

void Foam::planeTransform::makeLines()
{
    const int n[1] = {int(nThird)};
    const int number = dealtTo(Pstream::myProcNo()).n * rowLength;
    thirdStride_ = Pstream::parRun() ? number : planeSize_;
    plans_->lines = Pstream::parRun() ? zeros(nThird * number) : plans_->planes;
    if (Pstream::parRun())
    {
        DynamicList<label> rank, target, source;
        for (label k = 0; k < nPlanes; ++k)
        {
            for (label to = 0; to < Pstream::nProcs(); ++to)
            {
                const rows dealt(dealtTo(to));
                const label each = dealt.n * rowLength;
                for (label i = 0; i < each; ++i)
                {
                    rank.append(to);
                    target.append((firstPlane + k) * each + i);
                    source.append(k * planeSize_ + dealt.first * rowLength + i);
                }
            }
        }
        toLines_.reset(new indexExchange(rank, target, source));
    }
    const fftw_r2r_kind kind[1] = {FFTW_R2HC};
    double* r = plans_->lines;
    if (number)
    {
        plans_->third =
            fftw_plan_many_r2r(1, n, number, r, nullptr, thirdStride_, 1, r,
                               nullptr, thirdStride_, 1, kind, FFTW_ESTIMATE);
    }
}

void Foam::planeTransform::transformThird()
{
    if (!plans_->lines) makeLines();
    if (toLines_) toLines_->forward(plans_->planes, plans_->lines);
    if (plans_->third) fftw_execute(plans_->third);
}

const double* Foam::planeTransform::thirdMode(const label k) const
{
    return plans_->lines + k * thirdStride_;
}
