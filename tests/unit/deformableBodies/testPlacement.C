// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "placement.H"
#include "testBox.H"
#include "testRefusal.H"

using namespace Foam;

namespace
{
//- A box of 8 with walls in y, for as long as the tests of this file
std::unique_ptr<test::box> made;

const uniformGrid& box()
{
    return uniformGrid::New(made->mesh());
}

const solidForm rod{0.2 * vector::one, 0.8};
const scalar volume = 0.25;

placement place(const std::string& entries)
{
    packing all(box());
    return placement(test::dictOf(entries), "fibres", rod, volume, box(), all);
}

//- Message for entries that are refused
std::string refused(const std::string& entries)
{
    return test::refusal([&] { place(entries); });
}

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}
} // namespace

class Placement : public ::testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        made.reset(new test::box(labelVector(16, 16, 16), vector(8, 8, 8),
                                 {false, true, false}, 1));
    }
    static void TearDownTestSuite() { made.reset(); }
};

TEST_F(Placement, aVolumeFractionIsANumberOfBodies)
{
    const placement byNumber(place("placement { type random; number 41; }"));
    const placement byFraction(place(
        "placement { type random; volumeFraction 0.02; }")); // 40.96 bodies
    EXPECT_EQ(byNumber.centres().size(), 41);
    EXPECT_EQ(byFraction.centres(), byNumber.centres());
}

TEST_F(Placement, fibresAlongADirectionAreExactlyAlongIt)
{
    const placement p(place(
        "placement { type random; number 20; orientation aligned (0 0 2); }"));
    for (const vector& d : p.directions())
    {
        EXPECT_LE(mag(d - vector(0, 0, 1)), 1e-15);
    }
}

// Thin ones, which leave each other room in all directions. The mean square of the angles
// of 400 fibres has a deviation of 1/sqrt(400)
TEST_F(Placement, fibresAboutADirectionDeviateAsAsked)
{
    packing all(box());
    const placement p(
        test::dictOf("placement { type random; number 400; minimumGap 0; "
                     "orientation normal (1 0 0) 10; }"),
        "fibres", {0.01 * vector::one, 0.2}, 1e-4, box(), all);
    scalar square = 0;
    for (const vector& d : p.directions())
    {
        EXPECT_NEAR(mag(d), 1, 1e-12);
        square += sqr(std::acos(d.x())) / 2 / 400;
    }
    const scalar degrees = std::sqrt(square) * 180 / constant::mathematical::pi;
    EXPECT_NEAR(degrees, 10, 0.75);
}

TEST_F(Placement, bodiesBeforeAreKeptFree)
{
    packing all(box());
    all.add({{2 * vector::one, 0}, point(4, 4, 4), vector(0, 0, 1)});
    const placement p(test::dictOf("placement { type random; number 30; }"),
                      "fibres", rod, volume, box(), all);
    EXPECT_EQ(all.solids().size(), 31u);
    for (const point& x : p.centres())
    {
        EXPECT_GT(mag(x - point(4, 4, 4)), 2.2);
    }
}

TEST_F(Placement, whatMakesNoSenseIsRefused)
{
    EXPECT_TRUE(says(refused("placement { type random; number 0; }"),
                     "entry number has the value 0 allowed: 1 to "));
    EXPECT_TRUE(says(refused("placement { type random; }"),
                     "a number of bodies, a volumeFraction, or nL3 of "
                     "filaments: one of them"));
    EXPECT_TRUE(says(refused("placement { type random; nL3 2; number 2; }"),
                     "one of them"));
    EXPECT_TRUE(says(refused("placement { type random; volumeFraction 1; }"),
                     "volumeFraction has the value 1 allowed: below 1"));
    EXPECT_TRUE(says(refused("placement { type lattice; number 2; }"),
                     "entry type has the value lattice allowed: (random)"));
    EXPECT_TRUE(says(refused("placement { type random; number 2; sead 1; }"),
                     "unknown entry sead"));
    EXPECT_TRUE(says(refused("positions ((0 0 0)); placement { type random; "
                             "number 2; }"),
                     "entry positions has the value"));
    EXPECT_TRUE(
        says(refused("placement { type random; number 2; orientation up; }"),
             "entry orientation has the value up allowed: random, aligned"));
    EXPECT_TRUE(says(refused("placement random;"),
                     "entry placement has the value random allowed: a "
                     "dictionary, such as placement { type random; number "
                     "200; }"));
}
