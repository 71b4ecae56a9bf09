// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "effectTable.H"
#include "libraryVersion.H"
#include "resultFile.H"
#include <iomanip>
#include <sstream>

namespace
{
std::string column(const std::string& s, const int width)
{
    std::ostringstream os;
    os << std::left << std::setw(width) << s;
    return os.str();
}
} // namespace

Foam::effectTable::effectTable(const Time& time, const word& region)
    : time_(time),
      region_(region),
      since_(std::chrono::steady_clock::now()),
      startUp_(time.elapsedCpuTime())
{
}

void Foam::effectTable::charge()
{
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> used(now - since_);
    (running_.size() ? effects_[running_.last()].seconds : rest_) +=
        used.count();
    since_ = now;
}

void Foam::effectTable::stop()
{
    charge();
    ++effects_[running_.last()].calls;
    running_.setSize(running_.size() - 1);
}

void Foam::effectTable::declare(const word& name, const bool active,
                                const string& note)
{
    for (effect& e : effects_)
    {
        if (e.name == name)
        {
            // An effect is active if one group needs it; the notes of all such groups
            // are joined
            if (active && !e.active) e = effect{name, true, note, 0, 0};
            if (active && e.note.find(note) == string::npos)
            {
                e.note += "; " + note;
            }
            return;
        }
    }
    effects_.append(effect{name, active, note, 0, 0});
}

Foam::effectTable::timer Foam::effectTable::time(const word& name)
{
    forAll(effects_, i)
    {
        if (effects_[i].name != name || !effects_[i].active) continue;
        charge();
        running_.append(i);
        return timer(*this);
    }
    FatalErrorInFunction << "effect " << name << " was not declared active"
                         << exit(FatalError);
    return timer(*this);
}

void Foam::effectTable::printEffects()
{
    charge();
    startUp_ += rest_;
    rest_ = 0;
    Info << nl << libraryVersion << nl << nl << "Effects of this scene" << nl;
    for (const effect& e : effects_)
    {
        Info << "    " << column(e.name, 18).c_str()
             << column(e.active ? "active" : "skipped", 9).c_str()
             << e.note.c_str() << nl;
    }
    Info << endl;
}

template<class Visit>
void Foam::effectTable::rows(Visit visit)
{
    charge();
    const auto row =
        [&](const word& name, const double seconds, const label calls)
    {
        visit(name,
              returnReduce(scalar(seconds), sumOp<scalar>()) /
                  Pstream::nProcs(),
              returnReduce(scalar(seconds), maxOp<scalar>()), calls);
    };
    row("start-up", startUp_, 1);
    for (const effect& e : effects_)
    {
        if (e.active) row(e.name, e.seconds, e.calls);
    }
    row("rest", rest_, 1);
}

void Foam::effectTable::printCost()
{
    scalar total = 0;
    rows([&](const word&, const scalar mean, scalar, label) { total += mean; });

    Info << nl << "Seconds per effect (wall clock"
         << (Pstream::parRun()
                 ? "; on average over the ranks, per cent, largest"
                 : "")
         << ")" << nl;
    std::string untimed;
    rows(
        [&](const word& name, const scalar mean, const scalar largest,
            const label calls)
        {
            if (calls == 0)
            {
                untimed += ' ' + name;
                return;
            }
            std::ostringstream os;
            os << std::fixed << std::setprecision(3) << std::setw(12) << mean
               << std::setprecision(1) << std::setw(8)
               << 100 * mean / max(total, VSMALL) << " %";
            if (Pstream::parRun())
            {
                os << std::setprecision(3) << std::setw(12) << largest;
            }
            os << std::setw(10) << calls << " calls";
            Info << "    " << column(name, 18).c_str() << os.str().c_str()
                 << nl;
        });
    if (!untimed.empty())
    {
        Info << "    not timed separately:" << untimed.c_str() << nl;
    }
    Info << endl;
}

void Foam::effectTable::write()
{
    if (Pstream::master() && !file_.valid())
    {
        file_ = newResultFile(time_, region_ / "effectCost", "effectCost.dat");
        file_() << "# time effect seconds calls" << nl;
    }
    rows(
        [&](const word& name, const scalar mean, scalar, const label calls)
        {
            if (!Pstream::master()) return;
            file_() << time_.timeName() << ' ' << name << ' ' << mean << ' '
                    << calls << nl;
        });
    if (Pstream::master()) file_().flush();
}
