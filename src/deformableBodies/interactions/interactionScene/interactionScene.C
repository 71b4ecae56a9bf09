// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "interactionScene.H"
#include "bodyGroup.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include "Time.H"

bool Foam::interactionScene::takesPart(const bodyGroup& group)
{
    return group.takesForces() && !group.withoutFluid();
}

Foam::interactionScene
Foam::interactionScene::of(const fvMesh& mesh, const PtrList<bodyGroup>& groups,
                           const bodyScene& scene, const bool nearField)
{
    const dictionary& control = mesh.time().controlDict();
    interactionScene all{
        scene.grid,
        scene.mu,
        scene.adjusted && scene.likelyDeltaT < GREAT ? scene.likelyDeltaT
        : control.found("deltaT") ? readPositive(control, "deltaT", dimTime)
                                  : mesh.time().deltaTValue(),
        0,
        0,
        GREAT,
        List<contactLoad>(),
        nearField};
    all.adjusted = scene.adjusted && scene.forceAtFaces;
    all.films = nearField;
    forAll(groups, g)
    {
        if (!takesPart(groups[g])) continue;
        all.loads.append(contactLoad::of(groups, g, scene));
        all.add(groups[g].points(-1));
        if (all.loads.last().isSurface && groups[g].host() < 0)
        {
            all.share += groups[g].nBodies() * 4 *
                         constant::mathematical::pi / 3 *
                         pow3(all.loads.last().radius) / scene.grid.volume();
        }
        const nearSurface* surface = groups[g].nearSources();
        all.films = all.films && surface && surface->makesFilms();
    }
    return all;
}

std::function<Foam::scalar(Foam::scalar)>
Foam::interactionScene::deltaTOf(const bool surfaces, const scalar range) const
{
    const List<contactLoad> all(loads);
    return [=](const scalar now)
    {
        scalar least = GREAT;
        for (const contactLoad& load : all)
        {
            if (load.isSurface == surfaces)
                least = min(least, load.borne(range, now));
        }
        return least;
    };
}

void Foam::interactionScene::add(const bodyPoints& p)
{
    const scalar pi = constant::mathematical::pi;
    if (p.isSurface())
    {
        const scalar area = sum(mag(p.areas));
        const scalar Gs = p.stiffness / std::sqrt(area / (4 * pi));
        softest = softest ? min(softest, Gs) : Gs;
    }
    else
    {
        const scalar radius = std::sqrt(p.crossSection / pi);
        thickest = max(thickest, radius);
        thinnest = min(thinnest, radius);
    }
}

void Foam::interactionScene::needFibres(const dictionary& interactions,
                                        const word& model) const
{
    if (thickest == 0)
    {
        refuse(interactions, model, "{...}",
               "scenes with filaments in a fluid");
    }
    const scalar h = cmptMax(grid.h());
    if (thinnest < 0.125 * h)
    {
        refuse(interactions, model,
               "{...} with filaments of diameter " + Foam::name(2 * thinnest),
               "diameters of " + Foam::name(0.25 * h) +
                   " (a quarter of a cell) and more");
    }
}
