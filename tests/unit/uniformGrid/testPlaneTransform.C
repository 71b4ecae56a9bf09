// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testWaves.H"

using namespace Foam;
using namespace test;

TEST(PlaneTransform, thereAndBack)
{
    const List<labelVector> cells(grid().cells());
    scalar worst = 0;
    for (unsigned code = 0; code < 4; ++code)
    {
        planeTransform transform(grid(), conditions(code));
        scalarField x(cells.size()), back(cells.size());
        forAll(x, i)
        {
            x[i] = noise(vector(cells[i].x(), cells[i].y(), cells[i].z()));
        }
        transform.forward(x.cdata());
        transform.backward(back.data());
        worst = max(worst, gMax(mag(back / transform.normalisation - x)));
    }
    test::expectBelow("transforms there and back", worst, 1e-14);
}

// A wave becomes a single mode of its two directions with the eigenvalues of the wave
TEST(PlaneTransform, waveIsOneMode)
{
    const List<labelVector> cells(grid().cells());
    scalar others = 0, eigen = 0;
    for (unsigned code = 0; code < 4; ++code)
    {
        const auto sides(conditions(code));
        planeTransform transform(grid(), sides);
        const waves w(sides);
        scalarField x(cells.size());
        forAll(x, i)
        {
            x[i] = w.at(cells[i]);
        }
        transform.forward(x.cdata());

        // Periodic waves: cosine and sine have the same eigenvalue
        scalar all = 0, own = 0;
        const scalar slow = w.along[transform.slow].eigenvalue(),
                     fast = w.along[transform.fast].eigenvalue();
        for (label k = 0; k < transform.nPlanes; ++k)
        {
            for (label j = 0; j < transform.nSlowModes; ++j)
            {
                for (label i = 0; i < transform.rowLength; ++i)
                {
                    const scalar c =
                        sqr(transform.plane(k)[i + transform.rowLength * j]);
                    const scalar off = max(mag(transform.eigenSlow[j] - slow),
                                           mag(transform.eigenFast[i] - fast));
                    all += c;
                    if (off < 1e-10)
                    {
                        own += c;
                        eigen = max(eigen, off);
                    }
                }
            }
        }
        reduce(all, sumOp<scalar>());
        reduce(own, sumOp<scalar>());
        others = max(others, mag(1 - own / all));
    }
    test::expectBelow("energy of a wave in other modes", others, 1e-13);
    test::expectBelow("eigenvalues", returnReduce(eigen, maxOp<scalar>()),
                      1e-14);
}
