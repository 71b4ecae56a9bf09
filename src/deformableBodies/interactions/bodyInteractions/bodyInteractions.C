// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyInteractions.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "pointBins.H"
#include "resultFile.H"
#include "sceneNumbers.H"
#include "segmentDistance.H"
#include "wallPolyPatch.H"

namespace
{
using namespace Foam;

//- Forces between bodies as one of those that act on the bodies of a group
class interactionForce : public bodyForce
{
    const bodyInteractions& all_;
    const label group_;

public:
    interactionForce(const word& name, const bodyInteractions& all,
                     const label group)
        : bodyForce(name),
          all_(all),
          group_(group)
    {
    }

    virtual word effect() const { return "interactions"; }

    virtual bool actsOn(const label body) const
    {
        return all_.actOn(group_, body);
    }

    virtual void add(const bodyPoints& body, scalar, vectorField& F) const
    {
        all_.add(group_, body.body, F);
    }

    //- update() has looked at them
    virtual bool looksAtPoints() const { return false; }
};
} // namespace

Foam::bodyInteractions::bodyInteractions(const dictionary& dict,
                                         const fvMesh& mesh,
                                         const PtrList<bodyGroup>& groups,
                                         const bodyScene& scene)
    : time_(mesh.time()),
      region_(mesh.dbDir()),
      grid_(scene.grid),
      groups_(groups),
      effects_(scene.effects),
      neighbours_(scene.grid),
      boxes_(neighbours_),
      walls_(FixedList<bool, 2>(false)),
      firstBody_(groups.size() + 1, label(0)),
      areas_(groups.size())
{
    const dictionary& control = mesh.time().controlDict();
    string from;
    const flowScales flow(scalesAtStart(mesh, from));
    interactionScene about{scene.grid,
                           scene.mu,
                           control.found("deltaT")
                               ? readPositive(control, "deltaT", dimTime)
                               : mesh.time().deltaTValue(),
                           0,
                           0,
                           GREAT,
                           List<contactLoad>()};
    forAll(groups_, g)
    {
        firstBody_[g + 1] = firstBody_[g] + groups_[g].nBodies();
        if (!takesPart(groups_[g])) continue;
        about.loads.append(loadOf(g, flow, scene));
        scene.forces.append(new interactionForce(groups_[g].name(), *this, g));

        // Any one of the group
        const bodyPoints p(groups_[g].points(-1));
        if (p.isSurface())
        {
            areas_[g] = mag(p.areas);
            const scalar area = sum(areas_[g]);
            const scalar Gs =
                p.stiffness /
                std::sqrt(area / (4 * constant::mathematical::pi));
            about.softest = about.softest ? min(about.softest, Gs) : Gs;
        }
        else
        {
            const scalar radius =
                std::sqrt(p.crossSection / constant::mathematical::pi);
            about.thickest = max(about.thickest, radius);
            about.thinnest = min(about.thinnest, radius);
        }
    }

    scalar ofSurfaces = 0, ofLines = 0;
    for (const word& name : dict.toc())
    {
        models_.append(interactionModel::New(name, dict, about).ptr());
        const interactionModel& model = models_.last();
        effects_.declare(name, true, model.describe());
        if (about.softest > 0)
        {
            ofSurfaces = max(ofSurfaces, model.range(true, true));
        }
        if (about.thickest > 0)
        {
            ofLines = max(ofLines, max(model.range(true, false),
                                       model.range(false, false)));
        }
    }
    forAll(groups_, g)
    {
        if (resists() && takesPart(groups_[g]) && !isSurface(g) &&
            groups_[g].forcing() == forcingType::none)
        {
            refuse(dict.parent(), "interactions",
                   "what resists the motion of filaments, with group " +
                       groups_[g].name() + " of coupling oneWay",
                   "filaments of coupling twoWay");
        }
    }
    if (ofSurfaces > 0) surfacePairs_.reset(new closePairs(grid_, ofSurfaces));
    if (ofLines > 0) linePairs_.reset(new closePairs(grid_, ofLines));
    range_ = max(ofSurfaces, ofLines);

    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (!isA<wallPolyPatch>(patch)) continue;
        forAll(patch, i)
        {
            const label facei = patch.start() + i;
            const direction d = grid_.faceDirection(facei);
            walls_[d][grid_.lowerSide(facei) ? 0 : 1] = true;
        }
    }
    for (direction d = 0; d < 3; ++d)
    {
        for (bool& wall : walls_[d])
        {
            reduce(wall, orOp<bool>());
        }
    }
}

Foam::contactLoad Foam::bodyInteractions::loadOf(const label g,
                                                 const flowScales& flow,
                                                 const bodyScene& scene) const
{
    const bodyGroup& group = groups_[g];
    const bodyPoints p(group.points(-1));
    const scalar pi = constant::mathematical::pi;
    contactLoad load{p.isSurface(), 0, 0, 0, 0, 0, 0, GREAT, ""};
    scalar volume, size, square; // drag = load.drag U + square U^2
    if (p.isSurface())
    {
        volume = sum(p.places & p.areas) / 3;
        size = load.radius = std::cbrt(0.75 * volume / pi);
        load.drag = 6 * pi * scene.mu * size;
        square = 0.2 * pi * scene.rho * sqr(size);
        load.mass = (p.densityRatio + 0.5) * scene.rho * volume;
        for (label soft = g; soft >= 0; soft = groups_[soft].host())
        {
            load.softness =
                min(load.softness, groups_[soft].points(-1).stiffness / size);
        }
    }
    else
    {
        const scalar L = sum(p.lengths);
        load.radius = std::sqrt(p.crossSection / pi);
        volume = p.crossSection * L;
        size = 0.5 * L;
        load.drag = 4 * pi * scene.mu * L /
                    (std::log(max(L / load.radius, scalar(3))) + 0.193);
        square = scene.rho * load.radius * L;
        load.mass = (p.densityRatio + 1) * scene.rho * volume;
    }

    for (label i = 0; i <= 8 && scene.forces.actOn(group.name(), 0); ++i)
    {
        vectorField F(p.places.size(), Zero);
        scene.forces.add(
            group.name(), 0, [&]() { return p; },
            time_.startTime().value() + 0.125 * i * scene.duration,
            scene.effects, F);
        load.own = max(load.own, max(mag(sum(F)), 0.5 * sum(mag(F))));
    }
    const scalar byFlow = flow.rate > 0    ? flow.rate * size
                          : flow.speed > 0 ? flow.speed
                          : load.own > 0   ? 0
                                           : scene.mu / (scene.rho * size);
    load.force = load.own + load.drag * byFlow + square * sqr(byFlow);
    load.speed = byFlow + (std::sqrt(sqr(load.drag) + 4 * square * load.own) -
                           load.drag) /
                              (2 * square);
    OStringStream os;
    os.precision(3);
    os << group.name().c_str() << ": weight and loads " << load.own
       << " N, flow " << load.force - load.own << " N, speed " << load.speed
       << " m/s";
    load.reason = os.str();
    return load;
}

bool Foam::bodyInteractions::takesPart(const bodyGroup& group) const
{
    return group.takesForces() && !group.alone();
}

Foam::string Foam::bodyInteractions::nameOf(const label body) const
{
    label g = 0;
    while (body >= firstBody_[g + 1])
        ++g;
    return groups_[g].nameOfBody(body - firstBody_[g]);
}

Foam::scalar Foam::bodyInteractions::toWall(const vector& x,
                                            vector& inward) const
{
    scalar least = GREAT;
    for (direction d = 0; d < 3; ++d)
    {
        const scalar above = x[d] - grid_.origin()[d];
        const scalar distances[2] = {above, grid_.length()[d] - above};
        for (label side = 0; side < 2; ++side)
        {
            if (!walls_[d][side] || distances[side] >= least) continue;
            least = distances[side];
            inward = Zero;
            inward[d] = side ? -1 : 1;
        }
    }
    return least;
}

bool Foam::bodyInteractions::actBetween(const label group,
                                        const label other) const
{
    if (!takesPart(groups_[group]) || !takesPart(groups_[other])) return false;
    for (const interactionModel& model : models_)
    {
        if (model.range(isSurface(group), isSurface(other)) > 0) return true;
    }
    return false;
}

bool Foam::bodyInteractions::actsWithinLines() const
{
    for (const interactionModel& model : models_)
    {
        if (model.withinLines()) return true;
    }
    return false;
}

bool Foam::bodyInteractions::others() const
{
    size_t n = 0;
    for (label g = 0; g < groups_.size(); ++g)
    {
        if (!takesPart(groups_[g])) continue;
        for (const label number : groups_[g].mine())
        {
            if (n == bodies_.size() || bodies_[n].group != g ||
                bodies_[n].number != number)
            {
                return true;
            }
            ++n;
        }
    }
    return n != bodies_.size();
}

void Foam::bodyInteractions::compareBoxes()
{
    bodies_.clear();
    find_.clear();
    DynamicList<vector> centres;
    DynamicList<scalar> facts; // half the sides of the box, number of the body
    DynamicList<boundBox> boxes;
    scalar largest = 0;
    label away = 0;
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!takesPart(group)) continue;
        forAll(group.mine(), i)
        {
            const label number = group.mine()[i];
            find_[firstBody_[g] + number] = bodies_.size();
            const bool mayFold = actsWithinLines() && !isSurface(g);
            bodies_.push_back({g, i, number, false, false,
                               mayFold && folded(group.points(i).places), 0,
                               0});
            boxes.append(group.bounds(i, false));
            const vector half(0.5 * boxes.last().span());
            centres.append(boxes.last().midpoint());
            facts.append(
                {half.x(), half.y(), half.z(), scalar(firstBody_[g] + number)});
            largest = max(largest, cmptMax(half));
            away = max(away, neighbours_.away(grid_.cellAt(centres.last())));
        }
    }
    reduce(largest, maxOp<scalar>());
    reduce(away, maxOp<label>());
    // Points of contact may be a step ahead
    const scalar reach =
        range_ + skin() + 2 * returnReduce(lastTravel_, maxOp<scalar>());

    // All boxes that may be near one of this rank, in bins; the middle of one of these
    // may lie outside the block
    boxes_.place(centres, grid_.layersWithin(2 * largest + reach) + away);
    const scalarField there(boxes_.handOut(facts.cdata(), 4));
    const UList<vector>& here = boxes_.here();
    const pointBins bins(grid_, 2 * largest + reach, here.size());
    List<DynamicList<label>> inBin(bins.count());
    forAll(here, k)
    {
        inBin[bins.numberOf(here[k])].append(k);
    }
    const auto nearAny = [&](const label own)
    {
        bool found = false;
        bins.eachNext(
            bins.numberOf(centres[own]),
            [&](const label bin)
            {
                for (const label k : inBin[bin])
                {
                    if (found) return;
                    const scalar *a = &facts[4 * own], *b = &there[4 * k];
                    const vector r(nearestImage(grid_, centres[own], here[k]));
                    found = a[3] != b[3] && mag(r.x()) < a[0] + b[0] + reach &&
                            mag(r.y()) < a[1] + b[1] + reach &&
                            mag(r.z()) < a[2] + b[2] + reach;
                }
            });
        return found;
    };

    anyNear_ = false;
    forAll(boxes, k)
    {
        vector inward;
        participant& p = bodies_[k];
        p.nearWall = toWall(boxes[k].min(), inward) < reach ||
                     toWall(boxes[k].max(), inward) < reach;
        p.near = p.folded || p.nearWall || nearAny(k);
        anyNear_ = anyNear_ || p.near;
    }
    reduce(anyNear_, orOp<bool>());
    travelled_ = 0;
}

bool Foam::bodyInteractions::actOn(const label group, const label body) const
{
    const auto found = find_.find(firstBody_[group] + body);
    return anyNear_ && found != find_.end() && bodies_[found->second].near;
}

void Foam::bodyInteractions::add(const label group, const label body,
                                 vectorField& F) const
{
    const participant& p = bodies_[find_.at(firstBody_[group] + body)];
    for (label i = 0; i < p.size; ++i)
    {
        const label k = p.first + i;
        if (isSurface(group))
        {
            F[i] += F_.F[k];
            continue;
        }
        const partOfSegment& on = parts_[k - firstOfLines_];
        vector ahead(on.onward * F_.F[k]);
        if (F_.arms.size()) ahead += on.part * F_.arms[k];
        F[on.segment] += F_.F[k] - ahead;
        F[on.segment + 1] += ahead;
    }
}

void Foam::bodyInteractions::sample()
{
    const scalar closest = returnReduce(closest_, minOp<scalar>());
    const label pairs = returnReduce(nPairs_, sumOp<label>()) / 2;
    const scalar power = returnReduce(power_, sumOp<scalar>());
    const scalar work = returnReduce(work_, sumOp<scalar>());
    if (!Pstream::master()) return;
    if (!file_.valid())
    {
        file_ = newResultFile(time_, fileName(region_) / "interactions",
                              "interactions.dat");
        file_() << "# time closest pairs power work" << nl
                << "# s m(0:none) 1 W J(since-the-start-of-the-run)" << endl;
        file_().precision(10);
    }
    file_() << time_.value() << ' ' << (closest < GREAT ? closest : 0) << ' '
            << pairs << ' ' << power << ' ' << work << endl;
}
