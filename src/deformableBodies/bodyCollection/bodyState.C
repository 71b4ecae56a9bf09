// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyState.H"
#include "bodyWriter.H"
#include "dictionaryChecks.H"
#include "functionObject.H"
#include <iomanip>
#include <sstream>

void Foam::bodyState::writeEntries(std::ostream& os,
                                   const entryHistory& entries) const
{
    OStringStream list;
    for (const auto& e : entries)
    {
        list << " (" << e.first() << ' ' << e.second() << ')';
    }
    os << "        given (" << list.str() << ");\n";
}

void Foam::bodyState::writeBodies(std::ostream& os,
                                  const bodyGroup& group) const
{
    const List<scalarList> local(group.states());
    const List<scalarList> states(bodyWriter::inOrder<scalarList>(
        group, [&](const label i) { return local[i]; }));
    os << group.name() << "\n(\n";
    for (const scalarList& s : states)
    {
        os << '(';
        for (const scalar x : s)
        {
            os << x << ' ';
        }
        os << ")\n";
    }
    os << ");\n";
}

void Foam::bodyState::write(Ostream& os, const bool diverged) const
{
    // 17 digits carry a double exactly; the file is text whatever writeFormat
    std::ostringstream text;
    text << std::setprecision(17);
    if (diverged) text << bodyStateFile::diverged << " true;\n";

    text << bodyStateFile::allGroups << "\n{\n    removed (";
    for (const word& name : removed_)
    {
        text << ' ' << name;
    }
    text << " );\n";
    writeEntries(text, given_.last());
    if (system_.nu->isMean())
    {
        text << "    nu " << system_.nu->value() << ";\n";
    }
    if (system_.interactions)
    {
        text << "    flowSpeed " << system_.firstFlow.speed
             << ";\n    flowRate " << system_.firstFlow.rate
             << ";\n    loads\n    {\n";
        for (const word& group : system_.firstLoads.sortedToc())
        {
            text << "        " << group << ' ' << system_.firstLoads[group]
                 << ";\n";
        }
        text << "    }\n";
    }
    if (system_.flowDeltaT >= 0)
    {
        text << "    flowDeltaT " << system_.flowDeltaT << ";\n";
    }
    if (system_.accuracy.wanted > 0 && limits_.savedDeltaT() < GREAT)
    {
        text << "    accuracy " << system_.accuracy.wanted << ";\n    deltaT "
             << limits_.savedDeltaT() << ";\n";
    }

    text << "}\n" << bodyStateFile::groups << "\n{\n";
    forAll(system_.groups, g)
    {
        const bodyGroup& group = system_.groups[g];
        text << "    " << group.name() << " { type " << group.type() << ';';
        for (const auto& fact : group.madeWith())
        {
            text << ' ' << fact.first() << ' ' << fact.second() << ';';
        }
        text << '\n';
        writeEntries(text, given_[g]);
        text << "    }\n";
    }
    text << "}\n";

    for (const bodyGroup& group : system_.groups)
    {
        writeBodies(text, group);
    }
    if (system_.interactions)
    {
        const string state(system_.interactions->state());
        text << bodyStateFile::interactions << "\n{\n" << state << "}\n";
    }
    if (Pstream::master()) os << text.str().c_str();
}

const Foam::dictionary&
Foam::bodyState::dictionaryOf(const label g, const dictionary& dict) const
{
    const bodyGroup& group = system_.groups[g];
    return group.host() < 0
               ? dict.subDict("bodies").subDict(group.name())
               : dictionaryOf(group.host(), dict).subDict("nucleus");
}

Foam::List<Foam::bodyState::origin>
Foam::bodyState::origins(const IOdictionary& dict) const
{
    const Enum<origin> words({{origin::STATE, "continue"},
                              {origin::DICTIONARY, "initial"},
                              {origin::EITHER, "initialOnce"}});
    const origin all = readEnum(words, dict, "restart", origin::STATE);
    List<origin> wanted(system_.groups.size());
    forAll(wanted, g)
    {
        const label host = system_.groups[g].host();
        wanted[g] = host < 0
                        ? readEnum(words, dictionaryOf(g, dict), "restart", all)
                        : wanted[host];

        // Pictures of a run are of its states
        if (functionObject::postProcess && wanted[g] == origin::DICTIONARY)
        {
            wanted[g] = origin::STATE;
        }
    }
    return wanted;
}

void Foam::bodyState::read(const IOdictionary& dict)
{
    const Time& time = system_.mesh.time();
    const List<origin> wanted(origins(dict));
    dictionary saved;
    fileName file;
    const bool found =
        (wanted.found(origin::STATE) || wanted.found(origin::EITHER)) &&
        bodyStateFile::read(system_.mesh, saved, file);
    const bool drawing = functionObject::postProcess && time.value() > 0;
    if (wanted.found(origin::STATE) && !found && time.value() > 0 && !drawing)
    {
        waitForMaster();
        FatalIOErrorInFunction(dict)
            << "no state of the bodies for time " << time.timeName()
            << ", file " << file.c_str() << nl
            << "    allowed: a time with a state, or restart initial; to start "
            << "the bodies as they stand in this file" << exit(FatalIOError);
    }
    boolList initial(wanted.size());
    forAll(initial, g)
    {
        // A nucleus starts where its capsule started: with it
        const label host = system_.groups[g].host();
        initial[g] = host < 0 ? wanted[g] == origin::DICTIONARY ||
                                    (wanted[g] == origin::EITHER &&
                                     !saved.found(system_.groups[g].name()))
                              : initial[host];
    }
    const bool any = initial.found(false);
    if (found)
    {
        Info << "Bodies continue from " << file << nl;
        checkGroups(dict, saved);
    }
    if (found && system_.interactions)
    {
        system_.interactions->readState(
            saved.subOrEmptyDict(bodyStateFile::interactions), initial);
    }
    forAll(system_.groups, g)
    {
        bodyGroup& group = system_.groups[g];
        if (drawing && !saved.found(group.name()))
        {
            Info << "Group " << group.name() << " is not in the state of time "
                 << time.timeName() << ": no bodies" << nl;
            continue;
        }
        const bool continues = found && !initial[g];
        if (found && !continues && group.start().atRandom && any)
        {
            refuse(dictionaryOf(g, dict), "placement",
                   "{...} in a group that starts while others go on",
                   "positions: random places know only where the others "
                   "started; or restart initial; for all");
        }
        system_.ownership->distribute(
            system_.groups, g,
            continues ? statesOf(group, saved) : List<scalarList>(),
            continues ? saved : dictionaryOf(g, dict));
        if (time.value() > 0 && !continues)
        {
            Info << "Group " << group.name() << " starts from constant/"
                 << "deformableBodies at time " << time.timeName()
                 << (saved.found(group.name()) ? ", although the state has it"
                                               : "")
                 << (wanted[g] == origin::EITHER
                         ? " (restart initialOnce: later "
                           "runs continue)"
                         : " (restart initial)")
                 << nl;
        }
    }
    if (found) compareEntries(saved, initial);
}
