// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyCopies.H"
#include <algorithm>
#include <set>

Foam::bodyCopies::bodyCopies(const PtrList<bodyGroup>& groups,
                             const bodyNumbers& numbers,
                             const uniformGrid& grid, const scalar range)
    : groups_(groups),
      grid_(grid),
      numbers_(numbers),
      range_(range),
      neighbours_(grid),
      copies_(neighbours_),
      sides_(boxSides(grid))
{
}

void Foam::bodyCopies::update(const bool atWalls)
{
    collect(own());
    if (atWalls) mirror();
}

std::vector<Foam::bodyCopies::body> Foam::bodyCopies::own() const
{
    std::vector<body> mine;
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!group.nearSources()) continue;
        forAll(group.mine(), i)
        {
            nearSurface::sources s(group.nearSources()->nearSourcesOf(i));
            body b;
            b.number = numbers_.number(g, group.mine()[i]);
            b.group = g;
            b.X = std::move(s.X);
            b.F = std::move(s.F);
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

void Foam::bodyCopies::write(const body& b, scalar* to)
{
    *to++ = b.number;
    *to++ = b.group;
    *to++ = b.radius;
    *to++ = b.X.size();
    for (const std::vector<vector>* v : {&b.X, &b.F})
    {
        for (const vector& x : *v)
        {
            to = std::copy(x.begin(), x.end(), to);
        }
    }
}

Foam::bodyCopies::body Foam::bodyCopies::read(const scalar* from,
                                              const point& centre)
{
    body b;
    b.number = from[0];
    b.group = from[1];
    b.centre = centre;
    b.radius = from[2];
    b.X.resize(label(from[3]));
    b.F.resize(b.X.size());
    from += nFacts;
    for (std::vector<vector>* v : {&b.X, &b.F})
    {
        for (vector& x : *v)
        {
            x = vector(from[0], from[1], from[2]);
            from += 3;
        }
    }
    return b;
}

void Foam::bodyCopies::collect(const std::vector<body>& mine)
{
    const label n = mine.size();
    largest_ = 0;
    label points = 0, away = 0;
    vectorField centres(n);
    std::set<label> ours;
    for (label k = 0; k < n; ++k)
    {
        centres[k] = mine[k].centre;
        largest_ = max(largest_, mine[k].radius);
        points = max(points, label(mine[k].X.size()));
        away = max(away, neighbours_.away(grid_.cellAt(centres[k])));
        ours.insert(mine[k].number);
    }
    reduce(largest_, maxOp<scalar>());
    reduce(points, maxOp<label>());
    reduce(away, maxOp<label>());
    const label each = nFacts + 6 * points;
    scalarField numbers(n * each, Zero);
    for (label k = 0; k < n; ++k)
    {
        write(mine[k], &numbers[k * each]);
    }
    copies_.route(centres, grid_.layersWithin(reach()) + away);
    const scalarField all(copies_.handOut(numbers.cdata(), each));
    bodies_.clear();
    forAll(copies_.here(), k)
    {
        bodies_.push_back(read(&all[k * each], copies_.here()[k]));
        bodies_.back().mine = ours.count(bodies_.back().number);
    }
    std::sort(bodies_.begin(), bodies_.end(),
              [](const body& a, const body& b) { return a.number < b.number; });
}

void Foam::bodyCopies::mirror()
{
    const label n = bodies_.size();
    for (direction d = 0; d < 3; ++d)
    {
        for (label side = 0; side < 2; ++side)
        {
            if (!sides_[d][side].closed) continue;
            const scalar at = grid_.origin()[d] + side * grid_.length()[d];
            for (label k = 0; k < n; ++k)
            {
                if (mag(bodies_[k].centre[d] - at) > reach()) continue;
                body b(bodies_[k]);
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
                bodies_.push_back(std::move(b));
            }
        }
    }
}
