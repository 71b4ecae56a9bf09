// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "velocityRates.H"

void Foam::velocityRates::begin()
{
    rates_.assign(block_.box().size.x(), 0);
    steepness_.assign(block_.box().size.x(), 0);
}

// One maximum per x index, so that the loop vectorises; NaN propagates. Not inlined: a
// restarted run must round as the uninterrupted one
void Foam::velocityRates::take(const componentArrays& u, const label q)
{
    const double r0 = 1 / h_.x(), r1 = 1 / h_.y(), r2 = 1 / h_.z();
    const double* a = u[0].cdata() + q;
    const double* b = u[1].cdata() + q;
    const double* c = u[2].cdata() + q;
    double *largest = rates_.data(), *steepest = steepness_.data();
    const label nx = block_.box().size.x();
#pragma GCC ivdep
    for (label i = 0; i < nx; ++i)
    {
        const double rate =
            std::abs(a[i]) * r0 + std::abs(b[i]) * r1 + std::abs(c[i]) * r2;
        const bool take = (rate > largest[i]) | (rate != rate);
        largest[i] = take ? rate : largest[i];
        const double steep =
            rate * rate * (a[i] * a[i] + b[i] * b[i] + c[i] * c[i]);
        steepest[i] = steep > steepest[i] ? steep : steepest[i];
    }
}

Foam::vector2D Foam::velocityRates::largest(const componentArrays& u)
{
    if (rates_.empty())
    {
        begin();
        block_.rows([&](const label q, const label) { take(u, q); });
    }
    vector2D largest(Zero);
    for (std::size_t i = 0; i < rates_.size(); ++i)
    {
        largest.x() = max(largest.x(), rates_[i] < VGREAT ? rates_[i] : VGREAT);
        largest.y() = max(largest.y(), steepness_[i]);
    }
    reduce(largest, maxOp<vector2D>());
    return largest;
}
