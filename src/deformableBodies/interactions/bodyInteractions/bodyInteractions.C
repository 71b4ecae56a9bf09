// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyInteractions.H"
#include "dictionaryChecks.H"
#include "interactionForce.H"
#include "interactionState.H"
#include "segmentDistance.H"
#include <iomanip>
#include <sstream>

Foam::bodyInteractions::bodyInteractions(const dictionary& dict,
                                         const fvMesh& mesh,
                                         const PtrList<bodyGroup>& groups,
                                         const bodyScene& scene,
                                         const bool nearField)
    : time_(mesh.time()),
      grid_(scene.grid),
      groups_(groups),
      effects_(scene.effects),
      numbers_(groups),
      walls_(scene.grid),
      models_(dict, interactionScene::of(mesh, groups, scene, nearField),
              scene.effects),
      takesPart_(groups.size(), false),
      surfaces_(groups.size()),
      near_(scene.grid, walls_, models_.range()),
      points_(scene.grid),
      watch_(
          mesh.time(), [this](const label number) { return nameOf(number); },
          [this](const label number)
          {
              const label host = groups_[numbers_.group(number)].host();
              return host < 0 ? -1
                              : numbers_.number(host, numbers_.body(number));
          },
          models_.actOn(false, false)),
      samples_(mesh.time(), mesh.dbDir())
{
    forAll(groups_, g)
    {
        if (!interactionScene::takesPart(groups_[g])) continue;
        const bodyPoints p(groups_[g].points(-1));
        const bool surface = p.isSurface();
        takesPart_[g] =
            models_.actOn(surface, true) || models_.actOn(surface, false);
        if (!takesPart_[g]) continue;
        scene.forces.append(new interactionForce(groups_[g].name(), *this, g));
        if (surface)
        {
            surfaces_[g] = contactSurface(p.positions, mag(p.areas),
                                          models_.surfaceRange());
        }
        if (resists() && !surface && groups_[g].forcing() == forcingType::none)
        {
            refuse(dict.parent(), "interactions",
                   "what resists the motion of filaments, with group " +
                       groups_[g].name() + " of coupling oneWay",
                   "filaments of coupling twoWay");
        }
    }
    if (models_.surfaceRange() > 0)
    {
        surfacePairs_.reset(new contactSearch(grid_, models_.surfaceRange()));
    }
    if (models_.lineRange() > 0)
    {
        linePairs_.reset(new contactSearch(grid_, models_.lineRange()));
    }
}

bool Foam::bodyInteractions::actBetween(const label group,
                                        const label other) const
{
    return takesPart_[group] && takesPart_[other] &&
           models_.actOn(isSurface(group), isSurface(other));
}

bool Foam::bodyInteractions::bodiesChanged() const
{
    const std::vector<nearBodies::body>& bodies = near_.bodies();
    size_t n = 0;
    forAll(groups_, g)
    {
        if (!takesPart_[g]) continue;
        for (const label body : groups_[g].mine())
        {
            if (n == bodies.size() ||
                bodies[n].number != numbers_.number(g, body))
            {
                return true;
            }
            ++n;
        }
    }
    return n != bodies.size();
}

void Foam::bodyInteractions::compareBoxes()
{
    std::vector<nearBodies::body> bodies;
    DynamicList<boundBox> boxes;
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!takesPart_[g]) continue;
        const bool mayFold = models_.actWithinLines() && !isSurface(g);
        forAll(group.mine(), i)
        {
            bodies.push_back({g, i, numbers_.number(g, group.mine()[i]),
                              mayFold && folded(group.points(i).positions),
                              false, false});
            boxes.append(group.bounds(i, false));
        }
    }
    near_.compare(bodies, boxes);
}

Foam::scalar Foam::bodyInteractions::pressed() const
{
    if (!hasForces_) return pressedBefore_;
    scalar now = 0;

    // Bodies may have been compared since their points were collected
    const label n = near_.any() ? points_.nBodies() : 0;
    for (label b = 0; b < n; ++b)
    {
        now = max(now, 2 * points_.load(b));
    }
    return returnReduce(now, maxOp<scalar>());
}

Foam::scalar Foam::bodyInteractions::maxDeltaT()
{
    const scalar now = pressed();
    if (near_.isOld()) compareBoxes();
    return near_.anyByMotion() ? models_.maxDeltaT(now) : GREAT;
}

bool Foam::bodyInteractions::actOn(const label group, const label body) const
{
    const label b = near_.find(numbers_.number(group, body));
    return hasForces_ && near_.any() && b >= 0 && near_.bodies()[b].near;
}

void Foam::bodyInteractions::add(const label group, const label body,
                                 vectorField& F) const
{
    points_.addTo(near_.find(numbers_.number(group, body)), F);
}

void Foam::bodyInteractions::addStiffness(const label group, const label body,
                                          scalarField& K) const
{
    points_.addStiffness(near_.find(numbers_.number(group, body)), K);
}

Foam::vector Foam::bodyInteractions::forceOn(const label group,
                                             const label body) const
{
    return actOn(group, body)
               ? points_.force(near_.find(numbers_.number(group, body)))
               : vector::zero;
}

Foam::string Foam::bodyInteractions::state() const
{
    std::ostringstream os;
    os << std::setprecision(17) << "    pressed " << pressed()
       << ";\n    travel " << near_.lastTravel() << ";\n";
    return os.str() + interactionState::write(models_, numbers_);
}

void Foam::bodyInteractions::readState(const dictionary& saved,
                                       const boolList& initial)
{
    continues_ = !initial.found(true);
    if (continues_)
    {
        pressedBefore_ = saved.getOrDefault<scalar>("pressed", GREAT);
        near_.travel(saved.getOrDefault<scalar>("travel", 0));
    }
    interactionState::read(saved, initial, numbers_, models_, effects_);
}
