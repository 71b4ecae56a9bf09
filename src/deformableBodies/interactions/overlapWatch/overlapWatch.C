// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "overlapWatch.H"
#include "dictionaryChecks.H"
#include "lastStep.H"
#include "ofAllRanks.H"
#include <map>

namespace
{
using namespace Foam;

//- For each point that is held, the nearest point of each other body, among pairs to be
//  looked at; first is the point
template<class LookAt>
std::map<labelPair, closePairs::pair> nearest(const closePairs& pairs,
                                              LookAt lookAt)
{
    std::map<labelPair, closePairs::pair> all;
    const auto include = [&](const closePairs::pair& p)
    {
        if (!lookAt(p)) return;
        closePairs::pair& next =
            all.insert({labelPair(p.first, pairs.body()[p.second]), p})
                .first->second;
        if (magSqr(p.r) < magSqr(next.r)) next = p;
    };
    for (const closePairs::pair& p : pairs.pairs())
    {
        include(p);
        if (p.bothHeld) include({p.second, p.first, true, -p.r});
    }
    return all;
}
} // namespace

void Foam::overlapWatch::overlaps::include(const scalar deep, const label first,
                                           const label second, const point& x)
{
    pairs.insert({max(first, second), min(first, second)});
    if (deep <= depth) return;
    depth = deep;
    body = first;
    other = second;
    position = x;
}

Foam::overlapWatch::overlapWatch(const Time& time,
                                 const std::function<string(label)>& nameOf,
                                 const std::function<label(label)>& hostOf,
                                 const bool linesKeptApart)
    : time_(time),
      nameOf_(nameOf),
      hostOf_(hostOf),
      linesKeptApart_(linesKeptApart),
      rarely_(warnRarely::once)
{
}

std::set<std::pair<Foam::label, Foam::label>>
Foam::overlapWatch::ofAll(const std::set<std::pair<label, label>>& own)
{
    labelList numbers;
    for (const auto& pair : own)
    {
        numbers.append(labelList({pair.first, pair.second}));
    }
    std::set<std::pair<label, label>> all;
    for (const labelList& of : ofAllRanks(numbers))
    {
        for (label k = 0; k < of.size(); k += 2)
        {
            all.insert({of[k], of[k + 1]});
        }
    }
    return all;
}

void Foam::overlapWatch::begin()
{
    if (stepIndex(time_) != step_) settle();
    step_ = stepIndex(time_);
    now_.time = time_.value();
    closest_ = GREAT;
    nPairs_ = 0;
}

Foam::label Foam::overlapWatch::bodyOf(const closePairs& pairs,
                                       const label point)
{
    const label number = pairs.body()[point];
    return number < 0 ? -1 - number : number;
}

void Foam::overlapWatch::include(const scalar depth, const closePairs& pairs,
                                 const closePairs::pair& p)
{
    now_.include(depth, bodyOf(pairs, p.first), bodyOf(pairs, p.second),
                 pairs.here()[p.first]);
}

void Foam::overlapWatch::look(const closePairs& pairs,
                              const UList<interactingPoint>& points)
{
    touching_.clear();
    for (const closePairs::pair& p : pairs.pairs())
    {
        nPairs_ += p.bothHeld ? 2 : 1;
        const scalar apart = mag(p.r);
        closest_ = min(closest_, apart);
        const interactingPoint &x = points[p.first], &y = points[p.second];
        if (x.radius > 0 && y.radius > 0)
        {
            const scalar both = x.radius + y.radius;
            if (linesKeptApart_ && apart < 0.9 * both)
                include(both - apart, pairs, p);
        }
        else
        {
            // Surfaces that cross have points of which some are closer to each other
            // than 0.4 of their spacing; those of a fibre through a surface are closer
            // than the spacing
            const bool surfaces = x.radius == 0 && y.radius == 0;
            if (apart < (surfaces ? 0.4 : 1.0) * max(x.spacing, y.spacing))
            {
                touching_.append(labelPair(p.first, p.second));
            }
        }
    }
}

bool Foam::overlapWatch::surfacesTouch() const
{
    return returnReduce(!touching_.empty(), orOp<bool>());
}

Foam::scalarField Foam::overlapWatch::touching(const closePairs& pairs,
                                               const label n) const
{
    scalarField here(pairs.here().size(), Zero), own(n, Zero);
    for (const labelPair& points : touching_)
    {
        here[points.first()] = here[points.second()] = 1;
    }
    pairs.addUp(here, 1, own.data());
    return own;
}

void Foam::overlapWatch::lookBehind(const closePairs& pairs,
                                    const UList<interactingPoint>& points,
                                    const UList<vector>& own)
{
    std::set<std::pair<label, label>> mine;
    for (const labelPair& near : touching_)
    {
        mine.insert(std::minmax(bodyOf(pairs, near.first()),
                                bodyOf(pairs, near.second())));
    }
    const std::set<std::pair<label, label>> bodies(ofAll(mine));
    const vectorField areas(pairs.handOut(own));
    lookAtSurfaces(pairs, points, areas, bodies);
    lookAtLines(pairs, areas);
}

void Foam::overlapWatch::lookAtSurfaces(
    const closePairs& pairs, const UList<interactingPoint>& points,
    const vectorField& areas, const std::set<std::pair<label, label>>& touching)
{
    // Normals are those of the place up to the spacing of the points only
    const auto lookAt = [&](const closePairs::pair& p)
    {
        const label first = bodyOf(pairs, p.first),
                    second = bodyOf(pairs, p.second);
        return mag(p.r) <=
                   max(points[p.first].spacing, points[p.second].spacing) &&
               (areas[p.first] & areas[p.second]) != 0 &&
               hostOf_(second) != first &&
               touching.count(std::minmax(first, second));
    };
    for (const auto& of : nearest(pairs, lookAt))
    {
        const closePairs::pair& p = of.second;
        const vector &n = areas[p.first], &m = areas[p.second];
        const scalar apart = max(mag(p.r), VSMALL);
        const scalar ofFirst = (n & p.r) / (mag(n) * apart),
                     ofSecond = (m & p.r) / (mag(m) * apart);

        // Either point lies behind the other's surface, or that of a nucleus outside its
        // host
        const bool alike = (n & m) > 0;
        const bool crosses =
            hostOf_(bodyOf(pairs, p.first)) == bodyOf(pairs, p.second)
                ? alike && ofSecond > 0.5
                : !alike && ofSecond < -0.5 && ofFirst > 0.5;
        if (crosses) include(apart, pairs, p);
    }
}

void Foam::overlapWatch::lookAtLines(const closePairs& pairs,
                                     const vectorField& areas)
{
    const labelList& body = pairs.body();
    const auto ofLines = nearest(pairs,
                                 [&](const closePairs::pair& p)
                                 {
                                     return body[p.first] >= 0 &&
                                            body[p.second] < 0 &&
                                            magSqr(areas[p.second]) > 0;
                                 });
    if (returnReduce(ofLines.empty(), andOp<bool>())) return;
    const auto cosine = [&](const closePairs::pair& p)
    {
        const vector& n = areas[p.second];
        return (n & p.r) / (mag(n) * max(mag(p.r), VSMALL));
    };

    // Points of a line may be held by several ranks: number of the line, of the surface,
    // and the side
    labelList mine;
    for (const auto& of : ofLines)
    {
        const closePairs::pair& p = of.second;
        if (mag(cosine(p)) < 0.5) continue;
        mine.append(
            labelList({body[p.first], body[p.second], label(cosine(p) > 0)}));
    }
    std::set<std::pair<label, label>> sides[2];
    for (const labelList& of : ofAllRanks(mine))
    {
        for (label k = 0; k < of.size(); k += 3)
        {
            sides[of[k + 2]].insert({of[k], of[k + 1]});
        }
    }
    for (const auto& of : ofLines)
    {
        const closePairs::pair& p = of.second;
        const std::pair<label, label> both(body[p.first], body[p.second]);
        if (cosine(p) < -0.5 && sides[0].count(both) && sides[1].count(both))
            include(mag(p.r), pairs, p);
    }
}

Foam::string Foam::overlapWatch::describe(const overlaps& all) const
{
    const scalar deepest = returnReduce(all.depth, maxOp<scalar>());
    string where;
    if (deepest == 0) return where;
    if (all.depth == deepest)
    {
        OStringStream os;
        os.precision(6);
        os << nameOf_(all.body).c_str() << " and "
           << (all.other < 0 ? string("a wall") : nameOf_(all.other)).c_str()
           << " overlap by " << deepest << " at " << all.position
           << ", at time " << all.time;
        where = os.str();
    }
    return firstOf(where);
}

void Foam::overlapWatch::settle()
{
    const overlaps last(now_);
    now_ = overlaps();
    std::set<std::pair<label, label>> pairs(std::move(all_.pairs));
    pairs.insert(last.pairs.begin(), last.pairs.end());
    if (last.depth > all_.depth) all_ = last;
    all_.pairs = std::move(pairs);
    if (!rarely_.due(step_)) return;
    const string where(describe(last));
    if (where.empty()) return;
    rarely_.warned(step_);
    if (Pstream::master())
    {
        WarningInFunction
            << where.c_str() << nl
            << "    Contact forces were too weak: take a larger strength or "
            << "range of interactions, or a smaller deltaT." << nl
            << "    All overlaps are summed up at the end" << endl;
    }
}

void Foam::overlapWatch::report()
{
    settle();
    const string where(describe(all_));
    if (where.empty()) return;

    const std::set<std::pair<label, label>> pairs(ofAll(all_.pairs));
    if (!Pstream::master()) return;
    WarningInFunction << "pairs of bodies, or of bodies and walls, that "
                      << "overlapped in this run: " << label(pairs.size())
                      << "; deepest: " << where.c_str() << endl;
}
