// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pointCopies.H"
#include "testWaves.H"

using namespace Foam;
using test::grid;

namespace
{
//- Points of this rank anywhere in the box and beyond its periodic sides
vectorField ownPoints()
{
    Random random(7 + Pstream::myProcNo());
    vectorField X(40 + 5 * Pstream::myProcNo());
    for (vector& x : X)
    {
        x = random.sample01<vector>();
        for (direction d = 0; d < 3; ++d)
        {
            const scalar s = grid().periodic(d) ? 3 * x[d] - 1 : x[d];
            x[d] = grid().origin()[d] + s * grid().length()[d];
        }
    }
    return X;
}

const scalar* numbers(const vectorField& x)
{
    return reinterpret_cast<const scalar*>(x.cdata());
}

//- Layers of cells between a cell and those of a box, across periodic sides
label layers(const cellBox& box, const labelVector& cell)
{
    label most = 0;
    for (direction d = 0; d < 3; ++d)
    {
        const label n = grid().n()[d];
        label least = labelMax;
        for (label k = -1; k <= 1; ++k)
        {
            if (k && !grid().periodic(d)) continue;
            const label c = cell[d] + k * n - box.lo[d];
            least = min(least, max(max(-c, c - box.size[d] + 1), label(0)));
        }
        most = max(most, least);
    }
    return most;
}
} // namespace

class PointCopies : public ::testing::Test
{
protected:
    blockNeighbours neighbours{grid()};
    pointCopies copies{neighbours};
    const vectorField X = ownPoints();

    void SetUp() override { copies.route(X, 2); }
};

TEST_F(PointCopies, ofEachPointOneRankHoldsTheCell)
{
    label held = 0;
    forAll(copies.here(), k)
    {
        held += copies.holds(k);
    }
    EXPECT_EQ(returnReduce(held, sumOp<label>()),
              returnReduce(X.size(), sumOp<label>()));
}

TEST_F(PointCopies, valuesGoWithTheirPoints)
{
    const scalarField here(copies.handOut(numbers(X), 3));
    ASSERT_EQ(here.size(), 3 * copies.here().size());
    scalar worst = 0;
    forAll(here, i)
    {
        worst = max(worst, mag(here[i] - copies.here()[i / 3][i % 3]));
    }
    EXPECT_EQ(worst, 0);
}

// A rank has a copy of a point if and only if it has cells within two layers of it
TEST_F(PointCopies, copiesAreWhereCellsAreNear)
{
    const List<cellBox> boxes(grid().allBoxes());
    scalarField own(X.size(), 0), ones(copies.here().size(), 1);
    copies.addUp(ones, 1, own.data());
    forAll(X, k)
    {
        label near = 0;
        for (const cellBox& box : boxes)
        {
            near += layers(box, grid().cellAt(X[k])) <= 2;
        }
        EXPECT_EQ(label(own[k]), near) << "point " << k;
    }
}

// Sums over own points of f g, and over those here: f.(P g) = (P^T f).g
TEST_F(PointCopies, theWayBackIsTheAdjoint)
{
    Random random(3 + Pstream::myProcNo());
    scalarField own(2 * X.size()), here(2 * copies.here().size());
    for (scalar& v : own)
    {
        v = random.sample01<scalar>();
    }
    for (scalar& v : here)
    {
        v = random.sample01<scalar>();
    }
    const scalar forward = gSum(here * copies.handOut(own.cdata(), 2));
    scalarField back(own.size(), 0);
    copies.addUp(here, 2, back.data());
    test::expectBelow("values out and sums back",
                      mag(gSum(back * own) / forward - 1), 1e-13);
}

TEST_F(PointCopies, sumsAreAddedToWhatIsThere)
{
    scalarField own(X.size(), 3);
    copies.addUp(scalarField(copies.here().size(), 0), 1, own.data());
    EXPECT_EQ(min(own), 3);
    EXPECT_EQ(max(own), 3);
}
