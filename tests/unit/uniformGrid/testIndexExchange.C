// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "indexExchange.H"
#include "unitTest.H"

using namespace Foam;

// Values numbered over all ranks are distributed in reverse order and return to their owners
TEST(IndexExchange, dealsAndReturns)
{
    const label n = 60, ranks = Pstream::nProcs(), me = Pstream::myProcNo();
    labelList rank(n), place(n), source(n);
    scalarField values(n), dealt(n, -1), back(n, -1);
    for (label i = 0; i < n; ++i)
    {
        const label number = n * me + i;
        rank[i] = number % ranks;
        place[i] = n - 1 - number / ranks;
        source[i] = (7 * i) % n;
        values[source[i]] = number;
    }
    const indexExchange exchange(rank, place, source);
    exchange.forward(values.cdata(), dealt.data());
    scalar wrong = 0;
    for (label i = 0; i < n; ++i)
    {
        wrong += mag(dealt[n - 1 - i] - (ranks * i + me));
    }
    EXPECT_EQ(returnReduce(wrong, sumOp<scalar>()), 0);

    const int64_t before = indexExchange::messages;
    exchange.backward(dealt.cdata(), back.data());
    EXPECT_EQ(gSum(mag(back - values)), 0);
    EXPECT_EQ(indexExchange::messages - before, ranks - 1);
}
