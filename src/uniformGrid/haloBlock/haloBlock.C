// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "haloBlock.H"

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

    const List<cellBox> boxes(grid.allBoxes());
    DynamicList<label> rank, theirs, ours;
    const auto visit = [&](const labelVector& local)
    {
        labelVector c(box_.lo + local);
        for (direction d = 0; d < 3; ++d)
        {
            const label n = grid.n()[d];
            if (!grid.periodic(d) && (c[d] < 0 || c[d] >= n)) return;
            c[d] = (c[d] + n) % n;
        }
        forAll(boxes, proci)
        {
            const cellBox& b = boxes[proci];
            if (!b.contains(c)) continue;
            rank.append(proci);
            theirs.append(index(strides(b.size), c - b.lo));
            ours.append(index(local));
            break;
        }
    };

    const auto made = [&]()
    {
        const indexExchange exchange(rank, theirs, ours);
        rank.clear();
        theirs.clear();
        ours.clear();
        return exchange;
    };

    // The two z layers whole; then y without their edges; then x
    for (const direction d : {2, 1, 0})
    {
        for (const label at : {label(-1), box_.size[d]})
        {
            layer(d, at,
                  [&](const labelVector& l)
                  {
                      for (direction e = d + 1; e < 3; ++e)
                      {
                          if (l[e] < 0 || l[e] >= box_.size[e]) return;
                      }
                      visit(l);
                  });
        }
    }
    exchange_ = made();

    const auto face = [&](const direction d, const label at)
    {
        layer(d, at,
              [&](const labelVector& l)
              {
                  for (direction e = 0; e < 3; ++e)
                  {
                      if (e != d && (l[e] < 0 || l[e] >= box_.size[e])) return;
                  }
                  visit(l);
              });
    };
    for (direction d = 0; d < 3; ++d)
    {
        face(d, -1);
    }
    below_ = made();
    for (direction d = 0; d < 3; ++d)
    {
        face(d, box_.size[d]);
        above_[d] = made();
    }
}
