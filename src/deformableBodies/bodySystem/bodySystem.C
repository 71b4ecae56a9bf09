// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodySystem.H"
#include "fvOptions.H"
#include "lastStep.H"

Foam::bodySystem::bodySystem(const fvMesh& mesh, const bool solverBalances)
    : mesh(mesh),
      grid(uniformGrid::New(mesh)),
      effects(mesh.time(), mesh.dbDir()),
      solverBalances(solverBalances),
      placed(grid)
{
}

bool Foam::bodySystem::twoWay() const
{
    for (const bodyGroup& group : groups)
    {
        if (group.twoWay()) return true;
    }
    return false;
}

bool Foam::bodySystem::startsAfresh() const
{
    bool any = false;
    for (const bodyGroup& group : groups)
    {
        any = any || group.startsAfresh();
    }
    return returnReduce(any, orOp<bool>());
}

Foam::labelList Foam::bodySystem::groupsOf(const forcingType forcing,
                                           label* nTwoWay) const
{
    DynamicList<label> acting, following;
    forAll(groups, g)
    {
        if (groups[g].forcing() != forcing) continue;
        (groups[g].twoWay() ? acting : following).append(g);
    }
    if (nTwoWay) *nTwoWay = acting.size();
    acting.append(following);
    return labelList(std::move(acting));
}

void Foam::bodySystem::begin()
{
    ownership->migrate(groups);
    if (!between) return;
    const auto timing(effects.time("neighbourField"));
    between->update();
}

Foam::label Foam::bodySystem::nMarkers(const labelUList& which) const
{
    label n = 0;
    for (const label g : which)
    {
        n += groups[g].nMarkers();
    }
    return n;
}

Foam::scalar Foam::bodySystem::excessViscosity(const label g) const
{
    const bodyGroup& group = groups[g];
    if (!group.inside()) return 0;
    const scalar around =
        group.host() < 0 ? 1 : groups[group.host()].inside()->viscosityRatio();
    return group.inside()->viscosityRatio() - around;
}

Foam::bodySystem::markerLoads
Foam::bodySystem::loads(const labelUList& which) const
{
    DynamicList<label> acting;
    for (const label g : which)
    {
        if (groups[g].twoWay()) acting.append(g);
    }
    markerLoads all;
    all.X.setSize(nMarkers(acting));
    all.F.setSize(all.X.size());
    const Time& time = mesh.time();
    const scalar middle = time.value() - 0.5 * lastStep::subStep(time);
    label first = 0;
    for (const label g : acting)
    {
        groups[g].loads(all.X.data() + first, all.F.data() + first, middle);
        first += groups[g].nMarkers();
    }
    return all;
}

Foam::wordList Foam::bodySystem::groupNames() const
{
    wordList names(groups.size());
    forAll(groups, g)
    {
        names[g] = groups[g].name();
    }
    return names;
}

void Foam::bodySystem::spreadLoads(const labelUList& which,
                                   staggeredField& faces) const
{
    const markerLoads all(loads(which));
    if (!returnReduce(all.X.size(), maxOp<label>())) return;
    const auto timing(effects.time("spreading"));
    markers->setPositions(all.X);
    markers->spread(all.F, faces);
}

bool Foam::bodySystem::isDriven() const
{
    const auto* options = mesh.cfindObject<fv::options>(fv::options::typeName);
    if (!options) return false;
    const wordList others({"deformableBodies", "ABCForcing",
                           "EswaranPopeForcing"}); // without a mean force
    for (const fv::option& o :
         static_cast<const PtrList<fv::option>&>(*options))
    {
        if (!others.found(o.type()) && o.active() && o.applyToField("U") >= 0)
        {
            return true;
        }
    }
    return false;
}

Foam::vector Foam::bodySystem::unbalanced(const vectorField& F,
                                          const labelUList& which) const
{
    const bool driven = isDriven();
    vector all(Zero);
    label first = 0;
    for (const label g : which)
    {
        const bodyGroup& group = groups[g];
        if (!group.twoWay()) continue;
        const label n = group.nMarkers();
        if (!driven || !group.isHeld())
            all += sum(SubField<vector>(F, n, first));
        first += n;
    }
    return returnReduce(all, sumOp<vector>());
}

Foam::vector Foam::bodySystem::forceByHeld() const
{
    vector sum(Zero);
    if (!periodicBox() || !isDriven()) return sum;
    forAll(groups, g)
    {
        const bodyGroup& group = groups[g];
        if (!group.isHeld()) continue;
        forAll(group.mine(), i)
        {
            if (interactions) sum -= interactions->forceOn(g, group.mine()[i]);
            if (films) sum -= films->forceOn(g, i);
        }
    }
    return returnReduce(sum, sumOp<vector>());
}

bool Foam::bodySystem::adjustsStep() const
{
    return mesh.time().controlDict().getOrDefault<bool>("adjustTimeStep",
                                                        false);
}
