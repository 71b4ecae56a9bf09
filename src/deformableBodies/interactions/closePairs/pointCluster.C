// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pointCluster.H"
#include <cmath>

Foam::pointCluster::pointCluster(const label start, const label n,
                                 const label number, const bool folds,
                                 const bool isHeld, const UList<vector>& points,
                                 const vector* positions, const float* radii)
    : first(start),
      size(n),
      body(number),
      present((1u << n) - 1),
      mayFold(folds),
      held(isHeld),
      nPoints(points.size())
{
    vector lo(points[0]), hi(points[0]);
    for (const vector& X : points)
    {
        lo = min(lo, X);
        hi = max(hi, X);
    }
    centre = 0.5 * (lo + hi);
    scalar furthestSqr = 0;
    for (const vector& X : points)
    {
        furthestSqr = max(furthestSqr, magSqr(X - centre));
    }
    radius = std::sqrt(furthestSqr);
    for (label k = 0; k < nParts; ++k)
    {
        const label i = min(k, n - 1);
        for (direction d = 0; d < 3; ++d)
        {
            x[d][k] = positions[i][d] - centre[d];
        }
        r[k] = radii ? radii[i] : 0;
    }
}

void Foam::pointCluster::gather(const std::vector<pointCluster>& parts,
                                const UList<vector>& X,
                                std::vector<pointCluster>& wholes)
{
    wholes.clear();
    label point = 0;
    for (size_t i = 0; i < parts.size();)
    {
        const pointCluster& p = parts[i];
        vector centres[nParts];
        float radii[nParts];
        label n = 0, points = 0;
        for (;
             n < nParts && i + n < parts.size() && parts[i + n].body == p.body;
             ++n)
        {
            const pointCluster& part = parts[i + n];
            centres[n] = part.centre;
            radii[n] = part.radius;
            points += part.nPoints;
        }
        wholes.emplace_back(label(i), n, p.body, p.mayFold, true,
                            SubList<vector>(X, points, point), centres, radii);
        i += n;
        point += points;
    }
}
