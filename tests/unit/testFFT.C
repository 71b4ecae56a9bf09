// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "fvm.H"
#include "fvc.H"
#include "uniformGrid.H"
#include "volFields.H"
#include "fixedValueFvPatchFields.H"
#include "zeroGradientFvPatchFields.H"

using namespace Foam;

namespace
{
//- A field whose walls are Dirichlet where the bit of the patch is set
tmp<volScalarField> field(const unsigned dirichlet)
{
    const fvMesh& mesh = test::mesh();
    wordList types(mesh.boundary().size());
    label wall = 0;
    forAll(types, patchi)
    {
        const fvPatch& p = mesh.boundary()[patchi];
        types[patchi] = p.coupled() ? p.type()
                        : (dirichlet >> wall++) & 1
                            ? fixedValueFvPatchScalarField::typeName
                            : zeroGradientFvPatchScalarField::typeName;
    }
    return tmp<volScalarField>(
        new volScalarField(IOobject("x", mesh.time().timeName(), mesh), mesh,
                           dimensionedScalar(dimless, Zero), types));
}

label nWalls()
{
    label n = 0;
    for (const fvPatch& p : test::mesh().boundary())
    {
        if (!p.coupled()) ++n;
    }
    return n;
}

volScalarField randomField(const unsigned dirichlet)
{
    volScalarField x(field(dirichlet));
    forAll(x, celli)
    {
        x[celli] = test::noise(x.mesh().C()[celli]);
    }
    x.correctBoundaryConditions();
    return x;
}

dictionary controls(const char* text)
{
    IStringStream is(text);
    return dictionary(is);
}

//- Largest difference between two fields, their means apart if asked
scalar difference(const volScalarField& a, const volScalarField& b,
                  const bool level)
{
    scalarField d(a.primitiveField() - b.primitiveField());
    if (!level) d -= gAverage(d);
    return gMax(mag(d));
}

//- Solve A x = A (random field): largest error, residual and iterations
struct outcome
{
    scalar error, residual;
    label iterations;
};

outcome solveRandom(const unsigned dirichlet, const scalar sigma,
                    const surfaceScalarField& gamma, const char* solver,
                    const bool reference)
{
    const volScalarField exact(randomField(dirichlet));
    volScalarField x(field(dirichlet));
    fvScalarMatrix A(fvm::Sp(dimensionedScalar("sigma", dimless, sigma), x) -
                     fvm::laplacian(gamma, x));
    scalarField b(x.size());
    {
        FieldField<Field, scalar> bou(A.boundaryCoeffs()),
            inner(A.internalCoeffs());
        scalarField diag(A.diag());
        forAll(inner, patchi)
        {
            const labelUList& cells = x.mesh().lduAddr().patchAddr(patchi);
            forAll(cells, i)
            {
                A.diag()[cells[i]] += inner[patchi][i];
            }
        }
        A.Amul(b, exact.primitiveField(), bou,
               x.boundaryField().scalarInterfaces(), 0);
        A.diag() = diag;
    }
    A.source() = b;
    if (reference)
    {
        const bool mine = Pstream::master();
        A.setReference(mine ? 0 : -1, mine ? exact[0] : 0);
    }
    const bool level = sigma != 0 || dirichlet || reference;
    const solverPerformance result(A.solve(controls(solver)));
    return {difference(x, exact, level), result.finalResidual(),
            result.nIterations()};
}

surfaceScalarField constantGamma()
{
    const fvMesh& mesh = test::mesh();
    return surfaceScalarField(IOobject("gamma", mesh.time().timeName(), mesh),
                              mesh, dimensionedScalar("gamma", dimArea, 0.7));
}

// 1/A of an implicit momentum matrix with walls at nu dt/h^2 = 2
surfaceScalarField wallGamma()
{
    const fvMesh& mesh = test::mesh();
    volScalarField rAU(IOobject("rAU", mesh.time().timeName(), mesh), mesh,
                       dimensionedScalar(dimArea, Zero),
                       zeroGradientFvPatchScalarField::typeName);
    volScalarField diag(field(~0u));
    fvScalarMatrix A(
        fvm::Sp(dimensionedScalar("one", dimless, 1), diag) -
        fvm::laplacian(
            dimensionedScalar("nu", dimArea,
                              2 * sqr(cmptMin(uniformGrid::New(mesh).h()))),
            diag));
    rAU.primitiveFieldRef() = 1 / A.A()().primitiveField();
    rAU.correctBoundaryConditions();
    return fvc::interpolate(rAU);
}
} // namespace

TEST(FFT, recognisesTheBox)
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    EXPECT_TRUE(grid.valid()) << grid.reason();
    EXPECT_EQ(grid.n(), labelVector(12, 10, 8));
}

TEST(FFT, residualInAllBoundaryKinds)
{
    const unsigned combinations = 1u << nWalls();
    for (const scalar sigma : {0.0, 3.0})
    {
        scalar error = 0, residual = 0;
        for (unsigned d = 0; d < combinations; ++d)
        {
            const outcome o(
                solveRandom(d, sigma, constantGamma(),
                            "solver FFT; tolerance 1e-30; maxIter 3;", false));
            error = max(error, o.error);
            residual = max(residual, o.residual);
        }
        const std::string what = std::to_string(combinations) +
                                 " kinds of walls, sigma " +
                                 std::to_string(int(sigma));
        test::expectBelow("residual, " + what, residual, 1e-12);
        test::expectBelow("error, " + what, error, 1e-10);
    }
}

TEST(FFT, respectsSetReference)
{
    const outcome o(solveRandom(0, 0, constantGamma(),
                                "solver FFT; tolerance 1e-30; maxIter 3;",
                                true));
    test::expectBelow("residual with setReference", o.residual, 1e-12);
    test::expectBelow("error with setReference", o.error, 1e-10);
}

TEST(FFT, preconditionsVariableCoefficients)
{
    const outcome o(solveRandom(0, 0, wallGamma(),
                                "solver PCG; preconditioner FFT; "
                                "tolerance 1e-8; relTol 0;",
                                false));
    test::expectBelow("PCG + FFT iterations to 1e-8, 1/A beside walls",
                      o.iterations, 8);
    test::expectBelow("its residual", o.residual, 1e-8);
}

TEST(FFT, refusesVariableCoefficients)
{
    surfaceScalarField gamma(constantGamma());
    forAll(gamma, facei)
    {
        gamma[facei] *= 1 + 0.1 * test::noise(gamma.mesh().Cf()[facei]);
    }
    bool refused = false;
    try
    {
        solveRandom(0, 0, gamma, "solver FFT; tolerance 1e-12;", false);
    }
    catch (const Foam::error& e)
    {
        refused = std::string(e.message()).find("vary") != std::string::npos;
    }
    EXPECT_TRUE(refused) << "a variable matrix was solved as if constant";
}
