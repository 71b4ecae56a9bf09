// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "patchOrder.H"
#include "ListOps.H"
#include "boundBox.H"
#include "pointField.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
vectorField cloud(const label n)
{
    Random random(2);
    vectorField X(n);
    for (vector& x : X)
    {
        x = random.sample01<vector>();
    }
    return X;
}
} // namespace

TEST(PatchOrder, hasEveryPointOnce)
{
    for (const label n : {0, 1, 7, 8, 9, 64, 65, 500, 1000})
    {
        labelList order(patchOrder(cloud(n)));
        sort(order);
        EXPECT_EQ(order, identity(n)) << n << " points";
    }
}

TEST(PatchOrder, patchesOfALineAreItsPieces)
{
    const label n = 64;
    vectorField X(n);
    forAll(X, i)
    {
        X[i] = vector((37 * i) % n, 0, 0);
    }
    const labelList order(patchOrder(X));
    forAll(order, k)
    {
        EXPECT_EQ(label(X[order[k]].x()) / pointsOfPatch, k / pointsOfPatch);
    }
}

// A patch of eight of 512 points in a cube has a box of a quarter of the side each way
TEST(PatchOrder, patchesAreSmall)
{
    const vectorField X(cloud(512));
    const labelList order(patchOrder(X));
    scalar mean = 0;
    for (label k = 0; k < X.size(); k += pointsOfPatch)
    {
        const boundBox box(
            pointField(X, SubList<label>(order, pointsOfPatch, k)), false);
        mean += box.mag() * pointsOfPatch / X.size();
    }
    test::expectBelow("mean diagonal of a patch over the cube's side", mean,
                      0.5);
}
