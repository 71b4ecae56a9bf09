// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "boxLattice.H"
#include <vector>

namespace
{
using namespace Foam;

// blockMesh writes 10 digits: positions carry relative errors of 1e-10 of the
// box, which may be 1e-7 of a cell. Anything graded on purpose exceeds this.
const scalar positionTolerance = 1e-4;

//- Smallest and largest sizes of the cells' bounding boxes [m]; false if some cells are no
//  hexahedra (collective). By faces: the mesh's lists of cell faces and points, once made,
//  stay, and take more memory than the flow
bool cellSizes(const polyMesh& mesh, vector& smallest, vector& largest)
{
    const label nCells = mesh.nCells();
    vectorField lower(nCells, vector::max), upper(nCells, vector::min);
    std::vector<direction> nFaces(nCells, 0);
    forAll(mesh.faces(), facei)
    {
        const boundBox b(mesh.points(), mesh.faces()[facei], false);
        const auto add = [&](const label celli)
        {
            lower[celli] = min(lower[celli], b.min());
            upper[celli] = max(upper[celli], b.max());
            ++nFaces[celli];
        };
        add(mesh.faceOwner()[facei]);
        if (facei < mesh.nInternalFaces()) add(mesh.faceNeighbour()[facei]);
    }
    smallest = vector::max;
    largest = vector::min;
    bool hexes = true;
    for (label celli = 0; celli < nCells; ++celli)
    {
        hexes = hexes && nFaces[celli] == 6;
        smallest = min(smallest, upper[celli] - lower[celli]);
        largest = max(largest, upper[celli] - lower[celli]);
    }
    reduce(hexes, andOp<bool>());
    reduce(smallest, minOp<vector>());
    reduce(largest, maxOp<vector>());
    return hexes;
}
} // namespace

bool Foam::boxLattice::number(const polyMesh& mesh)
{
    const vectorField& centres = mesh.cellCentres();
    const scalar volume = h.x() * h.y() * h.z();
    cells.setSize(mesh.nCells());
    bool aligned = true;
    forAll(cells, celli)
    {
        const vector c(centres[celli] - origin);
        for (direction d = 0; d < 3; ++d)
        {
            const scalar at = c[d] / h[d] - 0.5;
            cells[celli][d] = label(floor(at + 0.5));
            aligned =
                aligned && mag(at - cells[celli][d]) < positionTolerance * n[d];
        }
        aligned = aligned && mag(mesh.cellVolumes()[celli] / volume - 1) <
                                 10 * positionTolerance;
    }
    return returnReduce(aligned, andOp<bool>());
}

Foam::string Foam::boxLattice::recognise(const polyMesh& mesh)
{
    const boundBox bounds(mesh.points(), true);
    origin = bounds.min();

    vector hMin, hMax;
    if (!cellSizes(mesh, hMin, hMax))
    {
        return "some cells are not hexahedra with six faces";
    }
    for (direction d = 0; d < 3; ++d)
    {
        if (hMax[d] - hMin[d] > positionTolerance * hMin[d])
        {
            return "the cell size in direction " +
                   string(vector::componentNames[d]) + " varies between " +
                   Foam::name(hMin[d]) + " and " + Foam::name(hMax[d]);
        }
        n[d] = label(bounds.span()[d] / hMax[d] + 0.5);
        h[d] = bounds.span()[d] / n[d];
    }

    // Boxes of equal size that fill the bounding box on lattice positions
    if (!number(mesh))
    {
        return "the cells are not boxes along the coordinate axes";
    }
    const label nAll = returnReduce(cells.size(), sumOp<label>());
    if (nAll != n.x() * n.y() * n.z())
    {
        return "the " + Foam::name(nAll) +
               " cells do not fill their bounding box of " + Foam::name(n.x()) +
               " x " + Foam::name(n.y()) + " x " + Foam::name(n.z());
    }
    return string::null;
}
