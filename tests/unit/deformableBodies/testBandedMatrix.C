// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "bandedMatrix.H"
#include "Random.H"

using namespace Foam;

namespace
{
constexpr int band = 8, nLanes = 4, n = 60;
using lanes = Eigen::Array<double, nLanes, 1>;

//- Symmetric matrices, every second one with zeros on parts of its diagonal like matrices of
//  constraints, and their right-hand sides
struct systems
{
    double A[nLanes][n][n], b[nLanes][n];

    systems()
    {
        Random random(3);
        const auto number = [&]() { return 2 * random.sample01<scalar>() - 1; };
        for (int l = 0; l < nLanes; ++l)
        {
            for (int i = 0; i < n; ++i)
            {
                const bool constraint = l % 2 && i % 4 == 3;
                A[l][i][i] = constraint ? 0 : 12 + number();
                b[l][i] = number();
                for (int j = i + 1; j < n; ++j)
                {
                    const bool zero =
                        j > i + band || (constraint && j % 4 == 3);
                    A[l][i][j] = A[l][j][i] = zero ? 0 : number();
                }
            }
        }
    }

    //- Largest |A x - b| of a lane
    scalar residual(const int l, const alignedVector<lanes>& x) const
    {
        scalar largest = 0;
        for (int i = 0; i < n; ++i)
        {
            scalar sum = -b[l][i];
            for (int j = 0; j < n; ++j)
            {
                sum += A[l][i][j] * x[j][l];
            }
            largest = max(largest, std::abs(sum));
        }
        return largest;
    }
};

//- Matrix of several systems (lanes), and their right-hand sides
void fill(const systems& s, bandedMatrix<band, lanes>& A,
          alignedVector<lanes>& b)
{
    A.clear(n);
    b.resize(n);
    for (int i = 0; i < n; ++i)
    {
        for (int l = 0; l < nLanes; ++l)
        {
            b[i][l] = s.b[l][i];
            for (int j = i; j <= min(n - 1, i + band); ++j)
            {
                A(i, j)[l] = s.A[l][i][j];
            }
        }
    }
}
} // namespace

// Each lane gives the solution, with the same digits as if it were alone
TEST(BandedMatrix, solvesInEachLaneAsAlone)
{
    const systems s;
    bandedMatrix<band, lanes> together;
    alignedVector<lanes> x;
    fill(s, together, x);
    for (const bool regular : together.factor())
    {
        EXPECT_TRUE(regular);
    }
    together.solve(x);

    scalar residual = 0, difference = 0;
    for (int l = 0; l < nLanes; ++l)
    {
        residual = max(residual, s.residual(l, x));
        bandedMatrix<band> alone;
        alone.clear(n);
        alignedVector<double> y(s.b[l], s.b[l] + n);
        for (int i = 0; i < n; ++i)
        {
            for (int j = i; j <= min(n - 1, i + band); ++j)
            {
                alone(i, j) = s.A[l][i][j];
            }
        }
        alone.factor();
        alone.solve(y);
        for (int i = 0; i < n; ++i)
        {
            difference = max(difference, std::abs(y[i] - x[i][l]));
        }
    }
    test::expectBelow("A x - b, largest of all lanes", residual, 1e-12);
    test::expectBelow("from the solution alone", difference, 1e-13);
}

// factor() reports a leading block that is singular or nearly so, in its lane only. Nothing
// overflows
TEST(BandedMatrix, saysWhichLaneIsSingular)
{
    for (const scalar pivot : {0.0, 1e-8, 1e-99, -1e-99})
    {
        bandedMatrix<band, lanes> A;
        A.clear(n);
        alignedVector<lanes> x(n, lanes::Ones());
        for (int i = 0; i < n; ++i)
        {
            A(i, i) = lanes::Ones();
            for (int j = i + 1; j <= min(n - 1, i + band) && i >= 7; ++j)
            {
                A(i, j)[2] = 1e3;
            }
        }
        A(7, 7)[2] = pivot;
        const auto regular = A.factor();
        A.solve(x);
        for (int l = 0; l < nLanes; ++l)
        {
            EXPECT_EQ(regular[l], l != 2) << l;
            for (int i = 0; i < n; ++i)
            {
                EXPECT_TRUE(l == 2 ? std::isfinite(x[i][l]) : x[i][l] == 1);
            }
        }
    }
}

// take() copies the factors of the chosen lanes and no others
TEST(BandedMatrix, takesLanesOfAnother)
{
    const systems s;
    systems t;
    for (int l = 0; l < nLanes; ++l)
    {
        for (int i = 0; i < n; ++i)
        {
            t.A[l][i][i] += 5;
        }
    }
    bandedMatrix<band, lanes> A, other;
    alignedVector<lanes> x;
    fill(t, other, x);
    fill(s, A, x);
    A.factor();
    other.factor();
    const bool which[nLanes] = {true, true, false, false};
    A.take(other, which);
    A.solve(x);
    scalar residual = 0;
    for (int l = 0; l < nLanes; ++l)
    {
        residual = max(residual, (which[l] ? t : s).residual(l, x));
    }
    test::expectBelow("A x - b, largest of all lanes", residual, 1e-12);
}
