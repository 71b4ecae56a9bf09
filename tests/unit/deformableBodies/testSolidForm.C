// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "Random.H"
#include "solidForm.H"
#include "turnTo.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
vector randomDirection(Random& random)
{
    vector e;
    for (direction d = 0; d < 3; ++d)
    {
        e[d] = random.GaussNormal<scalar>();
    }
    return e / mag(e);
}

//- True if x lies in a solid about the origin, more than 0.03 below its surface: a rod
//  and an ellipsoid of the sizes below that are not apart may count as such up to there
bool contains(solidForm form, const vector& axis, const vector& x)
{
    form.semiAxes -= 0.03 * vector::one;
    const vector y(turnTo(axis).T() & x);
    if (!form.isRod()) return magSqr(cmptDivide(y, form.semiAxes)) < 1;
    const scalar beyond = max(mag(y.z()) - form.halfLength, scalar(0));
    return sqr(y.x()) + sqr(y.y()) + sqr(beyond) < sqr(form.semiAxes.x());
}

//- Distance along r where a solid moved in from afar stops being apart
scalar contactDistance(const solidForm& a, const vector& u, const solidForm& b,
                       const vector& v, const vector& r)
{
    scalar low = 0, high = a.circumradius() + b.circumradius();
    for (label i = 0; i < 50; ++i)
    {
        const scalar middle = 0.5 * (low + high);
        (a.isApart(u, b, v, middle * r) ? high : low) = middle;
    }
    return high;
}
} // namespace

TEST(SolidForm, turnsTheZAxis)
{
    Random random(2);
    scalar wrong = 0;
    for (label i = 0; i < 100; ++i)
    {
        const vector e(i ? randomDirection(random) : vector(0, 0, -1));
        const tensor Q(turnTo(e));
        wrong = max(wrong, mag((Q & vector(0, 0, 1)) - e));
        wrong = max(wrong, mag((Q & Q.T()) - tensor::I));
        wrong = max(wrong, mag(det(Q) - 1));
    }
    test::expectBelow("axis, orthogonality, determinant", wrong, 1e-12);
}

TEST(SolidForm, contactOfSimpleSolids)
{
    const vector x(1, 0, 0), z(0, 0, 1);
    const solidForm sphere{vector::one, 0}, small{0.5 * vector::one, 0};
    const solidForm rod{0.3 * vector::one, 2}, disc{vector(2, 2, 0.5), 0};
    EXPECT_NEAR(contactDistance(sphere, z, small, x, x), 1.5, 1e-9);

    // Rods side by side, in a row, and crossed
    EXPECT_NEAR(contactDistance(rod, z, rod, z, x), 0.6, 1e-9);
    EXPECT_NEAR(contactDistance(rod, z, rod, z, z), 4.6, 1e-9);
    EXPECT_NEAR(contactDistance(rod, x, rod, z, vector(0, 1, 0)), 0.6, 1e-9);

    // Discs on top of and beside each other; a rod on a disc
    EXPECT_NEAR(contactDistance(disc, z, disc, z, z), 1, 1e-6);
    EXPECT_NEAR(contactDistance(disc, z, disc, z, x), 4, 1e-6);
    EXPECT_NEAR(contactDistance(rod, x, disc, z, z), 0.8, 1e-6);
    EXPECT_NEAR(contactDistance(rod, z, disc, z, z), 2.8, 1e-6);
}

// Solids that are apart have no point in common; either may be first
TEST(SolidForm, nothingInCommon)
{
    Random random(3);
    const solidForm forms[3] = {{vector(1, 0.7, 0.3), 0},
                                {0.2 * vector::one, 1},
                                {0.6 * vector::one, 0}};
    label nApart = 0, nTogether = 0;
    for (label i = 0; i < 600; ++i)
    {
        const solidForm &a = forms[i % 3], &b = forms[i / 3 % 3];
        const vector u(randomDirection(random)), v(randomDirection(random)),
            r(1.8 * random.sample01<scalar>() * randomDirection(random));
        const bool apart = a.isApart(u, b, v, r);
        EXPECT_EQ(apart, b.isApart(v, a, u, -r));
        (apart ? nApart : nTogether)++;
        if (!apart) continue;
        for (label k = 0; k < 300; ++k)
        {
            const vector x(2 * random.sample01<vector>() - vector::one);
            EXPECT_FALSE(contains(b, v, x) && contains(a, u, x - r));
        }
    }
    EXPECT_GT(nApart, 100);
    EXPECT_GT(nTogether, 100);
}
