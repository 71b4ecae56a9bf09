// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "resultFile.H"
#include "IFstream.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "unitTest.H"

using namespace Foam;

TEST(ResultFile, earlierResultsAreKept)
{
    if (!Pstream::master()) return;
    const Time& time = test::mesh().time();
    const fileName folder(time.globalPath() / "postProcessing" / "kept" / "0");
    rmDir(folder, true);
    for (const label run : {1, 2, 3})
    {
        newResultFile(time, "kept", "a.dat")() << run << endl;
    }
    const auto content = [&](const word& name)
    {
        label run = 0;
        IFstream(folder / name)() >> run;
        return run;
    };
    EXPECT_EQ(content("a.dat.1"), 1);
    EXPECT_EQ(content("a.dat.2"), 2);
    EXPECT_EQ(content("a.dat"), 3);
    rmDir(folder);
}

TEST(ResultFile, runsThatBeganLaterAreKeptAside)
{
    if (!Pstream::master()) return;
    const Time& time = test::mesh().time();
    const fileName folder(time.globalPath() / "postProcessing" / "later");
    rmDir(folder, true);
    mkDir(folder / "5");
    OFstream(folder / "5" / "a.dat")() << 1 << endl;
    OFstream(folder / "5" / "b.dat")() << 1 << endl;
    newResultFile(time, "later", "a.dat")() << 2 << endl;
    EXPECT_FALSE(isFile(folder / "5" / "a.dat"));
    EXPECT_TRUE(isFile(folder / "5" / "a.dat.1"));
    EXPECT_TRUE(isFile(folder / "5" / "b.dat"));
    rmDir(folder);
}
