// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "coarsePoints.H"
#include "floatLanes.H"
#include <Eigen/QR>
#include <algorithm>
#include <limits>

namespace
{
using namespace Foam;
using namespace Foam::floatLanes;

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
    : n_(directions.size()),
      padded_(padded(n_)),
      which_(spread(directions, nCoarse)),
      P_(padded_ * which_.size(), 0)
{
    const label nHarmonics = (degree + 1) * (degree + 1);
    Eigen::MatrixXd all(n_, nHarmonics), coarse(which_.size(), nHarmonics);
    for (label k = 0; k < n_; ++k)
    {
        all.row(k) = polynomials(directions[k], degree);
    }
    for (size_t k = 0; k < which_.size(); ++k)
    {
        coarse.row(k) = all.row(which_[k]);
    }
    Eigen::Map<Eigen::MatrixXf>(P_.data(), padded_, which_.size()).topRows(n_) =
        (all * coarse.completeOrthogonalDecomposition().pseudoInverse())
            .cast<float>();
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

std::vector<Foam::vector> Foam::coarsePoints::forces(const vector* F) const
{
    std::vector<float> f(3 * padded_, 0);
    for (label k = 0; k < n_; ++k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            f[d * padded_ + k] = F[k][d];
        }
    }
    std::vector<vector> some;
    for (size_t c = 0; c < which_.size(); ++c)
    {
        lanes sum[3];
        sum[0].setZero();
        sum[1].setZero();
        sum[2].setZero();
        for (label k = 0; k < padded_; k += nLanes)
        {
            const lanes p = lanesOf(&P_[c * padded_ + k]);
            for (direction d = 0; d < 3; ++d)
            {
                sum[d] += p * lanesOf(&f[d * padded_ + k]);
            }
        }
        some.push_back(vector(sum[0].sum(), sum[1].sum(), sum[2].sum()));
    }
    return some;
}

void Foam::coarsePoints::add(const std::vector<vector>& coarse, vector* u) const
{
    std::vector<float> sum(3 * padded_, 0);
    for (size_t c = 0; c < which_.size(); ++c)
    {
        const float v[] = {float(coarse[c].x()), float(coarse[c].y()),
                           float(coarse[c].z())};
        for (label k = 0; k < padded_; k += nLanes)
        {
            const lanes p = lanesOf(&P_[c * padded_ + k]);
            for (direction d = 0; d < 3; ++d)
            {
                lanesAt(&sum[d * padded_ + k]) += v[d] * p;
            }
        }
    }
    for (label k = 0; k < n_; ++k)
    {
        u[k] += vector(sum[k], sum[padded_ + k], sum[2 * padded_ + k]);
    }
}
