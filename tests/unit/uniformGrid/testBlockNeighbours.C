// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "blockNeighbours.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

//- Points, equal on all ranks, in the box and beyond its periodic sides
vectorField points(const label n)
{
    Random random(5);
    vectorField X(n);
    for (vector& x : X)
    {
        const vector s(random.sample01<vector>());
        for (direction d = 0; d < 3; ++d)
        {
            x[d] =
                grid().origin()[d] +
                grid().length()[d] * (grid().periodic(d) ? 3 * s[d] - 1 : s[d]);
        }
    }
    return X;
}
} // namespace

TEST(BlockNeighbours, allRanksAgreeOnTheHolderOfAPoint)
{
    blockNeighbours neighbours(grid());
    const vectorField X(points(200));
    neighbours.cover(X, 0);
    for (const vector& x : X)
    {
        const label here = neighbours.holder(x);
        ASSERT_GE(here, 0);
        EXPECT_EQ(neighbours.ranks()[here], neighbours.holderOfAll(x));
    }
}

// The search finds every rank with a cell within the margin of a point; within the box
// called alone there is no other rank
TEST(BlockNeighbours, findsWhoHasCellsNearAPoint)
{
    blockNeighbours neighbours(grid());
    const vectorField X(points(50));
    const label margin = 2;
    neighbours.cover(X, margin);
    const List<cellBox> boxes(grid().allBoxes());
    const boundBox alone(neighbours.near(margin).alone);
    for (const vector& x : X)
    {
        labelList found;
        neighbours.each(neighbours.near(margin), grid().cellAt(x),
                        [&](const label i)
                        { found.append(neighbours.ranks()[i]); });
        labelList expected;
        forAll(boxes, proci)
        {
            bool near = false;
            labelVector l;
            for (l.x() = -margin; l.x() <= margin; ++l.x())
            {
                for (l.y() = -margin; l.y() <= margin; ++l.y())
                {
                    for (l.z() = -margin; l.z() <= margin; ++l.z())
                    {
                        labelVector c;
                        bool inside = true;
                        for (direction d = 0; d < 3; ++d)
                        {
                            const label n = grid().n()[d];
                            c[d] = grid().cellAt(x[d], d) + l[d];
                            if (grid().periodic(d)) c[d] = (c[d] + n) % n;
                            inside = inside && c[d] >= 0 && c[d] < n;
                        }
                        near = near || (inside && boxes[proci].contains(c));
                    }
                }
            }
            if (near) expected.append(proci);
        }
        EXPECT_EQ(found, expected);
        if (alone.contains(x))
        {
            EXPECT_EQ(found, labelList(1, Pstream::myProcNo()));
        }
    }
    const vector middle(
        grid().origin() +
        cmptMultiply(grid().h(), vector(grid().box().lo) +
                                     0.5 * vector(grid().box().size)));
    if (cmptMin(grid().box().size) > 2 * margin)
    {
        EXPECT_TRUE(alone.contains(middle));
    }
}

TEST(BlockNeighbours, messagesArrive)
{
    blockNeighbours neighbours(grid());
    const label me = Pstream::myProcNo();
    List<scalarField> out(neighbours.ranks().size()), in;
    forAll(out, i)
    {
        out[i] = scalarField(me, 100.0 * me + neighbours.ranks()[i]);
    }
    neighbours.exchange(out, in);
    labelList sizes(out.size());
    blockNeighbours::values give, take;
    forAll(in, i)
    {
        const label from = neighbours.ranks()[i];
        sizes[i] = out[i].size();
        give.emplace_back(out[i].data(), out[i].size());
        take.emplace_back(in[i].data(), in[i].size());
        if (from == me) continue;
        EXPECT_EQ(in[i], scalarField(from, 100.0 * from + me));
        in[i] = -1;
    }

    // Values of known sizes
    sizes = neighbours.sizes(sizes);
    neighbours.exchange(give, take);
    forAll(in, i)
    {
        const label from = neighbours.ranks()[i];
        EXPECT_EQ(sizes[i], from);
        if (from == me) continue;
        EXPECT_EQ(in[i], scalarField(from, 100.0 * from + me));
    }
}
