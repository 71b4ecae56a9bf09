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
            transforms_[c].reset(
                new fastHelmholtz(grid, sides, grid.cells(), grid.index()));
        }
    }
}

void Foam::implicitDiffusion::solve(const direction component, scalar* x,
                                    const scalar b,
                                    const wallVelocities& change)
{
    FixedList<scalar, 3> beta;
    for (direction d = 0; d < 3; ++d)
    {
        beta[d] = b / sqr(grid_.h()[d]);
    }

    if (!transforms_[component])
    {
        for (direction d = 0; d < 3; ++d)
        {
            lines_[component][d]->solve(x, beta[d], change[d][0][component],
                                        change[d][1][component]);
        }
        return;
    }

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
