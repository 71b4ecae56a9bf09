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

void Foam::bodyGroup::setHost(const label host, const bodyGroup& group)
{
    host_ = host;
    hostGroup_ = &group;
    forAll(start_.positions, body)
    {
        point& x = start_.positions[body];
        x += shift(scene_.grid, x - group.initialCentre(body));
    }
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

void Foam::bodyGroup::contactPoints(const label i, vector* X, vector* V) const
{
    const bodyPoints p(points(i));
    std::copy(p.places.begin(), p.places.end(), X);
    std::copy(p.velocities.begin(), p.velocities.end(), V);
}
