// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What is kept of the bodies: for a step taken again, for a restart, and where a
// run has to stop

#include "bodyCollection.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "fileOperation.H"
#include "IFstream.H"
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
    trouble_.clear();
    diverged_ = outside_ = false;
}

void Foam::bodyCollection::lookAtPlaces()
{
    if (empty() || diverged_ || lastLooked_ == mesh_.time().timeIndex()) return;
    lastLooked_ = mesh_.time().timeIndex();
    const auto timing(effects_.time("places"));
    trouble_ = places_->look();
    outside_ = diverged_ = returnReduce(!trouble_.empty(), orOp<bool>());
}

void Foam::bodyCollection::sample()
{
    const Time& time = mesh_.time();
    lookAtPlaces();
    if (empty() || diverged_ || !sampleDue() ||
        lastSampled_ == time.timeIndex())
    {
        return;
    }
    lastSampled_ = time.timeIndex();
    writer_->sample(time.value());
    if (interactions_) interactions_->sample();
}

void Foam::bodyCollection::stop()
{
    Time& time = const_cast<Time&>(mesh_.time());
    Info << "Writing the state before the stop" << endl;
    time.writeNow();
    FatalErrorInFunction
        << "a body " << (outside_ ? "left the box" : "diverged") << " at time "
        << time.timeName() << ": " << firstOf(trouble_).c_str() << nl
        << "    What it looked like has been written to time "
        << time.timeName()
        << (outside_ ? "; with outside remove; in its group the run goes on "
                       "from there without it"
                     : "; go on from an earlier time with a smaller deltaT")
        << exit(FatalError);
}

bool Foam::bodyCollection::writeData(Ostream& os) const
{
    // 17 digits carry a double exactly; the file is text whatever writeFormat
    std::ostringstream text;
    text << std::setprecision(17);
    if (diverged_ && !outside_) text << "diverged true;\n";
    text << stateEntry << "\n{\n";
    for (const bodyGroup& group : groups_)
    {
        text << "    " << group.name() << " { type " << group.type() << ';';
        for (const auto& fact : group.identify())
        {
            text << ' ' << fact.first() << ' ' << fact.second() << ';';
        }
        text << " }\n";
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
    const auto differs = [&](const string& what, const string& now)
    {
        FatalIOErrorInFunction(saved)
            << "the state has " << what.c_str()
            << ", constant/deformableBodies " << now.c_str() << nl
            << "    allowed: the same bodies, or restart "
            << "initial; in group " << name << " to start it from "
            << "constant/deformableBodies" << exit(FatalIOError);
    };
    if (!saved.found(name)) differs("no group " + name, "has one");

    const dictionary facts(
        saved.subOrEmptyDict(stateEntry).subOrEmptyDict(name));
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
            differs("group " + name + " with " + fact.first() + ' ' +
                        Foam::name(then),
                    "one with " + Foam::name(now));
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
        initial[g] = readEnum(words, dict.subDict("bodies").subDict(names[g]),
                              "restart", all);
        any = any || !initial[g];
    }

    dictionary saved;
    fileName file;
    const bool found = any && findState(saved, file);
    if (any && !found && time.value() > 0)
    {
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
            FatalIOErrorInFunction(saved)
                << "this state was written because a body diverged" << nl
                << "    allowed: an earlier time to start from"
                << exit(FatalIOError);
        }
        wordList known(names);
        known.append(dict.getOrDefault<wordList>("removed", wordList()));
        for (const word& name : saved.toc())
        {
            if (saved.isDict(name) || name == "diverged" || known.found(name))
                continue;
            FatalIOErrorInFunction(saved)
                << "the state has a group " << name
                << ", constant/deformableBodies none" << nl
                << "    allowed: " << oneOf(names).c_str() << ", or removed ("
                << name << "); in constant/deformableBodies to go on without it"
                << exit(FatalIOError);
        }
    }

    forAll(groups_, g)
    {
        const bool continues = found && !initial[g];
        ownership_->distribute(
            groups_[g],
            continues ? statesOf(groups_[g], saved) : List<scalarList>(),
            continues ? saved : dict.subDict("bodies").subDict(names[g]));
        if (time.value() > 0 && !continues)
        {
            Info << "Group " << names[g] << " starts from constant/"
                 << "deformableBodies at time " << time.timeName()
                 << (saved.found(names[g]) ? ", although the state has it" : "")
                 << " (restart initial)" << nl;
        }
    }
}
