// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "blockNeighbours.H"
#include "indexExchange.H"
#include <algorithm>

namespace
{
using namespace Foam;

//- Layers between cell i and the cells lo ... lo + size - 1 of a direction of n
label layersBetween(const label i, const label lo, const label size,
                    const label n, const bool periodic)
{
    const label below = lo - i, above = i - (lo + size - 1);
    const label away = max(max(below, above), label(0));
    if (!periodic || away == 0) return away;
    return below > 0 ? min(below, i + n - (lo + size - 1))
                     : min(above, lo + n - i);
}
} // namespace

Foam::blockNeighbours::blockNeighbours(const uniformGrid& grid)
    : grid_(grid),
      boxes_(grid.allBoxes())
{
    widen(2);
}

void Foam::blockNeighbours::widen(const label reach)
{
    reach_ = reach;
    tables_.clear();
    const cellBox& mine = grid_.box();
    DynamicList<label> ranks;
    forAll(boxes_, proci)
    {
        bool within = true;
        for (direction d = 0; d < 3; ++d)
        {
            // Between two blocks: from the nearer end of the one to the other
            const cellBox& b = boxes_[proci];
            const auto between = [&](const label i)
            {
                return layersBetween(i, b.lo[d], b.size[d], grid_.n()[d],
                                     grid_.periodic(d));
            };
            const label last = mine.lo[d] + mine.size[d] - 1;
            const bool overlap =
                b.lo[d] <= last && mine.lo[d] <= b.lo[d] + b.size[d] - 1;
            within = within && (overlap || min(between(mine.lo[d]),
                                               between(last)) <= reach);
        }
        if (proci == Pstream::myProcNo()) me_ = ranks.size();
        if (proci == Pstream::myProcNo() ||
            (within && mine.count() && boxes_[proci].count()))
        {
            ranks.append(proci);
        }
    }
    ranks_.transfer(ranks);
    nWords_ = (ranks_.size() + 63) / 64;

    for (direction d = 0; d < 3; ++d)
    {
        away_[d].setSize(grid_.n()[d]);
        forAll(away_[d], i)
        {
            away_[d][i] = layersBetween(i, mine.lo[d], mine.size[d],
                                        grid_.n()[d], grid_.periodic(d));
        }
    }
}

Foam::List<Foam::labelVector>
Foam::blockNeighbours::cover(const UList<vector>& X, const label margin)
{
    List<labelVector> cells(X.size());
    label away = 0;
    forAll(X, k)
    {
        const labelVector cell(grid_.cellAt(X[k]));
        away = max(away, this->away(cell));
        cells[k] = cell;
    }
    reduce(away, maxOp<label>());
    if (away + margin > reach_) widen(max(away + margin, label(1.25 * reach_)));
    return cells;
}

const Foam::blockNeighbours::table&
Foam::blockNeighbours::near(const label margin) const
{
    const auto made = tables_.find(margin);
    if (made != tables_.end()) return made->second;

    table& t = tables_[margin];
    for (direction d = 0; d < 3; ++d)
    {
        const label n = grid_.n()[d];
        t.near[d].assign(n * nWords_, 0);
        forAll(ranks_, r)
        {
            const cellBox& b = boxes_[ranks_[r]];
            if (!b.count()) continue;
            for (label i = 0; i < n; ++i)
            {
                if (layersBetween(i, b.lo[d], b.size[d], n,
                                  grid_.periodic(d)) <= margin)
                {
                    t.near[d][i * nWords_ + r / 64] |= uint64_t(1) << (r % 64);
                }
            }
        }
    }

    // Blocks leave the inside of this one to it; bounding boxes that overlap may not
    const cellBox& mine = grid_.box();
    vector from(vector::one * -GREAT), to(vector::one * GREAT);
    std::vector<uint64_t> others(nWords_, ~uint64_t(0));
    for (direction d = 0; d < 3; ++d)
    {
        const bool all = mine.size[d] == grid_.n()[d];
        const label first = mine.lo[d] + (all ? 0 : margin),
                    end = mine.lo[d] + mine.size[d] - (all ? 0 : margin);
        std::vector<uint64_t> any(nWords_, 0);
        for (label i = first * nWords_; i < end * nWords_; ++i)
        {
            any[i % nWords_] |= t.near[d][i];
        }
        for (label w = 0; w < nWords_; ++w)
        {
            others[w] &= any[w];
        }
        if (all) continue;
        const scalar roundOff = 1e-6;
        from[d] = grid_.origin()[d] + grid_.h()[d] * (first + roundOff);
        to[d] = grid_.origin()[d] + grid_.h()[d] * (end - roundOff);
    }
    others[me_ / 64] &= ~(uint64_t(1) << (me_ % 64));
    if (*std::max_element(others.begin(), others.end()) == 0)
    {
        t.alone = boundBox(from, to);
    }
    return t;
}

Foam::label Foam::blockNeighbours::holderOfAll(const vector& x) const
{
    const labelVector cell(grid_.cellAt(x));
    forAll(boxes_, proci)
    {
        if (boxes_[proci].contains(cell)) return proci;
    }
    return 0;
}

Foam::labelList Foam::blockNeighbours::sizes(const labelList& out) const
{
    scalarField outSizes(out.size()), inSizes(out.size(), Zero);
    values give, take;
    forAll(out, i)
    {
        outSizes[i] = out[i];
        give.emplace_back(&outSizes[i], 1);
        take.emplace_back(&inSizes[i], 1);
    }
    exchange(give, take);
    labelList in(out);
    forAll(in, i)
    {
        if (i != me_) in[i] = label(inSizes[i]);
    }
    return in;
}

// No message where there are no values
void Foam::blockNeighbours::exchange(const values& out, values& in) const
{
    const auto bytes = [](const UList<scalar>& v)
    { return std::streamsize(v.size() * sizeof(scalar)); };
    const label pending = Pstream::nRequests();
    forAll(ranks_, i)
    {
        if (i == me_ || in[i].empty()) continue;
        UIPstream::read(Pstream::commsTypes::nonBlocking, ranks_[i],
                        reinterpret_cast<char*>(in[i].data()), bytes(in[i]));
    }
    forAll(ranks_, i)
    {
        if (i == me_ || out[i].empty()) continue;
        UOPstream::write(Pstream::commsTypes::nonBlocking, ranks_[i],
                         reinterpret_cast<const char*>(out[i].cdata()),
                         bytes(out[i]));
        indexExchange::count(bytes(out[i]));
    }
    Pstream::waitRequests(pending);
}

void Foam::blockNeighbours::exchange(List<scalarField>& out,
                                     List<scalarField>& in) const
{
    labelList n(out.size());
    forAll(out, i)
    {
        n[i] = out[i].size();
    }
    n = sizes(n);
    values give, take;
    in.setSize(out.size());
    forAll(in, i)
    {
        in[i].setSize(i == me_ ? 0 : n[i]);
        give.emplace_back(out[i].data(), out[i].size());
        take.emplace_back(in[i].data(), in[i].size());
    }
    exchange(give, take);
}
