// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "viscosityContrast.H"
#include "fvcDiv.H"

Foam::viscosityContrast::viscosityContrast(const fvMesh& mesh, const scalar nu0,
                                           const scalarList& ratios)
    : mesh_(mesh),
      grid_(uniformGrid::New(mesh)),
      nu0_(nu0),
      range_(nu0 * min(scalar(1), min(ratios)),
             nu0 * max(scalar(1), max(ratios))),
      poisson_(fastHelmholtzCache::New(mesh).get(sidesOf(grid_, true)))
{
}

void Foam::viscosityContrast::update(const markerSet& markers,
                                     const vectorField& G, const scalar excess,
                                     staggeredField& work) const
{
    volScalarField& nu = mesh_.lookupObjectRef<volScalarField>("nu");
    nu.writeOpt() = IOobject::AUTO_WRITE;

    markers.spread(G, work);
    surfaceScalarField flux(IOobject("G", mesh_.time().timeName(), mesh_),
                            mesh_, dimensionedScalar(dimVolume, Zero));
    flux.setOriented();
    grid_.toFlux(work, flux);

    scalarField I(-fvc::div(flux)().primitiveField());
    FixedList<scalar, 3> inverseSqr;
    for (direction d = 0; d < 3; ++d)
    {
        inverseSqr[d] = 1 / sqr(grid_.h()[d]);
    }
    poisson_.solve(I.data(), I.cdata(), 0, inverseSqr);

    // Without walls the solution has zero mean; the enclosed volume gives its level
    const scalar mean =
        poisson_.singular(0)
            ? returnReduce(excess, sumOp<scalar>()) / grid_.volume()
            : 0;
    forAll(I, celli)
    {
        nu[celli] = range_.clip(nu0_ * (1 + mean + I[celli]));
    }
    nu.correctBoundaryConditions();
}
