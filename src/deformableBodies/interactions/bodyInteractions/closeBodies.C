// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The forces of one step: points of bodies that are near others, their pairs, what the
// models say of them, and bodies that have got through each other

#include "bodyInteractions.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "warnRarely.H"

void Foam::bodyInteractions::update()
{
    const auto timing(effects_.time("interactions"));
    if (returnReduce(travelled_ > 0.5 * skin() || others(), orOp<bool>()))
    {
        compareBoxes();
    }
    nPairs_ = 0;
    closest_ = GREAT;
    power_ = 0;
    if (!anyNear_) return;

    parts_.clear();
    along_.clear();
    body_.clear();
    X_.clear();
    V_.clear();
    points_.clear();
    for (const bool surfaces : {true, false})
    {
        for (participant& p : bodies_)
        {
            if (isSurface(p.group) != surfaces) continue;
            p.first = X_.size();
            if (p.near) collect(p);
            p.size = X_.size() - p.first;
        }
        if (surfaces) firstOfLines_ = X_.size();
    }

    F_.F.setSize(X_.size());
    F_.F = Zero;
    if (resists()) F_.arms = F_.F;
    overlap deepest;
    if (surfacePairs_)
    {
        act(*surfacePairs_, SubList<label>(body_, firstOfLines_), {}, deepest);
    }
    if (linePairs_)
    {
        // Pairs of surfaces have a list of their own. Parts of a fibre that is not folded
        // cannot come within range before the boxes are compared again
        labelList body(body_);
        scalarField along(body.size(), -1);
        for (label k = 0; k < firstOfLines_; ++k)
        {
            body[k] = -1 - body[k];
        }
        std::copy(along_.begin(), along_.end(), along.begin() + firstOfLines_);
        linePoints_.shallowCopy(act(*linePairs_, body, along, deepest));
    }
    if (returnReduce(!deepest.touching.empty(), orOp<bool>()))
        lookBehind(deepest);

    for (const participant& p : bodies_)
    {
        for (label k = p.first; p.nearWall && k < p.first + p.size; ++k)
        {
            vector inward;
            const scalar distance = toWall(X_[k], inward);
            if (distance >= range_) continue;
            const scalar radius = points_[k].radius;
            scalar P = 0;
            for (const interactionModel& model : models_)
            {
                P += model.ofWall(distance - radius, radius == 0);
            }
            F_.F[k] += P * points_[k].size * inward;
            // Not a point that is held at the wall
            if (P > 0 && distance < 0.5 * radius && mag(V_[k]) > 0)
            {
                deepest.take(radius - distance, body_[k], -1, X_[k]);
            }
        }
    }
    warnOf(deepest);
    forAll(X_, k)
    {
        power_ += F_.F[k] & V_[k];
    }
    work_ += time_.deltaTValue() * power_;
}

void Foam::bodyInteractions::collect(const participant& p)
{
    const bodyGroup& group = groups_[p.group];
    const label body = firstBody_[p.group] + p.number;
    if (isSurface(p.group))
    {
        const scalarField& areas = areas_[p.group];
        const label first = X_.size(), n = areas.size();
        X_.setSize(first + n);
        V_.setSize(first + n);
        group.contactPoints(p.place, &X_[first], &V_[first]);
        if (group.forcing() != forcingType::none)
        {
            const scalar dt = time_.deltaTValue();
            for (label k = first; k < first + n; ++k)
            {
                X_[k] += dt * V_[k];
            }
        }
        body_.setSize(first + n, body);
        for (const scalar area : areas)
        {
            points_.append({area, 0});
        }
        return;
    }
    const bodyPoints points(group.points(p.place));
    const vectorField& v = points.velocities;
    const vectorField& x = points.places;
    interactingPoint point{
        0, std::sqrt(points.crossSection / constant::mathematical::pi)};
    const scalar h = cmptMax(grid_.h());
    const scalar apart = max(min(0.5 * h, 2 * point.radius), 0.1 * h);
    scalar before = 0;
    for (label k = 0; k + 1 < x.size(); ++k)
    {
        const scalar length = mag(x[k + 1] - x[k]);
        // Whatever the rounding of segments as long as a cell
        const label parts = label(std::ceil(length / apart * (1 - 1e-6)));
        for (label j = 0; j < parts; ++j)
        {
            point.size = length / parts * h;
            const scalar onward = (j + 0.5) / parts;
            parts_.append({k, onward, scalar(1) / parts});
            along_.append(p.folded ? before + onward * length : -1);
            X_.append((1 - onward) * x[k] + onward * x[k + 1]);
            V_.append((1 - onward) * v[k] + onward * v[k + 1]);
            points_.append(point);
            body_.append(body);
        }
        before += length;
    }
}

Foam::UList<Foam::interactingPoint>
Foam::bodyInteractions::act(closePairs& pairs, const labelUList& body,
                            const UList<scalar>& along, overlap& deepest)
{
    const label n = body.size();
    pairs.search(SubList<vector>(X_, n), body, along,
                 2 * (pairs.range() + skin()));
    const label nHere = pairs.here().size();
    if (Pstream::parRun())
    {
        copies_.setSize(nHere);
        const scalarField numbers(
            pairs.handOut(reinterpret_cast<const scalar*>(points_.cdata()),
                          sizeof(interactingPoint) / sizeof(scalar)));
        std::copy(numbers.begin(), numbers.end(),
                  reinterpret_cast<scalar*>(copies_.data()));
    }
    const UList<interactingPoint> points(
        Pstream::parRun() ? copies_.data() : points_.data(), nHere);
    look(pairs, points, deepest);

    vectorField atCopies(Pstream::parRun() ? nHere : 0, Zero);
    vectorField& F = Pstream::parRun() ? atCopies : F_.F;
    for (const interactionModel& model : models_)
    {
        const auto timing(effects_.time(model.type()));
        model.add(pairs, points, F);
    }
    if (Pstream::parRun()) pairs.addUp(F, F_.F);
    return points;
}

void Foam::bodyInteractions::look(const closePairs& pairs,
                                  const UList<interactingPoint>& points,
                                  overlap& deepest)
{
    bool linesActOn = false;
    for (const interactionModel& model : models_)
    {
        linesActOn = linesActOn || model.range(false, false) > 0;
    }
    for (const closePairs::pair& p : pairs.pairs())
    {
        nPairs_ += p.bothHeld ? 2 : 1;
        const scalar apart = mag(p.r);
        closest_ = min(closest_, apart);
        const interactingPoint &x = points[p.first], &y = points[p.second];
        if (x.radius > 0 && y.radius > 0)
        {
            // Where something keeps them apart
            const scalar both = x.radius + y.radius;
            if (linesActOn && apart < 0.9 * both)
                deepest.take(both - apart, pairs, p);
        }
        else if (x.radius == 0 && y.radius == 0)
        {
            // Surfaces that cross have points of which some are closer to each other
            // than half the sides of the squares that they stand for
            if (sqr(apart) < 0.25 * max(x.size, y.size))
                deepest.touching.append({p.first, p.second});
        }
    }
}

void Foam::bodyInteractions::lookBehind(overlap& deepest) const
{
    const closePairs& pairs = *surfacePairs_;
    scalarField touching(pairs.here().size(), Zero),
        ownTouching(firstOfLines_, Zero);
    for (const label k : deepest.touching)
    {
        touching[k] = 1;
    }
    pairs.addUp(touching, 1, ownTouching.data());
    vectorField own(firstOfLines_, Zero);
    for (const participant& p : bodies_)
    {
        if (!isSurface(p.group) ||
            sum(SubField<scalar>(ownTouching, p.size, p.first)) == 0)
        {
            continue;
        }
        SubField<vector>(own, p.size, p.first) =
            groups_[p.group].points(p.place).areas;
    }
    const vectorField areas(pairs.handOut(own));
    for (const closePairs::pair& p : pairs.pairs())
    {
        // Either lies behind the other's surface, both seen
        const vector &n = areas[p.first], &m = areas[p.second];
        const scalar apart = mag(p.r);
        if ((n & m) < 0 && (m & p.r) < -0.5 * mag(m) * apart &&
            (n & p.r) > 0.5 * mag(n) * apart)
        {
            deepest.take(apart, pairs, p);
        }
    }
}

void Foam::bodyInteractions::overlap::take(const scalar deep, const label first,
                                           const label second, const point& x)
{
    twos.insert({max(first, second), min(first, second)});
    if (deep <= depth) return;
    depth = deep;
    body = first;
    other = second;
    at = x;
}

void Foam::bodyInteractions::overlap::take(const scalar deep,
                                           const closePairs& pairs,
                                           const closePairs::pair& p)
{
    const auto bodyOf = [&](const label k)
    {
        const label number = pairs.body()[k];
        return number < 0 ? -1 - number : number;
    };
    take(deep, bodyOf(p.first), bodyOf(p.second), pairs.here()[p.first]);
}

Foam::string Foam::bodyInteractions::describe(const overlap& deepest) const
{
    const scalar all = returnReduce(deepest.depth, maxOp<scalar>());
    string where;
    if (all == 0) return where;
    if (deepest.depth == all)
    {
        OStringStream os;
        os.precision(6);
        os << nameOf(deepest.body).c_str() << " and "
           << (deepest.other < 0 ? string("a wall") : nameOf(deepest.other))
                  .c_str()
           << " overlap by " << all << " at " << deepest.at << ", at time "
           << deepest.time;
        where = os.str();
    }
    return firstOf(where);
}

void Foam::bodyInteractions::warnOf(overlap& deepest)
{
    deepest.time = time_.value();
    overlaps_.twos.insert(deepest.twos.begin(), deepest.twos.end());
    if (deepest.depth > overlaps_.depth)
    {
        deepest.twos.swap(overlaps_.twos);
        overlaps_ = deepest;
    }
    if (warned_) return;
    const string where(describe(deepest));
    if (where.empty()) return;
    warned_ = true;
    if (Pstream::master())
    {
        WarningInFunction
            << where.c_str() << nl
            << "    Contact forces were too weak: take a larger strength or "
            << "range of interactions, or a smaller deltaT." << nl
            << "    All overlaps are summed up at the end" << endl;
    }
}

void Foam::bodyInteractions::judge() const
{
    const string where(describe(overlaps_));
    if (where.empty()) return;

    // Ranks may know the same
    List<labelList> ofRanks(Pstream::nProcs());
    labelList& mine = ofRanks[Pstream::myProcNo()];
    for (const auto& two : overlaps_.twos)
    {
        mine.append(labelList({two.first, two.second}));
    }
    Pstream::gatherList(ofRanks);
    if (!Pstream::master()) return;
    std::set<std::pair<label, label>> all;
    for (const labelList& numbers : ofRanks)
    {
        for (label n = 0; n < numbers.size(); n += 2)
        {
            all.insert({numbers[n], numbers[n + 1]});
        }
    }
    WarningInFunction << "pairs of bodies, or of bodies and walls, that "
                      << "overlapped in this run: " << label(all.size())
                      << "; deepest: " << where.c_str() << endl;
}
