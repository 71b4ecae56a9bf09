// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyForce.H"
#include "StringStream.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
//- Line of four points along (1 1 0); the inner points represent a length of 2
bodyPoints thread()
{
    bodyPoints p{"fibres",
                 0,
                 vectorField(4),
                 vectorField(4, Zero),
                 vectorField(),
                 scalarField(4, 2.0),
                 0.5,
                 1};
    p.lengths.first() = p.lengths.last() = 1;
    forAll(p.positions, i)
    {
        p.positions[i] = vector(i, i, 0);
    }
    return p;
}

//- Six faces of a cube of side 2 about (5 0 0)
bodyPoints cube()
{
    bodyPoints p{"cells",
                 0,
                 vectorField(6),
                 vectorField(6, Zero),
                 vectorField(6),
                 scalarField(),
                 0,
                 1};
    for (direction d = 0; d < 3; ++d)
    {
        for (const label side : {0, 1})
        {
            vector n(Zero);
            n[d] = 2 * side - 1;
            p.positions[2 * d + side] = vector(5, 0, 0) + n;
            p.areas[2 * d + side] = 4 * n;
        }
    }
    return p;
}

vectorField on(const bodyPoints& body, const char* entries)
{
    IStringStream is(entries);
    const dictionary dict(is);
    vectorField F(body.positions.size(), Zero);
    bodyForce::New(dict, body)->add(body, 0.5, F);
    return F;
}
} // namespace

TEST(BodyForce, deadLoadKeepsItsDirection)
{
    const vectorField end(
        on(thread(), "type deadLoad; group fibres; force (0 -3 0);"));
    EXPECT_EQ(end[3], vector(0, -3, 0));
    EXPECT_EQ(mag(end[0]) + mag(end[1]) + mag(end[2]), 0);
    const vectorField all(
        on(thread(), "type deadLoad; group fibres; force (0 -3 0); at all;"));
    EXPECT_NEAR(mag(sum(all) - vector(0, -3, 0)), 0, 1e-15);
    EXPECT_NEAR(all[1].y(), -1, 1e-15);
}

TEST(BodyForce, followerLoadActsAlongTheLine)
{
    const vectorField F(on(thread(), "type followerLoad; group fibres; "
                                     "force table ((0 0) (1 4)); at first;"));
    EXPECT_NEAR(mag(F[0] - std::sqrt(2.0) * vector(1, 1, 0)), 0, 1e-15);
    EXPECT_EQ(mag(F[1]) + mag(F[2]) + mag(F[3]), 0);
}

TEST(BodyForce, pointPairPullsBothEnds)
{
    const vectorField F(
        on(cube(), "type pointPair; group cells; force 3; patch 0.1;"));
    EXPECT_NEAR(mag(sum(F)), 0, 1e-15);
    EXPECT_NEAR(F[1].x(), 3, 1e-15);
    EXPECT_NEAR(F[0].x(), -3, 1e-15);
}

TEST(BodyForce, weightIsExcessTimesVolume)
{
    const char* entries = "type weight; group any; excess (0 0 -10);";
    EXPECT_NEAR(mag(sum(on(cube(), entries)) - vector(0, 0, -80)), 0, 1e-13);
    EXPECT_NEAR(mag(sum(on(thread(), entries)) - vector(0, 0, -30)), 0, 1e-13);
}

TEST(BodyForce, refusesWhatDoesNotFit)
{
    EXPECT_THROW(on(cube(), "type deadLoad; group cells; force (0 0 1);"),
                 Foam::IOerror);
    EXPECT_THROW(on(thread(), "type pointPair; group fibres; force 1;"),
                 Foam::IOerror);
    EXPECT_THROW(on(thread(), "type push; group fibres; force 1;"),
                 Foam::IOerror);
    EXPECT_THROW(
        on(thread(), "type deadLoad; group fibres; force (0 0 1); at middle;"),
        Foam::IOerror);
}
