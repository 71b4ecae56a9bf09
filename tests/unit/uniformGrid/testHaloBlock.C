// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "haloBlock.H"
#include "testWaves.H"

using namespace Foam;
using namespace test;

// Every halo value, edges and corners included, is that of the cell it represents; beyond
// walls that of the cell inside
TEST(HaloBlock, fillsItsLayer)
{
    if (!blocks()) return; // unstructured decompositions have no halo blocks
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
    box.cells([&](const label, const labelVector& c)
              { f[halo.index(c - box.lo)] = value(c); });
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
                worst = max(worst, mag(f[halo.index(l)] - value(box.lo + l)));
            }
        }
    }
    test::expectBelow("halo against the cells it stands for",
                      returnReduce(worst, maxOp<scalar>()), 0);
}

// Exchange of the next cells only: sets the layers below of one array, the layers above in
// each direction of the array of that direction, and no others
TEST(HaloBlock, fillsFaces)
{
    if (!blocks()) return;
    const haloBlock halo(grid());
    const cellBox& box = halo.box();
    FixedList<scalarField, 3> all, parts;
    for (direction d = 0; d < 3; ++d)
    {
        all[d] = scalarField(halo.size(), GREAT);
        box.cells(
            [&](const label, const labelVector& c)
            {
                all[d][halo.index(c - box.lo)] =
                    noise(vector(c.x(), c.y(), c.z() + 100 * d));
            });
        parts[d] = all[d];
        halo.update(all[d].data());
    }
    const scalarField before(parts[0]);
    halo.updateBelow<1>({parts[0].data()});
    const scalarField below(parts[0]);
    parts[0] = before;
    halo.updateAbove({parts[0].data(), parts[1].data(), parts[2].data()});

    label wrong = 0;
    labelVector l;
    for (l.z() = -1; l.z() <= box.size.z(); ++l.z())
    {
        for (l.y() = -1; l.y() <= box.size.y(); ++l.y())
        {
            for (l.x() = -1; l.x() <= box.size.x(); ++l.x())
            {
                label under = 0, over = 0;
                direction last = 0;
                for (direction d = 0; d < 3; ++d)
                {
                    under += l[d] < 0;
                    over += l[d] >= box.size[d];
                    if (l[d] >= box.size[d]) last = d;
                }
                if (under + over == 0) continue;
                const label q = halo.index(l);
                wrong += below[q] !=
                         (under + over == 1 && under ? all[0][q] : GREAT);
                for (direction d = 0; d < 3; ++d)
                {
                    wrong += parts[d][q] !=
                             (under + over == 1 && over && last == d ? all[d][q]
                                                                     : GREAT);
                }
            }
        }
    }
    EXPECT_EQ(returnReduce(wrong, sumOp<label>()), 0);
}
