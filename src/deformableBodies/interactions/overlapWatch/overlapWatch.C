// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "overlapWatch.H"
#include "dictionaryChecks.H"
#include "lastStep.H"

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

void Foam::overlapWatch::begin()
{
    if (stepIndex(time_) != step_) settle();
    step_ = stepIndex(time_);
    now_.time = time_.value();
    touching_.clear();
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
        else if (x.radius == 0 && y.radius == 0)
        {
            // Surfaces that cross have points of which some are closer to each other
            // than half the sides of the squares that they stand for
            if (sqr(apart) < 0.25 * max(x.size, y.size))
                touching_.append({p.first, p.second});
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
    for (const label k : touching_)
    {
        here[k] = 1;
    }
    pairs.addUp(here, 1, own.data());
    return own;
}

void Foam::overlapWatch::lookBehind(const closePairs& pairs,
                                    const UList<vector>& own)
{
    const vectorField areas(pairs.handOut(own));
    for (const closePairs::pair& p : pairs.pairs())
    {
        const vector &n = areas[p.first], &m = areas[p.second];
        if ((n & m) == 0) continue;
        const label first = bodyOf(pairs, p.first),
                    second = bodyOf(pairs, p.second);
        const scalar apart = max(mag(p.r), VSMALL),
                     ofFirst = (n & p.r) / (mag(n) * apart),
                     ofSecond = (m & p.r) / (mag(m) * apart);

        // Either point lies behind the other's surface, or that of a nucleus outside its
        // host
        const bool alike = (n & m) > 0;
        const bool crosses = hostOf_(first) == second ? alike && ofSecond > 0.5
                             : hostOf_(second) == first
                                 ? alike && ofFirst < -0.5
                                 : !alike && ofSecond < -0.5 && ofFirst > 0.5;
        if (crosses) include(apart, pairs, p);
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

void Foam::overlapWatch::judge()
{
    settle();
    const string where(describe(all_));
    if (where.empty()) return;

    // Several ranks may know one pair
    List<labelList> ofRanks(Pstream::nProcs());
    labelList& own = ofRanks[Pstream::myProcNo()];
    for (const auto& pair : all_.pairs)
    {
        own.append(labelList({pair.first, pair.second}));
    }
    Pstream::gatherList(ofRanks);
    if (!Pstream::master()) return;
    std::set<std::pair<label, label>> pairs;
    for (const labelList& numbers : ofRanks)
    {
        for (label n = 0; n < numbers.size(); n += 2)
        {
            pairs.insert({numbers[n], numbers[n + 1]});
        }
    }
    WarningInFunction << "pairs of bodies, or of bodies and walls, that "
                      << "overlapped in this run: " << label(pairs.size())
                      << "; deepest: " << where.c_str() << endl;
}
