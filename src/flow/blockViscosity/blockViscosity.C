// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "blockViscosity.H"

void Foam::blockViscosity::set(const volScalarField& nu,
                               const scalarMinMax& range)
{
    max_ = Foam::max(range.max(), gMax(nu.primitiveField()));
    min_ = Foam::min(range.min(), gMin(nu.primitiveField()));
    if (max_ - min_ <= 1e-12 * max_)
    {
        cells_.clear();
        for (auto& edges : edges_)
        {
            edges.clear();
        }
        return;
    }

    // Positions outside the cells have a value, too
    cells_.resize(block_.size(), max_);
    block_.set(nu, cells_.data());

    for (direction g = 0; g < 3; ++g)
    {
        const label sa = block_.stride(g == 0 ? 1 : 0);
        const label sb = block_.stride(g == 2 ? 1 : 2);
        edges_[g].resize(block_.size());
        const label end = block_.index(block_.box().size);
        for (label q = block_.index(0, 0, 0); q <= end; ++q)
        {
            edges_[g][q] = 4 / (1 / cells_[q] + 1 / cells_[q - sa] +
                                1 / cells_[q - sb] + 1 / cells_[q - sa - sb]);
        }
    }
}
