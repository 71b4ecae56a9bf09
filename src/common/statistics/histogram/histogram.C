// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "histogram.H"
#include "DynamicList.H"
#include <cmath>

Foam::histogram::histogram(const label most)
    : most_(most)
{
}

void Foam::histogram::add(const scalar value, const scalar weight)
{
    if (!std::isfinite(value)) return;

    // The first width is far below the values, so that joining finds the right one
    if (width_ == 0)
    {
        width_ = std::exp2(std::floor(
            std::log2(max(mag(value), scalar(VSMALL)) / most_) - 10));
    }
    while (!(mag(value) < 1e9 * width_))
        joinPairs();
    bins_[long(std::floor(value / width_))] += weight;
    sum_ += weight;
    while (bins_.rbegin()->first - bins_.begin()->first >= most_)
        joinPairs();
}

void Foam::histogram::joinPairs()
{
    width_ *= 2;
    std::map<long, scalar> joined;
    for (const auto& b : bins_)
    {
        joined[b.first >> 1] += b.second;
    }
    bins_.swap(joined);
}

Foam::scalarList Foam::histogram::state() const
{
    DynamicList<scalar> all;
    all.append(width_);
    all.append(sum_);
    for (const auto& b : bins_)
    {
        all.append(b.first);
        all.append(b.second);
    }
    return scalarList(std::move(all));
}

void Foam::histogram::restore(const UList<scalar>& state)
{
    bins_.clear();
    width_ = sum_ = 0;
    if (state.size() < 2) return;
    width_ = state[0];
    sum_ = state[1];
    for (label k = 2; k + 1 < state.size(); k += 2)
    {
        bins_[long(state[k])] = state[k + 1];
    }
}
