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
