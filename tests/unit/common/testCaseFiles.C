// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "caseFiles.H"
#include "OSspecific.H"
#include "testRefusal.H"

using namespace Foam;

namespace
{
//- Message for a file of that text in constant/
std::string refused(const std::string& text)
{
    const Time& time = test::mesh().time();
    const IOobject io("caseFile", time.constant(), test::mesh());
    const fileName file(time.globalPath() / time.constant() / "caseFile");
    test::writeText(file, text);
    const std::string message(
        test::refusal([&] { refuseUnreadable(io, "dictionary"); }));
    if (Pstream::master()) rm(file);
    return message;
}
} // namespace

TEST(CaseFiles, bracketsMatch)
{
    EXPECT_EQ(wrongBrackets("a { b (1 2); c { } }"), "");
    EXPECT_EQ(wrongBrackets("a { b (1 2; }"),
              "line 1 has } without an opening bracket");
    EXPECT_EQ(wrongBrackets("a\n{\n}\n}"),
              "line 4 has } without an opening bracket");
    EXPECT_EQ(wrongBrackets("a { b (1 2);"), "} is missing at its end");
}

TEST(CaseFiles, bracketsOfCommentsStringsAndCodeDoNotCount)
{
    EXPECT_EQ(wrongBrackets("a { // }\n} /* ( */ b \"{\\\"(\"; c #{ ( #};"),
              "");
    EXPECT_EQ(wrongBrackets("/*\n\n*/\n\")\"\n)"),
              "line 5 has ) without an opening bracket");
}

TEST(CaseFiles, whatCannotBeReadIsSaid)
{
    const auto says = [](const std::string& text, const std::string& why)
    { return refused(text).find(why) != std::string::npos; };
    EXPECT_TRUE(says("", "it is empty"));
    EXPECT_TRUE(says(" \n", "it is empty"));
    EXPECT_TRUE(says("a 1;", "it has no header"));
    EXPECT_TRUE(says("\xEF\xBB\xBF"
                     "FoamFile { }",
                     "byte-order mark"));
    EXPECT_TRUE(says("FoamFile { class word; }",
                     "names another class than dictionary"));
}

TEST(CaseFiles, nothingIsNoError)
{
    const IOobject io("notThere", test::mesh().time().constant(), test::mesh());
    EXPECT_EQ(test::refusal([&] { refuseUnreadable(io, "dictionary"); }), "");
}

TEST(CaseFiles, namesInOtherLetterCaseAreFound)
{
    const Time& time = test::mesh().time();
    const IOobject io("deformableBodies", time.constant(), test::mesh());
    EXPECT_EQ(fileWithOtherCapitals(io), "");
    for (const fileName name :
         {"constant/DeformableBodies", "system/deformableBodies"})
    {
        const fileName file(time.globalPath() / name);
        test::writeText(file, "a 1;");
        EXPECT_EQ(fileWithOtherCapitals(io), file);
        if (Pstream::master()) rm(file);
    }
}

TEST(CaseFiles, regionsHaveFoldersOfTheirOwn)
{
    const fileName root(test::mesh().time().globalPath());
    EXPECT_EQ(outputFolder(test::mesh(), "VTK"), root / "VTK");
}
