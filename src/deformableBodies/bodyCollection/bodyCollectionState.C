// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What is kept of the bodies: for a step taken again, for a restart, and where a
// run has to stop

#include "bodyCollection.H"
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
    diverged_ = false;
}

void Foam::bodyCollection::sample()
{
    const Time& time = mesh_.time();
    if (empty() || diverged_ || !sampleDue() ||
        lastSampled_ == time.timeIndex())
    {
        return;
    }
    lastSampled_ = time.timeIndex();
    writer_->sample(time.value());
}

void Foam::bodyCollection::stop()
{
    List<string> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = trouble_;
    Pstream::gatherList(all);
    Pstream::scatterList(all);

    Time& time = const_cast<Time&>(mesh_.time());
    Info << "Writing the state before the stop" << endl;
    time.writeNow();
    for (const string& trouble : all)
    {
        if (!trouble.empty())
        {
            FatalErrorInFunction
                << "a body diverged at time " << time.timeName() << ": "
                << trouble.c_str() << nl
                << "    What it looked like has been written to time "
                << time.timeName() << "; go on from an earlier time with a "
                << "smaller deltaT" << exit(FatalError);
        }
    }
}

bool Foam::bodyCollection::writeData(Ostream& os) const
{
    // 17 digits carry a double exactly; the file is text whatever writeFormat
    std::ostringstream text;
    text << std::setprecision(17);
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
    if (diverged_) text << "diverged true;\n";
    if (Pstream::master()) os << text.str().c_str();

    writer_->draw(mesh_.time().value(), mesh_.time().timeIndex());
    effects_.write();
    return os.good();
}

void Foam::bodyCollection::readState(const IOdictionary& dict)
{
    const Time& time = mesh_.time();

    // The first rank's directory, or that of the undecomposed case
    fileName file(time.timePath() / "uniform" / "deformableBodies");
    if (!isFile(file))
    {
        file = time.globalPath() / time.timeName() / "uniform" /
               "deformableBodies";
    }
    dictionary saved;
    bool found = false;
    if (Pstream::master() && isFile(file))
    {
        IFstream is(file);
        saved = dictionary(is);
        found = true;
    }
    Pstream::scatter(found);
    if (!found)
    {
        if (time.value() > 0)
        {
            WarningInFunction
                << "no saved bodies (uniform/deformableBodies) for time "
                << time.timeName()
                << ": they start from constant/deformableBodies" << endl;
        }
        forAll(groups_, g)
        {
            ownership_->distribute(
                groups_[g], List<scalarList>(),
                dict.subDict("bodies").subDict(groups_[g].name()));
        }
        return;
    }
    Info << "Bodies continue from " << file << nl;

    // All ranks need the dictionary, for their checks and messages
    Pstream::scatter(saved);
    saved.name() = file;
    if (saved.getOrDefault<bool>("diverged", false))
    {
        FatalIOErrorInFunction(saved)
            << "this state was written because a body diverged" << nl
            << "    allowed: an earlier time to start from"
            << exit(FatalIOError);
    }

    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        const List<scalarList> states(
            saved.get<List<scalarList>>(group.name()));
        if (states.size() != group.nBodies())
        {
            FatalIOErrorInFunction(saved)
                << states.size() << " bodies in group " << group.name()
                << " where constant/deformableBodies has " << group.nBodies()
                << exit(FatalIOError);
        }
        ownership_->distribute(group, states, saved);
    }
}
