// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "effectTable.H"
#include "OSspecific.H"
#include "unitTest.H"
#include <chrono>
#include <fstream>
#include <map>

using namespace Foam;

namespace
{
using clocks = std::chrono::steady_clock;

scalar since(const clocks::time_point& begin)
{
    return std::chrono::duration<scalar>(clocks::now() - begin).count();
}

void spend(const scalar seconds)
{
    for (const auto begin = clocks::now(); since(begin) < seconds;)
    {
    }
}
} // namespace

// The inner effect takes at least what is spent in it, the outer one at most the rest
TEST(EffectTable, timeOfAnInnerEffectIsItsOwn)
{
    const Time& time = test::mesh().time();
    const fileName folder(time.globalPath() / "postProcessing" / "table");
    std::map<std::string, std::pair<scalar, label>> rows;
    scalar all = 0;
    {
        effectTable table(time, "table");
        for (const word name : {"outer", "inner"})
        {
            table.declare(name, true, "");
        }
        table.declare("outer", true, "");
        table.declare("skipped", false, "why");
        const auto begin = clocks::now();
        {
            const auto outer = table.time("outer");
            for (label i = 0; i < 2; ++i)
            {
                const auto inner = table.time("inner");
                spend(0.05);
            }
        }
        all = since(begin);
        table.write();
    }
    if (!Pstream::master()) return;
    std::ifstream is(folder / "effectCost" / "0" / "effectCost.dat");
    std::string line;
    std::getline(is, line);
    EXPECT_EQ(line, "# time effect seconds calls");
    std::string at, name;
    scalar seconds;
    label calls;
    while (is >> at >> name >> seconds >> calls)
    {
        rows[name] = {seconds, calls};
    }
    EXPECT_EQ(rows.count("skipped"), 0u);
    EXPECT_EQ(rows["inner"].second, 2);
    EXPECT_EQ(rows["outer"].second, 1);
    // (six digits are written)
    EXPECT_GE(rows["inner"].first, 0.1 * (1 - 1e-5));
    EXPECT_LE(rows["outer"].first, (all - 0.1) * (1 + 1e-5) + 1e-6);
    rmDir(time.globalPath() / "postProcessing" / "table");
}
