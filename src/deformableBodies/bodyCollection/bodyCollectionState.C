// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What is kept of the bodies: for a step taken again, for a restart, and where a
// run has to stop

#include "bodyCollection.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "fileOperation.H"
#include "functionTimes.H"
#include "IFstream.H"
#include "lastStep.H"
#include <iomanip>
#include <sstream>

Foam::bodyCollection::snapshot Foam::bodyCollection::save() const
{
    snapshot s;
    forAll(groups_, g)
    {
        s.numbers.append(groups_[g].mine());
        s.states.append(groups_[g].states());
    }
    if (interactions_) s.interactions = interactions_->memory();
    return s;
}

void Foam::bodyCollection::restore(const snapshot& s)
{
    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        while (group.mine().size())
            group.release(group.mine().size() - 1);
        forAll(s.numbers[g], i)
        {
            group.insert(s.numbers[g][i], s.states[g][i], dictionary::null);
        }
    }
    if (interactions_) interactions_->remember(s.interactions);
    trouble_.clear();
    diverged_ = false;
    fate_ = bodyPlaces::INSIDE;
}

void Foam::bodyCollection::lookAtPlaces()
{
    if (empty() || diverged_ || lastLooked_ == mesh_.time().timeIndex()) return;
    lastLooked_ = mesh_.time().timeIndex();
    const auto timing(effects_.time("places"));
    const label here = places_->look(trouble_);
    const label worst = returnReduce(here, maxOp<label>());
    if (here < worst) trouble_.clear();
    fate_ = bodyPlaces::fate(worst);
    diverged_ = fate_ != bodyPlaces::INSIDE;
}

void Foam::bodyCollection::sample()
{
    const Time& time = mesh_.time();
    lookAtPlaces();
    if (forceField_ && !diverged_ && isLookedAt("bodyForce", time))
    {
        *forceField_ = fluidForce();
    }
    if (empty() || diverged_ || !sampleDue() ||
        lastSampled_ == time.timeIndex())
    {
        return;
    }
    lastSampled_ = time.timeIndex();
    writer_->sample(time.value());
    if (!contrast_) nu_->compare(groups_);
    if (interactions_) interactions_->sample();
}

void Foam::bodyCollection::draw()
{
    if (empty()) return;
    ownership_->migrate(groups_);
    if (interactions_) interactions_->update();
    if (forceField_) *forceField_ = fluidForce();
    writer_->draw(mesh_.time().value(), mesh_.time().timeIndex());
}

void Foam::bodyCollection::stop()
{
    const Time& time = mesh_.time();
    const string trouble(firstOf(trouble_));
    const bool left = fate_ == bodyPlaces::LEFT;
    const bool pressed = fate_ == bodyPlaces::PRESSED;
    lastStep::writeBeforeStop(time, left || pressed ? string() : trouble);
    firstRankSpeaks();
    FatalErrorInFunction
        << "a body "
        << (left      ? "left the box"
            : pressed ? "was pressed through a wall"
                      : "diverged")
        << " at time " << time.timeName() << ": " << trouble.c_str() << nl
        << "    What it looked like has been written to time "
        << time.timeName()
        << (pressed
                ? "; allowed: a larger strength of repulsion with a smaller "
                  "deltaT"
            : left ? ""
                   : "; go on from an earlier time with a smaller deltaT")
        << (left || pressed
                ? "; with outside remove; in its group the run goes on "
                  "without it"
                : "")
        << exit(FatalError);
}

bool Foam::bodyCollection::writeData(Ostream& os) const
{
    // 17 digits carry a double exactly; the file is text whatever writeFormat
    std::ostringstream text;
    text << std::setprecision(17);
    const bool outside =
        fate_ == bodyPlaces::LEFT || fate_ == bodyPlaces::PRESSED;
    if (diverged_ && !outside) text << "diverged true;\n";
    const auto given = [&](const givenEntries& entries)
    {
        OStringStream os;
        for (const auto& e : entries)
        {
            os << " (" << e.first() << ' ' << e.second() << ')';
        }
        text << "        given (" << os.str() << ");\n";
    };
    text << stateEntries[2] << "\n{\n    removed (";
    for (const word& name : removed_)
    {
        text << ' ' << name;
    }
    text << " );\n";
    given(given_.last());
    if (nu_->isMean()) text << "    nu " << nu_->value() << ";\n";
    if (accuracy_.wanted > 0 && wantedDeltaT_ < GREAT)
    {
        text << "    accuracy " << accuracy_.wanted << ";\n    deltaT "
             << wantedDeltaT_ << ";\n";
    }
    text << "}\n" << stateEntries[0] << "\n{\n";
    label g = 0;
    for (const bodyGroup& group : groups_)
    {
        text << "    " << group.name() << " { type " << group.type() << ';';
        for (const auto& fact : group.identify())
        {
            text << ' ' << fact.first() << ' ' << fact.second() << ';';
        }
        text << '\n';
        given(given_[g++]);
        text << "    }\n";
    }
    text << "}\n";
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        const List<scalarList> own(group.states());
        const List<scalarList> states(bodyWriter::inOrder<scalarList>(
            group, [&](const label i) { return own[i]; }));
        text << group.name() << "\n(\n";
        for (const scalarList& s : states)
        {
            text << '(';
            for (const scalar x : s)
            {
                text << x << ' ';
            }
            text << ")\n";
        }
        text << ");\n";
    }
    if (interactions_)
    {
        const string state(interactions_->state());
        text << stateEntries[3] << "\n{\n" << state << "}\n";
    }
    if (Pstream::master()) os << text.str().c_str();

    writer_->draw(mesh_.time().value(), mesh_.time().timeIndex());
    effects_.write();
    return os.good();
}

bool Foam::bodyCollection::findState(dictionary& saved, fileName& file) const
{
    const Time& time = mesh_.time();
    const IOobject io("deformableBodies", time.timeName(), "uniform", mesh_,
                      IOobject::MUST_READ, IOobject::NO_WRITE, false);

    // The first rank's directory, or that of the undecomposed case
    file = fileHandler().filePath(true, io, IOdictionary::typeName);
    if (file.empty())
    {
        file = time.globalPath() / time.timeName() / mesh_.dbDir() / "uniform" /
               io.name();
    }
    Pstream::scatter(file);
    bool found = false;
    string text;
    if (Pstream::master())
    {
        IFstream is(file);
        found = is.good();
        if (found)
        {
            text =
                std::string(std::istreambuf_iterator<char>(is.stdStream()), {});
        }
    }
    Pstream::scatter(found);
    if (!found) return false;

    const auto refuseFile = [&](const string& why)
    {
        FatalErrorInFunction
            << "the state of the bodies in file " << file.c_str() << ' '
            << why.c_str() << nl << "    allowed: what a run has written to "
            << "it, an earlier time to start from, or restart initial in "
            << "constant/deformableBodies" << exit(FatalError);
    };
    const bool own = text.find("FoamFile") != string::npos &&
                     text.find("deformableBodies") != string::npos &&
                     text.find("decomposedBlockData") == string::npos;
    if (!returnReduce(own || !Pstream::master(), andOp<bool>()))
    {
        refuseFile("is none: it was not written by deformableBodies");
    }
    string wrong(wrongBrackets(text));
    Pstream::scatter(wrong);
    if (!wrong.empty()) refuseFile("is damaged: " + wrong);
    if (Pstream::master())
    {
        IFstream is(file);
        saved = dictionary(is);
    }

    // All ranks need the dictionary, for their checks and messages
    Pstream::scatter(saved);
    saved.name() = file;
    return true;
}

Foam::List<Foam::scalarList>
Foam::bodyCollection::statesOf(const bodyGroup& group,
                               const dictionary& saved) const
{
    const word& name = group.name();
    const auto differs = [&](const string& what, const string& now,
                             const string& remedy = string())
    {
        firstRankSpeaks();
        FatalIOErrorInFunction(saved)
            << "the state has " << what.c_str()
            << ", constant/deformableBodies " << now.c_str() << nl
            << "    allowed: the same bodies, or restart "
            << "initial; in group "
            << (group.host() < 0 ? name : groups_[group.host()].name())
            << " to start it from "
            << "constant/deformableBodies" << remedy.c_str()
            << exit(FatalIOError);
    };
    if (!saved.found(name)) differs("no group " + name, "has one");

    const dictionary facts(
        saved.subOrEmptyDict(stateEntries[0]).subOrEmptyDict(name));
    const word type(facts.getOrDefault<word>("type", group.type()));
    if (type != group.type())
    {
        differs("group " + name + " of type " + type,
                "one of type " + group.type());
    }
    for (const auto& fact : group.identify())
    {
        const scalar now = fact.second();
        const scalar then = facts.getOrDefault<scalar>(fact.first(), now);
        if (mag(then - now) > 1e-6 * mag(now))
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

void Foam::bodyCollection::compareEntries(const dictionary& saved,
                                          const boolList& initial) const
{
    const auto before = [&](const label g) -> dictionary
    {
        return g == groups_.size() ? saved.subOrEmptyDict(stateEntries[2])
                                   : saved.subOrEmptyDict(stateEntries[0])
                                         .subOrEmptyDict(groups_[g].name());
    };
    forAll(given_, g)
    {
        const dictionary then(before(g));
        const bool all = g == groups_.size();
        if (!then.found("given") || (!all && initial[g])) continue;

        string taken, unused;
        for (changedEntry& change :
             changes(then.get<givenEntries>("given"), given_[g]))
        {
            // What a body was made with
            string otherwise;
            if (!all && change.name == "ends") otherwise = "(free free)";
            if (!all && change.name == "scheme") otherwise = "implicit";
            if (!otherwise.empty())
            {
                if (change.then.empty()) change.then = otherwise;
                if (change.now.empty()) change.now = otherwise;
                if (change.then == change.now) continue;
                firstRankSpeaks();
                FatalIOErrorInFunction(saved)
                    << "group " << groups_[g].name() << ": entry "
                    << change.text().c_str() << " in constant/deformableBodies"
                    << nl << "    allowed: " << change.then.c_str()
                    << ", or restart initial; in the group to start it from "
                    << "constant/deformableBodies" << exit(FatalIOError);
            }
            const bool atStart =
                !all && (change.name == "positions" ||
                         change.name == "directions" || change.name == "bow" ||
                         change.name.compare(0, 6, "shape.") == 0 ||
                         change.name.compare(0, 9, "placement") == 0);
            string& list = atStart ? unused : taken;
            list += (list.empty() ? "" : "; ") + change.text();
        }
        if (taken.empty() && unused.empty()) continue;
        const string who(all ? "All groups" : "Group " + groups_[g].name());
        Info << who.c_str() << ", other than before:";
        if (!taken.empty()) Info << ' ' << taken.c_str() << " (taken over)";
        if (!unused.empty())
        {
            Info << (taken.empty() ? " " : "; ") << unused.c_str()
                 << " (of the start only: no effect, the bodies continue)";
        }
        Info << nl;
    }
}

const Foam::dictionary&
Foam::bodyCollection::dictionaryOf(const label g, const dictionary& dict) const
{
    const label host = groups_[g].host();
    return host < 0 ? dict.subDict("bodies").subDict(groups_[g].name())
                    : dictionaryOf(host, dict).subDict("nucleus");
}

void Foam::bodyCollection::readState(const IOdictionary& dict)
{
    const Time& time = mesh_.time();
    const Enum<bool> words({{false, "continue"}, {true, "initial"}});
    const bool all = readEnum(words, dict, "restart", false);
    wordList names(groups_.size());
    boolList initial(groups_.size());
    bool any = false;
    forAll(groups_, g)
    {
        names[g] = groups_[g].name();
        const label host = groups_[g].host();
        initial[g] =
            host < 0 ? readEnum(words, dictionaryOf(g, dict), "restart", all)
                     : initial[host];
        any = any || !initial[g];
    }

    dictionary saved;
    fileName file;
    const bool found = any && findState(saved, file);
    if (any && !found && time.value() > 0)
    {
        firstRankSpeaks();
        FatalIOErrorInFunction(dict)
            << "no state of the bodies for time " << time.timeName()
            << ", file " << file.c_str() << nl
            << "    allowed: a time with a state, or restart initial; to start "
            << "the bodies as they stand in this file" << exit(FatalIOError);
    }
    if (found)
    {
        Info << "Bodies continue from " << file << nl;
        if (saved.getOrDefault<bool>("diverged", false))
        {
            firstRankSpeaks();
            FatalIOErrorInFunction(saved)
                << "this state was written because the run diverged" << nl
                << "    allowed: an earlier time to start from"
                << exit(FatalIOError);
        }
        const auto isGroup = [&](const word& name)
        { return !saved.isDict(name) && !stateEntries.found(name); };
        const wordList removed(
            dict.getOrDefault<wordList>("removed", wordList()));
        const dictionary before(saved.subOrEmptyDict(stateEntries[2]));
        removed_ = before.getOrDefault<wordList>("removed", wordList());
        if (before.getOrDefault<scalar>("accuracy", 0) == accuracy_.wanted)
        {
            wantedDeltaT_ = before.getOrDefault<scalar>("deltaT", GREAT);
        }
        for (const word& name : removed)
        {
            if (removed_.found(name)) continue;
            wordList others;
            for (const word& other : saved.toc())
            {
                if (isGroup(other)) others.append(other);
            }
            if (!others.found(name))
            {
                refuse(dict, "removed", name,
                       "groups of the state, " + oneOf(others));
            }
            removed_.append(name);
        }
        wordList known(names);
        known.append(removed);
        for (const word& name : saved.toc())
        {
            if (!isGroup(name) || known.found(name)) continue;
            firstRankSpeaks();
            FatalIOErrorInFunction(saved)
                << "the state has a group " << name
                << ", constant/deformableBodies none" << nl
                << "    allowed: " << oneOf(names).c_str() << ", or removed ("
                << name << "); in constant/deformableBodies to go on without it"
                << exit(FatalIOError);
        }
    }

    if (found) compareEntries(saved, initial);
    if (found && interactions_)
    {
        interactions_->readState(saved.subOrEmptyDict(stateEntries[3]),
                                 initial);
    }
    forAll(groups_, g)
    {
        const bool continues = found && !initial[g];
        if (found && !continues && groups_[g].placedAtRandom() &&
            initial.found(false))
        {
            refuse(dictionaryOf(g, dict), "placement",
                   "{...} in a group that starts while others go on",
                   "positions: random places know only where the others "
                   "started; or restart initial; for all");
        }
        ownership_->distribute(groups_[g],
                               continues ? statesOf(groups_[g], saved)
                                         : List<scalarList>(),
                               continues ? saved : dictionaryOf(g, dict));
        if (time.value() > 0 && !continues)
        {
            Info << "Group " << names[g] << " starts from constant/"
                 << "deformableBodies at time " << time.timeName()
                 << (saved.found(names[g]) ? ", although the state has it" : "")
                 << " (restart initial)" << nl;
        }
    }
}
