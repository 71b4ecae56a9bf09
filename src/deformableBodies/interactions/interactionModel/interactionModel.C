// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "interactionModel.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(interactionModel, 0);
defineRunTimeSelectionTable(interactionModel, dictionary);
} // namespace Foam

Foam::autoPtr<Foam::interactionModel>
Foam::interactionModel::New(const word& name, const dictionary& interactions,
                            const interactionScene& scene)
{
    auto cstr = dictionaryConstructorTablePtr_->cfind(name);
    if (!cstr.found())
    {
        refuse(interactions, name, "{...}",
               "models " + oneOf(dictionaryConstructorTablePtr_->sortedToc()));
    }
    return cstr()(readDict(interactions, name, "range 1e-6;"), scene);
}

void Foam::needFibres(const dictionary& interactions, const word& model,
                      const interactionScene& scene)
{
    if (scene.thickest == 0)
    {
        refuse(interactions, model, "{...}",
               "scenes with filaments in a fluid");
    }
    const scalar h = cmptMax(scene.grid.h());
    if (scene.thinnest < 0.125 * h)
    {
        refuse(interactions, model,
               "{...} with filaments of diameter " +
                   Foam::name(2 * scene.thinnest),
               "diameters of " + Foam::name(0.25 * h) +
                   " (a quarter of a cell) and more");
    }
}
