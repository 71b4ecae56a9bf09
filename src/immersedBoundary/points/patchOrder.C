// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "patchOrder.H"
#include "vector.H"
#include <algorithm>

namespace
{
using namespace Foam;

//- Split the points at the median of their longest direction, at a whole number of regions
//  or patches, and order both halves likewise
void halve(const UList<vector>& X, label* begin, label* end)
{
    const label n = end - begin, patch = pointsOfPatch;
    if (n <= patch) return;
    vector lo(vector::uniform(GREAT)), hi(-lo);
    for (const label* k = begin; k < end; ++k)
    {
        lo = min(lo, X[*k]);
        hi = max(hi, X[*k]);
    }
    direction widest = 0;
    for (direction d = 1; d < 3; ++d)
    {
        if (hi[d] - lo[d] > hi[widest] - lo[widest]) widest = d;
    }
    const label whole = n > patch * patch ? patch * patch : patch;
    label* middle = begin + ((n - 1) / whole + 1) / 2 * whole;
    const auto before = [&](const label a, const label b)
    {
        return X[a][widest] < X[b][widest] ||
               (X[a][widest] == X[b][widest] && a < b);
    };
    std::nth_element(begin, middle, end, before);
    halve(X, begin, middle);
    halve(X, middle, end);
}
} // namespace

Foam::labelList Foam::patchOrder(const UList<vector>& X)
{
    labelList order(identity(X.size()));
    halve(X, order.begin(), order.end());
    return order;
}
