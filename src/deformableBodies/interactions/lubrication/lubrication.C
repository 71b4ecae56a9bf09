// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lubrication.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "rangeCheck.H"
#include "mathematicalConstants.H"
#include "segmentDistance.H"

namespace Foam
{
defineTypeNameAndDebug(lubrication, 0);
addToRunTimeSelectionTable(contactResistance, lubrication, dictionary);
} // namespace Foam

namespace
{
using namespace Foam;
const scalar pi = constant::mathematical::pi;

//- Number of a wall by the direction away from it
label sideOf(const vector& inward)
{
    for (direction d = 0; d < 3; ++d)
    {
        if (mag(inward[d]) > 0.5) return 2 * d + (inward[d] < 0 ? 1 : 0);
    }
    return 0;
}

scalar given(const dictionary& dict, const word& name, const scalar otherwise)
{
    return dict.found(name) ? readPositive(dict, name, dimLength) : otherwise;
}
} // namespace

Foam::lubrication::lubrication(const dictionary& dict,
                               const interactionScene& scene)
    : mu_(scene.mu * (dict.found("coefficient")
                          ? readPositive(dict, "coefficient", dimless)
                          : 1)),
      thickest_(scene.thickest),
      longest_(0.5 * cmptMax(scene.grid.h())),
      range_(given(dict, "range", cmptMax(scene.grid.h()))),
      roughness_(given(dict, "roughness", 0.01 * scene.thinnest)),
      neighbours_(scene.grid),
      copies_(neighbours_)
{
    scene.needFibres(dict.parent(), type());
    checkEntries(dict, {"range", "roughness", "coefficient"});
    const scalar most = 0.25 * cmptMin(scene.grid.length());
    if (range_ > most)
    {
        refuse(dict, "range", Foam::name(range_),
               "gaps of less than " + Foam::name(most) +
                   " (a quarter of the box)");
    }
    if (roughness_ >= range_)
    {
        refuse(dict, "roughness", Foam::name(roughness_),
               "gaps below the range, " + Foam::name(range_));
    }
    checkRanges(dict,
                {{"roughness", "roughness/radius", roughness_ / scene.thinnest,
                  0.999e-6, GREAT, 0.999e-3, GREAT,
                  "the thinner the film, the longer its sum takes"}});
}

Foam::string Foam::lubrication::describe() const
{
    return "gaps below " + Foam::name(range_) + " m, constant below " +
           Foam::name(roughness_) + " m";
}

Foam::lubrication::film Foam::lubrication::between(const vector& e1,
                                                   const vector& e2,
                                                   const vector& r12,
                                                   const scalar r1,
                                                   const scalar r2) const
{
    film f{-1, -1, false, 0, 0, 0, Zero, r12};
    const scalar radii = r1 + r2, r = 2 * r1 * r2 / radii;
    const vector a(r12 - 0.5 * e1), c(-0.5 * e2);
    const scalar nearest = mag(connection(a, a + e1, c, c + e2)) - radii;
    if (nearest >= range_) return f;

    // Points in the middle of parts shorter than the film is wide
    const scalar apart = 0.7 * std::sqrt(4 * r * max(nearest, roughness_));
    const label n1 = label(mag(e1) / apart) + 1,
                n2 = label(mag(e2) / apart) + 1;
    for (label i = 0; i < n1; ++i)
    {
        const scalar s = (i + 0.5) / n1 - 0.5;
        const vector x(r12 + s * e1);
        for (label j = 0; j < n2; ++j)
        {
            const scalar t = (j + 0.5) / n2 - 0.5;
            const scalar d = mag(x - t * e2);
            const scalar gap = max(d - radii, roughness_);
            if (gap >= range_) continue;
            const scalar k = (1 / sqr(gap) - 1 / sqr(range_)) / max(d, radii);
            f.k += k;
            f.at += k * s;
            f.otherAt += k * t;
        }
    }
    if (f.k == 0) return f;
    f.at /= f.k;
    f.otherAt /= f.k;
    f.k *= 6 * mu_ * std::pow(r1 * r2, 1.5) / radii * mag(e1) * mag(e2) /
           (n1 * n2);
    f.n = r12 + f.at * e1 - f.otherAt * e2;
    f.n /= max(mag(f.n), VSMALL);
    return f;
}

Foam::scalar Foam::lubrication::ofWall(const scalar gap, const scalar r) const
{
    const auto per = [&](const scalar g) { return std::pow(2 * r / g, 1.5); };
    return gap < range_
               ? 1.5 * pi * mu_ * (per(max(gap, roughness_)) - per(range_))
               : 0;
}

void Foam::lubrication::findResistances(const closePairs& pairs,
                                        const UList<interactingPoint>& points,
                                        const fibreMotions& motions,
                                        scalarField& k)
{
    films_.clear();
    for (const closePairs::pair& p : pairs.pairs())
    {
        const scalar r1 = points[p.first].radius, r2 = points[p.second].radius;
        if (r1 == 0 || r2 == 0) continue;

        // Films are between two rods, and parts of one fibre do not move as such
        if (pairs.body()[p.first] == pairs.body()[p.second]) continue;
        film f(between(motions.elements[p.first], motions.elements[p.second],
                       p.r, r1, r2));
        if (f.k == 0) continue;
        f.first = p.first;
        f.second = p.second;
        f.bothHeld = p.bothHeld;
        films_.push_back(f);
        k[f.first] += f.k;
        if (f.bothHeld) k[f.second] += f.k;
    }
    forAll(motions.toWalls, i)
    {
        const scalar gap = motions.toWalls[i] - points[i].radius;
        if (points[i].radius == 0 || gap >= range_ || !pairs.holds(i))
        {
            continue;
        }
        const scalar k1 =
            ofWall(gap, points[i].radius) * mag(motions.elements[i]);
        films_.push_back({i, -1, false, k1, 0, 0, motions.inward[i],
                          motions.toWalls[i] * motions.inward[i]});
        k[i] += k1;
    }
}

Foam::filmMemory::key Foam::lubrication::keyOf(const film& f,
                                               const closePairs& pairs,
                                               const fibreMotions& motions)
{
    const label i = f.first, j = f.second;
    if (j < 0)
    {
        return {pairs.body()[i], motions.numbers[i], -1, sideOf(f.n)};
    }
    return filmMemory::lowerFirst({pairs.body()[i], motions.numbers[i],
                                   pairs.body()[j], motions.numbers[j]});
}

Foam::scalar Foam::lubrication::newForce(const film& f,
                                         const filmMemory::key& key,
                                         const fibreMotions& motions,
                                         const scalarField& implicit) const
{
    const auto velocity = [&](const label k, const scalar at)
    { return motions.velocities[k] + at * motions.turns[k]; };
    vector v(velocity(f.first, f.at));
    scalar M = implicit[f.first];
    if (f.second >= 0)
    {
        v -= velocity(f.second, f.otherAt);
        M += implicit[f.second];
    }
    const filmMemory::contact* last = memory_.find(key);
    scalar F = last ? last->force * min(scalar(1), f.k / last->k) : 0;
    F += (-f.k * (f.n & v) - F) / (1 + M);
    return F;
}

void Foam::lubrication::resist(const closePairs& pairs,
                               const fibreMotions& motions,
                               const scalarField& implicit, armedForces& forces)
{
    DynamicList<vector> X(2 * films_.size());
    DynamicList<scalar> contacts(6 * X.capacity());
    for (const film& f : films_)
    {
        const label i = f.first, j = f.second;
        const filmMemory::key key(keyOf(f, pairs, motions));
        const scalar F = newForce(f, key, motions, implicit);
        forces.F[i] += F * f.n;
        forces.arms[i] += f.at * F * f.n;
        forces.moment += (f.bothHeld || j < 0 ? F : 0.5 * F) * (f.n * f.r);
        if (f.bothHeld)
        {
            forces.F[j] -= F * f.n;
            forces.arms[j] -= f.otherAt * F * f.n;
        }
        filmMemory::append({key, F, f.k}, contacts);
        if (!Pstream::parRun()) continue;
        X.append(pairs.holdingPlace(i));
        if (f.bothHeld)
        {
            X.append(pairs.holdingPlace(j));
            filmMemory::append({key, F, f.k}, contacts);
        }
    }
    if (!Pstream::parRun())
    {
        memory_.set(contacts);
        return;
    }
    copies_.route(X, 2);
    memory_.set(copies_.handOut(contacts.cdata(), 6));
}
