// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "thicknessCouple.H"
#include "markerLine.H"
#include "mathematicalConstants.H"
#include <algorithm>
#include <cmath>
#include <numeric>

Foam::thicknessCouple::thicknessCouple(const label segments, const scalar ds,
                                       const scalar inset, const scalar K,
                                       const scalar h)
    : nSegments_(segments),
      nStations_(min(
          segments,
          max(label(1), label(segments * ds / (6 * h) * (1 + 1e-6) + 0.5)))),
      ds_(ds),
      pointDistance_(1.5 * h),
      K_(segments)
{
    forAll(K_, i)
    {
        const scalar begin = max(i * ds, inset);
        const scalar end = min((i + 1) * ds, segments * ds - inset);
        K_[i] = K * max(end - begin, scalar(0)) / ds;
    }
}

Foam::thicknessCouple::thicknessCouple(const label segments, const scalar ds,
                                       const scalar inset,
                                       const deltaKernel& kernel,
                                       const scalar mu, const scalar h)
    : thicknessCouple(segments, ds, inset,
                      constant::mathematical::twoPi * mu *
                          sqr(h * markerLine::radius(kernel)),
                      h)
{
    const scalar apart = segments * ds / nStations_;
    ownShear_ = 1.5 * sqr(pointDistance_ / h) * ownShear(kernel, apart / h) /
                (mu * apart);
}

void Foam::thicknessCouple::setWalls(const uniformGrid& grid)
{
    for (direction d = 0; d < 3; ++d)
    {
        if (grid.periodic(d)) continue;
        walls_.min()[d] = grid.origin()[d];
        walls_.max()[d] = grid.origin()[d] + grid.length()[d];
    }
}

Foam::scalar Foam::thicknessCouple::ownShear(const deltaKernel& kernel,
                                             const scalar apart)
{
    const bool Roma = kernel.type() == deltaKernel::Roma3;
    return pow025(pow4(Roma ? 0.0588 : 0.0431) +
                  pow4((Roma ? 0.0130 : 0.0076) * apart));
}

Foam::thicknessCouple::frame
Foam::thicknessCouple::frameAt(const vectorField& X, const label station) const
{
    frame f;
    f.t = X[first(station + 1)] - X[first(station)];
    f.t /= mag(f.t);

    // Any direction across t is possible, as three points measure a linear field exactly.
    // When the choice changes, the forces of the last step have other directions for one
    // step. Walls matter within 3.5 cells, the reach of points and kernel
    const point x(0.5 * (X[first(station)] + X[first(station + 1)]));
    vector a(mag(f.t.x()) < 0.7 ? vector(1, 0, 0) : vector(0, 1, 0));
    scalar least = 3.5 / 1.5 * pointDistance_;
    for (direction d = 0; d < 3; ++d)
    {
        const scalar lower = x[d] - walls_.min()[d],
                     upper = walls_.max()[d] - x[d];
        if (mag(f.t[d]) > 0.75 || min(lower, upper) >= least) continue;
        least = min(lower, upper);
        a = Zero;
        a[d] = lower < upper ? 1 : -1;
    }
    a -= (a & f.t) * f.t;
    a /= mag(a);
    const vector b(f.t ^ a);
    f.e[0] = a;
    f.e[1] = -0.5 * a + 0.5 * std::sqrt(3.0) * b;
    f.e[2] = -0.5 * a - 0.5 * std::sqrt(3.0) * b;
    return f;
}

void Foam::thicknessCouple::markers(const vectorField& X, List<frame>& frames,
                                    vector* points) const
{
    frames.setSize(nStations_);
    forAll(frames, j)
    {
        frames[j] = frameAt(X, j);
        const vector centre(0.5 * (X[first(j)] + X[first(j + 1)]));
        for (const vector& e : frames[j].e)
        {
            *points++ = centre + pointDistance_ * e;
        }
    }
}

void Foam::thicknessCouple::shear(const List<frame>& frames,
                                  const scalarField& K, const vector* U,
                                  const vector* F, vectorField& g) const
{
    g.setSize(nSegments_);
    forAll(frames, j)
    {
        const frame& f = frames[j];
        // n coinciding lines, each with K/n, cause the shear of one line with K
        const auto sum = [&](const scalarField& couples)
        {
            return std::accumulate(&couples[first(j)],
                                   couples.cdata() + first(j + 1), 0.0);
        };
        const scalar own = F ? ownShear_ * sum(K_) / sum(K) : 0;
        vector gradient(Zero);
        for (const vector& e : f.e)
        {
            scalar u = *U++ & f.t;
            if (F) u -= own * (*F++ & f.t);
            gradient += 2.0 / 3 / pointDistance_ * u * e;
        }
        std::fill(&g[first(j)], g.data() + first(j + 1), gradient);
    }
}

void Foam::thicknessCouple::forces(const List<frame>& frames,
                                   const vectorField& V,
                                   const vectorField& shear,
                                   const scalarField& K, vector* F) const
{
    forAll(frames, j)
    {
        const frame& f = frames[j];
        vector dipole(Zero);
        for (label i = first(j); i < first(j + 1); ++i)
        {
            dipole -= K[i] * (ds_ * shear[i] + V[i + 1] - V[i]);
        }
        for (const vector& e : f.e)
        {
            // Mean of the force of this and the last step: see the header
            const scalar now = 2.0 / 3 / pointDistance_ * (dipole & e);
            *F = 0.5 * (now + (*F & f.t)) * f.t;
            ++F;
        }
    }
}
