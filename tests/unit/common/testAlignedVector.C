// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "componentArrays.H"
#include "unitTest.H"
#include <cstdint>

using namespace Foam;

namespace
{
std::size_t indexOf(const void* p)
{
    return reinterpret_cast<std::uintptr_t>(p);
}
} // namespace

TEST(AlignedVector, beginsWithALineOfTheCache)
{
    for (const label n : {1, 3, 100, 4097})
    {
        EXPECT_EQ(indexOf(alignedVector<scalar>(n).data()) % 64, 0u);
    }
}

TEST(ComponentArrays, componentsDoNotShareValues)
{
    for (const label n : {1, 511, 512, 513})
    {
        componentArrays a(n);
        for (direction d = 0; d < 3; ++d)
        {
            for (scalar& x : a[d])
            {
                EXPECT_EQ(x, 0);
                x = d + 1;
            }
        }
        for (direction d = 0; d < 3; ++d)
        {
            EXPECT_EQ(a[d].size(), n);
            EXPECT_EQ(sum(a[d]), n * (d + 1));
        }
        a.clear();
        EXPECT_EQ(max(a[2]), 0);
    }
}

// Equal places in two components differ in the last twelve bits
TEST(ComponentArrays, componentsAreNoMultipleOf4kBApart)
{
    for (const label n : {512, 4096, 32768})
    {
        const componentArrays a(n);
        const std::size_t apart = indexOf(a[1].cdata()) - indexOf(a[0].cdata());
        EXPECT_EQ(apart % 4096, 176 * sizeof(scalar));
        EXPECT_EQ(apart, indexOf(a[2].cdata()) - indexOf(a[1].cdata()));
    }
}
