// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyInteractions.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "resultFile.H"
#include "stepGuard.H"
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
        if (actsOn(body.body)) F += all_.on(group_, body.body);
    }
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
      walls_(FixedList<bool, 2>(false)),
      firstBody_(groups.size() + 1, label(0)),
      surfaces_(groups.size(), false)
{
    interactionScene about{scene.grid, scene.mu, scene.deltaT, 0, 0};
    forAll(groups_, g)
    {
        firstBody_[g + 1] = firstBody_[g] + groups_[g].nBodies();
        if (!takesPart(groups_[g])) continue;
        scene.forces.append(new interactionForce(groups_[g].name(), *this, g));

        // Any one of the group
        const bodyPoints p(groups_[g].points(-1));
        surfaces_[g] = p.isSurface();
        if (surfaces_[g])
        {
            const scalar area = sum(mag(p.areas));
            const scalar Gs =
                p.stiffness /
                std::sqrt(area / (4 * constant::mathematical::pi));
            about.softest = about.softest ? min(about.softest, Gs) : Gs;
        }
        else
        {
            about.thickest =
                max(about.thickest,
                    std::sqrt(p.crossSection / constant::mathematical::pi));
        }
    }

    scalar range = 0;
    for (const word& name : dict.toc())
    {
        models_.append(interactionModel::New(name, dict, about).ptr());
        range = max(range, models_.last().range());
        effects_.declare(name, true, models_.last().describe());
    }
    pairs_.reset(new closePairs(grid_, range));

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
        if (model.actsOn(surfaces_[group], surfaces_[other])) return true;
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

void Foam::bodyInteractions::search()
{
    DynamicList<vector> X;
    DynamicList<label> body;
    bodies_.clear();
    find_.clear();
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (!takesPart(group)) continue;
        forAll(group.mine(), i)
        {
            const label number = group.mine()[i], first = X.size();
            X.append(group.points(i).places);
            find_[firstBody_[g] + number] = bodies_.size();
            bodies_.push_back({g, i, number, first, X.size() - first, false});
            for (label k = first; k < X.size(); ++k)
            {
                body.append(firstBody_[g] + number);
            }
        }
    }
    X_ = X;
    pairs_->search(X_, body);

    const boolList paired(pairs_->paired());
    const scalar reach = pairs_->range() + cmptMin(grid_.h());
    vector inward;
    anyNear_ = false;
    for (participant& p : bodies_)
    {
        for (label k = p.first; k < p.first + p.size && !p.near; ++k)
        {
            p.near = paired[k] || toWall(X_[k], inward) < reach;
        }
        anyNear_ = anyNear_ || p.near;
    }
    reduce(anyNear_, orOp<bool>());
}

void Foam::bodyInteractions::update()
{
    const auto timing(effects_.time("interactions"));
    if (others()) pairs_->forget();
    if (pairs_->outdated()) search();
    F_.setSize(X_.size());
    F_ = Zero;
    nPairs_ = 0;
    closest_ = GREAT;
    power_ = 0;
    if (!anyNear_) return;

    // Area vector, size and radius of each point
    scalarField facts(5 * X_.size(), Zero);
    vectorField V(X_.size(), Zero);
    for (const participant& p : bodies_)
    {
        if (!p.near) continue;
        const bodyPoints points(groups_[p.group].points(p.place));
        const scalar radius =
            std::sqrt(points.crossSection / constant::mathematical::pi);
        for (label k = 0; k < p.size; ++k)
        {
            scalar* fact = &facts[5 * (p.first + k)];
            X_[p.first + k] = points.places[k];
            V[p.first + k] = points.velocities[k];
            if (points.isSurface())
            {
                std::copy_n(points.areas[k].v_, 3, fact);
                fact[3] = mag(points.areas[k]);
            }
            else
            {
                fact[3] = points.lengths[k] * cmptMax(grid_.h());
                fact[4] = radius;
            }
        }
    }
    pairs_->move(X_);
    const scalarField there(pairs_->points().handOut(facts.cdata(), 5));
    const label n = pairs_->here().size();
    interactingPoints points{vectorField(n), scalarField(n), scalarField(n)};
    for (label k = 0; k < n; ++k)
    {
        const scalar* fact = &there[5 * k];
        points.areas[k] = vector(fact[0], fact[1], fact[2]);
        points.sizes[k] = fact[3];
        points.radii[k] = fact[4];
    }
    look(points);

    vectorField F(n, Zero);
    for (const interactionModel& model : models_)
    {
        const auto timing(effects_.time(model.type()));
        model.add(*pairs_, points, F);
    }
    pairs_->points().addUp(
        scalarField(UList<scalar>(reinterpret_cast<scalar*>(F.data()), 3 * n)),
        3, reinterpret_cast<scalar*>(F_.data()));

    for (const participant& p : bodies_)
    {
        if (!p.near) continue;
        for (label k = p.first; k < p.first + p.size; ++k)
        {
            vector inward;
            const scalar distance = toWall(X_[k], inward);
            if (distance < pairs_->range())
            {
                for (const interactionModel& model : models_)
                {
                    F_[k] += model.ofWall(distance - facts[5 * k + 4]) *
                             facts[5 * k + 3] * inward;
                }
            }
            power_ += F_[k] & V[k];
        }
    }
    work_ += time_.deltaTValue() * power_;
}

void Foam::bodyInteractions::look(const interactingPoints& points)
{
    // Deepest of those points that lie behind the other's surface, both seen
    scalar deepest = 0;
    label a = -1, b = -1;
    pairs_->each(
        [&](const label i, const label j, const vector& r, const bool both)
        {
            nPairs_ += both ? 2 : 1;
            const scalar apart = mag(r);
            closest_ = min(closest_, apart);
            const vector &ni = points.areas[i], &nj = points.areas[j];
            if (apart > deepest && (ni & nj) < 0 &&
                (nj & r) < -0.5 * mag(nj) * apart &&
                (ni & r) > 0.5 * mag(ni) * apart)
            {
                deepest = apart;
                a = i;
                b = j;
            }
        });
    const scalar all = returnReduce(deepest, maxOp<scalar>());
    if (all == 0 ||
        (warned_ >= 0 && time_.timeIndex() < warned_ + stepGuard::pause))
    {
        return;
    }
    warned_ = time_.timeIndex();
    string where;
    if (deepest == all)
    {
        OStringStream os;
        os.precision(6);
        os << nameOf(pairs_->body()[a]).c_str() << " and "
           << nameOf(pairs_->body()[b]).c_str() << " overlap by " << deepest
           << " at " << pairs_->here()[a];
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

bool Foam::bodyInteractions::actOn(const label group, const label body) const
{
    const auto found = find_.find(firstBody_[group] + body);
    return anyNear_ && found != find_.end() && bodies_[found->second].near;
}

Foam::SubField<Foam::vector> Foam::bodyInteractions::on(const label group,
                                                        const label body) const
{
    const participant& p = bodies_[find_.at(firstBody_[group] + body)];
    return SubField<vector>(F_, p.size, p.first);
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
