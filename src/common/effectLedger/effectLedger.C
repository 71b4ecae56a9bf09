// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "effectLedger.H"
#include "Time.H"
#include "OSspecific.H"
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

void Foam::effectLedger::charge()
{
    const auto now = std::chrono::steady_clock::now();
    if (running_.size())
    {
        const std::chrono::duration<double> used(now - since_);
        effects_[running_.last()].seconds += used.count();
    }
    since_ = now;
}

void Foam::effectLedger::stop()
{
    charge();
    ++effects_[running_.last()].calls;
    running_.setSize(running_.size() - 1);
}

void Foam::effectLedger::declare(const word& name, const bool active,
                                 const string& note)
{
    for (effect& e : effects_)
    {
        if (e.name == name)
        {
            // One group that needs it is enough; what others say of it follows
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

Foam::effectLedger::timer Foam::effectLedger::time(const word& name)
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

void Foam::effectLedger::printEffects() const
{
    Info << nl << "Effects of this scene" << nl;
    for (const effect& e : effects_)
    {
        Info << "    " << column(e.name, 18).c_str()
             << column(e.active ? "active" : "skipped", 9).c_str()
             << e.note.c_str() << nl;
    }
    Info << endl;
}

void Foam::effectLedger::printCost() const
{
    double total = 0;
    for (const effect& e : effects_)
    {
        total += e.seconds;
    }
    Info << nl << "Seconds per effect (wall clock, first rank)" << nl;
    for (const effect& e : effects_)
    {
        if (!e.active) continue;
        std::ostringstream os;
        os << std::fixed << std::setprecision(3) << std::setw(12) << e.seconds
           << std::setprecision(1) << std::setw(8)
           << 100 * e.seconds / std::max(total, 1e-300) << " %" << std::setw(10)
           << e.calls << " calls";
        Info << "    " << column(e.name, 18).c_str() << os.str().c_str() << nl;
    }
    Info << endl;
}

void Foam::effectLedger::write()
{
    if (!Pstream::master()) return;
    if (!file_.valid())
    {
        const fileName dir(time_.globalPath() / "postProcessing" /
                           "effectCost" /
                           Time::timeName(time_.startTime().value()));
        mkDir(dir);
        file_.reset(new OFstream(dir / "effectCost.dat"));
        file_() << "# time effect seconds calls" << nl;
    }
    for (const effect& e : effects_)
    {
        if (e.active)
        {
            file_() << time_.timeName() << ' ' << e.name << ' ' << e.seconds
                    << ' ' << e.calls << nl;
        }
    }
    file_().flush();
}
