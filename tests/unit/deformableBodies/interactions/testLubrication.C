// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "IStringStream.H"
#include "lubrication.H"
#include "mathematicalConstants.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const scalar pi = constant::mathematical::pi;

const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

//- Fibres of radius 1/2 cell, viscosity 2, film up to a fifth of the radius
struct scene
{
    const scalar mu = 2, r = 0.5 * cmptMin(grid().h()), R = 0.2 * r;

    lubrication model(const scalar roughness) const
    {
        const interactionScene about{grid(), mu, 0.01, 0, r, r, {}};
        IStringStream is("range " + Foam::name(R) + "; roughness " +
                         Foam::name(roughness) + ";");
        return lubrication(dictionary(is), about);
    }
};
} // namespace

// Resistance over four decades of the gap against Reynolds' equation. The loss of k by the
// cut-off at the range is known for crossing lines
TEST(Lubrication, formulas)
{
    if (Pstream::parRun()) return;
    const scene s;
    const scalar r = s.r;
    for (scalar g = 1e-6 * r; g < 2e-2 * r; g *= 10)
    {
        const lubrication model(s.model(max(0.1 * g, 1e-6 * r)));
        for (const scalar degrees : {90.0, 45.0, 15.0})
        {
            const scalar a = degrees * pi / 180;
            const vector e1(2.0 * r / std::sin(a), 0, 0);
            const vector e2(mag(e1) * vector(std::cos(a), 0, std::sin(a)));
            const auto film =
                model.between(e1, e2, vector(0, 2 * r + g, 0), r, r);
            const scalar right = 6 * pi * s.mu * sqr(r) / std::sin(a) *
                                 (1 / g - 1 / s.R - (s.R - g) / sqr(s.R));
            test::expectBelow("crossed at " + std::to_string(int(degrees)) +
                                  " degrees, gap over radius " +
                                  std::to_string(g / r),
                              mag(film.k / right - 1), 0.02);
            EXPECT_NEAR(film.n.y(), 1, 1e-6);
        }

        // Different radii: reduced to the radii of the principal curvatures
        {
            const scalar b = 0.3 * r, both = r * b / (r + b);
            const vector e1(2 * r, 0, 0), e2(0, 0, 2 * r);
            const auto film =
                model.between(e1, e2, vector(0, r + b + g, 0), r, b);
            const scalar right = 12 * pi * s.mu * both * std::sqrt(r * b) *
                                 (1 / g - 1 / s.R - (s.R - g) / sqr(s.R));
            test::expectBelow("radii 1 and 0.3, gap over radius " +
                                  std::to_string(g / r),
                              mag(film.k / right - 1), 0.02);
        }

        // An element beside an element that is longer than the film is wide
        const vector e1(0.3 * r, 0, 0), e2(3 * r, 0, 0);
        const auto film = model.between(e1, e2, vector(0, 2 * r + g, 0), r, r);
        const scalar right = 1.5 * pi * s.mu * std::pow(r / g, 1.5) * mag(e1);
        test::expectBelow("parallel, gap over radius " + std::to_string(g / r),
                          mag(film.k / right - 1),
                          0.005 + 2 * std::pow(g / s.R, 1.5));

        const scalar wall = 3 * std::sqrt(2.0) * pi * s.mu;
        test::expectBelow(
            "wall, gap over radius " + std::to_string(g / r),
            mag(model.ofWall(g, r) /
                    (wall * (std::pow(r / g, 1.5) - std::pow(r / s.R, 1.5))) -
                1),
            1e-12);
    }
}

// The resistance grows from 0 at the range to a constant at the roughness; it is symmetric
// and does not depend on the elements
TEST(Lubrication, isContinuousAndMutual)
{
    if (Pstream::parRun()) return;
    const scene s;
    const lubrication model(s.model(0.01 * s.r));
    const vector e1(0.6 * s.r, 0, 0.1 * s.r), e2(-0.2 * s.r, 0, 0.7 * s.r);
    const auto k = [&](const scalar gap)
    {
        return model
            .between(e1, e2, vector(0.1 * s.r, 2 * s.r + gap, 0), s.r, s.r)
            .k;
    };
    EXPECT_EQ(k(s.R), 0);
    EXPECT_EQ(model.ofWall(s.R, s.r), 0);
    test::expectBelow("just within the range, over that at its half",
                      k(0.99 * s.R) / k(0.5 * s.R), 0.02);
    test::expectBelow("within the roughness, over that at it",
                      k(-0.5 * s.r) / k(0.01 * s.r), 10);

    const vector apart(0.3 * s.r, 2.02 * s.r, -0.1 * s.r);
    const auto one = model.between(e1, e2, apart, s.r, s.r),
               other = model.between(e2, e1, -apart, s.r, s.r);
    test::expectBelow("either way round: k", mag(one.k / other.k - 1), 1e-13);
    test::expectBelow("direction", mag(one.n + other.n), 1e-13);
    test::expectBelow("place", mag(one.at - other.otherAt), 1e-13);
    const vector connection(apart + one.at * e1 - one.otherAt * e2);
    test::expectBelow("torque", mag(connection ^ one.n) / mag(connection),
                      1e-13);
}
