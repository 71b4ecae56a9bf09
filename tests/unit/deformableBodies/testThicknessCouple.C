// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "markerSet.H"
#include "testFlow.H"
#include "thicknessCouple.H"

using namespace Foam;
using namespace test;

// Slow flow driven by the couple of an infinite straight line, in a periodic box as long as
// the line: the measured shear does not contain the line's own
TEST(ThicknessCouple, doesNotFeelItself)
{
    Random random(3);
    for (const deltaKernel::kernelType type :
         {deltaKernel::Roma3, deltaKernel::Peskin4})
    {
        scalar largest = 0;
        for (const label cells : {5, 6, 7, 8, 9, 12, 16})
        {
            const scalar h = 0.1, mu = 2;
            box b(labelVector(cells, 48, 48), h * vector(cells, 48, 48),
                  periodic, mu);
            const uniformGrid& grid = uniformGrid::New(b.mesh());
            const deltaKernel kernel(type);
            const label segments = 4 * cells;
            const scalar ds = 0.25 * h;
            const thicknessCouple couple(segments, ds, 0, kernel, mu, h);

            // Velocities of a rigid line that rotates about its middle
            const vector start(h * random.sample01<vector>() +
                               h * vector(0, 24, 24));
            const vector turning(0, random.sample01<scalar>(),
                                 random.sample01<scalar>());
            vectorField X(segments + 1), V(segments + 1);
            forAll(X, i)
            {
                X[i] = start + vector(i * ds, 0, 0);
                V[i] = i * ds * turning;
            }
            List<thicknessCouple::frame> frames;
            vectorField at(couple.nMarkers()), F(at.size(), Zero), U, g,
                gAndOwn;
            couple.markers(X, frames, at.data());

            // Forces change by half of the difference in a step
            const auto settle = [&](const scalarField& K)
            {
                for (int i = 0; i < 60; ++i)
                {
                    couple.forces(frames, V, vectorField(segments, Zero), K,
                                  F.data());
                }
            };
            settle(couple.K());

            // Started from zero, an infinitely long step gives twice the steady flow
            auto flow = b.flow("convection off; diffusion FFT;");
            blockNeighbours neighbours(grid);
            markerSet markers(grid, kernel, neighbours);
            markers.setPositions(at);
            markers.spread(F, flow->force());
            step(*flow, 1e8 * sqr(h) / mu);
            markers.interpolate({flow->velocity()}, U);
            U *= 0.5;

            couple.shear(frames, couple.K(), U.cdata(), nullptr, gAndOwn);
            couple.shear(frames, couple.K(), U.cdata(), F.cdata(), g);
            largest = max(largest, max(mag(g)) / max(mag(gAndOwn)));

            // Two coinciding lines that share the couple do not measure their own shear, nor
            // does a line that others cross in the middle of the first station, where it has
            // little of the couple
            vectorField ofTwo;
            couple.shear(frames, scalarField(0.5 * couple.K()), U.cdata(),
                         vectorField(0.5 * F).cdata(), ofTwo);
            EXPECT_LE(max(mag(ofTwo - g)), 1e-12 * max(mag(gAndOwn)));

            scalarField K(couple.K());
            const label middle = segments / couple.nMarkers() * 3 / 2;
            K[middle] *= 0.01;
            settle(K);
            const vectorField atRest(F.size(), Zero);
            vectorField own;
            couple.shear(frames, K, atRest.cdata(), F.cdata(), own);
            EXPECT_LE(max(mag(own)), 1.001 * max(mag(gAndOwn - g)));
        }
        expectBelow(std::string("shear of its own that is left, ") +
                        (type == deltaKernel::Roma3 ? "Roma3" : "Peskin4"),
                    largest, 0.03);
    }
}

// Couette flow between walls: the same shear beside each of them, down to 0.8
// cells for a line along the flow, and in the middle
TEST(ThicknessCouple, shearBesideWalls)
{
    const scalar h = 0.1;
    box b(labelVector(12, 16, 12), h * vector(12, 16, 12), wallsInY, 1);
    const uniformGrid& grid = uniformGrid::New(b.mesh());
    const deltaKernel kernel(deltaKernel::Roma3);
    staggeredField u(grid.box());
    u.box().cells([&](const label i, const labelVector& c)
                  { u[0][i] = (c.y() + 0.5) * h; });
    blockNeighbours neighbours(grid);
    markerSet markers(grid, kernel, neighbours);
    scalar largest = 0;
    for (const scalar distance : {0.8, 1.0, 1.24, 1.5, 4.0, 8.0})
    {
        for (const bool upper : {false, true})
        {
            thicknessCouple couple(6, h, 0, kernel, 1, h);
            couple.setWalls(grid);
            vectorField X(7);
            forAll(X, i)
            {
                X[i] = h * vector(2.3 + i, upper ? 16 - distance : distance, 5.6);
            }
            List<thicknessCouple::frame> frames;
            vectorField at(couple.nMarkers()), U, g;
            couple.markers(X, frames, at.data());
            markers.setPositions(at);
            markers.interpolate({u}, U);
            couple.shear(frames, couple.K(), U.cdata(), nullptr, g);
            largest = max(largest, max(mag(g - vector(0, 1, 0))));
        }
    }
    expectBelow("error of the shear beside walls", largest, 1e-12);
}
