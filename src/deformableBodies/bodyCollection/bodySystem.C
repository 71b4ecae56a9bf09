// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodySystem.H"

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

Foam::labelList Foam::bodySystem::groupsThat(const forcingType forcing) const
{
    DynamicList<label> which;
    forAll(groups, g)
    {
        if (groups[g].forcing() == forcing) which.append(g);
    }
    return labelList(std::move(which));
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

bool Foam::bodySystem::adjustsStep() const
{
    return mesh.time().controlDict().getOrDefault<bool>("adjustTimeStep",
                                                        false);
}
