// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "duplicateEntries.H"
#include "OSspecific.H"
#include "testRefusal.H"

using namespace Foam;

namespace
{
//- Message for a file of that text
std::string refused(const std::string& text)
{
    const fileName file(test::mesh().time().globalPath() / "repeated");
    test::writeText(file, text);
    const std::string message(
        test::refusal([&] { refuseDuplicates(dictionary(), file); }));
    if (Pstream::master()) rm(file);
    return message;
}
} // namespace

TEST(RepeatedDictionary, twoGroupsOfOneNameAreRefused)
{
    const std::string message(
        refused("bodies { cells { a 1; } fibres { } cells { b 2; } }"));
    EXPECT_NE(message.find("entry bodies/cells has the value two dictionaries"),
              std::string::npos)
        << message;
}

TEST(RepeatedDictionary, twoValuesAreRefused)
{
    EXPECT_NE(refused("a { b 1; c (1 2); b 2; }")
                  .find("entry a/b has the value two values"),
              std::string::npos);
}

TEST(RepeatedDictionary, namesInOtherPlacesAreNot)
{
    EXPECT_EQ(refused("a { b 1; } c { b 1; } b 1; list ({ b 1; } { b 2; });"),
              "");
}

TEST(RepeatedDictionary, commentsAndTextThatStandsForOthersAreNot)
{
    EXPECT_EQ(refused("a 1; // a 2;\n/* a 3; */ $b; $b;\n"
                      "#include \"x\"\n#include \"x\"\nc 1;"),
              "");
    EXPECT_EQ(refused("#if 1\na 1;\n#else\na 2;\n#endif"), "");
}
