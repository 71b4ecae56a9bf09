// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "haloBlock.H"

// Positions in the halo to be filled, and the cells of all ranks that fill them
class Foam::haloBlock::sources
{
    const haloBlock& halo_;
    const uniformGrid& grid_;
    const List<cellBox> boxes_;

    //- Rank of each cell, its position in the array there, and the position here
    DynamicList<label> rank_, theirs_, ours_;

public:
    sources(const haloBlock& halo, const uniformGrid& grid)
        : halo_(halo),
          grid_(grid),
          boxes_(grid.allBoxes())
    {
    }

    //- Add the position l in the halo, unless it is beyond a wall
    void add(const labelVector& l)
    {
        labelVector c(halo_.box_.lo + l);
        for (direction d = 0; d < 3; ++d)
        {
            const label n = grid_.n()[d];
            if (!grid_.periodic(d) && (c[d] < 0 || c[d] >= n)) return;
            c[d] = (c[d] + n) % n;
        }
        forAll(boxes_, proci)
        {
            const cellBox& b = boxes_[proci];
            if (!b.contains(c)) continue;
            rank_.append(proci);
            theirs_.append(index(strides(b.size), c - b.lo));
            ours_.append(halo_.index(l));
            break;
        }
    }

    //- Add the layer of positions at l[d] = at, without those beyond the block in the other
    //  directions from first on
    void addLayer(const direction d, const label at, const direction first)
    {
        halo_.layer(d, at,
                    [&](const labelVector& l)
                    {
                        for (direction e = first; e < 3; ++e)
                        {
                            if (e != d &&
                                (l[e] < 0 || l[e] >= halo_.box_.size[e]))
                            {
                                return;
                            }
                        }
                        add(l);
                    });
    }

    //- Exchange that fills the positions added since the last one (collective)
    indexExchange exchange()
    {
        const indexExchange made(rank_, theirs_, ours_);
        rank_.clear();
        theirs_.clear();
        ours_.clear();
        return made;
    }
};

Foam::haloBlock::haloBlock(const uniformGrid& grid)
    : grid_(grid),
      box_(grid.box()),
      stride_(strides(box_.size)),
      indices_(grid.index().size())
{
    forAll(indices_, celli)
    {
        indices_[celli] = index(grid.ijk(celli) - box_.lo);
    }

    // The two z layers whole; then y without their edges; then x
    sources from(*this, grid);
    for (const direction d : {2, 1, 0})
    {
        from.addLayer(d, -1, d + 1);
        from.addLayer(d, box_.size[d], d + 1);
    }
    exchange_ = from.exchange();

    for (direction d = 0; d < 3; ++d)
    {
        from.addLayer(d, -1, 0);
    }
    below_ = from.exchange();
    for (direction d = 0; d < 3; ++d)
    {
        from.addLayer(d, box_.size[d], 0);
        above_[d] = from.exchange();
    }
}
