// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "bandedMatrix.H"
#include "Random.H"

using namespace Foam;

namespace
{
constexpr int band = 8, nLanes = 4, n = 60;
using lanes = Eigen::Array<double, nLanes, 1>;

//- Matrices of which every second has zeros on parts of its diagonal, as those of
//  constraints, so that rows have to be exchanged; their right-hand sides
struct systems
{
    double A[nLanes][n][n], b[nLanes][n];

    systems()
    {
        Random random(3);
        for (int l = 0; l < nLanes; ++l)
        {
            for (int i = 0; i < n; ++i)
            {
                for (int j = 0; j < n; ++j)
                {
                    const double value = 2 * random.sample01<scalar>() - 1;
                    A[l][i][j] = std::abs(i - j) > band ? 0 : value;
                }
                A[l][i][i] = l % 2 && i % 4 == 3 ? 0 : A[l][i][i] + 3;
                b[l][i] = 2 * random.sample01<scalar>() - 1;
            }
        }
    }
};
} // namespace

// Each lane is solved, and as if it were alone: what is exchanged in one has no
// effect on the others
TEST(BandedMatrix, solvesInEachLaneAsAlone)
{
    const systems s;
    bandedMatrix<band, lanes> together;
    together.clear(n);
    alignedVector<lanes> x(n);
    for (int i = 0; i < n; ++i)
    {
        for (int l = 0; l < nLanes; ++l)
        {
            x[i][l] = s.b[l][i];
            for (int j = max(0, i - band); j <= min(n - 1, i + band); ++j)
            {
                together(i, j)[l] = s.A[l][i][j];
            }
        }
    }
    for (const bool regular : together.factor())
    {
        EXPECT_TRUE(regular);
    }
    together.solve(x);

    scalar residual = 0, difference = 0;
    for (int l = 0; l < nLanes; ++l)
    {
        bandedMatrix<band> alone;
        alone.clear(n);
        std::vector<double> y(s.b[l], s.b[l] + n);
        for (int i = 0; i < n; ++i)
        {
            double sum = -s.b[l][i];
            for (int j = max(0, i - band); j <= min(n - 1, i + band); ++j)
            {
                alone(i, j) = s.A[l][i][j];
                sum += s.A[l][i][j] * x[j][l];
            }
            residual = max(residual, std::abs(sum));
        }
        alone.factor();
        alone.solve(y);
        for (int i = 0; i < n; ++i)
        {
            difference = max(difference, std::abs(y[i] - x[i][l]));
        }
    }
    test::expectBelow("A x - b, largest of all lanes", residual, 1e-12);
    test::expectBelow("from the solution alone", difference, 1e-12);
}

// A column of zeros is said to be singular, in its lane only
TEST(BandedMatrix, saysWhichLaneIsSingular)
{
    bandedMatrix<band, lanes> A;
    A.clear(n);
    for (int i = 0; i < n; ++i)
    {
        A(i, i) = lanes::Ones();
    }
    A(7, 7)[2] = 0;
    const auto regular = A.factor();
    for (int l = 0; l < nLanes; ++l)
    {
        EXPECT_EQ(regular[l], l != 2) << l;
    }
}

// Lanes of a matrix with exchanges of rows beside those of one without, both ways
TEST(BandedMatrix, takesLanesOfAnother)
{
    const systems s;
    const auto factorsOf = [&](const bool exchanges)
    {
        bandedMatrix<band, lanes> A;
        A.clear(n);
        for (int i = 0; i < n; ++i)
        {
            for (int l = 0; l < nLanes; ++l)
            {
                for (int j = max(0, i - band); j <= min(n - 1, i + band); ++j)
                {
                    // Large on the diagonal: no row is exchanged
                    A(i, j)[l] = s.A[l][i][j] + (exchanges || i != j ? 0 : 30);
                }
            }
        }
        A.factor();
        return A;
    };
    for (const bool exchanges : {false, true})
    {
        auto A = factorsOf(exchanges), other = factorsOf(!exchanges);
        const bool which[nLanes] = {true, true, false, false};
        A.take(other, which);
        alignedVector<lanes> x(n);
        for (int i = 0; i < n; ++i)
        {
            for (int l = 0; l < nLanes; ++l)
            {
                x[i][l] = s.b[l][i];
            }
        }
        A.solve(x);
        scalar residual = 0;
        for (int l = 0; l < nLanes; ++l)
        {
            for (int i = 0; i < n; ++i)
            {
                double sum = -s.b[l][i];
                for (int j = max(0, i - band); j <= min(n - 1, i + band); ++j)
                {
                    const bool large = exchanges == which[l] && i == j;
                    sum += (s.A[l][i][j] + (large ? 30 : 0)) * x[j][l];
                }
                residual = max(residual, std::abs(sum));
            }
        }
        test::expectBelow("A x - b, largest of all lanes", residual, 1e-12);
    }
}
