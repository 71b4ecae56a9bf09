// This file is part of deformableBodies. License: GPL-3.0-or-later.

// One step: contact forces, and resistances once the fluid's velocity is known

#include "bodyInteractions.H"
#include "dictionaryChecks.H"
#include "directForcing.H"
#include "fibreResistances.H"
#include "mathematicalConstants.H"
#include "Time.H"

void Foam::bodyInteractions::update()
{
    const auto timing(effects_.time("interactions"));
    const bool changed = returnReduce(bodiesChanged(), orOp<bool>());
    if (near_.isOld() || changed) compareBoxes();
    const bool first = !hasForces_;
    hasForces_ = true;
    watch_.begin();
    samples_.begin();
    contactMoment_ = wallMoment_ = filmMoment_ = tensor::zero;
    if (!near_.any()) return;

    collectPoints();
    points_.clearForces(resists());
    if (surfacePairs_)
    {
        act(*surfacePairs_,
            SubList<label>(points_.body(), points_.nOfSurfaces()), {});
    }
    if (linePairs_)
    {
        // Parts of a fibre that is not folded cannot come within range before the boxes
        // are compared again
        act(*linePairs_, points_.lineBodies(), points_.linesAlong());
    }
    contactMoment_ -= momentAboutCentres();
    actOfWalls();
    samples_.addPower(points_.power(), time_.deltaTValue());
    if (first && !continues_) checkStart();
}

void Foam::bodyInteractions::checkStart() const
{
    string where;
    scalar most = 10 * models_.load();
    for (label b = 0; b < near_.nBodies(); ++b)
    {
        if (points_.load(b) <= most) continue;
        const nearBodies::body& body = near_.bodies()[b];
        most = points_.load(b);
        OStringStream os;
        os << nameOf(body.number).c_str() << " at "
           << groups_[body.group].centre(body.local)
           << " starts so close to bodies or walls that they press it with "
           << most << " N; flow, weight and loads press with " << models_.load()
           << " N";
        where = os.str();
    }
    where = firstOf(where);
    if (where.empty() || !Pstream::master()) return;
    WarningInFunction
        << where.c_str() << nl
        << "    Bodies are thrown apart in the first steps: start them further "
           "apart, up to "
        << models_.range()
        << " m (positions, minimumGap of placement, radiusRatio of a nucleus)"
        << endl;
}

void Foam::bodyInteractions::collectPoints()
{
    const std::vector<nearBodies::body>& bodies = near_.bodies();
    const label n = near_.nBodies();
    points_.clear(n);
    for (label b = 0; b < n; ++b)
    {
        if (bodies[b].near && isSurface(bodies[b].group))
        {
            collectSurface(b, bodies[b]);
        }
    }
    for (label b = 0; b < n; ++b)
    {
        const nearBodies::body& body = bodies[b];
        if (!body.near || isSurface(body.group)) continue;
        const bodyPoints p(groups_[body.group].points(body.local));
        points_.addLine(b, body.number, p.positions, p.velocities,
                        std::sqrt(p.crossSection / constant::mathematical::pi),
                        body.folded, p.held, models_.range());
    }
}

void Foam::bodyInteractions::collectSurface(const label index,
                                            const nearBodies::body& b)
{
    const bodyGroup& group = groups_[b.group];
    const contactSurface& surface = surfaces_[b.group];
    const auto place = [&](vector* X, vector* V)
    {
        group.contactPoints(b.local, X, V);
        if (group.forcing() == forcingType::none) return;

        // Bodies of direct forcing are at the start of the step. A force in its middle
        // neither gives energy to an elastic contact nor takes it
        const scalar half = 0.5 * time_.deltaTValue();
        for (label k = 0; k < surface.nMarkers(); ++k)
        {
            X[k] += half * V[k];
        }
    };
    points_.addSurface(index, b.number, surface, place);
}

void Foam::bodyInteractions::act(contactSearch& search, const labelUList& body,
                                 const UList<scalar>& along)
{
    search.search(points_.X(), points_.points(), body, along,
                  2 * (search.pairs().range() + near_.skin()));
    watch_.look(search.pairs(), search.points());
    if (watch_.surfacesTouch())
    {
        watch_.lookBehind(search.pairs(), search.points(),
                          touchingAreas(search.pairs(), body.size()));
    }
    const auto add = [&](pairForces all)
    {
        for (const contactForce& force : models_.forces())
        {
            const auto timing(effects_.time(force.type()));
            force.add(search.pairs(), search.points(), all);
        }
        contactMoment_ += all.moment;
    };
    search.addForces(add, points_.forces().F,
                     &search == linePairs_.get() ? &points_.stiffness()
                                                 : nullptr);
}

Foam::tensor Foam::bodyInteractions::momentAboutCentres() const
{
    tensor moment(Zero);
    for (label b = 0; b < near_.nBodies(); ++b)
    {
        const nearBodies::body& body = near_.bodies()[b];
        if (!body.near) continue;
        const point centre(groups_[body.group].centre(body.local));
        moment += points_.moment(b, centre);
    }
    return moment;
}

Foam::vectorField Foam::bodyInteractions::touchingAreas(const closePairs& pairs,
                                                        const label n) const
{
    const scalarField touching(watch_.touching(pairs, n));
    vectorField areas(n, Zero);
    for (label b = 0; b < near_.nBodies(); ++b)
    {
        const nearBodies::body& body = near_.bodies()[b];
        const contactPoints::range& points = points_.ofBody(b);
        if (!isSurface(body.group) ||
            sum(SubField<scalar>(touching, points.size, points.first)) == 0)
        {
            continue;
        }
        const vectorField of(groups_[body.group].points(body.local).areas);
        std::copy(of.begin(), of.end(), areas.begin() + points.first);
        points_.setBetween(b, areas.data() + points.first);
    }
    return areas;
}

void Foam::bodyInteractions::actOfWalls()
{
    // Fibres meet other bodies at the start of the step, and walls in its middle
    const scalar half = 0.5 * time_.deltaTValue();
    for (label b = 0; b < near_.nBodies(); ++b)
    {
        const nearBodies::body& body = near_.bodies()[b];
        if (!body.nearWall) continue;
        const contactPoints::range& points = points_.ofBody(b);
        const point centre(groups_[body.group].centre(body.local));
        for (label k = points.first; k < points.end(); ++k)
        {
            const interactingPoint& p = points_.points()[k];
            if (points_.isRooted(k)) continue;
            const vector x(points_.X()[k] +
                           (p.radius > 0 ? half : 0) * points_.V()[k]);
            const auto act = [&](const scalar distance, const vector& inward)
            {
                if (distance >= models_.range()) return;
                const auto ofWall =
                    models_.ofWall(distance - p.radius, p.radius == 0);
                const scalar P = ofWall.first;
                const vector force(P * p.size * inward);
                points_.forces().F[k] += force;
                points_.stiffness()[k] += ofWall.second * p.size;
                wallMoment_ += force * (centre - (x - distance * inward));
                if (P > 0 && distance < 0.5 * p.radius)
                {
                    watch_.pressedIntoWall(p.radius - distance, body.number, x);
                }
            };
            walls_.each(x, act);
        }
    }
}

void Foam::bodyInteractions::resist(const labelUList& groups, const vector* U,
                                    const scalar* lineDensity,
                                    const bodyStep& step)
{
    if (!resists()) return;
    const auto timing(effects_.time("interactions"));
    if (!near_.any())
    {
        remember(List<scalarList>(models_.resistances().size()));
        return;
    }

    // Velocities that the points of this rank would have; effect of a force on each body
    lineMotions motions(points_.size());
    scalarField mobility(near_.bodies().size(), Zero);
    vectorField v;
    for (const label g : groups)
    {
        const bodyGroup& group = groups_[g];
        const label n = group.mine().size();
        for (label i = 0; i < n; ++i)
        {
            const label b = near_.find(numbers_.number(g, group.mine()[i]));
            if (near_.bodies()[b].near)
            {
                mobility[b] = refCast<const directForcing>(group).freeVelocities(
                    i, U, lineDensity, step, v);
                points_.moveLine(b, group.points(i).positions, v, motions);
            }
            U += group.nMarkers() / n;
            lineDensity += group.nMarkers() / n;
        }
    }
    const tensor before(momentAboutCentres());
    const fibreResistances all(models_.resistances(), *linePairs_, walls_,
                               effects_);
    samples_.addPower(all.add(motions, mobility, points_), step.dt);
    filmMoment_ = points_.forces().moment - (momentAboutCentres() - before);
}
