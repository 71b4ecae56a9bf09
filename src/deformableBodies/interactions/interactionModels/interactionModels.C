// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "interactionModels.H"
#include "dictionaryChecks.H"

Foam::interactionModels::interactionModels(const dictionary& dict,
                                           const interactionScene& scene,
                                           effectTable& effects)
{
    for (const contactLoad& load : scene.loads)
    {
        load_ = max(load_, load.force);
    }
    wordList names(contactForce::dictionaryConstructorTablePtr_->toc());
    names.append(contactResistance::dictionaryConstructorTablePtr_->toc());
    sort(names);
    checkEntries(dict, names);
    for (const word& name : dict.toc())
    {
        if (contactForce::known(name))
        {
            forces_.append(contactForce::New(name, dict, scene).ptr());
            include(forces_.last(), scene, effects);
        }
        else
        {
            resistances_.append(
                contactResistance::New(name, dict, scene).ptr());
            include(resistances_.last(), scene, effects);
        }
    }
}

void Foam::interactionModels::include(const interactionModel& model,
                                      const interactionScene& scene,
                                      effectTable& effects)
{
    effects.declare(model.type(), true, model.describe());
    if (scene.softest > 0)
    {
        surfaceRange_ = max(surfaceRange_, model.range(true, true));
    }
    if (scene.thickest > 0)
    {
        lineRange_ = max(lineRange_, max(model.range(true, false),
                                         model.range(false, false)));
    }
}

bool Foam::interactionModels::actOn(const bool surface,
                                    const bool otherIsSurface) const
{
    for (const contactForce& force : forces_)
    {
        if (force.range(surface, otherIsSurface) > 0) return true;
    }
    for (const contactResistance& resistance : resistances_)
    {
        if (resistance.range(surface, otherIsSurface) > 0) return true;
    }
    return false;
}

bool Foam::interactionModels::actWithinLines() const
{
    for (const contactForce& force : forces_)
    {
        if (force.withinLines()) return true;
    }
    return false;
}

Foam::scalar Foam::interactionModels::maxDeltaT(const scalar now) const
{
    scalar smallest = GREAT;
    for (const contactForce& force : forces_)
    {
        smallest = min(smallest, force.maxDeltaT(now));
    }
    return smallest;
}

std::pair<Foam::scalar, Foam::scalar>
Foam::interactionModels::ofWall(const scalar distance,
                                const bool isSurface) const
{
    std::pair<scalar, scalar> sum(0, 0);
    for (const contactForce& force : forces_)
    {
        const scalar P = force.ofWall(distance, isSurface);
        sum.first += P;
        if (P > 0) sum.second += P * force.wallSteepness(distance);
    }
    return sum;
}

Foam::List<Foam::scalarList> Foam::interactionModels::memory() const
{
    List<scalarList> memories;
    for (const contactResistance& resistance : resistances_)
    {
        memories.append(resistance.memory());
    }
    return memories;
}

void Foam::interactionModels::remember(const List<scalarList>& memories)
{
    forAll(resistances_, m)
    {
        resistances_[m].remember(memories[m]);
    }
}
