// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "implicitDiffusion.H"
#include "testWaves.H"

using namespace Foam;
using namespace test;

// Each component of a product of waves: ADI divides by the product of the factors of
// the directions, FFT by 1 plus the sum of their parts
TEST(ImplicitDiffusion, dividesWaves)
{
    const cellBox& box = grid().box();
    const scalar b = 3 * sqr(cmptMin(grid().h()));
    const FixedList<vector, 2> rest(vector::zero);
    const wallVelocities none(rest);
    label walled = 0;
    for (direction d = 0; d < 3; ++d)
    {
        walled += !grid().periodic(d);
    }
    for (const bool byFFT : {false, true})
    {
        // What each of them asks for
        if (byFFT ? walled > 1 : !blocks()) continue;
        implicitDiffusion diffusion(grid(), byFFT);
        scalar worst = 0;
        for (direction c = 0; c < 3; ++c)
        {
            const waves w(conditions(3, c));
            scalar product = 1, sum = 1;
            for (direction d = 0; d < 3; ++d)
            {
                const scalar part =
                    b / sqr(grid().h()[d]) * w.along[d].eigenvalue();
                product *= 1 + part;
                sum += part;
            }
            scalarField exact(box.count(), Zero), x;
            FixedList<scalar*, 3> only({nullptr, nullptr, nullptr});
            for (const label i : grid().index())
            {
                exact[i] = w.at(box.cell(i));
            }
            x = (byFFT ? sum : product) * exact;
            only[c] = x.data();
            diffusion.solve(only, b, none);
            worst = max(worst, gMax(mag(x - exact)));
        }
        test::expectBelow(std::string("increment of a wave by ") +
                              (byFFT ? "FFT" : "ADI"),
                          worst, 1e-13);
    }
}
