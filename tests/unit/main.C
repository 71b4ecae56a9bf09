// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Main program of the unit tests. The tests run in a case with a mesh (./run), on any number
// of ranks: deformableBodiesUnitTests -case <case> [--gtest_filter=...]

#include "argList.H"
#include "Time.H"
#include "unitTest.H"
#include "volFields.H"
#include "surfaceFields.H"

static const Foam::fvMesh* theMesh = nullptr;

const Foam::fvMesh& test::mesh()
{
    return *theMesh;
}

// Run by tests/verification/red only: proof that tests can fail
TEST(Main, DISABLED_redIsPossible)
{
    EXPECT_LT(2, 1);
}

// Run by tests/bench/flow: memory of a mesh with its geometry and the fields that every
// OpenFOAM solver has
static void touchGeometry(const Foam::fvMesh& mesh)
{
    EXPECT_EQ(mesh.C().size(), mesh.V().size());
    EXPECT_EQ(mesh.Cf().size(), mesh.magSf().size());
    EXPECT_EQ(mesh.weights().size(), mesh.deltaCoeffs().size());
}

TEST(Main, DISABLED_meshAlone)
{
    touchGeometry(test::mesh());
}

TEST(Main, DISABLED_meshWithFields)
{
    using namespace Foam;
    const fvMesh& mesh = test::mesh();
    touchGeometry(mesh);
    const auto io = [&](const char* name)
    { return IOobject(name, mesh.time().timeName(), mesh); };
    const dimensionedScalar zero(dimless, Zero);
    const volVectorField U(io("U"), mesh, dimensionedVector(dimless, Zero));
    const volScalarField p(io("p"), mesh, zero), nu(io("nu"), mesh, zero);
    const surfaceScalarField phi(io("phi"), mesh, zero);
    EXPECT_EQ(U.size(), p.size());
}

int main(int argc, char* argv[])
{
    using namespace Foam;

    ::testing::InitGoogleTest(&argc, argv);
    argList::noBanner();
    argList args(argc, argv);
    Time runTime(Time::controlDictName, args);
    fvMesh mesh(IOobject(fvMesh::defaultRegion, runTime.timeName(), runTime,
                         IOobject::MUST_READ));
    theMesh = &mesh;

    // Errors that tests provoke are thrown as exceptions
    FatalError.throwExceptions();
    FatalIOError.throwExceptions();

    if (!Pstream::master())
    {
        auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
        delete listeners.Release(listeners.default_result_printer());
    }

    int failed = RUN_ALL_TESTS();
    reduce(failed, maxOp<int>());

    // "return 1" ends with exit status 0 on v1912
    if (failed) Pstream::exit(1);
    return 0;
}
