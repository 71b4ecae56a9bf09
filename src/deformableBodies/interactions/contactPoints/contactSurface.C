// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactSurface.H"
#include "patchOrder.H"
#include <algorithm>
#include <set>
#include <vector>

namespace
{
using namespace Foam;

//- Pairs of markers of which one is among the six nearest of the other, by directions.
//  Distances are rounded: on symmetric shapes many are equal, and numbers decide
List<labelPair> neighbours(const vectorField& X)
{
    const label n = X.size(), most = min(label(6), n - 1);
    const vectorField e(X / mag(X));
    std::set<std::pair<label, label>> all;
    std::vector<std::pair<scalar, label>> others(n);
    for (label i = 0; i < n; ++i)
    {
        for (label j = 0; j < n; ++j)
        {
            others[j] = {j == i ? GREAT : std::round(1e9 * magSqr(e[j] - e[i])),
                         j};
        }
        std::partial_sort(others.begin(), others.begin() + most, others.end());
        for (label k = 0; k < most; ++k)
        {
            all.insert(std::minmax(i, label(others[k].second)));
        }
    }
    List<labelPair> pairs(all.size());
    label k = 0;
    for (const auto& pair : all)
    {
        pairs[k++] = labelPair(pair.first, pair.second);
    }
    return pairs;
}
} // namespace

Foam::contactSurface::contactSurface(const vectorField& X,
                                     const scalarField& areas,
                                     const scalar range)
    : nMarkers_(X.size()),
      areas_(areas)
{
    if (sum(areas) < nMarkers_ * sqr(0.5 * range)) return;

    // In an order that keeps patches small. A quarter of the area is that of the markers
    const List<labelPair> pairs(neighbours(X));
    vectorField middles(pairs.size());
    forAll(middles, k)
    {
        middles[k] = X[pairs[k].first()] + X[pairs[k].second()];
    }
    ends_ = List<labelPair>(pairs, patchOrder(middles));
    labelList n(nMarkers_, Zero);
    for (const labelPair& ends : ends_)
    {
        ++n[ends.first()];
        ++n[ends.second()];
    }
    areas_ *= 0.25;
    areas_.setSize(nMarkers_ + ends_.size());
    forAll(ends_, k)
    {
        const label i = ends_[k].first(), j = ends_[k].second();
        areas_[nMarkers_ + k] = 0.75 * (areas[i] / n[i] + areas[j] / n[j]);
    }
}

void Foam::contactSurface::setMiddles(vector* values) const
{
    forAll(ends_, k)
    {
        values[nMarkers_ + k] = 0.5 * (values[ends_[k].first()] +
                                       values[ends_[k].second()]);
    }
}

void Foam::contactSurface::addTo(const vector* forces, vectorField& F) const
{
    for (label i = 0; i < nMarkers_; ++i)
    {
        F[i] += forces[i];
    }
    forAll(ends_, k)
    {
        const vector half(0.5 * forces[nMarkers_ + k]);
        F[ends_[k].first()] += half;
        F[ends_[k].second()] += half;
    }
}
