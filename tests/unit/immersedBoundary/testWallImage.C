// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include "wallImage.H"

using namespace Foam;

namespace
{
const scalar h = 0.5, mu = 2;

const wallImage& image()
{
    static const wallImage one(deltaKernel::Roma3, h, mu);
    return one;
}

//- Velocity at a point of a force, beside a wall at x[normal] = at with the fluid above
//  (side 1) or below it (-1)
vector velocity(const vector& x, const vector& y, const vector& F,
                const direction normal, const scalar at)
{
    vector mirrored(y), force(F);
    mirrored[normal] = 2 * at - y[normal];
    force[normal] *= -1;
    const nearField::pointSet body({x}, {vector::zero}),
        other({mirrored}, {force});
    std::vector<vector> u;
    image().velocity(body, other, other.origin - body.origin, normal,
                     body.origin[normal] - at, u);
    return u[0];
}
} // namespace

// High above the wall, at one place: the closed form of order h^2
TEST(WallImage, farFromTheWall)
{
    const scalar c = 0.5 * 0.2984667; // half the second moment of Roma3
    for (const scalar z : {7.45058, 14.5519, 22.7374}) // heights of the table
    {
        const scalar Z = 2 * z, s = 0.25;
        const scalar normal = (4 * c - 5 / 32.0) * 2 +
                              (4 * c + 17 / 96.0) * 6 - 7 / 96.0 * 24 +
                              s * (21 / 16.0 * 24 - 7 / 48.0 * 120);
        const scalar along =
            3 / 16.0 * 2 - 7 / 48.0 * 6 + (11 / 32.0 - 3 / 16.0 - 4 * c) +
            (4 * c - 79 / 96.0 + 7 / 48.0) * 3 + 7 / 96.0 * 12 +
            s * (21 / 16.0 * 12 - 7 / 48.0 * 60);
        const auto K = image().parts(0, z, z);
        const scalar order = 12 / sqr(z); // size of the next terms
        EXPECT_NEAR(K[wallImage::NN] * pow3(Z), -normal, order * normal);
        EXPECT_NEAR(K[wallImage::EE] * pow3(Z), -along, order * normal);
        EXPECT_NEAR(K[wallImage::TT], K[wallImage::EE], 1e-6);
    }
}

// The wall takes away: a force beside it meets more resistance than on the mesh
TEST(WallImage, resists)
{
    for (const scalar z : {0.5, 0.7, 1.0, 1.5, 3.0})
    {
        EXPECT_LT(image().parts(0, z, z)[wallImage::NN], 0);
    }
}

// u(x; F at y).G = u(y; G at x).F
TEST(WallImage, isReciprocal)
{
    const vector F(0.3, -0.7, 0.5), G(-0.2, 0.4, 0.9);
    for (const scalar height : {0.4, 0.9, 2.0})
    {
        const vector x(0.1, height, 0.2), y(0.9, 0.7, -0.5);
        EXPECT_NEAR((velocity(x, y, F, 1, 0) & G) / (velocity(y, x, G, 1, 0) & F),
                    1, 0.02);
    }
}

// Walls of all sides answer alike
TEST(WallImage, allSidesAreAlike)
{
    const vector x(0.1, 0.8, 0.2), y(0.9, 0.7, -0.5), F(0.3, -0.7, 0.5);
    const vector u(velocity(x, y, F, 1, 0));
    const auto turned = [](const vector& v)
    { return vector(v.z(), v.x(), v.y()); };
    const auto below = [](const vector& v)
    { return vector(v.x(), -v.y(), v.z()); };
    EXPECT_NEAR(mag(velocity(turned(x), turned(y), turned(F), 2, 0) - turned(u)),
                0, 1e-6 * mag(u));
    const vector up(0, 3, 0);
    EXPECT_NEAR(mag(velocity(below(x) + up, below(y) + up, below(F), 1, 3) -
                    below(u)),
                0, 1e-5 * mag(u));
}
