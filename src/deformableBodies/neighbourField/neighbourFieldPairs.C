// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Pairs of bodies, and the sums between them

#include "mathematicalConstants.H"
#include "neighbourField.H"
#include "periodicBox.H"

namespace
{
using namespace Foam;

//- The near field fades out from nearGap to farGap, close points fade into far ones from
//  closeGap to apartGap: gaps of two bodies [cells]
const scalar nearGap = 4, farGap = 6, closeGap = 0.5, apartGap = 1.5;

//- Spacing of the points of each level [cells]
const scalar levelSpacing[] = {1.1, 2};

//- Largest degree of the harmonics that surfaces exchange
const label largestDegree = 8;

//- 1 below a, 0 above b
scalar fade(const scalar x, const scalar a, const scalar b)
{
    const scalar t = min(max((b - x) / (b - a), scalar(0)), scalar(1));
    return t * t * (3 - 2 * t);
}

//- The point that is furthest along e, of every second one
const vector& furthest(const std::vector<vector>& X, const vector& e)
{
    size_t best = 0;
    scalar most = -GREAT;
    for (size_t k = 0; k < X.size(); k += 2)
    {
        const scalar along = X[k] & e;
        if (along <= most) continue;
        most = along;
        best = k;
    }
    return X[best];
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
    return b.wall < 0 && numbers_.body(a.number) == numbers_.body(b.number) &&
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

    // Separating planes: normal along the centres, then along the touching points, three
    // iterations
    scalar largest = -GREAT;
    vector e(r / apart);
    for (label i = 0; i < 3 && largest < farGap * h; ++i)
    {
        const vector between(furthest(b.X, -e) + shift - furthest(a.X, e));
        largest = max(largest, between & e);
        if (mag(between) < SMALL * h) break;
        e = between / mag(between);
    }
    return largest / h;
}

void Foam::neighbourField::findPairs()
{
    pairs_.clear();
    const label n = here_.size();
    for (label a = 0; a < n && here_[a].wall < 0; ++a)
    {
        for (label b = 0; b < n; ++b)
        {
            const bool mirrored = here_[b].wall >= 0;
            if (!mirrored && b < a) continue;
            if (here_[a].mine || (!mirrored && here_[b].mine)) findPairs(a, b);
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
    if (magSqr(nearest) > sqr(reach)) return;
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

        // A body and its own images: 13 of 26, as the others repeat these pairs
        if (a == b && image <= 13) continue;
        pair p{a, b, first.centre + r - second.centre, 0,
               isPartner(first, second) &&
                   mag(r) < max(first.radius, second.radius)};
        if (nucleiOnly_ && !p.inside) continue;
        p.gap = p.inside ? 0 : gap(first, second, p.shift);
        if (p.gap < farGap) pairs_.push_back(p);
    }
}

std::vector<Foam::neighbourField::closeSpheres>
Foam::neighbourField::spheresWithin(const scalar most) const
{
    std::vector<closeSpheres> all;
    for (const pair& p : pairs_)
    {
        const bodyHere &a = here_[p.a], &b = here_[p.b];
        const bool own = b.wall >= 0 && a.number == b.number;
        if (!a.mine || (b.wall >= 0 && !own) ||
            !groups_[a.group].nearSources()->makesFilms() ||
            !groups_[b.group].nearSources()->makesFilms())
        {
            continue;
        }
        const vector r(a.centre - (b.centre + p.shift));
        const scalar gap = (mag(r) - a.radius - b.radius) / (own ? 2 : 1);
        if (gap >= most) continue;
        all.push_back({a.number, own ? -1 : b.number, r / mag(r), gap, a.radius,
                       own ? 0 : b.radius});
    }
    return all;
}

const Foam::nearField& Foam::neighbourField::sumFor(const scalar spacing,
                                                    const scalar mu)
{
    const scalar h = grid_.h().x(), d = max(0.5 * h, 0.48 * spacing);
    std::unique_ptr<const nearField>& sum = sums_[{d, mu}];
    if (!sum) sum.reset(new nearField(kernel_, h, mu, d, nearField::OTHER));
    return *sum;
}

const Foam::coarsePoints* Foam::neighbourField::coarseOf(const bodyHere& body,
                                                         const level l)
{
    const label n = body.X.size();
    const std::array<label, 3> key{body.group, n, l};
    const auto found = coarse_.find(key);
    if (found != coarse_.end()) return found->second.get();

    const scalar pi = constant::mathematical::pi;
    const scalar cells = spacing_[body.group] / grid_.h().x() *
                         std::sqrt(n / (4 * pi)); // radius
    const label degree =
        l == CLOSE ? largestDegree
                   : min(largestDegree, label(std::ceil(1.25 * cells)));
    const label some = max(1.6 * sqr(scalar(degree + 1)),
                           4 * pi * sqr(cells / levelSpacing[l]));
    std::unique_ptr<const coarsePoints>& points = coarse_[key];
    if (some < 0.8 * n)
    {
        points.reset(new coarsePoints(
            groups_[body.group].nearSources()->nearDirections(n), degree,
            some));
    }
    return points.get();
}

void Foam::neighbourField::add(const pair& p, const level l,
                               const scalar weight)
{
    scalar spacing = levelSpacing[l] * grid_.h().x(), mu = mu_;
    for (const label k : {p.a, p.b})
    {
        bodyHere& x = here_[k];
        const coarsePoints* coarse = coarseOf(x, l);
        if (!coarse) spacing = max(spacing, spacing_[x.group]);
        if (x.points[l].n) continue;
        x.points[l] = coarse ? nearField::pointSet(coarse->positions(x.X),
                                                   coarse->forces(x.F.data()))
                             : nearField::pointSet(x.X, x.F);
    }
    bodyHere &a = here_[p.a], &b = here_[p.b];
    std::vector<vector> u, v;
    const vector apart(b.points[l].origin + p.shift - a.points[l].origin);
    if (b.wall >= 0)
    {
        image_->velocity(a.points[l], b.points[l], apart, b.wall,
                         a.points[l].origin[b.wall] - b.wallAt, u);
        addTo(a.u[l], u, weight);
        return;
    }
    if (p.inside)
    {
        const bodyHere& host = groups_[a.group].host() == b.group ? b : a;
        mu *= groups_[host.group].inside()->viscosityRatio();
    }
    sumFor(spacing, mu).exchange(a.points[l], b.points[l], apart, u, v);
    addTo(a.u[l], u, weight);
    addTo(b.u[l], v, weight);
}

void Foam::neighbourField::add(const pair& p)
{
    const scalar weight = p.inside ? 1 : fade(p.gap, nearGap, farGap);
    const scalar close = p.inside ? 1 : fade(p.gap, closeGap, apartGap);
    if (close > 0) add(p, CLOSE, weight * close);
    if (close < 1) add(p, FAR, weight * (1 - close));
}

std::vector<Foam::vector> Foam::neighbourField::velocities(const bodyHere& body)
{
    std::vector<vector> u(body.X.size(), vector(Zero));
    for (const level l : {CLOSE, FAR})
    {
        if (body.u[l].empty()) continue;
        const coarsePoints* coarse = coarseOf(body, l);
        if (coarse)
            coarse->add(body.u[l], u.data());
        else
            addTo(u, body.u[l], 1);
    }
    return u;
}
