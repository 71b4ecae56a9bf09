// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fastHelmholtz.H"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace Foam
{
defineTypeNameAndDebug(fastHelmholtzCache, 0);
}

namespace
{
using namespace Foam;

//- What a piece says of its ends for each line, in rows of doubles. With each right-hand
//  side: that of the equation of its last plane, and what it adds to that of the plane
//  before it
enum
{
    OWN,
    BEFORE,
    NVALUES
};

//- Once for all right-hand sides: the diagonals in these equations, and the coefficient
//  between the two planes
enum
{
    OWNDIAGONAL,
    BEFOREDIAGONAL,
    BETWEEN,
    NCOEFFICIENTS
};

//- What it is told: the values of its last plane and of the plane before it
enum
{
    LAST,
    PREVIOUS,
    NTOLD
};

//- The rank that is dealt the first slow mode solves the line of the constant one
bool holdsFirst(const planeTransform::rows& dealt)
{
    return dealt.first == 0 && dealt.n > 0;
}
} // namespace

Foam::fastHelmholtz::fastHelmholtz(const uniformGrid& grid,
                                   const FixedList<sideConditions, 3>& sides,
                                   const List<labelVector>& cells,
                                   const labelUList& places)
    : sides_(sides),
      transform_(grid, sides, cells, places),
      work_((2 * transform_.nPlanes + 3) * transform_.rowLength, 0),
      eigenOfFirst_(transform_.eigenFast)
{
    std::fill_n(work_.data() + (transform_.nPlanes + 1) * transform_.rowLength,
                transform_.rowLength, 1.0);
    std::fill_n(eigenOfFirst_.data(), transform_.complexModes ? 2 : 1, 1.0);

    const label ranks = Pstream::parRun() ? Pstream::nProcs() : 1;
    for (label rank = 0; rank < ranks; ++rank)
    {
        const label n = transform_.nThird;
        if (planeTransform::firstDealt(n, rank, ranks) ==
            planeTransform::firstDealt(n, rank + 1, ranks))
        {
            continue;
        }
        if (rank == Pstream::myProcNo()) mine_ = holders_.size();
        holders_.append(rank);
    }
    const bool cyclic = sides[transform_.third].periodic;
    const label nPieces = holders_.size();
    coupled_ = cyclic || nPieces > 1;
    backwards_ = !cyclic && mine_ > 0 && mine_ == nPieces - 1;
    follows_ = cyclic || (mine_ > 0 && !backwards_);

    connect(coefficients_, NCOEFFICIENTS, false);
    connect(ends_, NVALUES, true);
    connect(told_, NTOLD, true);
    couple_.resize((3 * nPieces + 2) * transform_.rowLength);
}

void Foam::fastHelmholtz::connect(ofEnds& e, const label each,
                                  const bool constants) const
{
    const label n = each * transform_.rowLength, nPieces = holders_.size(),
                all = n * (nPieces == 1 ? 1 : transform_.nSlowModes);
    e.here.resize(all + (constants ? transform_.nPlanes : 0));
    if (nPieces == 1) return;

    DynamicList<label> rank, place, source;
    const auto travels = [&](const label to, const label p, const label s)
    {
        rank.append(to);
        place.append(p);
        source.append(s);
    };
    for (label to = 0; to < Pstream::nProcs() && mine_ >= 0; ++to)
    {
        const planeTransform::rows dealt(transform_.dealtTo(to));
        for (label i = 0; i < n * dealt.n; ++i)
        {
            travels(to, n * dealt.n * mine_ + i, n * dealt.first + i);
        }
        if (!constants || !holdsFirst(dealt)) continue;
        for (label k = 0; k < transform_.nPlanes; ++k)
        {
            travels(to, n * dealt.n * nPieces + transform_.firstPlane + k,
                    all + k);
        }
    }
    const planeTransform::rows dealt(transform_.dealtTo(Pstream::myProcNo()));
    e.there.resize(n * dealt.n * nPieces +
                   (constants && holdsFirst(dealt) ? transform_.nThird : 0));
    e.exchange.reset(new indexExchange(rank, place, source));
}

bool Foam::fastHelmholtz::singular(const scalar sigma) const
{
    return sigma == 0 && sides_[0].constantAllowed() &&
           sides_[1].constantAllowed() && sides_[2].constantAllowed();
}

template<bool values>
void Foam::fastHelmholtz::eliminate(const label slowMode, const scalar sigma,
                                    const FixedList<scalar, 3>& a, double* ends,
                                    double* coefficients)
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
    double* before = ends + BEFORE * m;
    double* beforeDiagonal = coefficients + BEFOREDIAGONAL * m;
    if (values && coupled_)
    {
        std::fill_n(ends, NVALUES * m, 0.0);
        std::fill_n(coefficients, NCOEFFICIENTS * m, 0.0);
    }

    // A step along the line changes c by the square of the factor by which it changes a
    // solution, of the slowest fast mode
    const double least = *std::min_element(eigen, eigen + m);
    const double decay =
        std::acosh(max(scalar(1), (base + af * least) / (2 * at)));
    settled_ = decay * n > 19 ? label(19 / decay) + 2 : n;

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
        ends[OWN * m + i] = wall ? 0 : scale * x[i] + at * xm[i];
        coefficients[OWNDIAGONAL * m + i] =
            wall ? VGREAT : diag + af * eigen[i] - at * cm[i];
        coefficients[BETWEEN * m + i] = backwards_ ? at : at * em[i];
    }
}

void Foam::fastHelmholtz::substitute(const label slowMode, const double* told)
{
    const label n = transform_.nPlanes, m = transform_.rowLength,
                stride = this->stride();
    const double* c = work_.data() + m;
    const double* e = c + (n + 1) * m;
    const double* previous = told + PREVIOUS * m;
    double* row = firstOf(slowMode);
    if (coupled_)
    {
        std::copy_n(told + LAST * m, m, row + (n - 1) * stride);
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

// Elimination once more, of one unknown per piece; the last one of all is coupled to
// the first where the direction is periodic
void Foam::fastHelmholtz::couple(const double* ends, const label nextEnds,
                                 const double* coefficients,
                                 const label nextCoefficients, double* told,
                                 const label nextTold)
{
    const label P = holders_.size(), m = transform_.rowLength;
    const double* zeros = work_.data();
    const double* ones = zeros + (transform_.nPlanes + 1) * m;
    const auto value = [&](const label p, const label which)
    { return ends + (p % P) * nextEnds + which * m; };
    const auto coefficient = [&](const label p, const label which)
    { return coefficients + (p % P) * nextCoefficients + which * m; };
    double* c = couple_.data();
    double* e = c + P * m;
    double* y = e + P * m;
    double* lastValue = y + P * m;
    double* lastDiagonal = lastValue + m;

    // One piece is its own neighbour on both sides
    const double twice = P == 1 ? 2 : 0;
    for (label i = 0; i < m; ++i)
    {
        lastValue[i] = value(P - 1, OWN)[i] + value(0, BEFORE)[i];
        lastDiagonal[i] = coefficient(P - 1, OWNDIAGONAL)[i] -
                          coefficient(0, BEFOREDIAGONAL)[i] -
                          twice * coefficient(0, BETWEEN)[i];
    }
    for (label p = 0; p < P - 1; ++p)
    {
        const double* own = value(p, OWN);
        const double* added = value(p + 1, BEFORE);
        const double* diagonal = coefficient(p, OWNDIAGONAL);
        const double* addedDiagonal = coefficient(p + 1, BEFOREDIAGONAL);
        const double* between = coefficient(p, BETWEEN);
        const double* betweenNext = coefficient(p + 1, BETWEEN);
        const double* cm = p ? c + (p - 1) * m : zeros;
        const double* ym = p ? y + (p - 1) * m : zeros;
        const double* em = p ? e + (p - 1) * m : ones;
        const bool nextIsLast = p == P - 2;
        for (label i = 0; i < m; ++i)
        {
            const double toLast =
                between[i] * em[i] + (nextIsLast ? betweenNext[i] : 0);
            const double r =
                1 / (diagonal[i] - addedDiagonal[i] - between[i] * cm[i]);
            c[p * m + i] = nextIsLast ? 0 : betweenNext[i] * r;
            e[p * m + i] = toLast * r;
            y[p * m + i] = (own[i] + added[i] + between[i] * ym[i]) * r;
            lastValue[i] += toLast * y[p * m + i];
            lastDiagonal[i] -= toLast * e[p * m + i];
        }
    }
    double* last = told + (P - 1) * nextTold + LAST * m;
    for (label i = 0; i < m; ++i)
    {
        last[i] = lastValue[i] / lastDiagonal[i];
    }
    for (label p = P - 2; p >= 0; --p)
    {
        const double* next = told + (p + 1) * nextTold + LAST * m;
        double* x = told + p * nextTold + LAST * m;
        for (label i = 0; i < m; ++i)
        {
            x[i] =
                y[p * m + i] + c[p * m + i] * next[i] + e[p * m + i] * last[i];
        }
    }
    for (label p = 0; p < P; ++p)
    {
        std::copy_n(told + ((p + P - 1) % P) * nextTold + LAST * m, m,
                    told + p * nextTold + PREVIOUS * m);
    }
}

// The singular line of the constant mode by two summations: first the differences, then
// the values; the means of b and x are taken out
void Foam::fastHelmholtz::solveConstant(const double* b, double* x,
                                        const scalar a) const
{
    const label n = transform_.nThird;
    const double scale = 1 / (transform_.normalisation * a),
                 mean = std::accumulate(b, b + n, 0.0) / n;
    double slope = 0, value = 0, values = 0, slopes = 0;
    for (label j = 0; j < n; ++j)
    {
        x[j] = value;
        values += value;
        slope -= scale * (b[j] - mean);
        slopes += slope;
        value += slope;
    }
    // Once round a periodic direction the value must come back to itself
    const double closing = sides_[transform_.third].periodic ? slopes / n : 0;
    values -= closing * 0.5 * n * (n - 1);
    for (label j = 0; j < n; ++j)
    {
        x[j] -= closing * j + values / n;
    }
}

void Foam::fastHelmholtz::solve(scalar* x, const scalar* b, const scalar sigma,
                                const FixedList<scalar, 3>& a)
{
    transform_.forward(b);
    const bool constants = singular(sigma);
    const label m = transform_.rowLength,
                rows = mine_ >= 0 ? transform_.nSlowModes : 0;

    // The constant modes stand behind the ends of lines: of all lines, or of the one slow
    // mode at a time that is solved where one rank has all planes
    const bool apart = bool(ends_.exchange);
    const label kept = apart ? transform_.nSlowModes * m : m;
    for (label k = 0; k < transform_.nPlanes && constants; ++k)
    {
        ends_.here[NVALUES * kept + k] = *transform_.plane(k);
    }
    if (apart)
    {
        for (label row = 0; row < rows; ++row)
        {
            eliminate<true>(
                row, sigma, a, ends_.here.data() + NVALUES * m * row,
                coefficients_.here.data() + NCOEFFICIENTS * m * row);
        }
        if (sigma != sigma_ || a != a_)
        {
            coefficients_.exchange->forward(coefficients_.here.data(),
                                            coefficients_.there.data());
            sigma_ = sigma;
            a_ = a;
        }
        ends_.exchange->forward(ends_.here.data(), ends_.there.data());

        const planeTransform::rows dealt(
            transform_.dealtTo(Pstream::myProcNo()));
        const label each = m * dealt.n, all = each * holders_.size();
        for (label row = 0; row < dealt.n; ++row)
        {
            couple(ends_.there.data() + NVALUES * m * row, NVALUES * each,
                   coefficients_.there.data() + NCOEFFICIENTS * m * row,
                   NCOEFFICIENTS * each, told_.there.data() + NTOLD * m * row,
                   NTOLD * each);
        }
        if (constants && holdsFirst(dealt))
        {
            solveConstant(ends_.there.data() + NVALUES * all,
                          told_.there.data() + NTOLD * all, alongThird(a));
        }
        told_.exchange->backward(told_.there.data(), told_.here.data());
        for (label row = 0; row < rows; ++row)
        {
            eliminate<false>(row, sigma, a, nullptr, nullptr);
            substitute(row, told_.here.data() + NTOLD * m * row);
        }
    }
    else
    {
        for (label row = 0; row < rows; ++row)
        {
            eliminate<true>(row, sigma, a, ends_.here.data(),
                            coefficients_.here.data());
            if (coupled_)
            {
                couple(ends_.here.data(), 0, coefficients_.here.data(), 0,
                       told_.here.data(), 0);
            }
            substitute(row, told_.here.data());
        }
        if (constants && rows)
        {
            solveConstant(ends_.here.data() + NVALUES * m,
                          told_.here.data() + NTOLD * m, alongThird(a));
        }
    }
    for (label k = 0; k < transform_.nPlanes && constants; ++k)
    {
        double* mode = transform_.plane(k);
        mode[0] = told_.here[NTOLD * kept + k];
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
    kept_.emplace_back(code, std::unique_ptr<fastHelmholtz>(
                                 new fastHelmholtz(grid, sides, grid.cells())));
    return *kept_.back().second;
}
