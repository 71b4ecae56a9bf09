// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "neighbourField.H"
#include "periodicBox.H"
#include <algorithm>

namespace
{
//- Gaps of spheres about bodies up to which they are near, and from which on not [cells]
const Foam::scalar nearGap = 4, farGap = 6;
} // namespace

Foam::neighbourField::neighbourField(const PtrList<bodyGroup>& groups,
                                     const bodyScene& scene)
    : groups_(groups),
      grid_(scene.grid),
      numbers_(groups),
      neighbours_(scene.grid),
      copies_(neighbours_)
{
    const scalar h = grid_.h().x();
    for (const bodyGroup& group : groups_)
    {
        const nearSurface* surface = group.nearSources();
        sums_.emplace_back(
            surface ? new nearField(scene.kernel.type(), h, scene.mu,
                                    max(0.5 * h, 0.48 * surface->nearSpacing()),
                                    nearField::OTHER)
                    : nullptr);
    }
}

std::vector<Foam::neighbourField::bodyHere> Foam::neighbourField::own() const
{
    std::vector<bodyHere> mine;
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!sums_[g]) continue;
        forAll(group.mine(), i)
        {
            const nearSurface::sources& s = group.nearSources()->nearSources(i);
            bodyHere b{
                numbers_.number(g, group.mine()[i]), g, Zero, 0, s.X, s.F};
            for (const vector& x : b.X)
            {
                b.centre += x / scalar(b.X.size());
            }
            for (const vector& x : b.X)
            {
                b.radius = max(b.radius, mag(x - b.centre));
            }
            if (b.X.empty()) b.centre = group.centre(i);
            mine.push_back(std::move(b));
        }
    }
    return mine;
}

void Foam::neighbourField::collect(const std::vector<bodyHere>& mine)
{
    // Numbers that each body is sent as: number, group, radius, points, then these and
    // their forces
    const label facts = 4, n = mine.size();
    scalar largest = 0;
    label points = 0, away = 0;
    vectorField centres(n);
    for (label k = 0; k < n; ++k)
    {
        centres[k] = mine[k].centre;
        largest = max(largest, mine[k].radius);
        points = max(points, label(mine[k].X.size()));
        away = max(away, neighbours_.away(grid_.cellAt(centres[k])));
    }
    reduce(largest, maxOp<scalar>());
    reduce(points, maxOp<label>());
    reduce(away, maxOp<label>());
    const label each = facts + 6 * points;
    scalarField numbers(n * each, Zero);
    for (label k = 0; k < n; ++k)
    {
        scalar* to = &numbers[k * each];
        *to++ = mine[k].number;
        *to++ = mine[k].group;
        *to++ = mine[k].radius;
        *to++ = mine[k].X.size();
        for (const std::vector<vector>* v : {&mine[k].X, &mine[k].F})
        {
            for (const vector& x : *v)
            {
                to = std::copy(x.begin(), x.end(), to);
            }
        }
    }
    const scalar reach = 2 * largest + farGap * grid_.h().x();
    copies_.route(centres, grid_.layersWithin(reach) + away);
    const scalarField all(copies_.handOut(numbers.cdata(), each));
    here_.clear();
    forAll(copies_.here(), k)
    {
        const scalar* from = &all[k * each];
        bodyHere b{label(from[0]),
                   label(from[1]),
                   copies_.here()[k],
                   from[2],
                   std::vector<vector>(label(from[3])),
                   std::vector<vector>(label(from[3]))};
        from += facts;
        for (std::vector<vector>* v : {&b.X, &b.F})
        {
            for (vector& x : *v)
            {
                x = vector(from[0], from[1], from[2]);
                from += 3;
            }
        }
        here_.push_back(std::move(b));
    }
}

bool Foam::neighbourField::isPartner(const bodyHere& a, const bodyHere& b) const
{
    return numbers_.body(a.number) == numbers_.body(b.number) &&
           (groups_[a.group].host() == b.group ||
            groups_[b.group].host() == a.group);
}

void Foam::neighbourField::findNear(const bodyHere& body,
                                    std::vector<neighbour>& found) const
{
    const scalar h = grid_.h().x();
    const vector L(grid_.length());
    for (size_t k = 0; k < here_.size(); ++k)
    {
        const bodyHere& other = here_[k];
        const vector nearest(nearestImage(grid_, other.centre, body.centre));
        for (label image = 0; image < 27; ++image)
        {
            const labelVector at(image % 3 - 1, image / 3 % 3 - 1,
                                 image / 9 - 1);
            vector r(nearest);
            bool exists = true;
            for (direction d = 0; d < 3; ++d)
            {
                exists = exists && (at[d] == 0 || grid_.periodic(d));
                r[d] += at[d] * L[d];
            }
            const bool itself =
                other.number == body.number && mag(r) < 0.5 * cmptMin(L);
            if (!exists || itself) continue;
            const scalar gap = (mag(r) - body.radius - other.radius) / h;
            if (gap >= farGap) continue;
            if (isPartner(body, other) && mag(r) < body.radius + other.radius)
            {
                continue;
            }
            const scalar t = min(
                max((farGap - gap) / (farGap - nearGap), scalar(0)), scalar(1));
            found.push_back({other.number, label(k),
                             body.centre + r - other.centre,
                             t * t * (3 - 2 * t)});
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const neighbour& a, const neighbour& b)
                     { return a.number < b.number; });
}

void Foam::neighbourField::findMean(const std::vector<bodyHere>& mine)
{
    if (!grid_.periodic()) return;
    mean_ = Zero;
    for (const bodyHere& body : mine)
    {
        vector force(Zero);
        for (const vector& F : body.F)
        {
            force += F;
        }
        mean_ += sums_[body.group]->withheldFlow() * force;
    }
    reduce(mean_, sumOp<vector>());
    mean_ /= grid_.volume();
}

void Foam::neighbourField::update()
{
    const std::vector<bodyHere> mine(own());
    collect(mine);
    findMean(mine);
    near_.setSize(groups_.size());
    size_t k = 0;
    forAll(groups_, g)
    {
        near_[g].clear();
        if (!sums_[g]) continue;
        near_[g].setSize(groups_[g].mine().size());
        for (std::vector<neighbour>& found : near_[g])
        {
            findNear(mine[k++], found);
        }
    }
}

void Foam::neighbourField::add(const label group, const label i,
                               const vector* X, const label n, vector* u) const
{
    if (group >= near_.size() || i >= near_[group].size()) return;
    std::vector<vector> at(n), v(n);
    for (const neighbour& other : near_[group][i])
    {
        const bodyHere& body = here_[other.copy];
        if (body.X.empty()) continue;
        for (label k = 0; k < n; ++k)
        {
            at[k] = X[k] - other.shift;
            v[k] = Zero;
        }
        sums_[body.group]->add(body.X.data(), body.F.data(),
                               label(body.X.size()), at.data(), n, v.data());
        for (label k = 0; k < n; ++k)
        {
            u[k] += other.weight * v[k];
        }
    }
    for (label k = 0; k < n; ++k)
    {
        u[k] -= mean_;
    }
}
