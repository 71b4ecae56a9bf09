// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "overlapWatch.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

string nameOf(const label body)
{
    return "body " + Foam::name(body);
}

label noHost(label)
{
    return -1;
}

//- Points in a row at these heights over the middle of the box, one body each
struct row
{
    vectorField X;
    labelList body;
    closePairs pairs;

    row(const scalarList& heights, const scalar range)
        : X(heights.size()),
          body(identity(heights.size())),
          pairs(grid(), range)
    {
        forAll(X, k)
        {
            X[k] = grid().origin() + 0.5 * grid().length() +
                   vector(0, 0, heights[k]);
        }
        pairs.search(X, body);
    }
};
} // namespace

// Fibres overlap where axes are within 0.9 of the radii, and walls are counted as well
TEST(OverlapWatch, fibres)
{
    if (Pstream::parRun()) return;
    const scalar h = cmptMin(grid().h()), radius = 0.5 * h;
    const row r(scalarField(scalarList({0, 0.95 * h, 1.7 * h})), 1.2 * h);
    const List<interactingPoint> points(3, interactingPoint{sqr(h), radius, 0});
    overlapWatch watch(test::mesh().time(), nameOf, noHost, true);
    watch.begin();
    watch.look(r.pairs, points);
    EXPECT_FALSE(watch.surfacesTouch());
    EXPECT_EQ(watch.nPairs(), 4); // two pairs, counted twice
    EXPECT_NEAR(watch.closest(), 0.75 * h, 1e-12 * h);
    watch.settle();
    EXPECT_EQ(watch.nOverlaps(), 1);
    EXPECT_NEAR(watch.deepest(), 0.25 * h, 1e-12 * h);

    watch.begin();
    EXPECT_EQ(watch.nPairs(), 0);
    EXPECT_EQ(watch.closest(), GREAT);
    watch.pressedIntoWall(0.4 * h, 0, r.X[0]);
    watch.pressedIntoWall(0.1 * h, 2, r.X[2]);
    watch.settle();
    EXPECT_EQ(watch.nOverlaps(), 3);
    EXPECT_EQ(watch.deepest(), 0.4 * h);

    // A smaller overlap of known bodies changes nothing
    watch.begin();
    watch.pressedIntoWall(0.2 * h, 0, r.X[0]);
    watch.settle();
    EXPECT_EQ(watch.nOverlaps(), 3);
    EXPECT_EQ(watch.deepest(), 0.4 * h);
}

// Where nothing keeps fibres apart they may cross
TEST(OverlapWatch, fibresThatNothingKeepsApart)
{
    if (Pstream::parRun()) return;
    const scalar h = cmptMin(grid().h());
    const row r(scalarField(scalarList({0, 0.1 * h})), h);
    overlapWatch watch(test::mesh().time(), nameOf, noHost, false);
    watch.begin();
    watch.look(r.pairs,
               List<interactingPoint>(2, interactingPoint{sqr(h), 0.5 * h, 0}));
    watch.settle();
    EXPECT_EQ(watch.nPairs(), 2);
    EXPECT_EQ(watch.nOverlaps(), 0);
}

// Surfaces cross where either point lies behind the other's surface: normals point away
// from each other. They do not where normals face each other
TEST(OverlapWatch, surfaces)
{
    if (Pstream::parRun()) return;
    const scalar h = cmptMin(grid().h()), depth = 0.2 * h;
    const row r(scalarField(scalarList({0, depth})), h);
    const List<interactingPoint> points(2, interactingPoint{sqr(h), 0, h});
    const vector up(0, 0, sqr(h)); // area of a point
    for (const bool cross : {false, true})
    {
        overlapWatch watch(test::mesh().time(), nameOf, noHost, true);
        watch.begin();
        watch.look(r.pairs, points);
        EXPECT_TRUE(watch.surfacesTouch());
        EXPECT_EQ(sum(watch.touching(r.pairs, 2)), 2);

        vectorField areas(2, up);
        areas[cross ? 0 : 1] *= -1;
        watch.lookBehind(r.pairs, points, areas);
        watch.settle();
        EXPECT_EQ(watch.nOverlaps(), cross ? 1 : 0);
        EXPECT_NEAR(watch.deepest(), cross ? depth : 0, 1e-12 * h);
    }
}

// Bodies that do not touch do not cross, whatever the normals of those that touch others
TEST(OverlapWatch, othersNear)
{
    if (Pstream::parRun()) return;
    const scalar h = cmptMin(grid().h());
    const row r(scalarField(scalarList({0, 0.2 * h, 0.9 * h})), h);
    const List<interactingPoint> points(3, interactingPoint{sqr(h), 0, h});
    overlapWatch watch(test::mesh().time(), nameOf, noHost, true);
    watch.begin();
    watch.look(r.pairs, points);
    EXPECT_EQ(sum(watch.touching(r.pairs, 3)), 2);

    // The first two face each other, the second and the third face away
    vectorField areas(3, vector(0, 0, sqr(h)));
    areas[1] *= -1;
    watch.lookBehind(r.pairs, points, areas);
    watch.settle();
    EXPECT_EQ(watch.nOverlaps(), 0);
}

// A nucleus crosses its capsule where its surface lies outside; normals are alike
TEST(OverlapWatch, nuclei)
{
    if (Pstream::parRun()) return;
    const scalar h = cmptMin(grid().h()), depth = 0.2 * h;
    const row r(scalarField(scalarList({0, depth})), h);
    const List<interactingPoint> points(2, interactingPoint{sqr(h), 0, h});
    for (const label nucleus : {0, 1})
    {
        overlapWatch watch(
            test::mesh().time(), nameOf,
            [=](const label body)
            { return body == nucleus ? 1 - nucleus : -1; },
            true);
        watch.begin();
        watch.look(r.pairs, points);
        watch.lookBehind(r.pairs, points, vectorField(2, vector(0, 0, sqr(h))));
        watch.settle();
        EXPECT_EQ(watch.nOverlaps(), nucleus); // the second is above the first
    }
}

// The nearest point of a capsule that is bent around its nucleus tells the side
TEST(OverlapWatch, nucleiInBentCapsules)
{
    if (Pstream::parRun()) return;
    const scalar h = cmptMin(grid().h());
    for (const scalar below : {0.3 * h, 0.1 * h})
    {
        row r(scalarField(scalarList({0, 0.15 * h, -below})), h);
        const labelList body({0, 1, 1});
        r.pairs.search(r.X, body);
        const List<interactingPoint> points(3, interactingPoint{sqr(h), 0, h});
        overlapWatch watch(
            test::mesh().time(), nameOf,
            [](const label number) { return number == 0 ? 1 : -1; }, true);
        watch.begin();
        watch.look(r.pairs, points);
        watch.lookBehind(r.pairs, points, vectorField(3, vector(0, 0, sqr(h))));
        watch.settle();
        EXPECT_EQ(watch.nOverlaps(), label(below < 0.15 * h));
    }
}

// A fibre crosses a surface if points of it lie before and behind that
TEST(OverlapWatch, fibresThroughSurfaces)
{
    if (Pstream::parRun()) return;
    const scalar h = cmptMin(grid().h());
    for (const bool crosses : {true, false})
    {
        row r(scalarField(scalarList({0, 0.3 * h, (crosses ? -0.4 : 0.8) * h})),
              2 * h);
        const labelList body({-1, 1, 1});
        r.pairs.search(r.X, body);
        const List<interactingPoint> points(
            {interactingPoint{sqr(h), 0, h},
             interactingPoint{sqr(h), 0.2 * h, 0},
             interactingPoint{sqr(h), 0.2 * h, 0}});
        overlapWatch watch(test::mesh().time(), nameOf, noHost, false);
        watch.begin();
        watch.look(r.pairs, points);
        EXPECT_TRUE(watch.surfacesTouch());
        vectorField areas(3, Zero);
        areas[0].z() = sqr(h);
        watch.lookBehind(r.pairs, points, areas);
        watch.settle();
        EXPECT_EQ(watch.nOverlaps(), label(crosses));
        EXPECT_NEAR(watch.deepest(), crosses ? 0.4 * h : 0, 1e-12 * h);
    }
}
