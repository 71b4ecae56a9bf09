// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Copies of bodies on this rank, images in walls, velocities at the points of bodies

#include "neighbourField.H"
#include <algorithm>
#include <set>

Foam::neighbourField::neighbourField(PtrList<bodyGroup>& groups,
                                     const bodyScene& scene,
                                     const bool nucleiOnly)
    : groups_(groups),
      grid_(scene.grid),
      mu_(scene.mu),
      kernel_(scene.kernel.type()),
      numbers_(groups),
      nucleiOnly_(nucleiOnly),
      neighbours_(scene.grid),
      copies_(neighbours_),
      walls_(wallSides(scene.grid)),
      spacing_(groups.size(), Zero)
{
    forAll(groups, g)
    {
        nearSurface* surface = groups[g].nearSources();
        if (!surface) continue;
        surface->join();
        spacing_[g] = surface->nearSpacing();
    }
    if (!nucleiOnly_ && grid_.periodic())
    {
        const scalar h = grid_.h().x();
        withheld_ =
            nearField(kernel_, h, mu_, h, nearField::OTHER).withheldFlow();
    }
}

std::vector<Foam::neighbourField::bodyHere> Foam::neighbourField::own() const
{
    std::vector<bodyHere> mine;
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!group.nearSources()) continue;
        forAll(group.mine(), i)
        {
            const nearSurface::sources& s = group.nearSources()->nearSources(i);
            bodyHere b;
            b.number = numbers_.number(g, group.mine()[i]);
            b.group = g;
            b.X = s.X;
            b.F = s.F;
            b.centre = b.X.empty() ? group.centre(i) : point(Zero);
            for (const vector& x : b.X)
            {
                b.centre += x / scalar(b.X.size());
            }
            b.radius = 0;
            for (const vector& x : b.X)
            {
                b.radius = max(b.radius, mag(x - b.centre));
            }
            mine.push_back(std::move(b));
        }
    }
    return mine;
}

void Foam::neighbourField::collect(const std::vector<bodyHere>& mine)
{
    // Message of a body: number, group, radius, number of points; then positions and forces
    const label facts = 4, n = mine.size();
    largest_ = 0;
    label points = 0, away = 0;
    vectorField centres(n);
    for (label k = 0; k < n; ++k)
    {
        centres[k] = mine[k].centre;
        largest_ = max(largest_, mine[k].radius);
        points = max(points, label(mine[k].X.size()));
        away = max(away, neighbours_.away(grid_.cellAt(centres[k])));
    }
    reduce(largest_, maxOp<scalar>());
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
    copies_.route(centres, grid_.layersWithin(reach()) + away);
    const scalarField all(copies_.handOut(numbers.cdata(), each));
    std::set<label> ours;
    for (const bodyHere& b : mine)
    {
        ours.insert(b.number);
    }
    here_.clear();
    forAll(copies_.here(), k)
    {
        const scalar* from = &all[k * each];
        bodyHere b;
        b.number = from[0];
        b.group = from[1];
        b.centre = copies_.here()[k];
        b.radius = from[2];
        b.X.resize(label(from[3]));
        b.F.resize(b.X.size());
        from += facts;
        for (std::vector<vector>* v : {&b.X, &b.F})
        {
            for (vector& x : *v)
            {
                x = vector(from[0], from[1], from[2]);
                from += 3;
            }
        }
        b.mine = ours.count(b.number);
        here_.push_back(std::move(b));
    }
    std::sort(here_.begin(), here_.end(),
              [](const bodyHere& a, const bodyHere& b)
              { return a.number < b.number; });
}

void Foam::neighbourField::mirror()
{
    const label n = here_.size();
    for (direction d = 0; d < 3; ++d)
    {
        for (label side = 0; side < 2; ++side)
        {
            if (!walls_[d][side]) continue;
            const scalar at = grid_.origin()[d] + side * grid_.length()[d];
            for (label k = 0; k < n; ++k)
            {
                if (mag(here_[k].centre[d] - at) > reach()) continue;
                if (!image_)
                {
                    image_.reset(new wallImage(kernel_, grid_.h().x(), mu_));
                }
                bodyHere b(here_[k]);
                b.mine = false;
                b.wall = d;
                b.wallAt = at;
                b.centre[d] = 2 * at - b.centre[d];
                for (vector& x : b.X)
                {
                    x[d] = 2 * at - x[d];
                }
                for (vector& F : b.F)
                {
                    F[d] *= -1;
                }
                here_.push_back(std::move(b));
            }
        }
    }
}

void Foam::neighbourField::update()
{
    const std::vector<bodyHere> mine(own());
    collect(mine);
    if (!nucleiOnly_) mirror();
    findPairs();
    for (const pair& p : pairs_)
    {
        add(p);
    }
    vector force(Zero);
    for (const bodyHere& b : mine)
    {
        for (const vector& F : b.F)
        {
            force += F;
        }
    }
    reduce(force, sumOp<vector>());
    const vector mean(withheld_ / grid_.volume() * force);
    std::map<label, bodyHere*> byNumber;
    for (bodyHere& b : here_)
    {
        if (b.wall < 0) byNumber[b.number] = &b;
    }
    forAll(groups_, g)
    {
        nearSurface* surface = groups_[g].nearSources();
        if (!surface) continue;
        std::vector<std::vector<vector>> u;
        for (const label i : groups_[g].mine())
        {
            u.push_back(velocities(*byNumber[numbers_.number(g, i)]));
            for (vector& v : u.back())
            {
                v -= mean;
            }
        }
        surface->setOfOthers(std::move(u));
    }
}
