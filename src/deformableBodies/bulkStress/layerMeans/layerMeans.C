// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "layerMeans.H"
#include "sumOverRanks.H"
#include "volFields.H"

namespace
{
using namespace Foam;

scalar cellsPerLayer(const uniformGrid& grid, const direction g)
{
    const labelVector& n = grid.n();
    return scalar(n.x()) * n.y() * n.z() / n[g];
}
} // namespace

Foam::layerMeans::layerMeans(const label nLayers)
    : u(nLayers, Zero),
      squares(nLayers, Zero),
      product(nLayers, 0)
{
}

Foam::layerMeans::layerMeans(const uniformGrid& grid, const direction f,
                             const direction g, const staggeredView& view)
    : layerMeans(grid.n()[g])
{
    const cellBox& box = grid.box();
    const label step[3] = {1, view.row, view.layer};
    const label toF = step[f], toG = step[g], nx = box.size.x();
    const auto addRow = [&](const label layer, const label first, const label n)
    {
        const bool onWall = layer == 0 && !grid.periodic(g);
        for (direction d = 0; d < 3; ++d)
        {
            const scalar* v = view.first[d] + first;
            scalar sum = 0, sumOfSquares = 0;
            for (label i = 0; i < n; ++i)
            {
                sum += v[i];
                sumOfSquares += v[i] * v[i];
            }
            u[layer][d] += sum;
            squares[layer][d] += sumOfSquares;
        }
        if (onWall) return;
        const scalar *a = view.first[f] + first, *b = view.first[g] + first;
        scalar sum = 0;
        for (label i = 0; i < n; ++i)
        {
            sum += (a[i] + a[i - toG]) * (b[i] + b[i - toF]);
        }
        product[layer] += 0.25 * sum;
    };
    for (label k = 0; k < box.size.z(); ++k)
    {
        for (label j = 0; j < box.size.y(); ++j)
        {
            const label first = view.index(labelVector(0, j, k));
            const labelVector cell(box.lo + labelVector(0, j, k));
            for (label i = 0; g == 0 && i < nx; ++i)
            {
                addRow(cell.x() + i, first + i, 1);
            }
            if (g != 0) addRow(cell[g], first, nx);
        }
    }
    finish(cellsPerLayer(grid, g));

    // Means of the lower faces, 0 on walls, to those of both faces of a layer
    const vector lowest(u[0]), lowestSquares(squares[0]);
    const label last = u.size() - 1;
    forAll(u, j)
    {
        u[j][g] = 0.5 * (u[j][g] + (j < last ? u[j + 1] : lowest)[g]);
        squares[j][g] = 0.5 * (squares[j][g] +
                               (j < last ? squares[j + 1] : lowestSquares)[g]);
    }
}

Foam::layerMeans::layerMeans(const uniformGrid& grid, const direction f,
                             const direction g, const volVectorField& U)
    : layerMeans(grid.n()[g])
{
    forAll(U, celli)
    {
        const label layer = grid.ijk(celli)[g];
        const vector& v = U[celli];
        u[layer] += v;
        squares[layer] += cmptMultiply(v, v);
        product[layer] += v[f] * v[g];
    }
    finish(cellsPerLayer(grid, g));

    // From the cells to their lower faces
    const scalarField cells(product);
    const label n = cells.size();
    forAll(product, j)
    {
        product[j] = j == 0 && !grid.periodic(g)
                         ? 0
                         : 0.5 * (cells[j] + cells[(j + n - 1) % n]);
    }
}

void Foam::layerMeans::finish(const scalar n)
{
    sumOverRanks(u);
    sumOverRanks(squares);
    sumOverRanks(product);
    u /= n;
    squares /= n;
    product /= n;
}
