// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "packing.H"
#include "segmentDistance.H"
#include "testBox.H"

using namespace Foam;

namespace
{
//- A box of 8 with walls in y, for as long as the tests of this file
std::unique_ptr<test::box> made;

const uniformGrid& box()
{
    return uniformGrid::New(made->mesh());
}

vector anyDirection(Random& random)
{
    const vector v(2 * random.sample01<vector>() - vector::one);
    return v / mag(v);
}

//- Solids from number first on, filled into a box
struct filled
{
    packing all{box()};
    Random random;
    scalar size = 0;

    filled(const label n, const solidForm& form, const scalar gap,
           const label seed = 1)
        : random(seed)
    {
        fill(n, form, gap);
    }

    void fill(const label n, const solidForm& form, const scalar gap)
    {
        size = all.fill(
            n, form, gap, true, [&] { return anyDirection(random); }, random,
            "solids");
    }
};

//- Least distance of the axes of two solids, over periodic images
scalar axesApart(const solid& a, const solid& b, const bool same)
{
    const vector u(a.form.halfLength * a.direction),
        v(b.form.halfLength * b.direction);
    scalar least = GREAT;
    for (label i = -1; i <= 1; ++i)
    {
        for (label k = -1; k <= 1; ++k)
        {
            if (same && i == 0 && k == 0) continue;
            const vector c(b.centre + vector(8 * i, 0, 8 * k));
            least =
                min(least,
                    mag(connection(a.centre - u, a.centre + u, c - v, c + v)));
        }
    }
    return least;
}

scalar axesApart(const packing& all, const label first = 0)
{
    const auto& s = all.solids();
    scalar least = GREAT;
    for (size_t i = first; i < s.size(); ++i)
    {
        for (size_t j = 0; j <= i; ++j)
        {
            least = min(least, axesApart(s[i], s[j], i == j));
        }
    }
    return least;
}
} // namespace

class Packing : public ::testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        made.reset(new test::box(labelVector(16, 16, 16), vector(8, 8, 8),
                                 {false, true, false}, 1));
    }
    static void TearDownTestSuite() { made.reset(); }
};

TEST_F(Packing, turnsZToADirection)
{
    for (const vector& e : {vector(0, 0, 1), vector(0, 0, -1),
                            vector(0.6, 0, -0.8), vector(0, 1, 0)})
    {
        const tensor Q(turnTo(e));
        EXPECT_LE(mag((Q & vector(0, 0, 1)) - e), 1e-14);
        EXPECT_LE(mag((Q & Q.T()) - tensor::I), 1e-14);
        EXPECT_NEAR(det(Q), 1, 1e-14);
    }
}

// Directions whose z is within 1e-12 of -1 are taken for -z
TEST_F(Packing, turnsZToNearlyItsOpposite)
{
    const vector d(2e-7, 0, -1), e(d / mag(d));
    const tensor Q(turnTo(e));
    EXPECT_LE(mag((Q & vector(0, 0, 1)) - e), 1.5e-6);
    EXPECT_NEAR(det(Q), 1, 1e-14);
}

TEST_F(Packing, pointsGoRoundAtPeriodicSidesOnly)
{
    const point x(intoBox(box(), point(-1, -1, 17)));
    EXPECT_LE(mag(x - point(7, -1, 1)), 1e-14);
}

TEST_F(Packing, spheresKeepTheGap)
{
    const scalar R = 0.9, gap = 0.3;
    const filled f(30, {R * vector::one, 0}, gap);
    ASSERT_EQ(f.size, 1);
    EXPECT_EQ(f.all.solids().size(), 30u);
    EXPECT_GE(axesApart(f.all), 2 * R + gap - 1e-12);
    for (const solid& s : f.all.solids())
    {
        EXPECT_GE(s.centre.y(), R + 0.5 * gap);
        EXPECT_LE(s.centre.y(), 8 - R - 0.5 * gap);
    }
}

// A quarter of the volume, where one after the other would find no room
TEST_F(Packing, rodsThatGrowKeepTheGap)
{
    const scalar R = 0.5, half = 1.5, gap = 0.1;
    const filled f(45, {R * vector::one, half}, gap);
    ASSERT_EQ(f.size, 1);
    EXPECT_GE(axesApart(f.all), 2 * R + gap - 1e-12);
    for (const solid& s : f.all.solids())
    {
        const scalar reach = half * mag(s.direction.y()) + R + 0.5 * gap;
        EXPECT_GE(s.centre.y(), reach);
        EXPECT_LE(s.centre.y(), 8 - reach);
        EXPECT_NEAR(mag(s.direction), 1, 1e-12);
    }
}

// No point of a surface lies in another
TEST_F(Packing, ellipsoidsDoNotOverlap)
{
    const vector axes(0.6, 0.6, 1.3);
    const filled f(60, {axes, 0}, 0);
    ASSERT_EQ(f.size, 1);
    Random random(9);
    label within = 0;
    const auto& s = f.all.solids();
    for (const solid& a : s)
    {
        const tensor Q(turnTo(a.direction));
        for (label k = 0; k < 200; ++k)
        {
            const point x(a.centre + (Q & vector(cmptMultiply(
                                              axes, anyDirection(random)))));
            for (const solid& b : s)
            {
                if (&a == &b) continue;
                vector r(x - b.centre);
                for (const direction d : {0, 2})
                {
                    r[d] -= 8 * std::round(r[d] / 8);
                }
                const vector own(cmptDivide(turnTo(b.direction).T() & r, axes));
                within += magSqr(own) < 1 - 1e-6;
            }
        }
    }
    EXPECT_EQ(within, 0);
}

TEST_F(Packing, thoseThatAreThereStayAndAreKeptFree)
{
    packing all(box());
    const solidForm large{2 * vector::one, 0};
    all.add({large, point(4, 4, 4), vector(0, 0, 1)});
    Random random(1);
    const solidForm small{0.5 * vector::one, 0};
    const scalar size = all.fill(
        40, small, 0, true, [&] { return anyDirection(random); }, random, "s");
    ASSERT_EQ(size, 1);
    EXPECT_EQ(all.solids()[0].centre, point(4, 4, 4));
    for (size_t i = 1; i < all.solids().size(); ++i)
    {
        EXPECT_GE(axesApart(all.solids()[0], all.solids()[i], false), 2.5);
    }
}

TEST_F(Packing, aSeedMakesTheScene)
{
    const solidForm form{0.9 * vector::one, 0};
    const filled a(20, form, 0.3, 1), b(20, form, 0.3, 1), c(20, form, 0.3, 2);
    scalar same = 0, other = 0;
    for (label i = 0; i < 20; ++i)
    {
        same += mag(a.all.solids()[i].centre - b.all.solids()[i].centre);
        other += mag(a.all.solids()[i].centre - c.all.solids()[i].centre);
    }
    EXPECT_EQ(same, 0);
    EXPECT_GT(other, 1);
}

TEST_F(Packing, whatDoesNotFitIsSmaller)
{
    // Three spheres as wide as the space between the walls, less a hair
    const filled f(3, {3.9 * vector::one, 0}, 0);
    EXPECT_GT(f.size, 0.2);
    EXPECT_LT(f.size, 0.9);
}
