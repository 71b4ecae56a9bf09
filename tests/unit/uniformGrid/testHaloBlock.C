// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "haloBlock.H"
#include "testWaves.H"

using namespace Foam;
using namespace test;

// Every place of the halo, its edges and corners included, has the value of the cell
// that it stands for; beyond walls that of the cell inside
TEST(HaloBlock, fillsItsLayer)
{
    if (!blocks()) return; // of an unstructured decomposition there are none
    const haloBlock halo(grid());
    const cellBox& box = halo.box();
    const auto value = [&](labelVector c)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const label n = grid().n()[d];
            c[d] = grid().periodic(d) ? (c[d] + n) % n
                                      : max(label(0), min(n - 1, c[d]));
        }
        return noise(vector(c.x(), c.y(), c.z()));
    };

    scalarField f(halo.size(), GREAT);
    for (label i = 0; i < box.count(); ++i)
    {
        f[halo.place(box.cell(i) - box.lo)] = value(box.cell(i));
    }
    halo.update(f.data());
    halo.extend(f.data());

    scalar worst = 0;
    labelVector l;
    for (l.z() = -1; l.z() <= box.size.z(); ++l.z())
    {
        for (l.y() = -1; l.y() <= box.size.y(); ++l.y())
        {
            for (l.x() = -1; l.x() <= box.size.x(); ++l.x())
            {
                worst = max(worst, mag(f[halo.place(l)] - value(box.lo + l)));
            }
        }
    }
    test::expectBelow("halo against the cells it stands for",
                      returnReduce(worst, maxOp<scalar>()), 0);
}
