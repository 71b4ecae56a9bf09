// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "unitTest.H"
#include <chrono>
#include <cstdio>
#include <vector>

// Bandwidth of one core: a = b + s c over arrays that together are as long as a dozen
// fields of a flow of 64^3 and of 128^3 cells, counting 24 bytes
// a point (see tests/bench/floor)
TEST(Bandwidth, DISABLED_triad)
{
    for (const int n : {64, 128})
    {
        const size_t size = size_t(4) * n * n * n;
        std::vector<double> a(size, 0), b(size, 1), c(size, 2);
        double least = 1e300;
        for (int pass = 0; pass < 12; ++pass)
        {
            const double s = 1 + 1e-3 * pass;
            double *x = a.data(), *y = b.data(), *z = c.data();
            const auto begin = std::chrono::steady_clock::now();
#pragma GCC ivdep
            for (size_t i = 0; i < size; ++i)
            {
                x[i] = y[i] + s * z[i];
            }
            const std::chrono::duration<double> time =
                std::chrono::steady_clock::now() - begin;
            least = std::min(least, time.count());
        }
        std::printf("triad %d %.2f\n", n, 24e-9 * size / least);
        EXPECT_GT(a[size / 2], 2);
    }
}
