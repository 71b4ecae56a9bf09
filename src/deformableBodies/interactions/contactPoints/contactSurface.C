// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactSurface.H"
#include "patchOrder.H"
#include <algorithm>
#include <cmath>
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
      areas_(areas),
      parts_(areas.size(), Zero)
{
    const scalar side = std::sqrt(sum(areas) / max(nMarkers_, label(1)));
    apart_ = max(0.5 * range, 0.8 * side);
    least_ = side < 0.5 * range ? 0 : 1;

    // In an order that keeps patches small. A quarter of the area is that of the markers
    const List<labelPair> pairs(neighbours(X));
    vectorField middles(pairs.size());
    forAll(middles, k)
    {
        middles[k] = X[pairs[k].first()] + X[pairs[k].second()];
    }
    ends_ = List<labelPair>(pairs, patchOrder(middles));
    for (const labelPair& ends : ends_)
    {
        ++parts_[ends.first()];
        ++parts_[ends.second()];
    }
    parts_ = 0.75 * areas / max(parts_, scalar(1));
}

void Foam::contactSurface::count(const vector* X, label* counts) const
{
    forAll(ends_, k)
    {
        const scalar length = mag(X[ends_[k].second()] - X[ends_[k].first()]);
        counts[k] = max(least_, label(std::ceil(length / apart_)) - 1);
    }
}

void Foam::contactSurface::setAreas(const label* counts, scalar* areas) const
{
    std::copy(areas_.begin(), areas_.end(), areas);
    scalar* between = areas + nMarkers_;
    forAll(ends_, k)
    {
        if (counts[k] == 0) continue;
        const label i = ends_[k].first(), j = ends_[k].second();
        areas[i] -= parts_[i];
        areas[j] -= parts_[j];
        std::fill_n(between, counts[k], (parts_[i] + parts_[j]) / counts[k]);
        between += counts[k];
    }
}

void Foam::contactSurface::setBetween(const label* counts,
                                      vector* values) const
{
    vector* between = values + nMarkers_;
    forAll(ends_, k)
    {
        const vector &x = values[ends_[k].first()],
                     &y = values[ends_[k].second()];
        for (label n = 1; n <= counts[k]; ++n)
        {
            *between++ = x + scalar(n) / (counts[k] + 1) * (y - x);
        }
    }
}

void Foam::contactSurface::addTo(const label* counts, const vector* forces,
                                 vectorField& F) const
{
    for (label i = 0; i < nMarkers_; ++i)
    {
        F[i] += forces[i];
    }
    const vector* between = forces + nMarkers_;
    forAll(ends_, k)
    {
        for (label n = 1; n <= counts[k]; ++n)
        {
            const vector onward(scalar(n) / (counts[k] + 1) * *between);
            F[ends_[k].first()] += *between++ - onward;
            F[ends_[k].second()] += onward;
        }
    }
}
