// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "implicitDiffusion.H"

Foam::implicitDiffusion::implicitDiffusion(const uniformGrid& grid,
                                           const bool byFFT)
    : grid_(grid)
{
    for (direction c = 0; c < 3; ++c)
    {
        FixedList<sideConditions, 3> sides;
        for (direction d = 0; d < 3; ++d)
        {
            sides[d].periodic = grid.periodic(d);
            sides[d].faces = !grid.periodic(d) && c == d;
            sides[d].lowerDirichlet = sides[d].upperDirichlet =
                !grid.periodic(d) && c != d;
            if (!byFFT) lines_[c][d].reset(new lineSolver(grid, d, c == d));
        }
        if (byFFT)
        {
            transforms_[c].reset(new fastHelmholtz(grid, sides, grid.index()));
        }
    }
}

// The directions of a component follow each other, while it is in the cache, up to one
// whose lines wait for other ranks. Those come first, where the order is free: the next
// direction makes their correction
void Foam::implicitDiffusion::byLines(const FixedList<scalar*, 3>& x,
                                      const scalar b,
                                      const wallVelocities& change)
{
    // Factors with walls that change do not commute: what one adds only the later ones see
    const bool resting = change == wallVelocities(FixedList<vector, 2>(Zero));
    FixedList<direction, 3> order({0, 1, 2}), next({0, 0, 0});
    label n = 0;
    for (const bool waits : {true, false})
    {
        for (direction d = 0; d < 3 && resting; ++d)
        {
            if (lines_[0][d]->waits() == waits) order[n++] = d;
        }
    }

    // To the end of a component, or to a direction that waits
    const auto advance = [&](const direction c)
    {
        lineSolver* earlier = nullptr;
        if (next[c] > 0)
        {
            earlier = lines_[c][order[next[c] - 1]].get();
            earlier->receive();
        }
        while (next[c] < 3)
        {
            const direction d = order[next[c]++];
            lineSolver& lines = *lines_[c][d];
            lines.begin(x[c], b / sqr(grid_.h()[d]), change[d][0][c],
                        change[d][1][c], earlier);
            if (lines.waits()) return false;
            earlier = nullptr;
        }
        if (earlier) earlier->correct(x[c]);
        return true;
    };
    FixedList<bool, 3> done({!x[0], !x[1], !x[2]});
    while (!(done[0] && done[1] && done[2]))
    {
        for (direction c = 0; c < 3; ++c)
        {
            done[c] = done[c] || advance(c);
        }
    }
}

void Foam::implicitDiffusion::byTransforms(const direction component, scalar* x,
                                           const scalar b,
                                           const wallVelocities& change)
{
    const vector& h = grid_.h();
    const FixedList<scalar, 3> beta(
        {b / sqr(h.x()), b / sqr(h.y()), b / sqr(h.z())});

    // The mirrored value beyond a wall is 2 change - x
    const cellBox& box = grid_.box();
    for (direction d = 0; d < 3; ++d)
    {
        for (label side = 0; side < 2; ++side)
        {
            const scalar w = 2 * beta[d] * change[d][side][component];
            if (d == component || w == 0 || grid_.periodic(d)) continue;
            const label wall = (side ? grid_.n()[d] - 1 : 0) - box.lo[d];
            if (wall < 0 || wall >= box.size[d]) continue;
            box.layer(d, wall, [&](const label i) { x[i] += w; });
        }
    }
    transforms_[component]->solve(x, x, 1, beta);
}

void Foam::implicitDiffusion::solve(const FixedList<scalar*, 3>& x,
                                    const scalar b,
                                    const wallVelocities& change)
{
    if (!transforms_[0]) return byLines(x, b, change);
    for (direction c = 0; c < 3; ++c)
    {
        if (x[c]) byTransforms(c, x[c], b, change);
    }
}
