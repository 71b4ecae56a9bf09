// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Whether a state fits the dictionary

#include "bodyState.H"
#include "dictionaryChecks.H"

bool Foam::bodyState::isGroup(const word& name, const dictionary& saved)
{
    return !saved.isDict(name) && !bodyStateFile::reserved(name);
}

void Foam::bodyState::checkGroups(const IOdictionary& dict,
                                  const dictionary& saved)
{
    if (saved.getOrDefault<bool>(bodyStateFile::diverged, false))
    {
        waitForMaster();
        FatalIOErrorInFunction(saved)
            << "this state was written because the run diverged" << nl
            << "    allowed: an earlier time to start from"
            << exit(FatalIOError);
    }
    const dictionary before(saved.subOrEmptyDict(bodyStateFile::allGroups));
    if (before.getOrDefault<scalar>("accuracy", 0) == system_.accuracy.wanted)
    {
        limits_.setSavedDeltaT(before.getOrDefault<scalar>("deltaT", GREAT));
    }
    removed_ = before.getOrDefault<wordList>("removed", wordList());
    const wordList removed(dict.getOrDefault<wordList>("removed", wordList()));
    for (const word& name : removed)
    {
        if (dict.subDict("bodies").found(name))
        {
            refuse(dict, "removed", name,
                   "groups that bodies {...} has no longer");
        }
        if (removed_.found(name)) continue;
        wordList others;
        for (const word& other : saved.toc())
        {
            if (isGroup(other, saved)) others.append(other);
        }
        if (!others.found(name))
        {
            refuse(dict, "removed", name,
                   "groups of the state, " + oneOf(others));
        }
        removed_.append(name);
    }
    const wordList names(system_.groupNames());
    for (const word& name : saved.toc())
    {
        if (!isGroup(name, saved) || names.found(name) || removed.found(name))
        {
            continue;
        }
        waitForMaster();
        FatalIOErrorInFunction(saved)
            << "the state has a group " << name
            << ", constant/deformableBodies none" << nl
            << "    allowed: " << oneOf(names).c_str() << ", or removed ("
            << name << "); in constant/deformableBodies to go on without it"
            << exit(FatalIOError);
    }
}

Foam::List<Foam::scalarList>
Foam::bodyState::statesOf(const bodyGroup& group, const dictionary& saved) const
{
    const word& name = group.name();
    const auto differs = [&](const string& what, const string& now,
                             const string& remedy = string())
    {
        const label host = group.host();
        waitForMaster();
        FatalIOErrorInFunction(saved)
            << "the state has " << what.c_str()
            << ", constant/deformableBodies " << now.c_str() << nl
            << "    allowed: the same bodies, or restart "
            << "initial; in group "
            << (host < 0 ? name : system_.groups[host].name())
            << " to start it from "
            << "constant/deformableBodies" << remedy.c_str()
            << exit(FatalIOError);
    };
    if (!saved.found(name)) differs("no group " + name, "has one");

    const dictionary facts(
        saved.subOrEmptyDict(bodyStateFile::groups).subOrEmptyDict(name));
    const word type(facts.getOrDefault<word>("type", group.type()));
    if (type != group.type())
    {
        differs("group " + name + " of type " + type,
                "one of type " + group.type());
    }
    for (const auto& fact : group.madeWith())
    {
        const scalar now = fact.second();
        const scalar then = facts.getOrDefault<scalar>(fact.first(), now);
        // Areas by another quadrature differ by 4e-5
        const scalar same = fact.first() == "area" ? 1e-4 : 1e-6;
        if (mag(then - now) > same * mag(now))
        {
            const bool isEntry =
                fact.first() == "harmonics" || fact.first() == "segments";
            differs("group " + name + " with " + fact.first() + ' ' +
                        Foam::name(then),
                    "one with " + Foam::name(now),
                    isEntry ? ", or " + fact.first() + ' ' + Foam::name(then) +
                                  "; there to go on with it, as its default "
                                  "is that of the mesh"
                            : string());
        }
    }
    const List<scalarList> states(saved.get<List<scalarList>>(name));
    if (states.size() != group.nBodies())
    {
        differs(Foam::name(states.size()) + " bodies in group " + name,
                "has " + Foam::name(group.nBodies()));
    }
    return states;
}

void Foam::bodyState::compareEntries(const dictionary& saved,
                                     const boolList& initial) const
{
    const dictionary groups(saved.subOrEmptyDict(bodyStateFile::groups));
    forAll(given_, g)
    {
        const bool all = g == system_.groups.size();
        if (!all && initial[g]) continue;
        const dictionary then(
            all ? saved.subOrEmptyDict(bodyStateFile::allGroups)
                : groups.subOrEmptyDict(system_.groups[g].name()));
        if (!then.found("given")) continue;
        compareEntries(g, then.get<entryHistory>("given"), saved);
    }
}

void Foam::bodyState::compareEntries(const label g, const entryHistory& then,
                                     const dictionary& saved) const
{
    const bool all = g == system_.groups.size();
    const word name(all ? word::null : system_.groups[g].name());
    string taken, unused;
    for (changedEntry& change : changes(then, given_[g]))
    {
        // A body is made with ends and scheme
        string otherwise;
        if (!all && change.name == "ends") otherwise = "(free free)";
        if (!all && change.name == "scheme") otherwise = "implicit";

        // A rigid body has its shape, a membrane may be without stress in it
        if (!all && change.name.compare(0, 6, "shape.") == 0)
        {
            otherwise = "none";
        }
        if (!otherwise.empty())
        {
            if (change.then.empty()) change.then = otherwise;
            if (change.now.empty()) change.now = otherwise;
            if (change.then == change.now) continue;
            waitForMaster();
            FatalIOErrorInFunction(saved)
                << "group " << name << ": entry " << change.text().c_str()
                << " in constant/deformableBodies" << nl
                << "    allowed: " << change.then.c_str()
                << ", or restart initial; in the group to start it from "
                << "constant/deformableBodies" << exit(FatalIOError);
        }
        const bool ofStart =
            !all && (change.name == "positions" ||
                     change.name == "directions" || change.name == "bow" ||
                     change.name.compare(0, 9, "placement") == 0);
        string& list = ofStart ? unused : taken;
        list += (list.empty() ? "" : "; ") + change.text();
    }
    if (taken.empty() && unused.empty()) return;
    const string who(all ? "All groups" : "Group " + name);
    Info << who.c_str() << ", changed entries:";
    if (!taken.empty()) Info << ' ' << taken.c_str() << " (used)";
    if (!unused.empty())
    {
        Info << (taken.empty() ? " " : "; ") << unused.c_str()
             << " (ignored: acts at the start only)";
    }
    Info << nl;
}
