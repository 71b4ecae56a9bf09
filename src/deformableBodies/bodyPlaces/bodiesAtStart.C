// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Bodies that lie in one place at the start

#include "bodyPlaces.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include <unordered_map>

namespace
{
using namespace Foam;

//- A body at the start, and the sphere around it
struct startingBody
{
    label group, number;
    point centre;
    scalar radius;
};

//- How much of the solid angle around x a closed surface fills: 1 inside
scalar enclosure(const bodyPoints& surface, const point& x)
{
    scalar angle = 0;
    forAll(surface.places, k)
    {
        const vector r(surface.places[k] - x);
        angle += (surface.areas[k] & r) / (pow3(mag(r)) + VSMALL);
    }
    return angle / (4 * constant::mathematical::pi);
}

//- Points of a body, about n of a surface; of a line at most this far apart
pointField someOf(const bodyPoints& body, const label n, const scalar apart)
{
    DynamicList<point> points;
    const vectorField& X = body.places;
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

//- Shortest distance of the segments a-b and c-d
scalar distance(const point& a, const point& b, const point& c, const point& d)
{
    const vector u(b - a), v(d - c), w(a - c);
    const scalar uu = u & u, uv = u & v, vv = v & v, uw = u & w, vw = v & w;
    const scalar det = uu * vv - uv * uv;
    scalar s = det > 1e-12 * uu * vv ? (uv * vw - vv * uw) / det : 0;
    s = min(max(s, scalar(0)), scalar(1));
    const scalar t = min(max((uv * s + vw) / vv, scalar(0)), scalar(1));
    s = min(max((uv * t - uw) / uu, scalar(0)), scalar(1));
    return mag(w + s * u - t * v);
}

//- What two bodies do that they cannot, or nothing
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
        for (label i = 1; i < a.places.size(); ++i)
        {
            for (label j = 1; j < b.places.size(); ++j)
            {
                if (distance(a.places[i - 1], a.places[i], b.places[j - 1],
                             b.places[j]) < thickness)
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
        const boundBox box(outer.places, false);
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

void Foam::bodyPlaces::checkStart(const dictionary& dict) const
{
    // All bodies of groups that start afresh, as all ranks know them
    DynamicList<startingBody> bodies;
    scalar largest = 0;
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!returnReduce(group.startsAfresh(), orOp<bool>())) continue;
        scalar radius = 0;
        bool alike = false; // capsules of a group are
        for (label body = 0; body < group.nBodies(); ++body)
        {
            const point centre(group.initialCentre(body));
            if (!alike)
            {
                const bodyPoints p(group.initialPoints(body));
                radius = std::sqrt(max(magSqr(p.places - centre)));
                radius += std::sqrt(p.crossSection);
                alike = p.isSurface();
            }
            bodies.append(startingBody{g, body, centre, radius});
            largest = max(largest, radius);
        }
    }
    if (bodies.size() < 2) return;

    // In bins no smaller than the largest body
    const vector L(grid_.length());
    label n[3];
    for (direction d = 0; d < 3; ++d)
    {
        n[d] = max(label(1), label(min(scalar(1000), L[d] / (2 * largest))));
    }
    const auto binAt = [&](const point& x, const direction d)
    {
        const label b =
            label(std::floor((x[d] - grid_.origin()[d]) / L[d] * n[d]));
        return min(max(b, label(0)), n[d] - 1);
    };
    std::unordered_map<label, DynamicList<label>> bins;
    const auto key = [&](const label i, const label j, const label k)
    { return i + n[0] * (j + n[1] * k); };
    forAll(bodies, b)
    {
        const point& x = bodies[b].centre;
        bins[key(binAt(x, 0), binAt(x, 1), binAt(x, 2))].append(b);
    }

    const scalar h = cmptMin(grid_.h());
    label nErrors = 0, nWarnings = 0;
    string error, warning;
    const auto judgePair = [&](const startingBody& a, const startingBody& b)
    {
        vector apart(b.centre - a.centre), image(Zero);
        for (direction d = 0; d < 3; ++d)
        {
            if (grid_.periodic(d))
            {
                image[d] = -L[d] * std::round(apart[d] / L[d]);
            }
        }
        apart += image;
        if (mag(apart) >= a.radius + b.radius) return;
        const bodyGroup &g = groups_[a.group], &k = groups_[b.group];
        const bodyPoints p(g.initialPoints(a.number));
        bodyPoints q(k.initialPoints(b.number));
        q.places += image;
        const bool onePlace = a.group == b.group && mag(apart) < 1e-6 * h;
        const meeting m =
            onePlace && p.isSurface() ? meeting::cross : meetingOf(p, q, h);
        if (m == meeting::none) return;
        const bool fatal = m == meeting::cross && g.twoWay() && k.twoWay();
        ++(fatal ? nErrors : nWarnings);
        string& first = fatal ? error : warning;
        if (!first.empty()) return;
        OStringStream os;
        os.precision(6);
        os << g.nameOfBody(a.number).c_str() << " at " << a.centre << " and "
           << k.nameOfBody(b.number).c_str() << " at " << b.centre << ' '
           << (onePlace                 ? "lie in one place"
               : m == meeting::cross    ? "cross each other"
               : m == meeting::surround ? "lie one within the other"
                                        : "are closer than their diameters");
        first = os.str();
    };
    forAll(bodies, b)
    {
        // Each pair is looked at by the rank of the second
        const startingBody& body = bodies[b];
        if (!groups_[body.group].mine().found(body.number)) continue;
        label at[3][3], nAt[3];
        for (direction d = 0; d < 3; ++d)
        {
            nAt[d] = 0;
            for (label k = -1; k <= 1; ++k)
            {
                label i = binAt(body.centre, d) + k;
                if (grid_.periodic(d)) i = (i + n[d]) % n[d];
                bool again = i < 0 || i >= n[d];
                for (label j = 0; j < nAt[d]; ++j)
                {
                    again = again || at[d][j] == i;
                }
                if (!again) at[d][nAt[d]++] = i;
            }
        }
        for (label i = 0; i < nAt[0]; ++i)
        {
            for (label j = 0; j < nAt[1]; ++j)
            {
                for (label k = 0; k < nAt[2]; ++k)
                {
                    const auto bin =
                        bins.find(key(at[0][i], at[1][j], at[2][k]));
                    if (bin == bins.end()) continue;
                    for (const label other : bin->second)
                    {
                        if (other < b) judgePair(bodies[other], body);
                    }
                }
            }
        }
    }

    reduce(nWarnings, sumOp<label>());
    if (nWarnings)
    {
        IOWarningInFunction(dict)
            << firstOf(warning).c_str() << " (such pairs: " << nWarnings << ")"
            << nl << "    The fluid between them is not resolved" << endl;
    }
    reduce(nErrors, sumOp<label>());
    if (nErrors)
    {
        FatalIOErrorInFunction(dict)
            << "entry positions: " << firstOf(error).c_str()
            << " (such pairs: " << nErrors << ")" << nl
            << "    allowed: bodies beside each other or one within the other, "
            << "or coupling oneWay" << exit(FatalIOError);
    }
}
