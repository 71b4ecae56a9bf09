// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "implicitDiffusion.H"
#include "testWaves.H"

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Dense>

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
        // FFT needs two periodic directions, ADI blocks
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
            scalarField exact(box.nPlaces(), Zero), x;
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

// Walls that change their velocity, on any blocks as by Thomas along whole lines in the
// order x, y, z
TEST(ImplicitDiffusion, changingWallsInOrder)
{
    if (!blocks()) return;
    const labelVector& n = grid().n();
    const scalar b = 3 * sqr(cmptMin(grid().h()));
    const FixedList<vector, 2> rest(vector::zero);
    wallVelocities change(rest);
    for (direction d = 0; d < 3; ++d)
    {
        if (grid().periodic(d)) continue;
        change[d][0] = vector(1, 2, 3);
        change[d][1] = vector(-2, 1, 0.5);
        change[d][0][d] = change[d][1][d] = 0;
    }
    implicitDiffusion diffusion(grid(), false);
    cellBox whole;
    whole.lo = labelVector::zero;
    whole.size = n;
    scalar worst = 0;
    for (direction c = 0; c < 3; ++c)
    {
        std::vector<scalar> all(whole.nPlaces());
        whole.cells(
            [&](const label i, const labelVector& l)
            {
                all[i] = noise(vector(l.x(), l.y(), l.z()));
                if (!grid().periodic(c) && l[c] == 0) all[i] = 0;
            });
        const cellBox& box = grid().box();
        scalarField x(box.nPlaces());
        box.cells([&](const label i, const labelVector& l)
                  { x[i] = all[whole.index(l)]; });
        FixedList<scalar*, 3> only({nullptr, nullptr, nullptr});
        only[c] = x.data();
        diffusion.solve(only, b, change);

        for (direction d = 0; d < 3; ++d)
        {
            const scalar beta = b / sqr(grid().h()[d]);
            const bool walls = !grid().periodic(d), faces = walls && c == d;
            Eigen::MatrixXd A(Eigen::MatrixXd::Identity(n[d], n[d]));
            for (label j = 0; j < n[d]; ++j)
            {
                A(j, j) += 2 * beta;
                for (const label k : {j - 1, j + 1})
                {
                    const bool beyond = k < 0 || k == n[d];
                    if (!beyond || !walls) A(j, (k + n[d]) % n[d]) -= beta;
                    if (beyond && walls && !faces) A(j, j) += beta;
                }
            }
            if (faces)
            {
                A.row(0).setZero();
                A(0, 0) = 1;
            }
            const Eigen::MatrixXd inverse(A.inverse());
            whole.cells(
                [&](const label, labelVector l)
                {
                    if (l[d]) return;
                    Eigen::VectorXd r(n[d]);
                    for (l[d] = 0; l[d] < n[d]; ++l[d])
                    {
                        r[l[d]] = all[whole.index(l)];
                    }
                    if (walls && !faces)
                    {
                        r[0] += 2 * beta * change[d][0][c];
                        r[n[d] - 1] += 2 * beta * change[d][1][c];
                    }
                    if (faces) r[0] = 0;
                    r = inverse * r;
                    for (l[d] = 0; l[d] < n[d]; ++l[d])
                    {
                        all[whole.index(l)] = r[l[d]];
                    }
                });
        }
        box.cells([&](const label i, const labelVector& l)
                  { worst = max(worst, mag(x[i] - all[whole.index(l)])); });
    }
    test::expectBelow("walls that change, against whole lines",
                      returnReduce(worst, maxOp<scalar>()), 1e-13);
}
