// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "coarsePoints.H"
#include <Eigen/QR>
#include <algorithm>
#include <limits>

namespace
{
using namespace Foam;
using rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using rowsOf = Eigen::Map<const rows>;
using rowsAt = Eigen::Map<rows>;
using matrixOf = Eigen::Map<const Eigen::MatrixXd>;

//- Indices of n of the points, each the one furthest from those before
std::vector<label> spread(const std::vector<vector>& X, const label n)
{
    std::vector<label> which(1, 0);
    std::vector<scalar> distance(X.size(), std::numeric_limits<scalar>::max());
    while (label(which.size()) < n)
    {
        for (size_t k = 0; k < X.size(); ++k)
        {
            distance[k] = min(distance[k], magSqr(X[k] - X[which.back()]));
        }
        which.push_back(std::max_element(distance.begin(), distance.end()) -
                        distance.begin());
    }
    std::sort(which.begin(), which.end());
    return which;
}

//- Polynomials of degree p and p - 1 in the coordinates of a point: on the unit sphere they
//  span all harmonics to degree p
Eigen::RowVectorXd polynomials(const vector& n, const label p)
{
    Eigen::RowVectorXd row((p + 1) * (p + 1));
    label k = 0;
    for (const label degree : {p, p - 1})
    {
        for (label i = 0; i <= degree; ++i)
        {
            for (label j = 0; j <= degree - i; ++j)
            {
                row[k++] = std::pow(n.x(), i) * std::pow(n.y(), j) *
                           std::pow(n.z(), degree - i - j);
            }
        }
    }
    return row;
}
} // namespace

Foam::coarsePoints::coarsePoints(const std::vector<vector>& directions,
                                 const label degree, const label nCoarse)
    : which_(spread(directions, nCoarse))
{
    const label n = directions.size(), nHarmonics = (degree + 1) * (degree + 1);
    Eigen::MatrixXd all(n, nHarmonics), coarse(which_.size(), nHarmonics);
    for (label k = 0; k < n; ++k)
    {
        all.row(k) = polynomials(directions[k], degree);
    }
    for (size_t k = 0; k < which_.size(); ++k)
    {
        coarse.row(k) = all.row(which_[k]);
    }
    P_.resize(n * which_.size());
    Eigen::Map<Eigen::MatrixXd>(P_.data(), n, which_.size()) =
        all * coarse.completeOrthogonalDecomposition().pseudoInverse();
}

std::vector<Foam::vector>
Foam::coarsePoints::positions(const std::vector<vector>& X) const
{
    std::vector<vector> some;
    for (const label k : which_)
    {
        some.push_back(X[k]);
    }
    return some;
}

std::vector<Foam::vector>
Foam::coarsePoints::forces(const std::vector<vector>& F) const
{
    std::vector<vector> some(which_.size());
    rowsAt(&some[0].x(), some.size(), 3).noalias() =
        matrixOf(P_.data(), F.size(), some.size()).transpose() *
        rowsOf(&F[0].x(), F.size(), 3);
    return some;
}

void Foam::coarsePoints::add(const std::vector<vector>& coarse, vector* u) const
{
    const label n = P_.size() / which_.size();
    rowsAt(&u[0].x(), n, 3).noalias() +=
        matrixOf(P_.data(), n, coarse.size()) *
        rowsOf(&coarse[0].x(), coarse.size(), 3);
}
