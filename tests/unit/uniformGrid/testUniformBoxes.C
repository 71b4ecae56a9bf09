// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Decomposition into rectangular blocks: numbers of blocks, and their ranks

#include "planeTransform.H"
#include "testBox.H"
#include "uniformBoxes.H"

using namespace Foam;

namespace
{
//- Values that the busiest rank sends in a step, counted cell by cell: seven for each face
//  to another rank, two for each cell of a plane that another rank transforms
label sent(const labelVector& cells, const labelVector& blocks,
           const FixedList<bool, 3>& periodic)
{
    const label ranks = cmptProduct(blocks);
    const auto rankOf = [&](const labelVector& c)
    {
        labelVector b;
        for (direction d = 0; d < 3; ++d)
        {
            b[d] = uniformBoxes::part(cells[d], blocks[d], c[d]);
        }
        return b.x() + blocks.x() * (b.y() + blocks.y() * b.z());
    };
    labelList faces(ranks, Zero);
    List<labelList> moved(3, faces);
    for (label i = 0; i < cmptProduct(cells); ++i)
    {
        const labelVector c(i % cells.x(), i / cells.x() % cells.y(),
                            i / cells.x() / cells.y());
        const label rank = rankOf(c);
        for (direction d = 0; d < 3; ++d)
        {
            for (const label step : {-1, 1})
            {
                labelVector next(c);
                next[d] += step;
                const bool inside = next[d] >= 0 && next[d] < cells[d];
                if (!inside && !periodic[d]) continue;
                next[d] = (next[d] + cells[d]) % cells[d];
                faces[rank] += rankOf(next) != rank;
            }
            const bool own =
                c[d] >= planeTransform::firstDealt(cells[d], rank, ranks) &&
                c[d] < planeTransform::firstDealt(cells[d], rank + 1, ranks);
            moved[d][rank] += !own;
        }
    }
    label least = labelMax;
    for (direction d = 0; d < 3; ++d)
    {
        const bool all = periodic[0] && periodic[1] && periodic[2];
        if (!all && d != planeTransform::swept(cells, periodic)) continue;
        least = min(least, max(7 * faces + 2 * moved[d]));
    }
    return least;
}

dictionary decomposition(const char* text)
{
    IStringStream is(text);
    return dictionary(is);
}
} // namespace

TEST(UniformBoxes, noOtherCountsSendFewerValues)
{
    for (const bool walls : {false, true})
    {
        FixedList<bool, 3> periodic(true);
        periodic[1] = !walls;
        for (const labelVector& cells :
             {labelVector(16, 16, 16), labelVector(20, 11, 8)})
        {
            for (const label ranks : {2, 3, 4, 5, 6, 8, 12})
            {
                const labelVector n(
                    uniformBoxes::counts(cells, ranks, periodic));
                ASSERT_EQ(cmptProduct(n), ranks);
                const label least = sent(cells, n, periodic);
                for (label x = 1; x <= ranks; ++x)
                {
                    for (label y = 1; x * y <= ranks; ++y)
                    {
                        const labelVector other(x, y, ranks / x / y);
                        if (ranks % (x * y) || cmptMin(cells - other) < 0)
                        {
                            continue;
                        }
                        EXPECT_LE(least, sent(cells, other, periodic))
                            << ranks << " ranks, cells " << cells.x()
                            << ", blocks " << other.x() << other.y()
                            << other.z();
                    }
                }
            }
        }
    }
}

TEST(UniformBoxes, ofEqualCountsTheyCutAlongZFirst)
{
    const labelVector cells(64, 64, 64);
    EXPECT_EQ(uniformBoxes::counts(cells, 1), labelVector(1, 1, 1));
    EXPECT_EQ(uniformBoxes::counts(cells, 2), labelVector(1, 1, 2));
    EXPECT_EQ(uniformBoxes::counts(cells, 4), labelVector(1, 1, 4));
    EXPECT_EQ(uniformBoxes::counts(cells, 6), labelVector(1, 1, 6));
    EXPECT_EQ(uniformBoxes::counts(cells, 7), labelVector(1, 1, 7));
    EXPECT_EQ(uniformBoxes::counts(cells, 8), labelVector(1, 1, 8));
}

// A cut between walls has one side, a periodic cut has two
TEST(UniformBoxes, twoRanksMeetBetweenWalls)
{
    FixedList<bool, 3> periodic(true);
    periodic[1] = false;
    EXPECT_EQ(uniformBoxes::counts(labelVector(32, 32, 32), 2, periodic),
              labelVector(1, 2, 1));
}

TEST(UniformBoxes, everyRankHasALayer)
{
    const labelVector cells(4, 3, 5);
    EXPECT_EQ(uniformBoxes::counts(cells, 60), cells);
    EXPECT_EQ(uniformBoxes::counts(cells, 61), labelVector::zero);
    EXPECT_EQ(uniformBoxes::counts(cells, 7), labelVector::zero);
}

TEST(UniformBoxes, partsDifferByOneLayerAtMost)
{
    for (const label n : {3, 32, 63, 64})
    {
        for (const label parts : {1, 2, 3, 5, 7, 16, 63})
        {
            if (parts > n) continue;
            labelList size(parts, Zero);
            label last = 0;
            for (label i = 0; i < n; ++i)
            {
                const label p = uniformBoxes::part(n, parts, i);
                ASSERT_TRUE(p >= last && p < parts);
                ++size[last = p];
            }
            EXPECT_EQ(sum(size), n);
            EXPECT_LE(max(size) - min(size), 1) << n << " in " << parts;
            EXPECT_EQ(max(size), size[0]);
        }
    }
    labelList sevenths(7, Zero);
    for (label i = 0; i < 32; ++i)
    {
        ++sevenths[uniformBoxes::part(32, 7, i)];
    }
    EXPECT_EQ(sevenths, labelList({5, 5, 5, 5, 4, 4, 4}));
}

TEST(UniformBoxes, everyCellIsDealtToABlock)
{
    const labelVector cells(9, 8, 7);
    test::box b(cells, vector(3, 1, 2), {false, true, false}, 1);
    const dictionary dict(
        decomposition("numberOfSubdomains 12; coeffs { n (2 3 2); }"));
    const uniformBoxes method(dict);
    const pointField& centres = b.mesh().cellCentres();
    const labelList rank(
        method.decompose(b.mesh(), centres, scalarField(centres.size(), 1)));

    // A whole block has as many cells as its bounding box has places
    std::vector<boundBox> around(12);
    labelList held(12, Zero);
    forAll(rank, celli)
    {
        ++held[rank[celli]];
        around[rank[celli]].add(centres[celli]);
    }
    EXPECT_EQ(sum(held), cmptProduct(cells));
    const vector h(3.0 / 9, 1.0 / 8, 2.0 / 7);
    for (label r = 0; r < 12; ++r)
    {
        const vector size(cmptDivide(around[r].span(), h) + vector::one);
        EXPECT_NEAR(held[r], cmptProduct(size), 1e-9) << "rank " << r;
    }
}
