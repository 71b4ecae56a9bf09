// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "IStringStream.H"
#include "mathematicalConstants.H"
#include "rigidShape.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
rigidShape shape(const string& entries)
{
    IStringStream is(entries);
    return rigidShape(dictionary(is));
}
} // namespace

// Volume, area and moments of a sphere, an oblate and a prolate spheroid against closed
// forms
TEST(RigidShape, measures)
{
    const scalar pi = constant::mathematical::pi;
    const rigidShape sphere(shape("type sphere; radius 2;"));
    EXPECT_NEAR(sphere.volume(), 32 * pi / 3, 1e-12);
    EXPECT_NEAR(sphere.area(), 16 * pi, 1e-12 * 16 * pi);
    EXPECT_NEAR(sphere.inertia().x(), 1.6, 1e-14);

    const scalar e = std::sqrt(0.75);
    EXPECT_NEAR(shape("type ellipsoid; semiAxes (1 1 0.5);").area(),
                2 * pi + 0.25 * pi / e * std::log((1 + e) / (1 - e)), 1e-5);
    const rigidShape prolate(shape("type ellipsoid; semiAxes (2 1 1);"));
    EXPECT_NEAR(prolate.area(), 2 * pi * (1 + 2 / e * std::asin(e)), 1e-3);
    EXPECT_NEAR(prolate.radius(), std::cbrt(2.0), 1e-14);
    EXPECT_NEAR(prolate.inertia().x(), 0.4, 1e-14);
    EXPECT_NEAR(prolate.inertia().z(), 1, 1e-14);
}

// Points lie on the surface, in opposite pairs, and represent equal areas
TEST(RigidShape, points)
{
    for (const string entries :
         {"type sphere; radius 1;", "type ellipsoid; semiAxes (1 0.7 1.6);"})
    {
        const rigidShape s(shape(entries));
        const label n = 400;
        vectorField X, dS;
        s.points(n, 0.1, X, dS);
        ASSERT_EQ(X.size(), n);

        tensor moment(Zero);
        scalar nearest = GREAT, furthest = 0;
        const vector inner(s.semiAxes() - 0.1 * vector::one);
        forAll(X, k)
        {
            EXPECT_NEAR(mag(cmptDivide(X[k], inner)), 1, 1e-12);
            const vector onSurface(
                cmptMultiply(cmptDivide(X[k], inner), s.semiAxes()));
            moment += onSurface * dS[k];
            scalar toNext = GREAT;
            forAll(X, l)
            {
                if (l != k) toNext = min(toNext, mag(X[l] - X[k]));
            }
            nearest = min(nearest, toNext);
            furthest = max(furthest, toNext);
        }
        EXPECT_NEAR(mag(sum(X)), 0, 1e-12);
        EXPECT_NEAR(mag(sum(dS)), 0, 1e-12);
        EXPECT_NEAR(mag(moment - s.volume() * tensor::I), 0, 1e-10);
        EXPECT_NEAR(sum(mag(dS)), s.area(), 0.02 * s.area());

        // Relative to the spacing that n points would have on a square
        const scalar spacing = std::sqrt(s.area() / n);
        EXPECT_GT(nearest, 0.25 * spacing);
        EXPECT_LT(furthest, 1.5 * spacing);
    }
}
