// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactPoints.H"
#include "surfacePoints.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

//- A surface of four points and a bent fibre of two segments, in units of the cell
struct scene
{
    const scalar h = cmptMax(grid().h()), radius = 0.2 * h;
    const contactSurface surface{
        vectorField(List<vector>({vector(1, 0, 0), vector(0, 1, 0),
                                  vector(-1, 0, 0), vector(0, -1, 0)})),
        scalarField(scalarList({1, 2, 3, 4})), GREAT};
    const vectorField x{List<vector>(
        {vector(0, 0, 0), vector(2.3 * h, 0, 0), vector(2.3 * h, 1.1 * h, 0)})};
    const vectorField v{
        List<vector>({vector(1, 0, 0), vector(0, 1, 2), vector(3, 0, 0)})};
    contactPoints points;

    explicit scene(const bool folded)
        : points(grid())
    {
        points.clear(3); // the first body is not near anything
        points.addSurface(2, 12, surface,
                          [](vector* X, vector* V)
                          {
                              for (label k = 0; k < 4; ++k)
                              {
                                  X[k] = vector(k % 2 ? 0 : 1 - k,
                                                k % 2 ? 2 - k : 0, 0);
                                  V[k] = vector(0, k, 0);
                              }
                          });
        points.addLine(1, 11, x, v, radius, folded);
    }
};
} // namespace

// Points of connections have the area of the surface, stretched to an ellipsoid as well, and
// are dense where it is stretched; forces on them have the sum, torque and power of those on
// the markers
TEST(ContactPoints, pointsBetweenMarkers)
{
    const label n = 300;
    vectorField X(n), V(n);
    Random random(1);
    for (label k = 0; k < n; ++k)
    {
        const scalar z = 1 - (2 * k + 1.0) / n, turn = 2.399963 * k;
        X[k] = vector(std::sqrt(1 - z * z) * std::cos(turn),
                      std::sqrt(1 - z * z) * std::sin(turn), z);
        V[k] = random.sample01<vector>();
    }
    const scalarField areas(n, 4 * constant::mathematical::pi / n);
    const scalar side = std::sqrt(areas[0]);
    for (const scalar range : {0.3, 1.2, 2.2, 3.0})
    {
        const contactSurface surface(X, areas, range * side);
        const bool middles = range < 2;
        for (const scalar stretch : {1.0, 1.2, 5.0})
        {
            const scalar e = std::sqrt(1 - 1 / sqr(stretch));
            const scalar ellipsoid =
                stretch == 1 ? 1 : 0.5 * (1 + stretch / e * std::asin(e));
            vectorField x(X);
            x.replace(vector::X, stretch * X.component(vector::X));
            labelList halved(surface.nConnections());
            DynamicList<interactingPoint> points;
            surface.addPoints(x.cdata(), halved.data(), points);
            const label all = points.size();
            scalar area = 0, largest = 0;
            for (const interactingPoint& p : points)
            {
                EXPECT_GE(p.size, -1e-15 * areas[0]);
                area += p.size;
                largest = max(largest, p.size);
            }
            EXPECT_NEAR(area / sum(areas) / ellipsoid, 1,
                        stretch == 1 ? 1e-13 : 0.02);
            if (stretch < 2)
            {
                // The number is that at rest
                EXPECT_EQ(max(halved), middles ? 1 : 0);
                EXPECT_EQ(min(halved), max(halved));
                EXPECT_NEAR(scalar(all) / n, middles ? 4.1 : 1, 0.2);
                EXPECT_LT(largest,
                          (middles ? 0.4 : 1.001) * stretch * areas[0]);
            }
            else
                EXPECT_GT(max(halved), middles ? 1 : 0);

            // No farther apart than half the range, or 1.6 times as far as at rest
            const scalar most =
                max(0.5 * range, 1.6 * 1.6 / (middles ? 2 : 1)) * side;
            for (const interactingPoint& p : points)
            {
                EXPECT_LE(p.spacing, 1.001 * most);
            }

            vectorField v(V), f(all);
            x.setSize(all);
            v.setSize(all);
            for (vector& force : f)
            {
                force = random.sample01<vector>();
            }
            surface.setBetween(halved.cdata(), x.data());
            surface.setBetween(halved.cdata(), v.data());

            // Each point has another at its spacing, which is along the chord
            for (label k = 0; k < all; ++k)
            {
                scalar nearest = GREAT;
                forAll(x, l)
                {
                    if (l != k) nearest = min(nearest, magSqr(x[l] - x[k]));
                }
                EXPECT_LE(std::sqrt(nearest), 1.1 * points[k].spacing);
            }
            vectorField F(n, Zero);
            surface.addTo(halved.cdata(), f.cdata(), F);
            const vector torque(sum(x ^ f));
            EXPECT_LE(mag(sum(F) - sum(f)), 1e-11);
            EXPECT_LE(mag(sum(SubField<vector>(x, n) ^ F) - torque),
                      1e-11 * stretch);
            EXPECT_NEAR(sum(SubField<vector>(v, n) & F), sum(v & f), 1e-10);
        }
    }
}

// Points of connections lie on the surface: of the markers of a capsule, as a sphere, and
// stretched to a spindle and a disk
TEST(ContactPoints, pointsOnTheSurface)
{
    const surfacePoints markers(10, 14, 10);
    const label n = markers.size();
    vectorField X(n);
    for (label k = 0; k < n; ++k)
    {
        X[k] = markers.onUnitSphere(k);
    }
    const contactSurface surface(X, scalarField(n, 12.6 / n), 0.2);
    for (const vector& axes :
         {vector(1, 1, 1), vector(3, 0.6, 0.6), vector(1.6, 1.6, 0.4)})
    {
        vectorField x(n);
        for (label k = 0; k < n; ++k)
        {
            x[k] = cmptMultiply(axes, X[k]);
        }
        labelList halved(surface.nConnections());
        DynamicList<interactingPoint> points;
        surface.addPoints(x.cdata(), halved.data(), points);
        x.setSize(points.size());
        surface.setBetween(halved.cdata(), x.data());
        scalar furthest = 0;
        for (const vector& point : x)
        {
            const vector scaled(cmptDivide(point, axes));
            const vector normal(cmptDivide(scaled, axes));
            furthest = max(furthest, mag(mag(scaled) - 1) / mag(normal));
        }
        test::expectBelow("distance from the surface", furthest, 2e-3);
    }
}

// Points that appear as a connection is stretched have no area at first
TEST(ContactPoints, pointsAppearContinuously)
{
    const vectorField X(List<vector>({vector(1, 0, 0), vector(-1, 0, 0),
                                      vector(0, 1, 0), vector(0, -1, 0)}));
    const contactSurface surface(X, scalarField(4, 1.0), 0.1);
    for (const scalar stretch : {1.6, 3.2})
    {
        DynamicList<interactingPoint> points[2];
        labelList halved[2];
        for (const label after : {0, 1})
        {
            const vectorField x(stretch * (1 + 2e-9 * (after - 0.5)) * X);
            halved[after].setSize(surface.nConnections());
            surface.addPoints(x.cdata(), halved[after].data(), points[after]);
        }
        EXPECT_EQ(min(halved[1]), min(halved[0]) + 1);
        label before = 4, after = 4;
        for (label k = 0; k < surface.nConnections(); ++k)
        {
            for (label m = 1; m < 1 << halved[1][k]; ++m, ++after)
            {
                const scalar size = points[1][after].size;
                EXPECT_NEAR(size, m % 2 ? 0 : points[0][before++].size, 1e-6);
            }
        }
        EXPECT_EQ(before, points[0].size());
        EXPECT_EQ(after, points[1].size());
    }
}

// Surfaces first, points of fibres at most half a cell apart, sizes that add up to the
// area of a fibre
TEST(ContactPoints, pointsOfBodies)
{
    const scene s(true);
    const contactPoints& points = s.points;
    EXPECT_EQ(points.ofBody(0).size, 0);
    EXPECT_EQ(points.ofBody(2).first, 0);
    EXPECT_EQ(points.ofBody(2).size, 4);
    EXPECT_EQ(points.nOfSurfaces(), 4);
    EXPECT_EQ(points.ofBody(1).first, 4);

    // Diameter 0.4 h: 6 + 3 points
    EXPECT_EQ(points.ofBody(1).size, 9);
    EXPECT_EQ(points.size(), 13);
    scalar area = 0;
    for (label k = 4; k < 13; ++k)
    {
        EXPECT_EQ(points.body()[k], 11);
        EXPECT_EQ(points.points()[k].radius, s.radius);
        area += points.points()[k].size;
    }
    EXPECT_NEAR(area / (3.4 * sqr(s.h)), 1, 1e-13);
    EXPECT_NEAR(points.points()[1].size, 2, 1e-14);
    EXPECT_EQ(points.points()[1].radius, 0);
    EXPECT_EQ(points.V()[3], vector(0, 3, 0));

    const labelList bodies(points.lineBodies());
    const scalarField along(points.linesAlong());
    EXPECT_EQ(bodies[0], -13);
    EXPECT_EQ(bodies[4], 11);
    EXPECT_EQ(along[0], -1);
    for (label k = 4; k < 13; ++k)
    {
        const vector& X = points.X()[k];
        EXPECT_NEAR(along[k], X.x() + X.y(), 1e-12 * s.h);
    }
    EXPECT_EQ(max(scene(false).points.linesAlong()), -1);
}

// Forces on the points reach the nodes with their sum, torque and power
TEST(ContactPoints, forcesReachTheNodes)
{
    scene s(false);
    contactPoints& points = s.points;
    points.clearForces(true);
    Random random(1);
    lineMotions motions(points.size());
    points.moveLine(1, s.x, s.v, motions);
    vector sumF(Zero), torque(Zero);
    scalar power = 0, pointPower = 0;
    for (label k = 4; k < points.size(); ++k)
    {
        const vector F(random.sample01<vector>() - 0.5 * vector::one);
        const scalar arm = random.sample01<scalar>() - 0.5;
        points.forces().F[k] = F;
        points.forces().arms[k] = arm * F;
        sumF += F;
        torque += (points.X()[k] + arm * motions.element[k]) ^ F;
        power += F & (motions.velocity[k] + arm * motions.turn[k]);
        pointPower += F & motions.velocity[k];
        EXPECT_EQ(motions.number[k], k - 4);
        EXPECT_LE(mag(motions.velocity[k] - points.V()[k]), 1e-13);
    }
    vectorField F(3, Zero), nothing(4, Zero);
    points.addTo(1, F);
    points.addTo(2, nothing);
    EXPECT_EQ(sum(mag(nothing)), 0);
    vector nodeTorque(Zero);
    scalar nodePower = 0;
    forAll(F, i)
    {
        nodeTorque += s.x[i] ^ F[i];
        nodePower += s.v[i] & F[i];
    }
    test::expectBelow("force", mag(sum(F) - sumF), 1e-13);
    test::expectBelow("torque over h", mag(nodeTorque - torque) / s.h, 1e-13);
    test::expectBelow("power", mag(nodePower - power), 1e-13);
    test::expectBelow("power without arms", mag(points.power() - pointPower),
                      1e-13);

    // Places along a fibre of two segments are counted in segments, from its middle
    EXPECT_NEAR(motions.along[4], 0.5 - 0.5 / 12, 1e-13);
    EXPECT_NEAR(motions.along[12], 0.5 - 0.5 / 6, 1e-13);
}

// Walls do not act on the points of a fibre within reach of an end that is held
TEST(ContactPoints, rootsOfFibres)
{
    const scalar h = cmptMax(grid().h());
    const vectorField x(List<vector>({vector(0, 0, 0), vector(4 * h, 0, 0)}));
    contactPoints points(grid());
    points.clear(1);
    points.addLine(0, 0, x, x, 0.2 * h, false, {true, false}, 1.1 * h);
    label rooted = 0;
    for (label k = 0; k < points.size(); ++k)
    {
        EXPECT_EQ(points.isRooted(k), points.X()[k].x() < 1.1 * h);
        rooted += points.isRooted(k);
    }
    EXPECT_TRUE(rooted > 0 && rooted < points.size());
}
