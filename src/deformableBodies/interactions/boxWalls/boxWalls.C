// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "boxWalls.H"
#include "wallPolyPatch.H"

Foam::boxWalls::boxWalls(const fvMesh& mesh, const uniformGrid& grid)
    : grid_(grid),
      walls_(FixedList<bool, 2>(false))
{
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (!isA<wallPolyPatch>(patch)) continue;
        forAll(patch, i)
        {
            const label facei = patch.start() + i;
            const direction d = grid_.faceDirection(facei);
            walls_[d][grid_.lowerSide(facei) ? 0 : 1] = true;
        }
    }
    for (FixedList<bool, 2>& ofDirection : walls_)
    {
        for (bool& wall : ofDirection)
        {
            reduce(wall, orOp<bool>());
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
