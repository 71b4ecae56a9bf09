// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "functionTimes.H"
#include "dictionaryChecks.H"
#include <cctype>

namespace
{
using namespace Foam;

//- True if a text has that name, not as a part of a longer one
bool has(const std::string& text, const std::string& name)
{
    const auto ofName = [&](const size_t i)
    {
        return i < text.size() &&
               (std::isalnum(text[i]) ||
                (text[i] == '.' && i + 1 < text.size() &&
                 std::isalnum(text[i + 1])));
    };
    for (size_t i = text.find(name); i != std::string::npos;
         i = text.find(name, i + 1))
    {
        if (!ofName(i - 1) && !ofName(i + name.size())) return true;
    }
    return false;
}

//- True if the condition holds for an enabled functionObject of controlDict that names
//  the field
template<class Condition>
bool any(const word& field, const Time& time, const Condition& holds)
{
    const dictionary* functions = time.controlDict().findDict("functions");
    if (!functions) return false;
    for (const entry& e : *functions)
    {
        if (e.isDict() && e.dict().getOrDefault<bool>("enabled", true) &&
            has(valueOf(e), field) && holds(e.dict()))
        {
            return true;
        }
    }
    return false;
}

//- True if the control `what` (execute, write) of a functionObject is due. Defaults as in
//  timeControl
bool isDue(const dictionary& function, const Time& time, const word& what)
{
    const word control(
        function.getOrDefault<word>(what + "Control", "timeStep"));
    const label interval =
        function.getOrDefault<scalar>(what + "Interval", 1) + 0.5;
    if (control == "timeStep")
    {
        return interval <= 1 || time.timeIndex() % interval == 0;
    }
    if (control == "writeTime" || control == "outputTime")
    {
        return time.writeTime();
    }
    if (control == "onEnd")
    {
        return isLastStep(time);
    }
    return control != "none";
}
} // namespace

void Foam::checkFunctionEntries(const dictionary& dict, wordList allowed)
{
    for (const word name :
         {"type", "libs", "functionObjectLibs", "enabled", "region", "log",
          "errors", "timeStart", "timeEnd", "executeControl", "executeInterval",
          "writeControl", "writeInterval", "writePrecision", "writeToFile",
          "useUserTime", "controlMode"})
    {
        allowed.append(name);
    }
    checkEntries(dict, allowed);
}

bool Foam::isLastStep(const Time& time)
{
    return time.value() > time.endTime().value() - 0.5 * time.deltaTValue();
}

bool Foam::isDue(const dictionary& function, const Time& time)
{
    const wordList writers({"writeObjects", "writeRegisteredObject", "probes",
                            "patchProbes", "sets", "systemCall"});
    const bool onlyWrites =
        writers.found(function.getOrDefault<word>("type", "")) &&
        !function.getOrDefault<bool>("sampleOnExecute", false);
    return (!onlyWrites && ::isDue(function, time, "execute")) ||
           ::isDue(function, time, "write");
}

bool Foam::isExecuted(const dictionary& function, const Time& time)
{
    const scalar t = time.value(), half = 0.5 * time.deltaTValue();
    return t > function.getOrDefault<scalar>("timeStart", -GREAT) - half &&
           t < function.getOrDefault<scalar>("timeEnd", GREAT) + half &&
           (::isDue(function, time, "execute") ||
            ::isDue(function, time, "write"));
}

bool Foam::needsNoFields(const dictionary& function)
{
    return wordList({"bodyStatistics", "phaseProfiles"})
        .found(function.getOrDefault<word>("type", ""));
}

bool Foam::isDueFor(const word& field, const Time& time)
{
    return any(field, time,
               [&](const dictionary& function)
               { return isDue(function, time); });
}

bool Foam::isNamed(const word& field, const Time& time)
{
    return any(field, time, [](const dictionary&) { return true; });
}
