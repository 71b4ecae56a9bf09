// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "expectedErrors.H"
#include "testRefusal.H"

using namespace Foam;
using test::dictOf;

namespace
{
//- A group with an error of cells and one of the step that is 0.1 deltaT
expectedErrors group(const scalar cells, const scalar step = 0.04)
{
    return {"cells",
            "D",
            {{"cells", cells, "a/h = 4",
              [](scalar) { return string("cells of h = 0.1 and smaller"); }},
             {"step", step, "deltaT 0.4", nullptr,
              [](const scalar error) { return 10 * error; },
              [](const scalar deltaT) { return 0.1 * deltaT; }}}};
}

std::string judged(const expectedErrors& errors, const scalar wanted)
{
    return test::refusal(
        [&] { checkErrors({errors}, wanted, "deformableBodies"); });
}
} // namespace

TEST(ExpectedErrors, accuracyIsAWordOrANumber)
{
    EXPECT_EQ(bodyAccuracy(dictOf("")).level, bodyAccuracy::standard);
    EXPECT_EQ(bodyAccuracy(dictOf("accuracy draft;")).level,
              bodyAccuracy::draft);
    EXPECT_EQ(bodyAccuracy(dictOf("accuracy draft;")).wanted, 0);
    EXPECT_EQ(bodyAccuracy(dictOf("accuracy 0.01;")).wanted, 0.01);
    for (const char* wrong :
         {"accuracy 0.3;", "accuracy 1e-5;", "accuracy fine;",
          "accuracy draft 0.1;", "accuracy { }"})
    {
        EXPECT_TRUE(test::refuses([&] { const bodyAccuracy a(dictOf(wrong)); },
                                  "allowed: (draft standard reference) or the "
                                  "relative error wanted, 1e-4 to 0.2"))
            << wrong;
    }
}

TEST(ExpectedErrors, adviceIsRoundedDown)
{
    EXPECT_EQ(atMost(0.01299), "0.012");
    EXPECT_EQ(atMost(0.3), "0.3");
    EXPECT_EQ(atMost(9.99), "9.9");
}

// 8e-4 of the diffusion number, up to 10
TEST(ExpectedErrors, forcesLagByTheDiffusionNumber)
{
    const expectedError e(ofForcing(2, 0.5, 1, 0, 0));
    EXPECT_NEAR(e.error, 8e-4, 1e-15);
    EXPECT_NEAR(e.deltaT(4e-3), 2.5, 1e-12);
    EXPECT_NEAR(e.deltaT(1), 5, 1e-12);
    EXPECT_NEAR(e.errorOf(2.5), 4e-3, 1e-15);
    EXPECT_LT(ofForcing(2, 6, 1, 0, 0).error, 0);
    // The lag is that part of the duration
    const scalar step = ofForcing(2, 0.5, 1, 30, 0).deltaT(4e-3);
    EXPECT_NEAR(step * (1 + 0.2 * 2 * step), 4e-3 * 30, 1e-12);
}

// The lag is dt (1 + 0.2 nu dt/h^2)
TEST(ExpectedErrors, forcesOfBodiesThatMeetLag)
{
    const expectedError e(ofForcing(2, 0.5, 1, 0, 3));
    EXPECT_NEAR(e.error, 8e-4 + 0.5 * 3 * 0.6, 1e-12);
    EXPECT_NEAR(e.errorOf(e.deltaT(0.02)), 0.02, 1e-12);
    EXPECT_NEAR(e.errorOf(e.deltaT(1e-4)), 1e-4, 1e-12);
}

TEST(ExpectedErrors, stepsHaveWhatIsLeft)
{
    expectedErrors errors(group(0.02));
    EXPECT_NEAR(stepFor(errors, 0.03), 0.1, 1e-12);
    EXPECT_NEAR(errors.parts[1].error, 0.01, 1e-12);

    // Half of what is wanted where others are not known, or larger
    errors = group(-1);
    EXPECT_NEAR(stepFor(errors, 0.03), 0.15, 1e-12);

    errors = group(0.05);
    EXPECT_NEAR(stepFor(errors, 0.03), 0.15, 1e-12);
}

TEST(ExpectedErrors, stepsThatAreSmallEnoughStay)
{
    expectedErrors errors(group(0.02, 0.005));
    stepFor(errors, 0.03);
    EXPECT_EQ(errors.parts[1].error, 0.005);
}

TEST(ExpectedErrors, sumsAboveWhatIsWantedAreRefusedWithRemedies)
{
    EXPECT_EQ(judged(group(0.02), 0), "");
    EXPECT_EQ(judged(group(0.02), 0.06), "");
    const std::string message(judged(group(0.02), 0.05));
    for (const char* part :
         {"entry accuracy has the value 0.05 allowed: 0.06",
          "and more for group cells", "or cells of h = 0.1 and smaller",
          "or deltaT of 0.3 s and smaller"})
    {
        EXPECT_NE(message.find(part), std::string::npos) << message;
    }
    EXPECT_NE(
        judged(group(0.06), 0.03).find("no single change is sufficient"),
        std::string::npos);
}

TEST(ExpectedErrors, whatNothingChangesIsSaid)
{
    expectedErrors errors(group(0.06));
    errors.parts[0].remedy = nullptr;
    EXPECT_NE(judged(errors, 0.03).find("nothing brings it below 6 %"),
              std::string::npos);
}

TEST(ExpectedErrors, unknownPartsAreNoError)
{
    EXPECT_EQ(judged(group(-1), 0.05), "");
    EXPECT_NE(judged(group(-1), 0.03), "");
}
