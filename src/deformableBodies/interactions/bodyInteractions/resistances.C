// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What resists the relative motion of fibres, and what it remembers

#include "bodyInteractions.H"
#include "directForcing.H"
#include "Pair.H"
#include <algorithm>
#include <iomanip>
#include <map>
#include <sstream>

namespace
{
using namespace Foam;

//- In place of a group; no group may have a colon in its name
const word ofWalls("wall:");
} // namespace

bool Foam::bodyInteractions::resists() const
{
    bool any = false;
    for (const interactionModel& model : models_)
    {
        any = any || model.resists();
    }
    return any;
}

void Foam::bodyInteractions::resist(const labelUList& groups, const vector* U,
                                    const scalar* lineDensity,
                                    const bodyStep& step)
{
    if (!resists()) return;
    const auto timing(effects_.time("interactions"));
    if (!anyNear_)
    {
        remember(List<scalarList>(models_.size()));
        return;
    }

    // How the points of this rank would move; what a force adds to their bodies
    const label nOwn = X_.size();
    scalarField number(nOwn, Zero), along(nOwn, Zero), own(nOwn, Zero);
    scalarField yield(bodies_.size(), Zero);
    vectorField element(nOwn, Zero), V(nOwn, Zero), turn(nOwn, Zero), v;
    for (const label g : groups)
    {
        const bodyGroup& group = groups_[g];
        const label n = group.mine().size();
        for (label i = 0; i < n; ++i)
        {
            const label b = find_.at(firstBody_[g] + group.mine()[i]);
            const participant& p = bodies_[b];
            if (p.near)
            {
                yield[b] = refCast<const directForcing>(group).freeVelocities(
                    i, U, lineDensity, step, v);
                const vectorField x(group.points(i).places);
                const scalar segments = x.size() - 1;
                for (label k = p.first; k < p.first + p.size; ++k)
                {
                    const partOfSegment& on = parts_[k - firstOfLines_];
                    const label at = on.segment;
                    number[k] = k - p.first;
                    along[k] = mag((at + on.onward) / segments - 0.5);
                    element[k] = on.part * (x[at + 1] - x[at]);
                    turn[k] = on.part * (v[at + 1] - v[at]);
                    V[k] = v[at] + on.onward * (v[at + 1] - v[at]);
                }
            }
            U += group.nMarkers() / n;
            lineDensity += group.nMarkers() / n;
        }
    }
    const closePairs& pairs = *linePairs_;
    const UList<vector>& x = pairs.here();
    const scalarField numbersHere(pairs.handOut(number.cdata(), 1));
    fibreMotions motions{labelList(x.size()),
                         pairs.handOut(element),
                         pairs.handOut(V),
                         pairs.handOut(turn),
                         scalarField(x.size(), GREAT),
                         vectorField(x.size(), Zero)};
    forAll(x, k)
    {
        motions.numbers[k] = label(numbersHere[k]);
        if (linePoints_[k].radius > 0)
        {
            motions.toWalls[k] = toWall(x[k], motions.inward[k]);
        }
    }

    // What all resistances of a body together take from each of its points, at most, as
    // of a rod: a push at s' adds 1 + 12 |s s'| at s, in lengths from the middle
    scalarField k(x.size(), Zero);
    for (interactionModel& model : models_)
    {
        const auto timing(effects_.time(model.type()));
        model.findResistances(pairs, linePoints_, motions, k);
    }
    pairs.addUp(k, 1, own.data());
    forAll(yield, b)
    {
        const label first = bodies_[b].first, end = first + bodies_[b].size;
        scalar all = 0, turning = 0;
        for (label m = first; m < end; ++m)
        {
            all += own[m];
            turning += own[m] * along[m];
        }
        for (label m = first; m < end; ++m)
        {
            own[m] = yield[b] * (all + 12 * along[m] * turning);
        }
    }
    const scalarField implicit(pairs.handOut(own.cdata(), 1));

    armedForces here{vectorField(x.size(), Zero), vectorField(x.size(), Zero)};
    for (interactionModel& model : models_)
    {
        const auto timing(effects_.time(model.type()));
        if (model.resists())
        {
            model.resist(pairs, motions, implicit, here);
        }
    }
    vectorField F(nOwn, Zero), arms(nOwn, Zero);
    pairs.addUp(here.F, F);
    pairs.addUp(here.arms, arms);
    F_.F += F;
    F_.arms += arms;
    const scalar power = sum(F & V) + sum(arms & turn);
    power_ += power;
    work_ += step.dt * power;
}

Foam::List<Foam::scalarList> Foam::bodyInteractions::memory() const
{
    List<scalarList> all;
    for (const interactionModel& model : models_)
    {
        all.append(model.memory());
    }
    return all;
}

void Foam::bodyInteractions::remember(const List<scalarList>& memory)
{
    forAll(models_, m)
    {
        models_[m].remember(memory[m]);
    }
}

Foam::string Foam::bodyInteractions::state() const
{
    std::ostringstream text;
    text << std::setprecision(17);
    const auto point = [&](const scalar* x)
    {
        const label body = label(x[0]);
        if (body < 0)
        {
            text << ofWalls << " 0 " << label(x[1]) << ' ';
            return;
        }
        label g = 0;
        while (body >= firstBody_[g + 1])
            ++g;
        text << groups_[g].name() << ' ' << body - firstBody_[g] << ' '
             << label(x[1]) << ' ';
    };
    text << "    strengths\n    {\n";
    for (const interactionModel& model : models_)
    {
        const scalarList defaults(model.defaults());
        if (defaults.empty()) continue;
        text << "        " << model.type() << " (";
        for (const scalar x : defaults)
        {
            text << ' ' << x;
        }
        text << " );\n";
    }
    text << "    }\n";
    for (const interactionModel& model : models_)
    {
        if (!model.resists()) continue;
        List<scalarList> ofRanks(Pstream::nProcs());
        ofRanks[Pstream::myProcNo()] = model.memory();
        Pstream::gatherList(ofRanks);

        // Ranks may have the same
        std::map<std::vector<scalar>, Pair<scalar>> sorted;
        for (const scalarList& all : ofRanks)
        {
            for (label n = 0; n < all.size(); n += 6)
            {
                const scalar* x = &all[n];
                sorted.insert(
                    {std::vector<scalar>(x, x + 4), Pair<scalar>(x[4], x[5])});
            }
        }
        text << "    " << model.type() << "\n    (\n";
        for (const auto& entry : sorted)
        {
            text << "        ";
            point(entry.first.data());
            point(entry.first.data() + 2);
            text << entry.second.first() << ' ' << entry.second.second()
                 << '\n';
        }
        text << "    );\n";
    }
    return text.str();
}

void Foam::bodyInteractions::readState(const dictionary& saved,
                                       const boolList& initial)
{
    // What is known of the flow now would make other defaults
    const dictionary strengths(saved.subOrEmptyDict("strengths"));
    for (interactionModel& model : models_)
    {
        if (initial.found(true) || !strengths.found(model.type())) continue;
        const scalarList defaults(strengths.get<scalarList>(model.type()));
        if (!model.keep(defaults)) continue;
        effects_.declare(model.type(), true,
                         "as at the start of the run, strength " +
                             Foam::name(defaults[0]));
    }
    List<scalarList> all(models_.size());
    forAll(models_, m)
    {
        if (!saved.found(models_[m].type())) continue;
        ITstream& is = saved.lookup(models_[m].type());
        DynamicList<scalar> numbers;
        const auto point = [&]()
        {
            const word group(is);
            const label number = readLabel(is), at = readLabel(is);
            label g = 0;
            while (g < groups_.size() && groups_[g].name() != group)
                ++g;
            const bool known = g < groups_.size() && !initial[g] &&
                               number < groups_[g].nBodies();
            numbers.append(known ? firstBody_[g] + number : -1);
            numbers.append(at);
            return known || group == ofWalls;
        };
        is.readBegin("list");
        for (token t(is); t.isWord(); is.read(t))
        {
            is.putBack(t);
            const label before = numbers.size();
            const bool first = point(), second = point();
            const scalar force = readScalar(is);
            numbers.append(force);
            numbers.append(readScalar(is));
            if (!first || !second) numbers.resize(before);
        }
        all[m] = numbers;
    }
    remember(all);
}
