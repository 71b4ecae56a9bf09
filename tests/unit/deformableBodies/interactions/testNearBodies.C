// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "nearBodies.H"
#include "periodicBox.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

boxWalls::sides noWalls()
{
    return boxWalls::sides(FixedList<bool, 2>(false));
}

//- Random boxes, the same on all ranks, of half a cell to one, anywhere; beyond periodic
//  sides as well
List<boundBox> randomBoxes(const label n)
{
    Random random(17);
    List<boundBox> boxes(n);
    for (boundBox& box : boxes)
    {
        vector centre(random.sample01<vector>());
        for (direction d = 0; d < 3; ++d)
        {
            const scalar s =
                grid().periodic(d) ? 2 * centre[d] - 0.5 : centre[d];
            centre[d] = grid().origin()[d] + s * grid().length()[d];
        }
        const vector half(cmptMultiply(
            0.25 * (vector::one + random.sample01<vector>()), grid().h()));
        box = boundBox(centre - half, centre + half);
    }
    return boxes;
}

//- Every so many of the boxes, wherever they are, are this rank's
struct ownBodies
{
    std::vector<nearBodies::body> bodies;
    DynamicList<boundBox> boxes;

    explicit ownBodies(const List<boundBox>& all)
    {
        forAll(all, number)
        {
            if (number % Pstream::nProcs() != Pstream::myProcNo()) continue;
            bodies.push_back(
                {0, label(bodies.size()), number, false, false, false});
            boxes.append(all[number]);
        }
    }
};
} // namespace

// Some are, others are not
TEST(NearBodies, asByAllPairs)
{
    const List<boundBox> all(randomBoxes(12));
    const scalar range = 0.01 * cmptMin(grid().h());
    const boxWalls walls(grid(), noWalls());
    nearBodies near(grid(), walls, range);
    const ownBodies own(all);
    near.compare(own.bodies, own.boxes);
    const scalar reach = range + near.skin();
    label nNear = 0;
    for (const nearBodies::body& b : near.bodies())
    {
        bool expected = false;
        forAll(all, other)
        {
            if (other == b.number) continue;
            const boundBox &p = all[b.number], &q = all[other];
            const vector r(
                cmptMag(nearestImage(grid(), p.midpoint(), q.midpoint())));
            const vector gap(r - 0.5 * (p.span() + q.span()));
            expected = expected || cmptMax(gap) < reach;
        }
        EXPECT_EQ(b.near, expected) << b.number;
        EXPECT_FALSE(b.nearWall);
        EXPECT_EQ(near.bodies()[near.find(b.number)].number, b.number);
        nNear += b.near;
    }
    reduce(nNear, sumOp<label>());
    EXPECT_GT(nNear, 0);
    EXPECT_EQ(near.any(), nNear > 0);
    EXPECT_EQ(near.find(all.size()), -1);
}

// A body alone is near nothing, unless it is at a wall or may meet itself
TEST(NearBodies, aloneAtAWallAndFolded)
{
    const point low(grid().origin());
    const vector L(grid().length());
    const bool here = Pstream::master();
    boxWalls::sides sides(noWalls());
    sides[2][0] = true;
    const boxWalls walls(grid(), sides);
    const scalar range = 0.01 * cmptMin(grid().h());
    nearBodies near(grid(), walls, range);
    const auto compare = [&](const scalar height, const bool folded)
    {
        const point x(low + cmptMultiply(vector(0.5, 0.5, height), L));
        std::vector<nearBodies::body> bodies;
        DynamicList<boundBox> boxes;
        if (here)
        {
            bodies.push_back({0, 0, 5, folded, false, false});
            boxes.append(boundBox(x - 0.02 * L, x + 0.02 * L));
        }
        near.compare(bodies, boxes);
    };
    compare(0.6, false);
    EXPECT_FALSE(near.any());
    compare(0.6, true);
    EXPECT_TRUE(near.any());
    compare(0.1, false);
    EXPECT_TRUE(near.any());
    if (here)
    {
        EXPECT_TRUE(near.bodies()[0].near);
        EXPECT_TRUE(near.bodies()[0].nearWall);
    }
}

TEST(NearBodies, comparisonsAgeByTravel)
{
    const boxWalls walls(grid(), noWalls());
    nearBodies near(grid(), walls, 0.1);
    EXPECT_TRUE(near.isOld()); // never compared
    near.compare({}, List<boundBox>());
    EXPECT_FALSE(near.isOld());
    EXPECT_FALSE(near.any());
    near.travel(0.4 * near.skin());
    EXPECT_FALSE(near.isOld());
    near.travel(0.2 * near.skin());
    EXPECT_TRUE(near.isOld());
    near.compare({}, List<boundBox>());
    EXPECT_FALSE(near.isOld());
}
