// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "dictionaryChecks.H"
#include "testRefusal.H"

using namespace Foam;
using test::dictOf;
using test::refuses;

TEST(DictionaryChecks, unknownEntriesAreNamedWithThoseAllowed)
{
    const dictionary dict(dictOf("radius 1; raduis 2;"));
    EXPECT_TRUE(refuses(
        [&] {
            checkEntries(dict, {"type", "radius"});
        },
        "unknown entry raduis"));
    EXPECT_TRUE(refuses(
        [&] {
            checkEntries(dict, {"type", "radius"});
        },
        "allowed: (type radius)"));
    EXPECT_EQ(test::refusal(
                  [&] {
                      checkEntries(dict, {"raduis", "radius"});
                  }),
              "");
}

TEST(DictionaryChecks, coefficientsBelongToFunctionsWithAType)
{
    const dictionary dict(dictOf("force table ((0 0) (1 1)); torque 3;"));
    const wordList all(withCoeffs(dict, {"force"}, {"force", "torque"}));
    EXPECT_TRUE(all.found("forceCoeffs"));
    EXPECT_FALSE(all.found("torqueCoeffs"));
}

TEST(DictionaryChecks, otherDimensionsAreRefused)
{
    const dictionary dict(
        dictOf("a [0 1 0 0 0 0 0] 2; b [0 2 0 0 0 0 0] 2; c 2;"));
    EXPECT_EQ(readNumber(dict, "a", dimLength), 2);
    EXPECT_EQ(readNumber(dict, "c", dimLength), 2);
    EXPECT_TRUE(refuses([&] { readNumber(dict, "b", dimLength); },
                        "allowed: dimensions [0 1 0 0 0 0 0]"));
}

TEST(DictionaryChecks, positiveNumbersAreGreaterThanZero)
{
    const dictionary dict(dictOf("a 0; b -1; c 1e-30;"));
    EXPECT_EQ(readPositive(dict, "c", dimless), 1e-30);
    for (const word name : {"a", "b"})
    {
        EXPECT_TRUE(refuses([&] { readPositive(dict, name, dimless); },
                            "allowed: numbers greater than 0"));
    }
}

TEST(DictionaryChecks, valuesAreOnOneLine)
{
    const dictionary dict(dictOf("a ( 1\n 2 ); b { c  1; d { e (0 1); } }"));
    EXPECT_EQ(valueOf(*dict.findEntry("a")), "(1 2)");
    EXPECT_EQ(valueOf(*dict.findEntry("b")), "{ c 1; d { e (0 1); } }");
}

TEST(DictionaryChecks, aValueIsNoDictionary)
{
    const dictionary dict(dictOf("a 1; b { c 2; }"));
    EXPECT_EQ(readDict(dict, "b", "c 1;").get<label>("c"), 2);
    EXPECT_TRUE(
        refuses([&] { readDict(dict, "a", "c 1;"); },
                "has the value 1 allowed: a dictionary, such as a { c 1; }"));
    EXPECT_TRUE(readDictIfPresent(dict, "d", "c 1;").empty());
}

TEST(DictionaryChecks, wordsAreThoseAllowed)
{
    const dictionary dict(dictOf("law Hooke; other Moose;"));
    const wordList laws({"Hooke", "Skalak"});
    EXPECT_EQ(readWord(dict, "law", laws, "Skalak"), "Hooke");
    EXPECT_EQ(readWord(dict, "none", laws, "Skalak"), "Skalak");
    EXPECT_TRUE(refuses([&] { readWord(dict, "other", laws, "Skalak"); },
                        "has the value Moose allowed: (Hooke Skalak)"));
}

TEST(DictionaryChecks, allRanksHaveTheSentenceOfTheFirst)
{
    EXPECT_EQ(firstOf(""), "");
    const label last = Pstream::parRun() ? Pstream::nProcs() - 1 : 0;
    EXPECT_EQ(firstOf(Pstream::myProcNo() == last ? "here" : ""), "here");
    EXPECT_EQ(firstOf(Foam::name(Pstream::myProcNo())), "0");
}
