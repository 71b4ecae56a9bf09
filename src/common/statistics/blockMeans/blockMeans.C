// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "blockMeans.H"
#include <cmath>

Foam::blockMeans::blockMeans(const label nValues)
    : nValues_(nValues),
      open_{0, 0, scalarList(nValues, scalar(0))}
{
}

void Foam::blockMeans::add(const scalar time, const scalar dt,
                           const UList<scalar>& values)
{
    if (inOpen_ == 0) open_.start = time - dt;
    open_.weight += dt;
    forAll(values, i)
    {
        open_.sums[i] += dt * values[i];
    }
    if (++inOpen_ < perBlock_) return;
    blocks_.push_back(open_);
    open_ = {0, 0, scalarList(nValues_, scalar(0))};
    inOpen_ = 0;
    if (nBlocks() == mostBlocks) joinPairs();
}

void Foam::blockMeans::joinPairs()
{
    for (label b = 0; b < mostBlocks / 2; ++b)
    {
        block joined(blocks_[2 * b]);
        const block& second = blocks_[2 * b + 1];
        joined.weight += second.weight;
        forAll(joined.sums, i)
        {
            joined.sums[i] += second.sums[i];
        }
        blocks_[b] = joined;
    }
    blocks_.resize(mostBlocks / 2);
    perBlock_ *= 2;
}

Foam::label Foam::blockMeans::firstFrom(const scalar time) const
{
    label b = 0;
    while (b < nBlocks() && blocks_[b].start < (1 - 1e-9) * time)
        ++b;
    return b;
}

Foam::label Foam::blockMeans::afterTransient(const label value) const
{
    // Sums over the blocks from the last one on
    scalar n = 0, sum = 0, squares = 0, least = GREAT;
    label first = nBlocks();
    for (label b = nBlocks() - 1; b >= 0; --b)
    {
        const scalar x = blocks_[b].sums[value] / blocks_[b].weight;
        ++n;
        sum += x;
        squares += sqr(x);
        if (n < leastBatches || 2 * b > nBlocks()) continue;
        const scalar variance = (squares - sqr(sum) / n) / sqr(n);
        if (variance > least) continue;
        least = variance;
        first = b;
    }
    const auto changes = [&](const label b)
    { return mag(change(value, b)) > 5e-3 * mag(of(value, b).value); };
    const label last = nBlocks() / 2;
    if (first >= last && nBlocks() < 4 * leastBatches) return nBlocks();
    while (first < last && changes(first))
        ++first;
    return first >= last && changes(last) ? nBlocks() : first;
}

std::pair<Foam::scalar, Foam::scalar>
Foam::blockMeans::sums(const label value, const label first,
                       const label end) const
{
    std::pair<scalar, scalar> all(0, 0);
    for (label b = first; b < end; ++b)
    {
        all.first += blocks_[b].weight;
        all.second += blocks_[b].sums[value];
    }
    return all;
}

Foam::blockMeans::mean Foam::blockMeans::over(const label value,
                                              const label first,
                                              const label end) const
{
    const std::pair<scalar, scalar> all(sums(value, first, end));
    mean m{all.second / max(all.first, VSMALL), -1};
    const label n = end - first;
    for (label size = 1; n / size >= leastBatches; size *= 2)
    {
        const label batches = n / size;
        scalar squares = 0;
        for (label k = 0; k < batches; ++k)
        {
            const std::pair<scalar, scalar> batch(
                sums(value, end - (k + 1) * size, end - k * size));
            squares += sqr(batch.second / batch.first - m.value);
        }
        m.error =
            max(m.error, std::sqrt(squares / (batches * (batches - 1.0))));
    }
    return m;
}

Foam::scalar Foam::blockMeans::change(const label value,
                                      const label first) const
{
    const label middle = (first + nBlocks()) / 2;
    const mean early(over(value, first, middle)),
        late(over(value, middle, nBlocks()));
    const scalar by = late.value - early.value;
    const bool known = early.error >= 0 && late.error >= 0;
    return known && sqr(by) > 16 * (sqr(early.error) + sqr(late.error)) ? by
                                                                        : 0;
}

Foam::blockMeans::mean Foam::blockMeans::of(const label value,
                                            const label first) const
{
    mean m(over(value, first, nBlocks()));
    const std::pair<scalar, scalar> all(sums(value, first, nBlocks()));
    m.value = (all.second + open_.sums[value]) /
              max(all.first + open_.weight, VSMALL);
    if (m.error >= 0) m.error = max(m.error, mag(change(value, first)));
    return m;
}

Foam::scalarList Foam::blockMeans::state() const
{
    DynamicList<scalar> all;
    all.append(perBlock_);
    all.append(inOpen_);
    const auto append = [&](const block& b)
    {
        all.append(b.start);
        all.append(b.weight);
        all.append(b.sums);
    };
    append(open_);
    for (const block& b : blocks_)
    {
        append(b);
    }
    return scalarList(std::move(all));
}

void Foam::blockMeans::restore(const UList<scalar>& state)
{
    blocks_.clear();
    perBlock_ = 1;
    inOpen_ = 0;
    open_ = {0, 0, scalarList(nValues_, scalar(0))};
    if (state.empty()) return;
    perBlock_ = label(state[0]);
    inOpen_ = label(state[1]);
    for (label k = 2; k + 2 + nValues_ <= state.size(); k += 2 + nValues_)
    {
        const block b{state[k], state[k + 1],
                      scalarList(SubList<scalar>(state, nValues_, k + 2))};
        if (k == 2)
            open_ = b;
        else
            blocks_.push_back(b);
    }
}
