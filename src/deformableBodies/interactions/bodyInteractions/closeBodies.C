// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The forces of one step: points of bodies that are near others, their pairs, what the
// models say of them, and bodies that have got through each other

#include "bodyInteractions.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "stepGuard.H"

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

    // Of each point area vector, size, radius, body, and place along a fibre that is
    // folded, else -1; velocity. Surfaces first
    which_.clear();
    onward_.clear();
    part_.clear();
    X_.clear();
    DynamicList<scalar> facts;
    DynamicList<vector> V;
    label nOfSurfaces = 0;
    const auto collect = [&](participant& p)
    {
        p.first = X_.size();
        p.size = 0;
        if (!p.near) return;
        const bodyPoints points(groups_[p.group].points(p.place));
        const scalar radius =
            std::sqrt(points.crossSection / constant::mathematical::pi);
        const vectorField &x = points.places, &v = points.velocities;
        const auto append = [&](const label k, const scalar onward,
                                const scalar part, const vector& area,
                                const scalar size, const scalar along)
        {
            which_.append(k);
            onward_.append(onward);
            part_.append(part);
            X_.append(onward > 0 ? (1 - onward) * x[k] + onward * x[k + 1]
                                 : x[k]);
            V.append(onward > 0 ? (1 - onward) * v[k] + onward * v[k + 1]
                                : v[k]);
            facts.append({area.x(), area.y(), area.z(), size, radius,
                          scalar(firstBody_[p.group] + p.number), along});
        };
        if (points.isSurface())
        {
            const label n = x.size();
            const scalar enough = 0.6 * sum(mag(points.areas)) / n;
            vector area(Zero);
            scalar size = 0;
            for (label k = 0; k < n; ++k)
            {
                area += points.areas[k];
                size += mag(points.areas[k]);
                if (size < enough && k + 1 < n) continue;
                append(k, 0, 0, area, size, -1);
                area = Zero;
                size = 0;
            }
        }
        else
        {
            const scalar h = cmptMax(grid_.h());
            const scalar apart = max(min(0.5 * h, 2 * radius), 0.1 * h);
            scalar before = 0;
            for (label k = 0; k + 1 < x.size(); ++k)
            {
                const scalar length = mag(x[k + 1] - x[k]);
                // Whatever the rounding of segments as long as a cell
                const label parts =
                    label(std::ceil(length / apart * (1 - 1e-6)));
                for (label j = 0; j < parts; ++j)
                {
                    append(k, (j + 0.5) / parts, scalar(1) / parts, Zero,
                           length / parts * h,
                           p.folded ? before + (j + 0.5) / parts * length : -1);
                }
                before += length;
            }
        }
        p.size = X_.size() - p.first;
    };
    for (const bool surfaces : {true, false})
    {
        for (participant& p : bodies_)
        {
            if (surfaces_[p.group] == surfaces) collect(p);
        }
        if (surfaces) nOfSurfaces = X_.size();
    }

    F_.F = vectorField(X_.size(), Zero);
    F_.arms = F_.F;
    overlap deepest;
    if (surfacePairs_)
    {
        act(*surfacePairs_, surfacePoints_, false, nOfSurfaces, facts.cdata(),
            deepest);
    }
    if (linePairs_)
    {
        act(*linePairs_, linePoints_, true, X_.size(), facts.cdata(), deepest);
    }
    warnOf(deepest);

    forAll(X_, k)
    {
        vector inward;
        const scalar distance = toWall(X_[k], inward);
        if (distance < range_)
        {
            for (const interactionModel& model : models_)
            {
                const scalar radius = facts[nFacts_ * k + 4];
                F_.F[k] += model.ofWall(distance - radius, radius == 0) *
                           facts[nFacts_ * k + 3] * inward;
            }
        }
        power_ += F_.F[k] & V[k];
    }
    work_ += time_.deltaTValue() * power_;
}

void Foam::bodyInteractions::act(closePairs& pairs, interactingPoints& points,
                                 const bool lines, const label n,
                                 const scalar* facts, overlap& deepest)
{
    // Pairs of surfaces have a list of their own: here all are as one body
    labelList body(n);
    scalarField along(n);
    forAll(body, k)
    {
        const bool isLine = facts[nFacts_ * k + 4] > 0;
        body[k] = !lines || isLine ? label(facts[nFacts_ * k + 5])
                                   : firstBody_.last();
        along[k] = facts[nFacts_ * k + 6];
    }
    // Parts of a fibre that is not folded cannot come within range before the boxes are
    // compared again
    pairs.search(SubList<vector>(X_, n), body, along,
                 2 * (pairs.range() + skin()));
    const scalarField there(pairs.points().handOut(facts, nFacts_));
    const label nHere = pairs.here().size();
    points = {vectorField(nHere), scalarField(nHere), scalarField(nHere)};
    labelList bodies(nHere);
    for (label k = 0; k < nHere; ++k)
    {
        const scalar* fact = &there[nFacts_ * k];
        points.areas[k] = vector(fact[0], fact[1], fact[2]);
        points.sizes[k] = fact[3];
        points.radii[k] = fact[4];
        bodies[k] = label(fact[5]);
    }
    look(pairs, points, bodies, deepest);

    vectorField F(nHere, Zero);
    for (const interactionModel& model : models_)
    {
        const auto timing(effects_.time(model.type()));
        model.add(pairs, points, F);
    }
    pairs.points().addUp(scalarField(UList<scalar>(
                             reinterpret_cast<scalar*>(F.data()), 3 * nHere)),
                         3, reinterpret_cast<scalar*>(F_.F.data()));
}

void Foam::bodyInteractions::look(const closePairs& pairs,
                                  const interactingPoints& points,
                                  const labelUList& body, overlap& deepest)
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
        scalar depth = 0;
        const scalar a = points.radii[p.first], b = points.radii[p.second];
        if (a > 0 && b > 0)
        {
            // Axes within half the sum of the radii, where that is kept from
            if (linesActOn && apart < 0.5 * (a + b)) depth = a + b - apart;
        }
        else
        {
            // Either lies behind the other's surface, both seen
            const vector& n = points.areas[p.first];
            const vector& m = points.areas[p.second];
            if ((n & m) < 0 && (m & p.r) < -0.5 * mag(m) * apart &&
                (n & p.r) > 0.5 * mag(n) * apart)
            {
                depth = apart;
            }
        }
        if (depth <= deepest.depth) continue;
        deepest = {depth, body[p.first], body[p.second], pairs.here()[p.first]};
    }
}

void Foam::bodyInteractions::warnOf(const overlap& deepest)
{
    const scalar all = returnReduce(deepest.depth, maxOp<scalar>());
    if (all == 0 ||
        (warned_ >= 0 && time_.timeIndex() < warned_ + stepGuard::pause))
    {
        return;
    }
    warned_ = time_.timeIndex();
    string where;
    if (deepest.depth == all)
    {
        OStringStream os;
        os.precision(6);
        os << nameOf(deepest.body).c_str() << " and "
           << nameOf(deepest.other).c_str() << " overlap by " << all << " at "
           << deepest.at;
        where = os.str();
    }
    where = firstOf(where);
    if (Pstream::master())
    {
        WarningInFunction
            << where.c_str() << ", at time " << time_.timeName() << nl
            << "    What keeps bodies apart has not held them: a larger "
            << "strength or range of interactions, or a smaller deltaT, may"
            << endl;
    }
}
