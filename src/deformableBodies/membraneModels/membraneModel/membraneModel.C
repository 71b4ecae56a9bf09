// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "membraneModel.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(membraneModel, 0);
defineRunTimeSelectionTable(membraneModel, dictionary);
} // namespace Foam

Foam::autoPtr<Foam::membraneModel>
Foam::membraneModel::New(const dictionary& dict)
{
    requireEntry(dict, "law");
    const word law(dict.get<word>("law"));
    auto cstr = dictionaryConstructorTablePtr_->cfind(law);
    if (!cstr.found())
    {
        refuse(dict, "law", law,
               oneOf(dictionaryConstructorTablePtr_->sortedToc()));
    }
    return cstr()(dict);
}
