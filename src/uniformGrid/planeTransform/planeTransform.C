// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "planePlans.H"

namespace
{
using namespace Foam;

//- First of the items that rank holds when n are dealt to all ranks
label firstOf(const label n, const label rank)
{
    return planeTransform::firstDealt(n, rank, Pstream::nProcs());
}

//- The rank that holds item i of n
label rankOf(const label n, const label i)
{
    label rank = (i * Pstream::nProcs()) / n;
    while (firstOf(n, rank) > i)
    {
        --rank;
    }
    while (firstOf(n, rank + 1) <= i)
    {
        ++rank;
    }
    return rank;
}

//- The direction that leaves most cells on their rank, as their plane is dealt to it; the
//  given one if it is as good as another (collective)
direction sweptByCut(const uniformGrid& grid, const List<labelVector>& cells,
                     const direction given)
{
    labelList own(3, Zero);
    const label me = Pstream::myProcNo();
    for (direction d = 0; d < 3; ++d)
    {
        const label n = grid.n()[d], begin = firstOf(n, me),
                    end = firstOf(n, me + 1);
        for (const labelVector& c : cells)
        {
            own[d] += c[d] >= begin && c[d] < end;
        }
        reduce(own[d], sumOp<label>());
    }
    direction best = given;
    for (const direction d : {2, 1, 0})
    {
        if (grid.n()[d] > 1 && own[d] > own[best]) best = d;
    }
    return best;
}
} // namespace

Foam::FixedList<Foam::sideConditions, 3> Foam::sidesOf(const uniformGrid& grid,
                                                       const bool zeroOnWalls)
{
    FixedList<sideConditions, 3> sides;
    for (direction d = 0; d < 3; ++d)
    {
        sides[d].periodic = grid.periodic(d);
        sides[d].lowerDirichlet = sides[d].upperDirichlet =
            zeroOnWalls && !grid.periodic(d);
    }
    return sides;
}

// A walled direction: its sine and cosine transforms cost twice a periodic one. y first,
// as walls usually are there
Foam::direction Foam::planeTransform::swept(const labelVector& n,
                                            const FixedList<bool, 3>& periodic)
{
    direction third = 0;
    for (const direction d : {2, 0, 1})
    {
        const bool walled = !periodic[d] && n[d] > 1;
        const bool longer = n[d] >= n[third];
        if (walled || (periodic[third] && longer)) third = d;
    }
    return third;
}

Foam::planeTransform::planeTransform(const uniformGrid& grid,
                                     const FixedList<sideConditions, 3>& sides,
                                     const labelUList& indices)
    : plans_(new plans)
{
    const List<labelVector> cells(grid.cells());
    setDirections(grid, sides, cells);

    // Columns are transformed by twos: one of zeros follows an odd number
    complexModes = sides[slow].periodic && sides[fast].periodic;
    nColumns_ = nFast + nFast % 2;
    nSlowModes = complexModes ? nSlow / 2 + 1 : nSlow;
    rowLength = complexModes ? 2 * nColumns_ : rowOfValues();
    planeSize_ = max(nSlowModes * rowLength, nSlow * rowOfValues());

    const label me = Pstream::myProcNo();
    firstPlane = firstOf(nThird, me);
    nPlanes = firstOf(nThird, me + 1) - firstPlane;
    plans_->planes = zeros(nPlanes * planeSize_);
    makeExchange(cells, indices);
    makePlans(sides[slow], sides[fast]);
}

void Foam::planeTransform::setDirections(
    const uniformGrid& grid, const FixedList<sideConditions, 3>& sides,
    const List<labelVector>& cells)
{
    FixedList<bool, 3> periodic;
    for (direction d = 0; d < 3; ++d)
    {
        periodic[d] = sides[d].periodic;
    }
    third = swept(grid.n(), periodic);
    if (periodic[0] && periodic[1] && periodic[2] && Pstream::parRun())
    {
        third = sweptByCut(grid, cells, third);
    }
    for (direction d = 0; d < 3; ++d)
    {
        if (sides[d].faces) third = d;
    }
    fast = third == 0 ? 2 : 0;
    slow = 3 - third - fast;
    nFast = grid.n()[fast];
    nSlow = grid.n()[slow];
    nThird = grid.n()[third];
}

// Memory of the values: [third][slow][fast], with room for the modes of a plane. Values
// that stay on this rank move plane by plane unless the planes lie across the rows of
// memory
void Foam::planeTransform::makeExchange(const List<labelVector>& cells,
                                        const labelUList& indices)
{
    const label me = Pstream::myProcNo();
    std::vector<DynamicList<label>> ownSource(nPlanes), ownTarget(nPlanes);
    DynamicList<label> rank, target, source;
    forAll(cells, celli)
    {
        const labelVector& c = cells[celli];
        const label to = rankOf(nThird, c[third]);
        const label plane = c[third] - firstOf(nThird, to);
        const bool own = to == me && third != 0;
        const label from = indices.size() ? indices[celli] : celli;
        const label position =
            c[fast] + rowOfValues() * c[slow] + (own ? 0 : planeSize_ * plane);
        if (!own) rank.append(to);
        (own ? ownSource[plane] : source).append(from);
        (own ? ownTarget[plane] : target).append(position);
    }
    toPlanes_.reset(new indexExchange(rank, target, source));
    toPlane_.resize(nPlanes);
    for (label p = 0; p < nPlanes; ++p)
    {
        toPlane_[p].keep(ownSource[p], ownTarget[p]);
    }
}

Foam::planeTransform::~planeTransform() {}

double* Foam::planeTransform::plane(const label k)
{
    return plans_->planes + k * planeSize_;
}

void Foam::planeTransform::forward(const scalar* x)
{
    toPlanes_->forward(x, plans_->planes);

    // From the last plane on, which the last transform back has left in the cache
    for (label k = nPlanes - 1; k >= 0; --k)
    {
        toPlane_[k].forward(x, plane(k));
        transform(plane(k));
    }
}

void Foam::planeTransform::backward(scalar* x)
{
    for (label k = 0; k < nPlanes; ++k)
    {
        transformBack(plane(k));
        toPlane_[k].backward(plane(k), x);
    }
    toPlanes_->backward(plans_->planes, x);
}

Foam::planeTransform::rows Foam::planeTransform::dealtTo(const label rank) const
{
    const label first = firstOf(nSlowModes, rank);
    return {first, firstOf(nSlowModes, rank + 1) - first};
}
