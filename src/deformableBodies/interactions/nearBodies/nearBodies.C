// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "nearBodies.H"
#include "periodicBox.H"

Foam::nearBodies::nearBodies(const uniformGrid& grid, const boxWalls& walls,
                             const scalar range)
    : grid_(grid),
      walls_(walls),
      range_(range),
      neighbours_(grid),
      boxes_(neighbours_)
{
}

Foam::boolList Foam::nearBodies::nearOthers(const UList<boundBox>& boxes,
                                            const scalar reach)
{
    vectorField centres(boxes.size());
    scalarField facts(4 * boxes.size()); // half the sides, number of the body
    scalar largest = 0;
    label away = 0; // layers of cells from the block of this rank to a centre
    forAll(boxes, k)
    {
        const vector half(0.5 * boxes[k].span());
        centres[k] = boxes[k].midpoint();
        std::copy(half.begin(), half.end(), &facts[4 * k]);
        facts[4 * k + 3] = bodies_[k].number;
        largest = max(largest, cmptMax(half));
        away = max(away, neighbours_.away(grid_.cellAt(centres[k])));
    }
    reduce(largest, maxOp<scalar>());
    reduce(away, maxOp<label>());

    // All boxes that may be near one of this rank, in bins
    boxes_.route(centres, grid_.layersWithin(2 * largest + reach) + away);
    const scalarField factsHere(boxes_.handOut(facts.cdata(), 4));
    const UList<vector>& here = boxes_.here();
    const pointBins bins(grid_, 2 * largest + reach, here.size());
    List<DynamicList<label>> inBin(bins.count());
    forAll(here, k)
    {
        inBin[bins.numberOf(here[k])].append(k);
    }
    boolList near(boxes.size(), false);
    forAll(near, i)
    {
        bool& found = near[i];
        const auto compareWith = [&](const label bin)
        {
            for (const label k : inBin[bin])
            {
                if (found) return;
                const scalar *a = &facts[4 * i], *b = &factsHere[4 * k];
                const vector r(nearestImage(grid_, centres[i], here[k]));
                found = a[3] != b[3] && mag(r.x()) < a[0] + b[0] + reach &&
                        mag(r.y()) < a[1] + b[1] + reach &&
                        mag(r.z()) < a[2] + b[2] + reach;
            }
        };
        bins.eachNext(bins.numberOf(centres[i]), compareWith);
    }
    return near;
}

bool Foam::nearBodies::isOld()
{
    const scalar way = returnReduce(displacement_, maxOp<scalar>());
    displacement_ = 0;
    if (way > 0) lastTravel_ = way;
    travelled_ += way;
    return !(travelled_ <= 0.5 * skin()); // not a number is old
}

void Foam::nearBodies::compare(const std::vector<body>& bodies,
                               const UList<boundBox>& boxes)
{
    bodies_ = bodies;
    index_.clear();

    // Points of contact may be a step ahead
    const scalar reach = range_ + skin() + 2 * lastTravel_;
    const boolList nearOther(nearOthers(boxes, reach));
    any_ = false;
    forAll(boxes, k)
    {
        body& b = bodies_[k];
        index_[b.number] = k;
        vector inward;
        b.nearWall = walls_.distance(boxes[k].min(), inward) < reach ||
                     walls_.distance(boxes[k].max(), inward) < reach;
        b.near = b.folded || b.nearWall || nearOther[k];
        any_ = any_ || b.near;
    }
    reduce(any_, orOp<bool>());
    if (travelled_ <= 0.5 * skin()) return;
    travelled_ = 0;
    anyByMotion_ = any_;
}
