// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyGroup.H"
#include "dictionaryChecks.H"
#include "placement.H"
#include "weight.H"
#include <algorithm>

namespace Foam
{
defineTypeNameAndDebug(bodyGroup, 0);
defineRunTimeSelectionTable(bodyGroup, dictionary);
} // namespace Foam

Foam::bodyCoupling Foam::readCoupling(const dictionary& dict,
                                      const bodyCoupling otherwise)
{
    return readEnum(Enum<bodyCoupling>({{bodyCoupling::none, "none"},
                                        {bodyCoupling::oneWay, "oneWay"},
                                        {bodyCoupling::twoWay, "twoWay"}}),
                    dict, "coupling", otherwise);
}

bool Foam::removesOutside(const dictionary& dict, const bool otherwise)
{
    return readEnum(Enum<bool>({{false, "stop"}, {true, "remove"}}), dict,
                    "outside", otherwise);
}

Foam::faceList Foam::ringFaces(const label nRings, const label nAround)
{
    faceList faces((nRings - 1) * nAround + 2, face(4));
    for (label f = 0; f + 2 < faces.size(); ++f)
    {
        const label ring = f / nAround * nAround, next = (f + 1) % nAround;
        faces[f][0] = f;
        faces[f][1] = f + nAround;
        faces[f][2] = ring + next + nAround;
        faces[f][3] = ring + next;
    }
    face north(nAround), south(nAround);
    for (label j = 0; j < nAround; ++j)
    {
        north[j] = j;
        south[j] = nRings * nAround - 1 - j;
    }
    faces[faces.size() - 2] = north;
    faces[faces.size() - 1] = south;
    return faces;
}

Foam::bodyGroup::bodyGroup(const word& name, const dictionary& dict,
                           const bodyScene& scene)
    : name_(name),
      coupling_(readCoupling(dict, scene.coupling)),
      removesOutside_(Foam::removesOutside(dict, scene.removesOutside)),
      scene_(scene)
{
    // Kernels do not wrap around a box of their own width
    const label least = scene.kernel.nPoints();
    const label n = cmptMin(scene.grid.n());
    if (!alone() && n < least)
    {
        refuse(
            dict, "type",
            dict.get<word>("type") + " on a mesh of " + Foam::name(n) +
                " cells in one direction",
            "meshes of " + Foam::name(least) +
                " cells and more in each direction, the width of the kernel");
    }
}

Foam::autoPtr<Foam::bodyGroup> Foam::bodyGroup::New(const word& name,
                                                    const dictionary& dict,
                                                    const bodyScene& scene)
{
    const word type(dict.get<word>("type"));
    auto cstr = dictionaryConstructorTablePtr_->cfind(type);
    if (!cstr.found())
    {
        refuse(dict, "type", type,
               oneOf(dictionaryConstructorTablePtr_->sortedToc()));
    }
    return cstr()(name, dict, scene);
}

Foam::FixedList<Foam::direction, 2>
Foam::bodyGroup::readShearPlane(const dictionary& dict) const
{
    const Enum<vector::components> axes(
        {{vector::X, "x"}, {vector::Y, "y"}, {vector::Z, "z"}});
    const wordList plane(dict.getOrDefault<wordList>("shearPlane", {"x", "y"}));
    if (plane.size() != 2 || plane[0] == plane[1])
    {
        refuse(dict, "shearPlane", Foam::name(plane.size()) + " words",
               "two different ones of x y z");
    }
    FixedList<direction, 2> directions;
    forAll(plane, k)
    {
        if (!axes.found(plane[k]))
        {
            refuse(dict, "shearPlane", plane[k], "two of x y z");
        }
        directions[k] = axes[plane[k]];
    }
    return directions;
}

bool Foam::bodyGroup::readGravity(const dictionary& dict) const
{
    const bool on = dict.getOrDefault<bool>("gravity", false);
    if (on && scene_.g == vector::zero)
    {
        refuse(dict, "gravity", "on", "off, or a file constant/g with a value");
    }
    return on;
}

Foam::bodyGroup::nearFieldEntry
Foam::bodyGroup::readNearField(const dictionary& dict, const string& never,
                               const scalar errorWithout) const
{
    const word wanted(
        readWord(dict, "nearField", {"auto", "on", "off"}, "auto"));
    string whyNot(never);
    const vector& h = scene_.grid.h();
    if (whyNot.empty() && cmptMax(h) > 1.001 * cmptMin(h))
    {
        whyNot = "cells that are not cubes";
    }
    if (whyNot.empty() && !scene_.forceAtFaces)
    {
        whyNot = "the solver takes the force as an average of each cell";
    }
    if (wanted == "on" && !whyNot.empty())
    {
        refuse(dict, "nearField", "on", "auto or off: " + whyNot);
    }
    if (wanted == "off") whyNot = "off";
    const scalar error = scene_.accuracy.wanted;
    if (wanted == "auto" && whyNot.empty() && errorWithout >= 0 &&
        errorWithout <= 0.6 * error)
    {
        whyNot = "accuracy " + Foam::name(error) + " needs none";
    }
    return {wanted == "on", wanted == "auto" && whyNot.empty(), whyNot};
}

void Foam::bodyGroup::addWeight(const bool on, const scalar excess)
{
    const bool acts = on && excess != 0;
    if (acts)
    {
        scene_.forces.append(new weight(name_, excess * scene_.rho * scene_.g));
    }
    scene_.effects.declare("gravity", acts,
                           acts ? "weight of " + name_
                           : on ? "as heavy as the fluid"
                                : "none on the bodies");
}

void Foam::bodyGroup::checkWalls(const dictionary& dict, const label body,
                                 const boundBox& bounds) const
{
    const vector lo(scene_.grid.origin()), hi(lo + scene_.grid.length());
    for (direction d = 0; d < 3; ++d)
    {
        if (!scene_.grid.periodic(d) &&
            (bounds.min()[d] < lo[d] || bounds.max()[d] > hi[d]))
        {
            firstRankSpeaks();
            FatalIOErrorInFunction(dict)
                << "entry positions: body " << body
                << " reaches through a wall of the box: it extends from "
                << bounds.min()[d] << " to " << bounds.max()[d]
                << " in direction " << vector::componentNames[d] << nl
                << "    allowed: " << lo[d] << " to " << hi[d]
                << exit(FatalIOError);
        }
    }
}

Foam::string Foam::bodyGroup::nameOfBody(const label body) const
{
    return "body " + Foam::name(body) + " of group " + name_;
}

void Foam::bodyGroup::insert(const label body, const scalarList& state,
                             const dictionary& source)
{
    const label i =
        std::lower_bound(mine_.begin(), mine_.end(), body) - mine_.begin();
    mine_.append(body);
    for (label k = mine_.size() - 1; k > i; --k)
    {
        mine_[k] = mine_[k - 1];
    }
    mine_[i] = body;
    insertBody(i, body);
    if (state.size())
    {
        setState(i, state, source);
        return;
    }
    startsAfresh_ = true;
    checkStart(i, source);
}

// Points of either are no more than 1.4 cells apart, and repulsion keeps those of the
// other about as far away: a Stokeslet smoothed over a cell is enough
void Foam::bodyGroup::putInto(const label host, bodyGroup& group)
{
    host_ = host;
    partner_ = &group;
    group.partner_ = this;
    if (hasNearField() && group.hasNearField())
    {
        const scalar h = scene_.grid.h().x();
        between_ =
            std::make_shared<nearField>(scene_.kernel.type(), h, scene_.mu, h);
        group.between_ = between_;
    }
    const vector L(scene_.grid.length());
    forAll(positions_, body)
    {
        const vector away(positions_[body] - group.initialCentre(body));
        for (direction d = 0; d < 3; ++d)
        {
            if (scene_.grid.periodic(d))
            {
                positions_[body][d] -= L[d] * std::round(away[d] / L[d]);
            }
        }
    }
}

void Foam::bodyGroup::addOfPartner(const label i, const vector* X,
                                   const label n, vector* u) const
{
    const pointForces& there = partner_->nearForces(i);
    between_->add(there.X.data(), there.F.data(), label(there.X.size()), X, n,
                  u);
}

Foam::scalarList Foam::bodyGroup::release(const label i)
{
    const scalarList s(state(i));
    for (label k = i; k + 1 < mine_.size(); ++k)
    {
        mine_[k] = mine_[k + 1];
    }
    mine_.setSize(mine_.size() - 1);
    eraseBody(i);
    return s;
}

Foam::List<Foam::scalarList> Foam::bodyGroup::states() const
{
    List<scalarList> all(mine_.size());
    forAll(all, i)
    {
        all[i] = state(i);
    }
    return all;
}

void Foam::bodyGroup::readPlaces(const dictionary& dict, const solidForm& form,
                                 const scalar volume, const scalar fromCentre,
                                 const vector& otherwise)
{
    const vector lo(scene_.grid.origin()), L(scene_.grid.length());
    if (dict.found("placement"))
    {
        const placement places(dict, name_, form, volume, scene_.grid,
                               scene_.placed);
        positions_ = places.centres() + fromCentre * places.directions();
        directions_ = places.directions();
        for (point& x : positions_)
        {
            x = intoBox(scene_.grid, x);
        }
        nBodies_ = positions_.size();
        placedAtRandom_ = true;
        return;
    }

    positions_ = pointField(dict.lookup("positions"));
    if (positions_.empty())
    {
        refuse(dict, "positions", "()", "at least one point, ((x y z) ...)");
    }
    const boundBox box(lo, lo + L);
    forAll(positions_, i)
    {
        if (!box.contains(positions_[i]))
        {
            firstRankSpeaks();
            FatalIOErrorInFunction(dict)
                << "entry positions: body " << i << " at " << positions_[i]
                << " lies outside the box" << nl << "    allowed: points in "
                << box.min() << " to " << box.max() << exit(FatalIOError);
        }
    }
    nBodies_ = positions_.size();
    if (dict.found("directions"))
    {
        directions_ = vectorField(dict.lookup("directions"));
        if (directions_.size() != nBodies_)
        {
            refuse(dict, "directions",
                   Foam::name(directions_.size()) + " vectors",
                   "as many as positions, " + Foam::name(nBodies_));
        }
        for (vector& t : directions_)
        {
            if (!(mag(t) > 0))
            {
                refuse(dict, "directions", "(0 0 0)",
                       "directions of any length but 0, such as (1 0 0)");
            }
            t /= mag(t);
        }
    }
    for (label i = 0; twoWay() && i < nBodies_; ++i)
    {
        const vector t(directions_.empty() ? otherwise : directions_[i]);
        scene_.placed.add({form, positions_[i] - fromCentre * t, t});
    }
}

void Foam::bodyGroup::contactPoints(const label i, vector* X, vector* V) const
{
    const bodyPoints p(points(i));
    std::copy(p.places.begin(), p.places.end(), X);
    std::copy(p.velocities.begin(), p.velocities.end(), V);
}
