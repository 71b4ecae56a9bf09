// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pieceCoupling.H"
#include "SquareMatrix.H"
#include "scalarMatrices.H"
#include "testWaves.H"

using namespace Foam;
using test::grid;

namespace
{
//- Value of piece p for a line, equal on all ranks
scalar said(const label what, const label p, const label row, const label i)
{
    return test::noise(vector(0.3 * p + 0.1, 0.7 * row, 0.9 * i), what);
}

scalar coefficient(const label what, const label p, const label row,
                   const label i)
{
    return (what == pieceCoupling::OWNDIAGONAL ? 4 : 0) +
           0.5 * said(10 + what, p, row, i);
}
} // namespace

class PieceCoupling : public ::testing::Test
{
protected:
    planeTransform transform{grid(), sidesOf(grid())};
    const bool cyclic = grid().periodic(transform.third);
    pieceCoupling pieces{transform, cyclic};
    const label m = transform.rowLength;

    //- Nothing lies before a piece at a wall, and the last one is swept from there
    bool follows(const label p) const
    {
        return cyclic || (p > 0 && p < pieces.nPieces() - 1);
    }
    scalar between(const label p, const label row, const label i) const
    {
        return cyclic || p > 0 ? coefficient(pieceCoupling::BETWEEN, p, row, i)
                               : 0;
    }

    void say(const label row)
    {
        const label p = pieces.mine();
        if (p < 0) return;
        for (label i = 0; i < m; ++i)
        {
            double* values = pieces.values(row) + i;
            double* coefficients = pieces.coefficients(row) + i;
            values[pieceCoupling::OWN * m] = said(0, p, row, i);
            values[pieceCoupling::BEFORE * m] =
                follows(p) ? said(1, p, row, i) : 0;
            coefficients[pieceCoupling::OWNDIAGONAL * m] =
                coefficient(pieceCoupling::OWNDIAGONAL, p, row, i);
            coefficients[pieceCoupling::BEFOREDIAGONAL * m] =
                follows(p)
                    ? coefficient(pieceCoupling::BEFOREDIAGONAL, p, row, i)
                    : 0;
            coefficients[pieceCoupling::BETWEEN * m] = between(p, row, i);
        }
    }

    //- Values of the last planes of all pieces, by elimination of the whole
    scalarField solution(const label row, const label i) const
    {
        const label P = pieces.nPieces();
        scalarSquareMatrix A(P, Zero);
        scalarField b(P, Zero);
        for (label p = 0; p < P; ++p)
        {
            const label before = (p + P - 1) % P;
            A(p, p) += coefficient(pieceCoupling::OWNDIAGONAL, p, row, i);
            b[p] += said(0, p, row, i);
            A(p, before) -= between(p, row, i);
            A(before, p) -= between(p, row, i);
            if (!follows(p)) continue;
            A(before, before) -=
                coefficient(pieceCoupling::BEFOREDIAGONAL, p, row, i);
            b[before] += said(1, p, row, i);
        }
        LUsolve(A, b);
        return b;
    }

    scalar worst(const label row) const
    {
        const label p = pieces.mine(), P = pieces.nPieces();
        if (p < 0) return 0;
        scalar most = 0;
        for (label i = 0; i < m; ++i)
        {
            const scalarField x(solution(row, i));
            const double* told = pieces.told(row) + i;
            most = max(most, mag(told[pieceCoupling::LAST * m] - x[p]));
            if (!follows(p)) continue;
            most = max(most, mag(told[pieceCoupling::PREVIOUS * m] -
                                 x[(p + P - 1) % P]));
        }
        return most;
    }
};

TEST_F(PieceCoupling, solvesTheEquationsOfAllPieces)
{
    scalar most = 0;
    if (pieces.apart())
    {
        for (label row = 0; row < transform.nSlowModes; ++row)
        {
            say(row);
        }
        pieces.solveApart(true, 0);
        for (label row = 0; row < transform.nSlowModes; ++row)
        {
            most = max(most, worst(row));
        }
    }
    else
    {
        for (label row = 0; row < transform.nSlowModes; ++row)
        {
            say(row);
            pieces.solveHere();
            most = max(most, worst(row));
        }
    }
    test::expectBelow("values at the ends of pieces",
                      returnReduce(most, maxOp<scalar>()), 1e-14);
}

TEST_F(PieceCoupling, coefficientsAreKept)
{
    if (!pieces.apart()) return;
    for (label row = 0; row < transform.nSlowModes; ++row)
    {
        say(row);
    }
    pieces.solveApart(true, 0);
    for (label row = 0; row < transform.nSlowModes && pieces.mine() >= 0; ++row)
    {
        double* coefficients = pieces.coefficients(row);
        std::fill_n(coefficients, pieceCoupling::NCOEFFICIENTS * m, -1.0);
    }
    pieces.solveApart(false, 0);
    scalar most = 0;
    for (label row = 0; row < transform.nSlowModes; ++row)
    {
        most = max(most, worst(row));
    }
    test::expectBelow("with the coefficients of the time before",
                      returnReduce(most, maxOp<scalar>()), 1e-14);
}

// Second differences of the line of the constant mode are the right-hand side less its
// mean, on the sides too
TEST_F(PieceCoupling, theConstantModeIsSolvedAsAWhole)
{
    const label n = transform.nThird;
    const scalar scale = 0.7;
    const auto load = [](const label k)
    { return test::noise(vector(k, 0.5, 0.2)); };
    if (pieces.mine() >= 0)
    {
        for (label k = 0; k < transform.nPlanes; ++k)
        {
            pieces.constants()[k] = load(transform.firstPlane + k);
        }
        for (label row = 0; row < transform.nSlowModes; ++row)
        {
            say(row);
        }
    }
    if (pieces.apart())
        pieces.solveApart(true, scale);
    else
        pieces.solveConstantHere(scale);

    scalarField x(n, Zero);
    scalar mean = 0;
    for (label k = 0; k < transform.nPlanes; ++k)
    {
        x[transform.firstPlane + k] = pieces.toldConstants()[k];
    }
    for (label k = 0; k < n; ++k)
    {
        mean += load(k) / n;
    }
    Pstream::listCombineGather(x, plusEqOp<scalar>());
    Pstream::listCombineScatter(x);
    scalar worst = mag(sum(x)) / n;
    for (label k = 0; k < n; ++k)
    {
        const scalar left = k > 0 ? x[k - 1] : cyclic ? x[n - 1] : x[k];
        const scalar right = k < n - 1 ? x[k + 1] : cyclic ? x[0] : x[k];
        worst =
            max(worst, mag(2 * x[k] - left - right - scale * (load(k) - mean)));
    }
    test::expectBelow("second differences and mean", worst, 1e-13);
}
