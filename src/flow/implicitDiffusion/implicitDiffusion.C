// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "implicitDiffusion.H"

Foam::implicitDiffusion::implicitDiffusion(const uniformGrid& grid,
                                           const bool byFFT)
    : grid_(grid)
{
    for (direction c = 0; c < 3; ++c)
    {
        for (direction d = 0; d < 3 && !byFFT; ++d)
        {
            lines_[c][d].reset(new lineSolver(grid, d, c == d));
        }
        if (!byFFT) continue;
        FixedList<sideConditions, 3> sides(sidesOf(grid, true));
        sides[c].faces = !grid.periodic(c);
        transforms_[c].reset(new fastHelmholtz(grid, sides, grid.index()));
    }
}

// Sweep a component in all directions while it is cached; stop at the first direction that
// needs other ranks, and go on when the other components have come as far. Directions that
// need other ranks come first where the order is free
void Foam::implicitDiffusion::byLines(const FixedList<scalar*, 3>& x,
                                      const scalar b,
                                      const wallVelocities& change)
{
    // Factors with walls that change do not commute: only later ones see the change that
    // one adds
    const bool resting = change == wallVelocities(FixedList<vector, 2>(Zero));
    FixedList<direction, 3> order({0, 1, 2});
    label n = 0;
    for (const bool waits : {true, false})
    {
        for (direction d = 0; d < 3 && resting; ++d)
        {
            if (lines_[0][d]->waits() == waits) order[n++] = d;
        }
    }

    // From the first direction, or the one after a direction that waits, to the next one
    // that waits
    for (label first = 0; first <= 3; ++first)
    {
        if (first && !lines_[0][order[first - 1]]->waits()) continue;
        for (direction c = 0; c < 3; ++c)
        {
            if (!x[c]) continue;
            if (first) lines_[c][order[first - 1]]->finish(x[c]);
            for (label i = first; i < 3; ++i)
            {
                const direction d = order[i];
                lines_[c][d]->begin(x[c], b / sqr(grid_.h()[d]),
                                    change[d][0][c], change[d][1][c]);
                if (lines_[c][d]->waits()) break;
            }
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
