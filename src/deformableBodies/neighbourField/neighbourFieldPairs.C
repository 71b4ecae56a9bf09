// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Pairs of bodies and their gaps

#include "neighbourField.H"
#include "periodicBox.H"

namespace
{
using namespace Foam;

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
} // namespace

bool Foam::neighbourField::isPartner(const bodyCopies::body& a,
                                     const bodyCopies::body& b) const
{
    return b.wall < 0 && numbers_.body(a.number) == numbers_.body(b.number) &&
           (groups_[a.group].host() == b.group ||
            groups_[b.group].host() == a.group);
}

Foam::scalar Foam::neighbourField::gap(const bodyCopies::body& a,
                                       const bodyCopies::body& b,
                                       const vector& shift, vector& e) const
{
    const scalar h = grid_.h().x();
    const vector r(b.centre + shift - a.centre);
    const scalar apart = mag(r), ofSpheres = (apart - a.radius - b.radius) / h;
    if (ofSpheres > farGap || apart < SMALL * h) return ofSpheres;

    // Separating planes: normal along the centres, then along the touching points, three
    // iterations
    scalar largest = -GREAT;
    vector n(r / apart);
    for (label i = 0; i < 3 && largest < farGap * h; ++i)
    {
        const vector between(furthest(b.X, -n) + shift - furthest(a.X, n));
        if ((between & n) > largest)
        {
            largest = between & n;
            e = n;
        }
        if (mag(between) < SMALL * h) break;
        n = between / mag(between);
    }
    return largest / h;
}

void Foam::neighbourField::findPairs()
{
    pairs_.clear();
    const std::vector<bodyCopies::body>& bodies = copies_.bodies();
    const label n = bodies.size();
    for (label a = 0; a < n && bodies[a].wall < 0; ++a)
    {
        for (label b = 0; b < n; ++b)
        {
            const bool mirrored = bodies[b].wall >= 0;
            if (!mirrored && b < a) continue;
            if (bodies[a].mine || (!mirrored && bodies[b].mine))
                findPairs(a, b);
        }
    }
}

void Foam::neighbourField::findPairs(const label a, const label b)
{
    const bodyCopies::body &first = copies_.bodies()[a],
                           &second = copies_.bodies()[b];
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
        const bool inside = isPartner(first, second) &&
                            mag(r) < max(first.radius, second.radius);
        const vector shift(first.centre + r - second.centre);
        pair p{a, b, shift, 0, vector(Zero), inside};
        if (nucleiOnly_ && !p.inside) continue;
        p.gap = p.inside ? 0 : gap(first, second, p.shift, p.e);
        if (p.gap < farGap) pairs_.push_back(p);
    }
}

std::vector<Foam::neighbourField::closeSpheres>
Foam::neighbourField::spheresWithin(const scalar most) const
{
    std::vector<closeSpheres> all;
    for (const pair& p : pairs_)
    {
        const bodyCopies::body &a = copies_.bodies()[p.a],
                               &b = copies_.bodies()[p.b];
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
