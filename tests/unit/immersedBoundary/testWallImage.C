// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "coarsePoints.H"
#include "mathematicalConstants.H"
#include "nearField.H"
#include "unitTest.H"
#include "wallImage.H"
#include <Eigen/Eigenvalues>

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
                     body.origin[normal] - at, body.origin[normal] < at, u);
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
    for (const scalar z : {1.2, 1.5, 2.0, 3.0})
    {
        EXPECT_LT(image().parts(0, z, z)[wallImage::NN], 0);
    }
}

// u(x; F at y).G = u(y; G at x).F
TEST(WallImage, isReciprocal)
{
    const vector F(0.3, -0.7, 0.5), G(-0.2, 0.4, 0.9);
    for (const scalar height : {0.6, 0.9, 2.0})
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

// Own part and wall together damp, without the help of the mesh, which answers late in small
// steps: no negative eigenvalues of the mobility of a sphere at the wall
TEST(WallImage, staysPositive)
{
    const double pi = constant::mathematical::pi;
    for (const scalar radius : {3.0, 4.0, 6.0}) // [cells]
    {
        const label n = 4 * pi * sqr(radius) / 1.2;
        std::vector<vector> e;
        for (label i = 0; i < n; ++i)
        {
            const double z = 1 - (2 * i + 1.0) / n, r = std::sqrt(1 - z * z),
                         angle = i * pi * (3 - std::sqrt(5.0));
            e.push_back(vector(r * std::cos(angle), z, r * std::sin(angle)));
        }
        const coarsePoints smooth(e, label(1.6 * radius), n);
        const nearField own(deltaKernel::Roma3, h, mu,
                            1.35 * h * std::sqrt(1.2));
        const scalar gap = 0.05; // [cells]
        std::vector<vector> X, mirrored;
        for (const vector& x : e)
        {
            X.push_back(h * (radius * x + vector(0, radius + gap, 0)));
            mirrored.push_back(X.back());
            mirrored.back().y() *= -1;
        }
        Eigen::MatrixXd M(3 * n, 3 * n);
        for (label j = 0; j < 3 * n; ++j)
        {
            std::vector<vector> F(n, vector(Zero)), u(n), v;
            F[j / 3][j % 3] = 1;
            own.velocity(X.data(), F.data(), n, u.data());
            std::vector<vector> image_(smooth.forces(F.data()));
            for (vector& f : image_)
            {
                f.y() *= -1;
            }
            const nearField::pointSet body(X, F), other(mirrored, image_);
            image().velocity(body, other, other.origin - body.origin, 1,
                             body.origin.y(), false, v);
            smooth.add(v, u.data());
            for (label i = 0; i < 3 * n; ++i)
            {
                M(i, j) = u[i / 3][i % 3];
            }
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(
            0.5 * (M + M.transpose()), Eigen::EigenvaluesOnly);
        const Eigen::VectorXd& values = modes.eigenvalues();
        EXPECT_GT(values(0), -1e-6 * values(3 * n - 1))
            << "a/h " << radius;
    }
}
