// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fastHelmholtz.H"
#include <algorithm>
#include <cmath>

namespace Foam
{
defineTypeNameAndDebug(fastHelmholtzCache, 0);
}

namespace
{
// Exponent of a decay whose square, exp(-38), is below round-off
const double decayed = 19;
} // namespace

Foam::fastHelmholtz::fastHelmholtz(const uniformGrid& grid,
                                   const FixedList<sideConditions, 3>& sides,
                                   const labelUList& indices)
    : sides_(sides),
      transform_(grid, sides, indices),
      pieces_(transform_, sides[transform_.third].periodic),
      work_((2 * transform_.nPlanes + 3) * transform_.rowLength, 0),
      eigenOfFirst_(transform_.eigenFast)
{
    std::fill_n(work_.data() + (transform_.nPlanes + 1) * transform_.rowLength,
                transform_.rowLength, 1.0);
    std::fill_n(eigenOfFirst_.data(), transform_.complexModes ? 2 : 1, 1.0);

    coupled_ = sides[transform_.third].periodic || pieces_.apart();
    backwards_ = pieces_.backwards();
    follows_ = pieces_.follows();
}

bool Foam::fastHelmholtz::singular(const scalar sigma) const
{
    return sigma == 0 && sides_[0].constantAllowed() &&
           sides_[1].constantAllowed() && sides_[2].constantAllowed();
}

template<bool values>
void Foam::fastHelmholtz::eliminate(const label slowMode, const scalar sigma,
                                    const FixedList<scalar, 3>& a)
{
    const sideConditions& walls = sides_[transform_.third];
    const double at = alongThird(a), af = a[transform_.fast];
    const label n = transform_.nPlanes, m = transform_.rowLength,
                interior = coupled_ ? n - 1 : n, stride = this->stride();
    const double* eigen = singular(sigma) && slowMode == 0
                              ? eigenOfFirst_.data()
                              : transform_.eigenFast.data();
    const double base =
        sigma + a[transform_.slow] * transform_.eigenSlow[slowMode] + 2 * at;
    const double scale = 1 / transform_.normalisation;

    const auto planeOf = [&](const label k)
    { return transform_.firstPlane + (backwards_ ? n - 1 - k : k); };
    const auto diagonal = [&](const label plane)
    {
        double diag = base;
        if (!walls.periodic && !walls.faces)
        {
            if (plane == 0) diag += walls.lowerDirichlet ? at : -at;
            if (plane == transform_.nThird - 1)
            {
                diag += walls.upperDirichlet ? at : -at;
            }
        }
        return diag;
    };
    // A value on the wall is zero
    const auto onWall = [&](const label plane)
    { return walls.faces && plane == 0; };

    // Before c_0 and y_0 come zeros, before e_0 ones
    const double* zero = work_.data();
    double* c = work_.data() + m;
    double* e = c + (n + 1) * m;
    double* ends = pieces_.values(slowMode);
    double* coefficients = pieces_.coefficients(slowMode);
    double* before = ends + pieceCoupling::BEFORE * m;
    double* beforeDiagonal = coefficients + pieceCoupling::BEFOREDIAGONAL * m;
    if (values && coupled_)
    {
        std::fill_n(ends, pieceCoupling::NVALUES * m, 0.0);
        std::fill_n(coefficients, pieceCoupling::NCOEFFICIENTS * m, 0.0);
    }

    // A solution without right-hand side decays by the factor exp(-decay) per plane, and the
    // difference of the pivots from their limit by its square: in the slowest fast mode
    const double least = *std::min_element(eigen, eigen + m);
    const double decay =
        std::acosh(max(scalar(1), (base + af * least) / (2 * at)));
    settled_ = decay * n > decayed ? label(decayed / decay) + 2 : n;

    double* row = firstOf(slowMode);
    for (label k = 0; k < interior; ++k)
    {
        const double diag = diagonal(planeOf(k));
        const double open = onWall(planeOf(k)) ? 0 : 1;
        double* x = row + k * stride;
        const double* xm = k ? x - stride : zero;
        const double* cm = c + min(k - 1, settled_) * m;

        // The diagonal of the last plane is another one at a wall
        const bool own = k <= settled_ || k == n - 1;
        double* ck = c + (own ? k : settled_) * m;
        if (own)
        {
#pragma GCC ivdep
            for (label i = 0; i < m; ++i)
            {
                ck[i] = at * open / (diag + af * eigen[i] - at * cm[i]);
            }
        }
        if (values)
        {
            const double scaled = scale / at;
#pragma GCC ivdep
            for (label i = 0; i < m; ++i)
            {
                x[i] = (scaled * x[i] + xm[i]) * ck[i];
            }
        }
        if (!follows(k)) continue;

        double* ek = e + k * m;
        const double* em = ek - m;
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            ek[i] = ck[i] * em[i];
            if (values)
            {
                before[i] += at * em[i] * x[i];
                beforeDiagonal[i] += at * em[i] * ek[i];
            }
        }
    }
    if (!values || !coupled_) return;

    const double diag = diagonal(planeOf(n - 1));
    const bool wall = onWall(planeOf(n - 1));
    const double* x = row + (n - 1) * stride;
    const double* xm = n > 1 ? x - stride : zero;
    const double* cm = c + min(n - 2, settled_) * m;
    const double* em = follows(n - 2) ? e + (n - 2) * m : zero;
    for (label i = 0; i < m; ++i)
    {
        ends[pieceCoupling::OWN * m + i] = wall ? 0 : scale * x[i] + at * xm[i];
        coefficients[pieceCoupling::OWNDIAGONAL * m + i] =
            wall ? VGREAT : diag + af * eigen[i] - at * cm[i];
        coefficients[pieceCoupling::BETWEEN * m + i] =
            backwards_ ? at : at * em[i];
    }
}

void Foam::fastHelmholtz::substitute(const label slowMode)
{
    const label n = transform_.nPlanes, m = transform_.rowLength,
                stride = this->stride();
    const double* c = work_.data() + m;
    const double* e = c + (n + 1) * m;
    const double* told = pieces_.told(slowMode);
    const double* previous = told + pieceCoupling::PREVIOUS * m;
    double* row = firstOf(slowMode);
    if (coupled_)
    {
        std::copy_n(told + pieceCoupling::LAST * m, m, row + (n - 1) * stride);
    }
    for (label k = n - 2; k >= 0; --k)
    {
        double* x = row + k * stride;
        const double* xp = x + stride;
        const double* ck = c + min(k, settled_) * m;
        const double* ek = e + k * m;
        if (follows(k))
        {
#pragma GCC ivdep
            for (label i = 0; i < m; ++i)
            {
                x[i] += ck[i] * xp[i] + ek[i] * previous[i];
            }
            continue;
        }
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            x[i] += ck[i] * xp[i];
        }
    }
}

void Foam::fastHelmholtz::solve(scalar* x, const scalar* b, const scalar sigma,
                                const FixedList<scalar, 3>& a)
{
    transform_.forward(b);
    const label rows = pieces_.mine() >= 0 ? transform_.nSlowModes : 0;
    const double ofConstants =
        singular(sigma) ? 1 / (transform_.normalisation * alongThird(a)) : 0;
    for (label k = 0; k < transform_.nPlanes && ofConstants != 0; ++k)
    {
        pieces_.constants()[k] = *transform_.plane(k);
    }
    if (pieces_.apart())
    {
        for (label row = 0; row < rows; ++row)
        {
            eliminate<true>(row, sigma, a);
        }
        pieces_.solveApart(sigma != sigma_ || a != a_, ofConstants);
        sigma_ = sigma;
        a_ = a;
        for (label row = 0; row < rows; ++row)
        {
            eliminate<false>(row, sigma, a);
            substitute(row);
        }
    }
    else
    {
        for (label row = 0; row < rows; ++row)
        {
            eliminate<true>(row, sigma, a);
            if (coupled_) pieces_.solveHere();
            substitute(row);
        }
        if (ofConstants != 0 && rows) pieces_.solveConstantHere(ofConstants);
    }
    for (label k = 0; k < transform_.nPlanes && ofConstants != 0; ++k)
    {
        double* mode = transform_.plane(k);
        mode[0] = pieces_.toldConstants()[k];
        if (transform_.complexModes) mode[1] = 0;
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
    kept_.emplace_back(
        code, std::unique_ptr<fastHelmholtz>(new fastHelmholtz(grid, sides)));
    return *kept_.back().second;
}
