// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "initialShape.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "testRefusal.H"
#include "testShapes.H"

using namespace test;

namespace
{
const int N = 12;

const sphericalHarmonics& grid()
{
    static const sphericalHarmonics g(N, 3 * N / 2 + 1);
    return g;
}

//- Points of a shape
vectorField pointsOf(const std::string& entries)
{
    const numbers c(initialShape(dictOf(entries), grid()));
    numbers x(3 * grid().nPoints());
    grid().values(c.data(), x.data());
    vectorField X(grid().nPoints());
    forAll(X, k)
    {
        for (direction d = 0; d < 3; ++d)
        {
            X[k][d] = x[d * grid().nPoints() + k];
        }
    }
    return X;
}

//- Largest |f(x)| of the points of a shape
template<class Function>
double worst(const vectorField& X, Function f)
{
    double most = 0;
    for (const vector& x : X)
    {
        most = std::max(most, std::abs(f(x)));
    }
    return most;
}

//- A surface of triangles: a cube of side 2 with its middle at (5 0 0), of which
//  some may be missing
fileName cube(const label missing = 0)
{
    const fileName file(test::mesh().time().globalPath() / "cube.stl");
    const label corners[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                  {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                  {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    OFstream os(file);
    os << "solid cube" << nl;
    for (label t = missing; t < 12; ++t)
    {
        os << "facet normal 0 0 0" << nl << "outer loop" << nl;
        for (const label k : corners[t])
        {
            os << "vertex " << (k & 4 ? 6 : 4) << ' ' << (k & 2 ? 1 : -1) << ' '
               << (k & 1 ? 1 : -1) << nl;
        }
        os << "endloop" << nl << "endfacet" << nl;
    }
    os << "endsolid cube" << endl;
    return file;
}
} // namespace

TEST(InitialShape, spheresAreOfDegreeOne)
{
    const auto X = pointsOf("type sphere; radius 2;");
    expectBelow("radius", worst(X, [](const vector& x) { return mag(x) - 2; }),
                1e-13);
    const numbers c(initialShape(dictOf("type sphere; radius 2;"), grid()));
    double others = 0;
    for (int n = 0; n <= N; ++n)
    {
        for (int m = 0; m <= n && n != 1; ++m)
        {
            for (int d = 0; d < 3; ++d)
            {
                others = std::max(
                    others, std::abs(c[3 * grid().index(n, m, false) + d]));
            }
        }
    }
    expectBelow("other degrees", others, 1e-13);
}

TEST(InitialShape, ellipsoidsHaveTheirAxesWhereTheAxisPoints)
{
    // The axis (1 0 0) takes z to x
    const auto X =
        pointsOf("type ellipsoid; semiAxes (1 1 0.5); axis (3 0 0);");
    expectBelow(
        "equation of the surface",
        worst(X, [](const vector& x)
              { return sqr(x.x() / 0.5) + sqr(x.y()) + sqr(x.z()) - 1; }),
        1e-13);
}

TEST(InitialShape, redCellsAreThoseOfEvansAndFung)
{
    const auto X = pointsOf("type biconcave; radius 2;");
    expectBelow("equation of the surface",
                worst(X,
                      [](const vector& x)
                      {
                          const double r2 = (sqr(x.x()) + sqr(x.y())) / 4;
                          return sqr(x.z()) -
                                 max(1 - r2, 0.0) *
                                     sqr(0.207 + 2.003 * r2 - 1.123 * r2 * r2);
                      }),
                1e-12);
}

// Harmonics of degree 12 round the edges of a cube; its faces are where they are
TEST(InitialShape, surfacesOfFilesAreFollowedAboutTheirMiddle)
{
    const fileName file(cube());
    const auto X = pointsOf("type fromFile; file \"" + file + "\"; scale 0.5;");
    rm(file);
    expectBelow(
        "departure from the faces",
        worst(X, [](const vector& x)
              { return max(max(mag(x.x()), mag(x.y())), mag(x.z())) - 0.5; }),
        0.05);
}

TEST(InitialShape, surfacesWithHolesAreRefused)
{
    const fileName file(cube(1));
    EXPECT_TRUE(refuses([&]
                        { pointsOf("type fromFile; file \"" + file + "\";"); },
                        "is open, or edges belong to more than two faces"));
    rm(file);
}

TEST(InitialShape, savedShapesKeepTheHarmonicsThatFit)
{
    const fileName file(test::mesh().time().globalPath() / "saved");
    const int M = 6;
    const numbers c(roughShape(M));
    {
        OFstream os(file);
        os.precision(17);
        // The shape and the one at the start between two numbers
        scalarList state(3 + 2 * c.size(), 0.0);
        std::copy(c.begin(), c.end(), state.begin() + 1);
        std::copy(c.begin(), c.end(), state.begin() + 1 + c.size());
        os.writeEntry("cells", List<scalarList>(1, state));
    }
    const std::string entries("type fromFile; file \"" + file + "\"; group ");
    const sphericalHarmonics other(M, M + 2);
    const numbers own(initialShape(dictOf(entries + "cells;"), grid()));
    double worst = 0;
    for (int n = 1; n <= M; ++n)
    {
        for (int m = 0; m <= n; ++m)
        {
            for (int d = 0; d < 3; ++d)
            {
                worst = std::max(
                    worst, std::abs(own[3 * grid().index(n, m, false) + d] -
                                    c[3 * other.index(n, m, false) + d]));
            }
        }
    }
    EXPECT_EQ(worst, 0);
    EXPECT_TRUE(refuses([&] { pointsOf(entries + "fibres;"); },
                        "a state of bodies with a group fibres"));
    EXPECT_TRUE(refuses([&] { pointsOf(entries + "cells; body 1;"); },
                        "a body 1 in group cells"));
    rm(file);
}

TEST(InitialShape, whatMakesNoShapeIsRefused)
{
    EXPECT_TRUE(
        refuses([] { pointsOf("type sphere; radius 0;"); },
                "entry radius has the value 0 allowed: numbers greater"));
    EXPECT_TRUE(
        refuses([] { pointsOf("type sphere; radius 1; axis (0 0 0);"); },
                "entry axis has the value (0 0 0) allowed: a direction"));
    EXPECT_TRUE(
        refuses([] { pointsOf("type ellipsoid; semiAxes (1 1 0);"); },
                "entry semiAxes has the value 0 allowed: three numbers"));
    EXPECT_TRUE(refuses([] { pointsOf("type cube; radius 1;"); },
                        "allowed: (sphere ellipsoid biconcave fromFile)"));
    EXPECT_TRUE(refuses([] { pointsOf("type sphere; radius 1; raduis 1;"); },
                        "unknown entry raduis"));
}
