// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "surfacePoints.H"
#include "patchOrder.H"
#include <cmath>

Foam::surfacePoints::surfacePoints(const label degree, const label nTheta,
                                   const label exact)
    : grid_(degree, nTheta),
      onGrid_(3 * grid_.nPoints())
{
    const label nPhi = grid_.nPhi();
    std::vector<label> used;
    std::vector<double> weights;
    DynamicList<vector> directions;
    for (label i = 0, k = 0; i < grid_.nTheta(); ++i)
    {
        const scalar sine = std::sin(grid_.theta(i));
        label step = 1;
        for (label s = 2; s * sine < 1.15 && s < nPhi; ++s)
        {
            if (nPhi % (2 * s) == 0 && nPhi / s > exact + 1) step = s;
        }
        for (label j = 0; j < nPhi; ++j, ++k)
        {
            if (j % step) continue;
            used.push_back(k);
            weights.push_back(step * grid_.weight(k));
            directions.append(vector(sine * std::cos(grid_.phi(j)),
                                     sine * std::sin(grid_.phi(j)),
                                     std::cos(grid_.theta(i))));
        }
    }
    for (const label k : patchOrder(directions))
    {
        used_.push_back(used[k]);
        weights_.push_back(weights[k]);
    }
}

Foam::vector Foam::surfacePoints::onUnitSphere(const label k) const
{
    const scalar theta = grid_.theta(used_[k] / grid_.nPhi()),
                 phi = grid_.phi(used_[k] % grid_.nPhi());
    return vector(std::sin(theta) * std::cos(phi),
                  std::sin(theta) * std::sin(phi), std::cos(theta));
}

void Foam::surfacePoints::values(const double* coeffs, vector* v) const
{
    grid_.values(coeffs, onGrid_.data());
    for (label k = 0; k < size(); ++k)
    {
        v[k] = value(onGrid_, k);
    }
}

void Foam::surfacePoints::areas(const double* coeffs, vector* dS) const
{
    xt_.resize(onGrid_.size());
    xp_.resize(onGrid_.size());
    grid_.gradient(coeffs, xt_.data(), xp_.data());
    for (label k = 0; k < size(); ++k)
    {
        dS[k] = weights_[k] * (value(xt_, k) ^ value(xp_, k));
    }
}

void Foam::surfacePoints::valuesAdjoint(const vector* v, double* coeffs) const
{
    const label n = grid_.nPoints();
    std::fill(onGrid_.begin(), onGrid_.end(), 0);
    for (label k = 0; k < size(); ++k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            onGrid_[d * n + used_[k]] = v[k][d];
        }
    }
    grid_.valuesAdjoint(onGrid_.data(), coeffs);
}

void Foam::surfacePoints::analysis(const vector* v, double* coeffs) const
{
    std::vector<vector> weighted(v, v + size());
    for (label k = 0; k < size(); ++k)
    {
        weighted[k] *= weights_[k];
    }
    valuesAdjoint(weighted.data(), coeffs);
}
