// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "viscosityContrast.H"
#include "sphericalHarmonics.H"

using namespace Foam;

// Two ellipsoids, spheres of only 2.4 cells, one across the corner of the box if there are
// no walls; five times and half the viscosity inside. Only the master has markers
TEST(ViscosityContrast, levelsVolumeAndRange)
{
    const fvMesh& mesh = test::mesh();
    const uniformGrid& grid = uniformGrid::New(mesh);
    volScalarField nu(IOobject("nu", mesh.time().timeName(), mesh), mesh,
                      dimensionedScalar("nu", dimViscosity, 2));

    const scalar radius = 2.4, ratios[2] = {5, 0.5};
    const vector semiAxes(radius * grid.h());
    const vector L(grid.length());
    vector centres[2];
    centres[0] = grid.origin() + cmptMultiply(vector(0.27, 0.5, 0.5), L);
    centres[1] = grid.origin() + cmptMultiply(vector(0.73, 0.5, 0.5), L);
    for (direction d = 0; d < 3; ++d)
    {
        if (grid.periodic(d)) centres[1][d] += 0.27 * L[d];
        if (grid.periodic(d)) centres[0][d] += 0.27 * L[d];
    }

    const sphericalHarmonics sphere(4, 24);
    vectorField X, G;
    scalar excess = 0;
    if (Pstream::master())
    {
        for (label b = 0; b < 2; ++b)
        {
            for (label k = 0; k < sphere.nPoints(); ++k)
            {
                const scalar t = sphere.theta(k / sphere.nPhi());
                const scalar p = sphere.phi(k % sphere.nPhi());
                const vector e(std::sin(t) * std::cos(p),
                               std::sin(t) * std::sin(p), std::cos(t));
                X.append(centres[b] + cmptMultiply(semiAxes, e));
                G.append((1 - ratios[b]) * sphere.weight(k) *
                         cmptDivide(e, semiAxes) * semiAxes.x() * semiAxes.y() *
                         semiAxes.z());
            }
            excess += (ratios[b] - 1) * 4.0 / 3 * constant::mathematical::pi *
                      pow3(radius) * grid.cellVolume();
        }
    }

    blockNeighbours neighbours(grid);
    markerSet markers(grid, deltaKernel(deltaKernel::Roma3), neighbours);
    markers.setPositions(X);
    const viscosityContrast contrast(mesh, 2, scalarList({5, 0.5}));
    staggeredField work(grid.box());
    contrast.update(markers, G, excess, work);

    scalar inside = 0, outside = 0, sum = 0;
    forAll(nu, celli)
    {
        scalar nearest = GREAT;
        for (label b = 0; b < 2; ++b)
        {
            vector r(mesh.C()[celli] - centres[b]);
            for (direction d = 0; d < 3; ++d)
            {
                if (grid.periodic(d)) r[d] -= L[d] * std::round(r[d] / L[d]);
            }
            const scalar distance = mag(cmptDivide(r, grid.h()));
            if (distance < 0.8)
            {
                inside =
                    max(inside, mag(nu[celli] / 2 - ratios[b]) / ratios[b]);
            }
            nearest = min(nearest, distance);
        }
        if (nearest > radius + 2)
            outside = max(outside, mag(nu[celli] / 2 - 1));
        sum += (nu[celli] / 2 - 1) * grid.cellVolume();
    }
    reduce(inside, maxOp<scalar>());
    reduce(outside, maxOp<scalar>());
    reduce(sum, sumOp<scalar>());
    reduce(excess, sumOp<scalar>());
    test::expectBelow("viscosity in the middle, relative", inside, 0.02);
    test::expectBelow("viscosity far outside, relative", outside, 0.02);
    test::expectBelow("integral, relative", mag(sum / excess - 1), 0.02);
    EXPECT_GE(gMin(nu.primitiveField()), 1);
    EXPECT_LE(gMax(nu.primitiveField()), 10);
}
