// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bulkStressFunction.H"
#include "addToRunTimeSelectionTable.H"
#include "bodyCollection.H"
#include "dictionaryChecks.H"
#include "sampledBodies.H"

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(bulkStressFunction, 0);
addToRunTimeSelectionTable(functionObject, bulkStressFunction, dictionary);
} // namespace functionObjects
} // namespace Foam

Foam::functionObjects::bulkStressFunction::bulkStressFunction(
    const word& name, const Time& time, const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      bodies_(bodyCollection::New(mesh_))
{
    if (bodies_.system().solverBalances)
    {
        refuse(dict, "type", typeName,
               "entry bulkStress in constant/deformableBodies: "
               "deformableBodyFoam needs no functionObject");
    }
    if (bodies_.empty())
    {
        refuse(dict, "type", typeName,
               "cases with constant/deformableBodies: there are no bodies");
    }
    for (const word when : {"executeControl", "executeInterval", "timeStart"})
    {
        if (!dict.found(when)) continue;
        refuse(dict, when, valueOf(*dict.findEntry(when)),
               "interval (steps) and startAverage in its place");
    }
    dictionary entry(dict.name());
    entry.add("bulkStress", dict);
    bodies_.statistics().watchStress(true, &entry);
}

bool Foam::functionObjects::bulkStressFunction::execute()
{
    if (postProcess) return true;
    sampledBodies::requireMotion(bodies_, *this);
    bodies_.statistics().end();
    return true;
}
