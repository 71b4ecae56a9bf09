// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "markerSet.H"

Foam::markerSet::markerSet(const uniformGrid& grid, const deltaKernel& kernel,
                           blockNeighbours& neighbours)
    : grid_(grid),
      kernel_(kernel),
      copies_(neighbours)
{
}

void Foam::markerSet::setPositions(const vectorField& X)
{
    copies_.route(X, label(kernel_.reach() + 1));
    sort();
}

bool Foam::markerSet::positionRange::contains(const vector& x) const
{
    bool within = true;
    for (direction d = 0; d < 3; ++d)
    {
        within = within && x[d] >= from[d] && x[d] < to[d];
    }
    return within;
}

// Faces on walls count as outside of the block, as a boundary condition sets their velocity.
// The upper limits have a margin for rounding
Foam::scalar Foam::markerSet::lowestPosition(const label face,
                                             const label cell) const
{
    return kernel_.reach() + max(face - scalar(1), cell - 0.5);
}

Foam::markerSet::positionRange Foam::markerSet::wholeInBlock() const
{
    positionRange range;
    for (direction d = 0; d < 3; ++d)
    {
        const label lo = grid_.box().lo[d];
        range.from[d] =
            lowestPosition(lo == 0 && !grid_.periodic(d) ? 1 : lo, lo);
        range.to[d] =
            kernel_.reach() + lo + grid_.box().size[d] - rowSize(d) - 1e-9;
    }
    return range;
}

Foam::markerSet::positionRange Foam::markerSet::freeOfWalls() const
{
    positionRange range;
    for (direction d = 0; d < 3; ++d)
    {
        const bool periodic = grid_.periodic(d);
        range.from[d] = periodic ? -GREAT : lowestPosition(1, 0);
        range.to[d] = periodic ? GREAT
                               : kernel_.reach() + grid_.n()[d] -
                                     kernel_.nPoints() - 1e-9;
    }
    return range;
}

Foam::vector Foam::markerSet::inCells(const vector& X) const
{
    vector x(cmptDivide(X - grid_.origin(), grid_.h()));
    for (direction d = 0; d < 3; ++d)
    {
        const scalar size = grid_.n()[d];
        if (grid_.periodic(d) && !(x[d] >= 0 && x[d] < size))
        {
            x[d] -= size * std::floor(x[d] / size);
        }
    }
    return x;
}

template<class Visit>
void Foam::markerSet::eachImage(const vector& x, Visit visit) const
{
    const cellBox& box = grid_.box();
    scalar reached[3][3];
    int count[3] = {0, 0, 0};
    for (direction d = 0; d < 3; ++d)
    {
        const int images = grid_.periodic(d) ? 1 : 0;
        for (int image = -images; image <= images; ++image)
        {
            const scalar shifted = x[d] + image * scalar(grid_.n()[d]);
            if (shifted > box.lo[d] - kernel_.reach() &&
                shifted < box.lo[d] + box.size[d] - 0.5 + kernel_.reach())
            {
                reached[d][count[d]++] = shifted;
            }
        }
    }
    for (int i = 0; i < count[0]; ++i)
        for (int j = 0; j < count[1]; ++j)
            for (int k = 0; k < count[2]; ++k)
                visit(vector(reached[0][i], reached[1][j], reached[2][k]));
}

// Bunches of layers and rows are sorted by z, then y. Within a bunch markers keep the order
// of the list, in which neighbours are close in space: rows that one marker has fetched
// are in the cache for the next
void Foam::markerSet::sort()
{
    const cellBox& box = grid_.box();
    const label n = X().size(), perLayer = box.size.y() / bunch_ + 1,
                nBunches = perLayer * (box.size.z() / bunch_ + 1);
    const positionRange whole(wholeInBlock()), clipped(freeOfWalls());
    const bool wide = box.size.x() >= rowSize(0) &&
                      box.size.y() >= rowSize(1) && box.size.z() >= rowSize(2);

    const label ofClipped = nBunches, ofCut = nBunches + 1;
    labelList start(nBunches + 3, Zero), bin(n);
    vectorField position(n);
    for (label k = 0; k < n; ++k)
    {
        const vector& x = position[k] = inCells(X()[k]);
        if (whole.contains(x))
        {
            bin[k] = label(x.y() - box.lo.y()) / bunch_ +
                     perLayer * layerOfBunches(x);
            ++start[bin[k] + 1];
        }
        else if (wide && clipped.contains(x))
        {
            bin[k] = ofClipped;
            eachImage(x, [&](const vector&) { ++start[ofClipped + 1]; });
        }
        else
        {
            bin[k] = ofCut;
            ++start[ofCut + 1];
        }
    }
    for (label b = 1; b < start.size(); ++b)
    {
        start[b] += start[b - 1];
    }
    nWhole_ = start[ofClipped];
    nClipped_ = start[ofCut] - nWhole_;
    sorted_.resize(start.last());
    positions_.resize(start.last());
    for (label k = 0; k < n; ++k)
    {
        const auto put = [&](const vector& x)
        {
            const label to = start[bin[k]]++;
            sorted_[to] = k;
            positions_[to] = x;
        };
        if (bin[k] == ofClipped)
            eachImage(position[k], put);
        else
            put(position[k]);
    }
}

void Foam::markerSet::interpolate(const List<staggeredView>& u,
                                  vectorField& U) const
{
    scatterThenGather(vectorField(), {}, u, U);
}

void Foam::markerSet::spread(const vectorField& F,
                             const staggeredTarget& f) const
{
    vectorField none;
    scatterThenGather(F, {f}, {}, none);
}

void Foam::markerSet::spreadAndInterpolate(const vectorField& F,
                                           const staggeredTarget& f,
                                           const List<staggeredView>& u,
                                           vectorField& U) const
{
    scatterThenGather(F, {f}, u, U);
}

// Forces go from the owners of the markers to the copies, velocities back to the owners
void Foam::markerSet::scatterThenGather(const vectorField& F,
                                        const List<staggeredTarget>& f,
                                        const List<staggeredView>& u,
                                        vectorField& U) const
{
    if (u.size()) U.setSize(size());
    if (!Pstream::parRun())
    {
        sweep(F, f, u, U);
        return;
    }
    const auto numbers = [](const UList<vector>& v)
    { return reinterpret_cast<const scalar*>(v.cdata()); };
    scalarField forces, values(u.size() ? 3 * X().size() : 0);
    if (f.size()) forces = copies_.handOut(numbers(F), 3);
    const label n = X().size();
    const UList<vector> forcesHere(reinterpret_cast<vector*>(forces.data()),
                                   f.size() ? n : 0);
    UList<vector> valuesHere(reinterpret_cast<vector*>(values.data()),
                             u.size() ? n : 0);
    sweep(forcesHere, f, u, valuesHere);
    if (u.empty()) return;
    U = Zero;
    copies_.addUp(values, 3, reinterpret_cast<scalar*>(U.data()));
}
