// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyGroup.H"
#include "dictionaryChecks.H"
#include "periodicBox.H"
#include <algorithm>

namespace Foam
{
defineTypeNameAndDebug(bodyGroup, 0);
defineRunTimeSelectionTable(bodyGroup, dictionary);
} // namespace Foam

Foam::bodyGroup::bodyGroup(const word& name, const dictionary& dict,
                           const bodyScene& scene)
    : bodyMembers(name, dict, scene),
      scene_(scene)
{
    // Kernels do not wrap around a box of their own width
    const label least = scene.kernel.nPoints();
    const label n = cmptMin(scene.grid.n());
    if (!withoutFluid() && n < least)
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
    requireEntry(dict, "type");
    const word type(dict.get<word>("type"));
    auto cstr = dictionaryConstructorTablePtr_->cfind(type);
    if (!cstr.found())
    {
        refuse(dict, "type", type,
               oneOf(dictionaryConstructorTablePtr_->sortedToc()));
    }
    return cstr()(name, dict, scene);
}

void Foam::bodyGroup::insert(const label body, const scalarList& state,
                             const dictionary& source)
{
    const bool atStart = state.empty();
    const label i = add(body, atStart);
    insertBody(i, body, state, source);
    if (atStart) checkStart(i, source);
}

void Foam::bodyGroup::checkStart(const label i, const dictionary& dict) const
{
    const boundBox box(bounds(i, true));
    const vector lo(scene_.grid.origin()), length(scene_.grid.length());
    const auto refuseBox =
        [&](const direction d, const string& what, const string& allowed)
    {
        waitForMaster();
        FatalIOErrorInFunction(dict)
            << "entry positions: body " << mine()[i] << what.c_str()
            << box.min()[d] << " to " << box.max()[d] << " in direction "
            << vector::componentNames[d] << nl
            << "    allowed: " << allowed.c_str() << exit(FatalIOError);
    };
    for (direction d = 0; d < 3; ++d)
    {
        const scalar hi = lo[d] + length[d];
        if (!scene_.grid.periodic(d) &&
            (box.min()[d] < lo[d] || box.max()[d] > hi))
        {
            refuseBox(d, " reaches through a wall of the box: it extends from ",
                      Foam::name(lo[d]) + " to " + Foam::name(hi));
        }
        if (box.span()[d] >= length[d] && points(-1).isSurface())
        {
            refuseBox(d, " is larger than the box: it extends from ",
                      "less than " + Foam::name(length[d]));
        }
    }
}

Foam::string Foam::bodyGroup::unsteady(const label body,
                                       const scalar displacement,
                                       const scalar sum,
                                       const scalar difference,
                                       const scalar radius, label& n) const
{
    const scalar cells = displacement / cmptMin(scene_.grid.h());
    if (!(cells <= 1))
    {
        return nameOfBody(body) + " moves by " + Foam::name(cells) +
               " cells in a step, limit 1";
    }
    n = difference > max(0.3 * sum, 0.005 * radius) ? n + 1 : 0;
    if (n >= 3)
    {
        return nameOfBody(body) + " moves to and fro by " +
               Foam::name(difference / radius) + " radii from step to step";
    }
    return string::null;
}

void Foam::bodyGroup::setHost(const label host, const bodyGroup& group)
{
    host_ = host;
    forAll(start_.positions, body)
    {
        point& x = start_.positions[body];
        x += shift(scene_.grid, x - group.initialCentre(body));
    }
}

Foam::scalarList Foam::bodyGroup::release(const label i)
{
    const scalarList s(state(i));
    remove(i);
    eraseBody(i);
    return s;
}

Foam::List<Foam::scalarList> Foam::bodyGroup::states() const
{
    List<scalarList> all(mine().size());
    forAll(all, i)
    {
        all[i] = state(i);
    }
    return all;
}

void Foam::bodyGroup::contactPoints(const label i, vector* X, vector* V) const
{
    const bodyPoints p(points(i));
    std::copy(p.positions.begin(), p.positions.end(), X);
    std::copy(p.velocities.begin(), p.velocities.end(), V);
}
