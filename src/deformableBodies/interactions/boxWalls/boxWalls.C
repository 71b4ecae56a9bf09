// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "boxWalls.H"
#include "boxSides.H"

Foam::boxWalls::boxWalls(const uniformGrid& grid)
    : grid_(grid)
{
    const auto sides(boxSides(grid));
    for (direction d = 0; d < 3; ++d)
    {
        for (label s = 0; s < 2; ++s)
        {
            walls_[d][s] = sides[d][s].wall;
        }
    }
}

Foam::scalar Foam::boxWalls::distance(const vector& x, vector& inward) const
{
    scalar least = GREAT;
    each(x,
         [&](const scalar distance, const vector& fromWall)
         {
             if (distance >= least) return;
             least = distance;
             inward = fromWall;
         });
    return least;
}
