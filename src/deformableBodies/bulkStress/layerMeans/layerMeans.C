// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "layerMeans.H"
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
    const FixedList<label, 3> stride({1, view.row, view.layer});
    const scalar* along = view.first[f];
    const scalar* across = view.first[g];
    for (label k = 0; k < box.size.z(); ++k)
    {
        for (label j = 0; j < box.size.y(); ++j)
        {
            const label first = view.index(labelVector(0, j, k));
            for (label i = 0; i < box.size.x(); ++i)
            {
                const label q = first + i;
                const label layer = (labelVector(i, j, k) + box.lo)[g];
                for (direction d = 0; d < 3; ++d)
                {
                    const scalar v = view.first[d][q];
                    u[layer][d] += v;
                    squares[layer][d] += v * v;
                }
                if (layer == 0 && !grid.periodic(g)) continue;
                product[layer] += 0.25 * (along[q] + along[q - stride[g]]) *
                                  (across[q] + across[q - stride[f]]);
            }
        }
    }
    finish(cellsPerLayer(grid, g));
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
}

void Foam::layerMeans::finish(const scalar n)
{
    reduce(u, sumOp<vectorField>());
    reduce(squares, sumOp<vectorField>());
    reduce(product, sumOp<scalarField>());
    u /= n;
    squares /= n;
    product /= n;
}
