// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stepLimits.H"
#include "dictionaryChecks.H"
#include "lastStep.H"
#include "stringOps.H"

namespace
{
using namespace Foam;

//- Warn of entries of controlDict that differ from those of the time step in the case of
//  letters only
void checkLetters(const dictionary& dict)
{
    for (const word name :
         {"adjustTimeStep", "maxCo", "maxDeltaT", "maxRetries"})
    {
        for (const entry& e : dict)
        {
            const word other(e.keyword());
            if (other == name ||
                stringOps::lower(other) != stringOps::lower(name))
                continue;
            IOWarningInFunction(dict)
                << "entry " << other << " has no effect" << nl
                << "    Did you mean " << name << '?' << endl;
        }
    }
}
} // namespace

Foam::stepLimits::stepLimits(const Time& time, const surfaceScalarField& phi,
                             const bool bodies)
    : time_(time),
      guard_(phi, bodies)
{
    checkLetters(time.controlDict());
}

void Foam::stepLimits::readControls()
{
    const dictionary& dict = time_.controlDict();
    adjusted_ = dict.getOrDefault<bool>("adjustTimeStep", false);
    maxCo_ = dict.getOrDefault<scalar>("maxCo", 1);
    maxDeltaT_ = dict.getOrDefault<scalar>("maxDeltaT", GREAT);

    const auto requirePositive = [&](const word& name, const scalar value)
    {
        if (value > 0) return;
        refuse(dict, name, Foam::name(value), "numbers greater than 0");
    };
    requirePositive("deltaT", time_.deltaTValue());
    requirePositive("maxCo", maxCo_);
    requirePositive("maxDeltaT", maxDeltaT_);
}

void Foam::stepLimits::set(const word& what, const scalar dt, const string& why,
                           const string& note)
{
    const limit changed{what, dt, why, note.empty() ? why : note};
    for (limit& l : limits_)
    {
        if (l.what != what) continue;
        l = changed;
        return;
    }
    limits_.push_back(changed);
}

Foam::stepLimits::limit Foam::stepLimits::flowLimit() const
{
    const scalar stable = guard_.stable();
    if (!(Co_ > 0)) return {"flow", GREAT, "", "at rest"};
    if (!(stable < GREAT)) return {"flow", GREAT, "", "no explicit convection"};
    return {"flow", stable / rate(), guard_.who(),
            "Courant number " + Foam::name(stable) + " for " + guard_.who()};
}

Foam::stepLimits::limit Foam::stepLimits::controlLimit() const
{
    return {"controlDict", maxDeltaT_, "maxDeltaT",
            string(maxDeltaT_ < GREAT ? "" : "no ") +
                "maxDeltaT; Courant number up to maxCo " + Foam::name(maxCo_)};
}

Foam::scalar Foam::stepLimits::smallestOther() const
{
    scalar smallest = min(maxDeltaT_, maxCo_ / max(rate(), SMALL));
    for (const limit& l : limits_)
    {
        smallest = min(smallest, l.dt);
    }
    return smallest;
}

Foam::stepLimits::limit Foam::stepLimits::binding() const
{
    const scalar last = time_.deltaTValue();
    const scalar byCo = min(maxCo_, guard_.stable()) / max(rate(), SMALL);
    limit smallest{"flow", byCo,
                   maxCo_ <= guard_.stable() ? string("maxCo") : guard_.who(),
                   ""};
    std::vector<limit> others(
        {{"growth", min(last + 0.1 * byCo, 1.2 * last), "slow growth", ""}});
    others.insert(others.end(), limits_.begin(), limits_.end());
    others.push_back(controlLimit());
    for (const limit& l : others)
    {
        if (l.dt < smallest.dt) smallest = l;
    }
    return smallest;
}

void Foam::stepLimits::print(Ostream& os) const
{
    os << "Limits of the time step (deltaT is "
       << Foam::name(time_.deltaTValue())
       << (adjusted_ ? ", adjusted)" : ", fixed)") << nl;
    const auto row = [&](const limit& l)
    {
        std::string what(l.what);
        what.resize(max(what.size(), std::string::size_type(12)), ' ');
        const string dt(l.dt < GREAT ? Foam::name(l.dt) + " s" : "none");
        os << "    " << what.c_str() << dt.c_str() << ", " << l.note.c_str()
           << nl;
    };
    row(flowLimit());
    for (const limit& l : limits_)
    {
        row(l);
    }
    if (adjusted_) row(controlLimit());
    const scalar step = adjusted_ ? min(smallestOther(), flowLimit().dt)
                                  : time_.deltaTValue();
    const scalar steps = (time_.endTime().value() - time_.value()) / step;
    if (steps > 1)
    {
        os << "    endTime     after some " << Foam::name(std::ceil(steps))
           << " steps" << nl;
    }
    os << endl;
    if (steps > 1e8)
    {
        WarningInFunction << "some " << steps << " steps to endTime" << nl
                          << "    Is the limit that is far below the others "
                          << "that of an entry in other units?" << endl;
    }
}

void Foam::stepLimits::resume(Time& time) const
{
    const scalar last = lastStep::read(time);
    if (adjusted_ && last > 0) time.setDeltaT(last, false);
}

void Foam::stepLimits::reduceFirst(Time& time) const
{
    if (!adjusted_ || time.timeIndex() != 0 || !(Co_ > SMALL)) return;
    const scalar deltaT = time.deltaTValue();
    time.setDeltaT(min(maxCo_ * deltaT / Co_, min(deltaT, maxDeltaT_)));
}

void Foam::stepLimits::setRounded(Time& time, const scalar deltaT)
{
    time.setDeltaT(deltaT);
    for (label n = 1; n < 100 && time.deltaTValue() > (1 + 1e-6) * deltaT; ++n)
    {
        time.setDeltaT(pow(0.99, n) * deltaT);
    }
}

void Foam::stepLimits::adjust(Time& time)
{
    readControls();
    if (!adjusted_) return;
    const limit l(binding());
    setRounded(time, l.dt);
    setCourantNo(rate() * time.deltaTValue());
    Info << "deltaT = " << time.deltaTValue() << ", limited by "
         << l.why.c_str() << endl;
}

Foam::string Foam::stepLimits::wrong() const
{
    const scalar wanted = min(maxCo_, guard_.stable());
    if (adjusted_ && Co_ > 1.2 * wanted && Co_ < CourantGuard::notFinite)
    {
        return "Courant number " + Foam::name(Co_) + ", wanted " +
               Foam::name(wanted);
    }
    return guard_.wrong(Co_);
}

void Foam::stepLimits::check(const std::function<void()>& beforeStop,
                             const string& failed)
{
    const auto nameCauses = [&]()
    {
        const scalar deltaT = time_.deltaTValue();
        for (const limit& l : limits_)
        {
            if (deltaT <= (1 + 1e-6) * l.dt) continue;
            Info << "deltaT " << Foam::name(deltaT)
                 << " is above the limit of the " << l.why.c_str() << ", "
                 << Foam::name(l.dt) << " s, which may be the cause" << nl;
        }
        beforeStop();
    };
    guard_.check(Co_, rate(), nameCauses, failed);
}

void Foam::stepLimits::checkEstimate(const word& what, const string& remedy)
{
    const scalar deltaT = time_.deltaTValue();
    for (const limit& l : limits_)
    {
        if (l.what != what || deltaT <= (1 + 1e-6) * l.dt) continue;
        const string exceeds("deltaT " + Foam::name(deltaT) +
                             " exceeds the estimated limit of the " + l.why +
                             ", " + Foam::name(l.dt) + " s, by a factor of " +
                             Foam::name(deltaT / l.dt));
        if (what == "bodies" && deltaT > 200 * l.dt &&
            time_.timeIndex() <= time_.startTimeIndex() + 1)
        {
            FatalErrorInFunction
                << exceeds.c_str() << ": bodies would diverge within a few "
                << "steps" << nl << "    allowed: deltaT up to "
                << Foam::name(l.dt) << ", at most 200 times that, or softer "
                << "bodies. Do the units of bodies, fluid and mesh fit?"
                << exit(FatalError);
        }
        warnRarely& warning = warnings_(what, warnRarely());
        if (!warning.due(time_.timeIndex())) return;
        warning.warned(time_.timeIndex());
        if (!Pstream::master()) return;
        WarningInFunction << exceeds.c_str() << nl
                          << "    If bodies diverge, reduce it"
                          << remedy.c_str() << endl;
    }
}
