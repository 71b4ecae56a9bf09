// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyGroup.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(bodyGroup, 0);
defineRunTimeSelectionTable(bodyGroup, dictionary);
} // namespace Foam

Foam::bodyGroup::bodyGroup(const word& name, const dictionary& dict,
                           const bodyScene& scene)
    : name_(name),
      nBodies_(0),
      coupling_(readCoupling(dict, scene.coupling)),
      scene_(scene)
{
    nBodies_ = readPositions(dict).size();
    DynamicList<label> mine;
    for (label i = 0; i < nBodies_; ++i)
    {
        if (i % Pstream::nProcs() == Pstream::myProcNo()) mine.append(i);
    }
    mine_.transfer(mine);
}

Foam::word Foam::bodyGroup::readCoupling(const dictionary& dict,
                                         const word& otherwise)
{
    const word coupling(dict.getOrDefault<word>("coupling", otherwise));
    if (!wordList({"twoWay", "oneWay", "none"}).found(coupling))
    {
        refuse(dict, "coupling", coupling, "(none oneWay twoWay)");
    }
    return coupling;
}

Foam::autoPtr<Foam::bodyGroup> Foam::bodyGroup::New(const word& name,
                                                    const dictionary& dict,
                                                    const bodyScene& scene)
{
    const word type(dict.get<word>("type"));
    auto cstr = dictionaryConstructorTablePtr_->cfind(type);
    if (!cstr.found())
    {
        FatalIOErrorInFunction(dict)
            << "entry type has the value " << type << nl << "    allowed: "
            << flatOutput(dictionaryConstructorTablePtr_->sortedToc())
            << exit(FatalIOError);
    }
    return cstr()(name, dict, scene);
}

Foam::FixedList<Foam::direction, 2>
Foam::bodyGroup::readShearPlane(const dictionary& dict) const
{
    const wordList plane(dict.getOrDefault<wordList>("shearPlane", {"x", "y"}));
    if (plane.size() != 2 || plane[0] == plane[1])
    {
        refuse(dict, "shearPlane", Foam::name(plane.size()) + " words",
               "two different ones of x y z");
    }
    FixedList<direction, 2> directions;
    forAll(plane, k)
    {
        const label d = wordList({"x", "y", "z"}).find(plane[k]);
        if (d < 0) refuse(dict, "shearPlane", plane[k], "two of x y z");
        directions[k] = d;
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

void Foam::bodyGroup::checkWalls(const dictionary& dict, const label body,
                                 const boundBox& bounds) const
{
    const vector lo(scene_.grid.origin()), hi(lo + scene_.grid.length());
    for (direction d = 0; d < 3; ++d)
    {
        if (!scene_.grid.periodic(d) &&
            (bounds.min()[d] < lo[d] || bounds.max()[d] > hi[d]))
        {
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

void Foam::bodyGroup::addLoad(const word& name, const dictionary& dict)
{
    refuse(dict, "group", name_, "a group of bodies that takes loads");
}

Foam::pointField Foam::bodyGroup::readPositions(const dictionary& dict) const
{
    const pointField positions(dict.lookup("positions"));
    if (positions.empty())
    {
        refuse(dict, "positions", "()", "at least one point, ((x y z) ...)");
    }
    const boundBox box(scene_.grid.origin(),
                       scene_.grid.origin() + scene_.grid.length());
    forAll(positions, i)
    {
        if (!box.contains(positions[i]))
        {
            FatalIOErrorInFunction(dict)
                << "entry positions: body " << i << " at " << positions[i]
                << " lies outside the box" << nl << "    allowed: points in "
                << box.min() << " to " << box.max() << exit(FatalIOError);
        }
    }
    return positions;
}
