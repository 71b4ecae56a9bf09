// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "startChecks.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "ofAllRanks.H"
#include "periodicBox.H"
#include "pointBins.H"
#include "segmentDistance.H"

namespace
{
using namespace Foam;

//- Part of the solid angle around x that a closed surface fills: 1 inside
scalar enclosure(const bodyPoints& surface, const point& x)
{
    scalar angle = 0;
    forAll(surface.positions, k)
    {
        const vector r(surface.positions[k] - x);
        angle += (surface.areas[k] & r) / (pow3(mag(r)) + VSMALL);
    }
    return angle / (4 * constant::mathematical::pi);
}

//- Some points of a body: about n of a surface, or points of a line at most apart [m]
pointField someOf(const bodyPoints& body, const label n, const scalar apart)
{
    DynamicList<point> points;
    const vectorField& X = body.positions;
    if (body.isSurface())
    {
        const label step = max(label(1), X.size() / n);
        for (label k = 0; k < X.size(); k += step)
        {
            points.append(X[k]);
        }
    }
    else
    {
        points.append(X[0]);
        for (label k = 1; k < X.size(); ++k)
        {
            const label parts = label(mag(X[k] - X[k - 1]) / apart) + 1;
            for (label j = 1; j <= parts; ++j)
            {
                points.append(X[k - 1] + scalar(j) / parts * (X[k] - X[k - 1]));
            }
        }
    }
    return pointField(std::move(points));
}

//- Ways in which two bodies lie in one place
enum class meeting
{
    none,
    cross,
    surround,
    overlap
};

meeting meetingOf(const bodyPoints& a, const bodyPoints& b, const scalar h)
{
    if (!a.isSurface() && !b.isSurface())
    {
        const scalar thickness =
            (std::sqrt(a.crossSection) + std::sqrt(b.crossSection)) /
            std::sqrt(constant::mathematical::pi);
        for (label i = 1; i < a.positions.size(); ++i)
        {
            for (label j = 1; j < b.positions.size(); ++j)
            {
                if (mag(connection(a.positions[i - 1], a.positions[i],
                                   b.positions[j - 1], b.positions[j])) <
                    thickness)
                {
                    return meeting::overlap;
                }
            }
        }
        return meeting::none;
    }
    for (const bool first : {true, false})
    {
        const bodyPoints &outer = first ? a : b, &inner = first ? b : a;
        if (!outer.isSurface()) continue;
        const boundBox box(outer.positions, false);
        label in = 0, out = 0;
        for (const point& x : someOf(inner, 200, h))
        {
            const scalar e = box.contains(x) ? enclosure(outer, x) : 0;
            if (e > 0.3) ++in;
            if (e < 0.7) ++out;
            if (in && out) return meeting::cross;
        }
        if (in) return meeting::surround;
    }
    return meeting::none;
}
} // namespace

Foam::DynamicList<Foam::startChecks::startingBody>
Foam::startChecks::bodies() const
{
    DynamicList<startingBody> all;
    DynamicList<label> continuing;
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!returnReduce(group.startsAfresh(), orOp<bool>()))
        {
            continuing.append(g);
            continue;
        }
        scalar radius = 0;
        bool alike = false; // capsules of a group are
        for (label body = 0; body < group.nBodies(); ++body)
        {
            const point centre(group.initialCentre(body));
            if (!alike)
            {
                const bodyPoints p(group.initialPoints(body));
                radius = std::sqrt(max(magSqr(p.positions - centre)));
                radius += std::sqrt(p.crossSection);
                alike = p.isSurface();
            }
            all.append(startingBody{g, body, centre, radius, true});
        }
    }
    for (label k = 0; k < continuing.size() && all.size(); ++k)
    {
        appendContinuing(continuing[k], all);
    }
    return all;
}

void Foam::startChecks::appendContinuing(const label g,
                                         DynamicList<startingBody>& all) const
{
    const bodyGroup& group = groups_[g];
    if (!group.points(-1).isSurface()) return;
    DynamicList<scalar> here;
    forAll(group.mine(), i)
    {
        const point centre(group.centre(i));
        const vectorField X(group.points(i).positions - centre);
        here.append(group.mine()[i]);
        for (direction d = 0; d < 3; ++d)
        {
            here.append(centre[d]);
        }
        here.append(std::sqrt(max(magSqr(X))));
    }
    for (const scalarList& of : ofAllRanks(scalarList(here)))
    {
        for (label k = 0; k + 4 < of.size(); k += 5)
        {
            all.append(startingBody{g, label(of[k]),
                                    point(of[k + 1], of[k + 2], of[k + 3]),
                                    of[k + 4], false});
        }
    }
}

void Foam::startChecks::checkPair(const startingBody& a, const startingBody& b)
{
    vector apart(b.centre - a.centre);
    const vector image(shift(grid_, apart));
    apart += image;
    if (mag(apart) >= a.radius + b.radius) return;
    const bodyGroup &g = groups_[a.group], &k = groups_[b.group];
    if (a.number == b.number && (g.host() == b.group || k.host() == a.group))
    {
        return;
    }
    if (!a.starts && !b.starts) return;
    if (!a.starts || !b.starts)
    {
        if (!g.points(-1).isSurface() || !k.points(-1).isSurface()) return;
        warnings_.note(
            g.nameOfBody(a.number), a.centre, k.nameOfBody(b.number), b.centre,
            "may cross, which is not looked at: one of them continues");
        return;
    }
    const scalar h = cmptMin(grid_.h());
    const bodyPoints p(g.initialPoints(a.number));
    bodyPoints q(k.initialPoints(b.number));
    q.positions += image;
    const bool onePlace = a.group == b.group && mag(apart) < 1e-6 * h;
    const meeting m =
        onePlace && p.isSurface() ? meeting::cross : meetingOf(p, q, h);
    if (m == meeting::none) return;
    findings& found =
        m == meeting::cross && g.twoWay() && k.twoWay() ? errors_ : warnings_;
    found.note(g.nameOfBody(a.number), a.centre, k.nameOfBody(b.number),
               b.centre,
               onePlace                 ? "lie in one place"
               : m == meeting::cross    ? "cross each other"
               : m == meeting::surround ? "lie one within the other"
                                        : "are closer than their diameters");
}

void Foam::startChecks::findings::note(const string& a, const point& at,
                                       const string& b, const point& bAt,
                                       const char* what)
{
    if (n++) return;
    OStringStream os;
    os.precision(6);
    os << a.c_str() << " at " << at << " and " << b.c_str() << " at " << bAt
       << ' ' << what;
    first = os.str();
}

void Foam::startChecks::check(const dictionary& dict)
{
    const DynamicList<startingBody> bodies(this->bodies());
    if (bodies.size() < 2) return;
    scalar largest = 0;
    for (const startingBody& b : bodies)
    {
        largest = max(largest, b.radius);
    }
    const pointBins bins(grid_, 2 * largest, bodies.size());
    List<DynamicList<label>> inBin(bins.count());
    forAll(bodies, b)
    {
        inBin[bins.numberOf(bodies[b].centre)].append(b);
    }
    forAll(bodies, b)
    {
        // Each pair is checked by the rank of the second
        const startingBody& body = bodies[b];
        if (!groups_[body.group].mine().found(body.number)) continue;
        const auto checkWith = [&](const label bin)
        {
            for (const label other : inBin[bin])
            {
                if (other < b) checkPair(bodies[other], body);
            }
        };
        bins.eachNext(bins.numberOf(body.centre), checkWith);
    }

    reduce(warnings_.n, sumOp<label>());
    if (warnings_.n)
    {
        IOWarningInFunction(dict)
            << firstOf(warnings_.first).c_str()
            << " (such pairs: " << warnings_.n << ")" << nl
            << "    Where they touch or cross the fluid between them is not "
               "resolved"
            << endl;
    }
    reduce(errors_.n, sumOp<label>());
    if (errors_.n)
    {
        waitForMaster();
        FatalIOErrorInFunction(dict)
            << "entry positions: " << firstOf(errors_.first).c_str()
            << " (such pairs: " << errors_.n << ")" << nl
            << "    allowed: bodies beside each other or one within the other, "
            << "or coupling oneWay, which rigid bodies do not have; groups "
            << "with positions before those with placement, which keeps clear "
            << "of groups before it" << exit(FatalIOError);
    }
}
