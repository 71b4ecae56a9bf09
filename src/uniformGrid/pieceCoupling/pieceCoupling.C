// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pieceCoupling.H"
#include <algorithm>
#include <numeric>

namespace
{
//- The rank that is dealt the first slow mode solves the line of the constant one
bool holdsFirst(const Foam::planeTransform::rows& dealt)
{
    return dealt.first == 0 && dealt.n > 0;
}
} // namespace

Foam::pieceCoupling::pieceCoupling(const planeTransform& transform,
                                   const bool cyclic)
    : transform_(transform),
      cyclic_(cyclic)
{
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
    connect(values_, NVALUES, BEFORE, true);
    connect(coefficients_, NCOEFFICIENTS, BEFOREDIAGONAL, false);
    connect(told_, NTOLD, PREVIOUS, true);

    const label m = transform_.rowLength;
    work_.resize((4 + 3 * nPieces()) * m, 0);
    std::fill_n(work_.data() + m, m, 1.0);
}

void Foam::pieceCoupling::connect(rows& r, const label each,
                                  const label beforePiece,
                                  const bool constants) const
{
    const label n = each * transform_.rowLength, all = each * keptOfAll();
    r.local.resize(all + (constants ? transform_.nPlanes : 0));
    if (!apart()) return;

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
            const label row = i / transform_.rowLength % each;
            if (row == beforePiece && !follows()) continue;
            travels(to, n * dealt.n * mine_ + i, n * dealt.first + i);
        }
        if (!constants || !holdsFirst(dealt)) continue;
        for (label k = 0; k < transform_.nPlanes; ++k)
        {
            travels(to, n * dealt.n * nPieces() + transform_.firstPlane + k,
                    all + k);
        }
    }
    const planeTransform::rows dealt(transform_.dealtTo(Pstream::myProcNo()));
    r.dealt.resize(n * dealt.n * nPieces() +
                   (constants && holdsFirst(dealt) ? transform_.nThird : 0));
    r.exchange.reset(new indexExchange(rank, place, source));
}

void Foam::pieceCoupling::solveHere()
{
    solveRow(values_.local.data(), 0, coefficients_.local.data(), 0,
             told_.local.data(), 0);
}

void Foam::pieceCoupling::solveConstantHere(const double scale)
{
    solveConstant(constants(), told_.local.data() + NTOLD * keptOfAll(), scale);
}

void Foam::pieceCoupling::solveApart(const bool newCoefficients,
                                     const double scale)
{
    if (newCoefficients)
    {
        coefficients_.exchange->forward(coefficients_.local.data(),
                                        coefficients_.dealt.data());
    }
    values_.exchange->forward(values_.local.data(), values_.dealt.data());

    const planeTransform::rows dealt(transform_.dealtTo(Pstream::myProcNo()));
    const label m = transform_.rowLength, each = m * dealt.n,
                all = each * nPieces();
    for (label row = 0; row < dealt.n; ++row)
    {
        solveRow(values_.dealt.data() + NVALUES * m * row, NVALUES * each,
                 coefficients_.dealt.data() + NCOEFFICIENTS * m * row,
                 NCOEFFICIENTS * each, told_.dealt.data() + NTOLD * m * row,
                 NTOLD * each);
    }
    if (scale != 0 && holdsFirst(dealt))
    {
        solveConstant(values_.dealt.data() + NVALUES * all,
                      told_.dealt.data() + NTOLD * all, scale);
    }
    told_.exchange->backward(told_.dealt.data(), told_.local.data());
}

// Elimination once more, of one unknown per piece; the last one of all is coupled to
// the first where the direction is periodic
void Foam::pieceCoupling::solveRow(const double* values, const label nextValues,
                                   const double* coefficients,
                                   const label nextCoefficients, double* told,
                                   const label nextTold)
{
    const label P = nPieces(), m = transform_.rowLength;
    const double* zeros = work_.data();
    const double* ones = zeros + m;
    const auto value = [&](const label p, const label which)
    { return values + (p % P) * nextValues + which * m; };
    const auto coefficient = [&](const label p, const label which)
    { return coefficients + (p % P) * nextCoefficients + which * m; };
    double* c = work_.data() + 2 * m;
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
void Foam::pieceCoupling::solveConstant(const double* b, double* x,
                                        const double scale) const
{
    const label n = transform_.nThird;
    const double mean = std::accumulate(b, b + n, 0.0) / n;
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
    const double closing = cyclic_ ? slopes / n : 0;
    values -= closing * 0.5 * n * (n - 1);
    for (label j = 0; j < n; ++j)
    {
        x[j] -= closing * j + values / n;
    }
}
