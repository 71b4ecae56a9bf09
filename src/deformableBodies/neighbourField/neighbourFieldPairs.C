// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Pairs of bodies, and the sums between them

#include "mathematicalConstants.H"
#include "neighbourField.H"
#include "periodicBox.H"

namespace
{
using namespace Foam;

//- Gaps up to which bodies are near, and from which on not; the same for all their points
//  [cells]
const scalar nearGap = 4, farGap = 6, closeGap = 1.5, apartGap = 2.5;

//- Spacing of coarse points [cells]
const scalar coarseSpacing = 2;

//- 1 below a, 0 above b
scalar fade(const scalar x, const scalar a, const scalar b)
{
    const scalar t = min(max((b - x) / (b - a), scalar(0)), scalar(1));
    return t * t * (3 - 2 * t);
}

//- Largest component of points along e
scalar furthest(const std::vector<vector>& X, const vector& e)
{
    scalar most = -GREAT;
    for (const vector& x : X)
    {
        most = max(most, x & e);
    }
    return most;
}

void addTo(std::vector<vector>& u, const std::vector<vector>& v,
           const scalar weight)
{
    u.resize(v.size(), vector(Zero));
    for (size_t k = 0; k < v.size(); ++k)
    {
        u[k] += weight * v[k];
    }
}
} // namespace

Foam::scalar Foam::neighbourField::reach() const
{
    return 2 * largest_ + farGap * grid_.h().x();
}

bool Foam::neighbourField::isPartner(const bodyHere& a, const bodyHere& b) const
{
    return numbers_.body(a.number) == numbers_.body(b.number) &&
           (groups_[a.group].host() == b.group ||
            groups_[b.group].host() == a.group);
}

Foam::scalar Foam::neighbourField::gap(const bodyHere& a, const bodyHere& b,
                                       const vector& shift) const
{
    const scalar h = grid_.h().x();
    const vector r(b.centre + shift - a.centre);
    const scalar apart = mag(r), ofSpheres = (apart - a.radius - b.radius) / h;
    if (ofSpheres > farGap || apart < SMALL * h) return ofSpheres;
    const vector e(r / apart);
    return ((shift & e) - furthest(b.X, -e) - furthest(a.X, e)) / h;
}

void Foam::neighbourField::findPairs()
{
    pairs_.clear();
    const label n = here_.size();
    for (label a = 0; a < n; ++a)
    {
        for (label b = a; b < n; ++b)
        {
            if (here_[a].mine || here_[b].mine) findPairs(a, b);
        }
    }
}

void Foam::neighbourField::findPairs(const label a, const label b)
{
    const bodyHere &first = here_[a], &second = here_[b];
    if (first.X.empty() || second.X.empty()) return;
    const vector L(grid_.length());
    const vector nearest(nearestImage(grid_, second.centre, first.centre));
    const scalar reach = first.radius + second.radius + farGap * grid_.h().x();
    for (label image = 0; image < 27; ++image)
    {
        const labelVector at(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
        vector r(nearest);
        bool exists = true;
        for (direction d = 0; d < 3; ++d)
        {
            exists = exists && (at[d] == 0 || grid_.periodic(d));
            r[d] += at[d] * L[d];
        }
        if (!exists || magSqr(r) > sqr(reach)) continue;

        // Of both images of a body on either side, and itself
        if (a == b && image <= 13) continue;
        pair p{a, b, first.centre + r - second.centre, 0,
               isPartner(first, second) &&
                   mag(r) < max(first.radius, second.radius)};
        if (nucleiOnly_ && !p.inside) continue;
        p.gap = p.inside ? 0 : gap(first, second, p.shift);
        if (p.gap < farGap) pairs_.push_back(p);
    }
}

const Foam::nearField& Foam::neighbourField::sumFor(const scalar spacing,
                                                    const scalar mu)
{
    const scalar h = grid_.h().x(), d = max(0.5 * h, 0.48 * spacing);
    std::unique_ptr<const nearField>& sum = sums_[{d, mu}];
    if (!sum) sum.reset(new nearField(kernel_, h, mu, d, nearField::OTHER));
    return *sum;
}

const Foam::coarsePoints* Foam::neighbourField::coarseOf(const bodyHere& body)
{
    const label n = body.X.size();
    auto found = coarse_.find({body.group, n});
    if (found == coarse_.end())
    {
        const nearSurface& surface = *groups_[body.group].nearSources();
        const scalar cells = spacing_[body.group] / grid_.h().x() *
                             std::sqrt(n / (4 * constant::mathematical::pi));
        const label degree = std::ceil(1.25 * cells),
                    some = label(1.6 * sqr(scalar(degree + 1)));
        std::unique_ptr<const coarsePoints> points;
        if (some < 0.6 * n)
        {
            points.reset(
                new coarsePoints(surface.nearDirections(n), degree, some));
        }
        found =
            coarse_.emplace(std::make_pair(body.group, n), std::move(points))
                .first;
    }
    return found->second.get();
}

void Foam::neighbourField::addAll(const pair& p, const scalar weight)
{
    bodyHere &a = here_[p.a], &b = here_[p.b];
    scalar mu = mu_;
    if (p.inside)
    {
        const bodyHere& host = groups_[a.group].host() == b.group ? b : a;
        mu *= groups_[host.group].inside()->viscosityRatio();
    }
    std::vector<vector> u, v;
    sumFor(max(spacing_[a.group], spacing_[b.group]), mu)
        .exchange(a.all, b.all, b.all.origin + p.shift - a.all.origin, u, v);
    addTo(a.u, u, weight);
    addTo(b.u, v, weight);
}

void Foam::neighbourField::addSome(const pair& p, const scalar weight)
{
    for (const label k : {p.a, p.b})
    {
        bodyHere& x = here_[k];
        if (x.some.n) continue;
        const coarsePoints& points = *coarseOf(x);
        x.some = nearField::pointSet(points.positions(x.X), points.forces(x.F));
    }
    bodyHere &a = here_[p.a], &b = here_[p.b];
    std::vector<vector> u, v;
    sumFor(coarseSpacing * grid_.h().x(), mu_)
        .exchange(a.some, b.some, b.some.origin + p.shift - a.some.origin, u,
                  v);
    addTo(a.uSome, u, weight);
    addTo(b.uSome, v, weight);
}

void Foam::neighbourField::add(const pair& p)
{
    if (p.inside)
    {
        addAll(p, 1);
        return;
    }
    const scalar weight = fade(p.gap, nearGap, farGap);
    const scalar all = coarseOf(here_[p.a]) && coarseOf(here_[p.b])
                           ? fade(p.gap, closeGap, apartGap)
                           : 1;
    if (all > 0) addAll(p, weight * all);
    if (all < 1) addSome(p, weight * (1 - all));
}
