// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stepRetries.H"
#include "dictionaryChecks.H"

Foam::stepRetries::stepRetries(Time& time, stepLimits& limits, lastStep& last,
                               const label maxRetries, const string& obstacle)
    : time_(time),
      limits_(limits),
      last_(last),
      maxRetries_(time.controlDict().getOrDefault<label>(
          "maxRetries", obstacle.empty() ? maxRetries : label(0)))
{
    if (maxRetries_ < 0 || maxRetries_ > 10)
    {
        refuse(time.controlDict(), "maxRetries", Foam::name(maxRetries_),
               "0 to 10");
    }
    if (maxRetries_ > 0 && !obstacle.empty())
    {
        refuse(time.controlDict(), "maxRetries", Foam::name(maxRetries_),
               "0, as " + obstacle);
    }
    if (maxRetries > 0 && !obstacle.empty())
    {
        Info << "No step is taken back: " << obstacle.c_str() << nl << endl;
    }
    if (maxRetries_ == 0) last_.divided() = lastStep::division();
    limitSteps();
}

void Foam::stepRetries::limitSteps()
{
    const scalar most = last_.divided().maxDeltaT;
    if (!limits_.adjusted() || !(most < GREAT)) return;
    limits_.set("retries", most, "last step that was taken back");
}

Foam::string Foam::stepRetries::inParts(const std::function<string()>& step)
{
    const label n = last_.divided().subSteps;
    last_.divided().lastSubSteps = n;
    if (n == 1) return step();
    string wrong;
    time_.subCycle(n);
    for (label i = 0; i < n; ++i)
    {
        ++time_;
        wrong = step();
        if (returnReduce(!wrong.empty(), orOp<bool>())) break;
    }
    time_.endSubCycle();
    return wrong;
}

Foam::string Foam::stepRetries::advance(const actions& a)
{
    if (maxRetries_ == 0)
    {
        a.step();
        return string();
    }
    lastStep::division& d = last_.divided();
    const label most = 1 << maxRetries_;
    d.nUnchecked = max(d.nUnchecked - 1, label(0));
    a.save();
    const label before = taken_;
    while (true)
    {
        a.watchUnsteady(d.nUnchecked == 0 && d.subSteps < most);
        const string wrong(firstOf(inParts(a.step)));
        if (wrong.empty()) break;
        if (d.subSteps >= most)
        {
            return wrong + ", also in " + Foam::name(d.subSteps) + " sub-steps";
        }
        if (taken_ == before)
            d.nGoodWanted = min(2 * d.nGoodWanted, label(1000));
        ++taken_;
        d.subSteps *= 2;
        d.nGood = 0;
        a.restore();
        Info << "Step taken back at time " << time_.timeName() << ": "
             << wrong.c_str() << nl << "    Taken again in " << d.subSteps
             << " sub-steps of " << time_.deltaTValue() / d.subSteps << " s"
             << nl;
    }
    if (d.nUnchecked == 0 && d.subSteps >= most)
    {
        goOnUnsteady(firstOf(a.unsteady()));
    }
    recover();
    return string();
}

void Foam::stepRetries::goOnUnsteady(const string& sentence)
{
    if (sentence.empty()) return;
    lastStep::division& d = last_.divided();
    if (Pstream::master())
    {
        WarningInFunction << sentence.c_str() << ", at time "
                          << time_.timeName() << ", also in " << d.subSteps
                          << " sub-steps" << nl
                          << "    The run goes on with whole steps. If bodies "
                          << "diverge, reduce " << stepEntry(time_) << endl;
    }
    d.subSteps = 1;
    d.nUnchecked = 1000;
}

void Foam::stepRetries::recover()
{
    lastStep::division& d = last_.divided();
    if (limits_.adjusted() && d.subSteps > 1)
    {
        d.maxDeltaT = time_.deltaTValue() / d.subSteps;
        d.subSteps = 1;
    }
    const bool divided = d.subSteps > 1 || d.maxDeltaT < GREAT;
    if (divided && ++d.nGood >= d.nGoodWanted)
    {
        d.nGood = 0;
        if (d.subSteps > 1) d.subSteps /= 2;
        if (d.maxDeltaT < GREAT) d.maxDeltaT *= 2;
    }
    limitSteps();
}

void Foam::stepRetries::printCount() const
{
    if (!taken_) return;
    Info << "Steps taken back: " << taken_ << nl << endl;
}
