// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "expectedErrors.H"
#include "dictionaryChecks.H"
#include "ITstream.H"
#include "PstreamReduceOps.H"
#include <cmath>
#include <iomanip>
#include <sstream>

namespace
{
Foam::string percent(const Foam::scalar error)
{
    std::ostringstream os;
    os << std::setprecision(2) << 100 * error << " %";
    return os.str();
}
} // namespace

Foam::bodyAccuracy::bodyAccuracy(const dictionary& dict)
{
    const entry* given = dict.findEntry("accuracy", keyType::LITERAL);
    if (!given) return;
    const string value(valueOf(*given));
    const Enum<levels> words(
        {{draft, "draft"}, {standard, "standard"}, {reference, "reference"}});
    const string allowed(oneOf(words.names()) +
                         " or the relative error wanted, 1e-4 to 0.2");
    if (!given->isStream() || given->stream().size() != 1)
    {
        refuse(dict, "accuracy", value, allowed);
    }
    const token first(given->stream().first());
    if (first.isNumber())
    {
        wanted = first.number();
        if (!(wanted >= 1e-4 && wanted <= 0.2))
        {
            refuse(dict, "accuracy", value, allowed);
        }
    }
    else if (first.isWord() && words.found(first.wordToken()))
        level = words[first.wordToken()];
    else
        refuse(dict, "accuracy", value, allowed);
}

Foam::string Foam::atMost(const scalar x)
{
    const scalar unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
    std::ostringstream os;
    os << std::setprecision(2) << unit * std::floor(x / unit * (1 + 1e-9));
    return os.str();
}

Foam::expectedError Foam::ofForcing(const scalar nu, const scalar deltaT,
                                    const scalar h, const scalar duration,
                                    const scalar rate)
{
    const auto number = [=](const scalar step) { return nu * step / sqr(h); };
    const auto lag = [=](const scalar step)
    { return step * (1 + 0.2 * number(step)); };
    const auto largest = [=](const scalar error)
    {
        // a step + b step^2 = value
        const auto root = [](const scalar a, const scalar b, const scalar value)
        { return 2 * value / (a + std::sqrt(sqr(a) + 4 * b * value)); };
        const scalar perStep = number(1);
        const scalar late =
            duration > 0 ? root(1, 0.2 * perStep, error * duration) : GREAT;
        return min(min(10 / perStep, late),
                   root(8e-4 * perStep + 0.5 * rate, 0.1 * rate * perStep,
                        error));
    };
    const auto remark = [=](const scalar step)
    {
        return string(rate > 0 ? "where bodies meet or turn" : "once steady") +
               "; a force lags by " + Foam::name(lag(step)) + " s";
    };
    const auto error = [=](const scalar step) -> scalar
    {
        if (number(step) > 10 * (1 + 1e-9)) return -1;
        return 8e-4 * number(step) + 0.5 * rate * lag(step);
    };
    const bool fixed = deltaT > 0 && deltaT < GREAT;
    return {"step",
            fixed ? error(deltaT) : -1,
            !fixed ? string("deltaT is adjusted")
            : error(deltaT) < 0
                ? "nu deltaT/h^2 = " + Foam::name(number(deltaT)) +
                      ", measured up to 10"
                : remark(deltaT),
            nullptr,
            largest,
            error,
            remark};
}

Foam::scalar Foam::stepFor(expectedErrors& group, const scalar wanted)
{
    expectedError* step = nullptr;
    scalar left = wanted, most = wanted;
    for (expectedError& part : group.parts)
    {
        if (part.deltaT)
            step = &part;
        else if (part.error < 0)
            most = 0.5 * wanted;
        else
            left -= part.error;
    }
    if (!step) return GREAT;
    left = left > 0 ? min(left, most) : 0.5 * wanted;
    const scalar deltaT = step->deltaT(left);
    if (step->error < 0 || step->error > left)
    {
        step->error = step->errorOf(deltaT);
        step->by = "deltaT adjusted, at most " + Foam::name(deltaT) + " s" +
                   (step->ofDeltaT ? "; " + step->ofDeltaT(deltaT) : string());
    }
    return deltaT;
}

void Foam::checkErrors(const List<expectedErrors>& errors, const scalar wanted,
                       const fileName& file)
{
    const dictionary dict(file);
    Info << "Errors to be expected" << nl;
    for (const expectedErrors& group : errors)
    {
        scalar sum = 0;
        bool known = group.parts.size();
        string list;
        for (const expectedError& part : group.parts)
        {
            known = known && part.error >= 0;
            sum += max(part.error, scalar(0));
            list +=
                (list.empty() ? "" : "; ") + part.source + " " +
                (part.error < 0 ? string("not known") : percent(part.error)) +
                " (" + part.by + ")";
        }
        std::ostringstream name;
        name << "    " << std::left << std::setw(18) << group.group;
        Info << name.str().c_str() << group.of.c_str() << ": "
             << (known ? "within " + percent(sum) : string("not known")).c_str()
             << (list.empty() ? "" : ": ") << list.c_str() << nl;
        const bool within = sum <= wanted * (1 + 1e-9);
        if (wanted <= 0 || (known && within)) continue;

        // Remedies: changes of one part each that would be sufficient
        string remedies;
        scalar least = 0;
        for (const expectedError& part : group.parts)
        {
            if (!part.remedy && !part.deltaT)
                least += max(part.error, scalar(0));
            const scalar rest = wanted - (sum - max(part.error, scalar(0)));
            if (rest <= 0) continue;
            string remedy(part.remedy ? part.remedy(rest) : string());
            if (part.deltaT)
            {
                remedy =
                    "deltaT of " + atMost(part.deltaT(rest)) + " s and smaller";
            }
            if (!remedy.empty()) remedies += ", or " + remedy;
        }
        if (!within)
        {
            if (least >= wanted)
                remedies = "; nothing brings it below " + percent(least);
            else if (remedies.empty())
                remedies = "; no single change is sufficient";
            Info << endl;
            const string enough(
                sum <= 0.2
                    ? Foam::name(1e-4 * std::ceil(1e4 * sum)) + " and more"
                    : string("none, as the error is above 0.2,"));
            refuse(dict, "accuracy", Foam::name(wanted),
                   enough + " for group " + group.group + " (" + list + ")" +
                       remedies);
        }
        IOWarningInFunction(dict)
            << "entry accuracy has the value " << wanted
            << ", but the error of group " << group.group
            << " is not known: " << list.c_str() << nl
            << "    bin/accuracyCost shows how results change with "
               "cells and deltaT"
            << endl;
    }
    Info << endl;
}

void Foam::checkIndicators(const word& group,
                           std::vector<errorIndicator> indicators,
                           const scalar time, const bool atEnd,
                           HashSet<string>& warned)
{
    std::ostringstream line;
    line << "    " << std::left << std::setw(18) << group;
    string between;
    for (errorIndicator& i : indicators)
    {
        const scalar own = i.value;
        reduce(i.value, maxOp<scalar>());
        i.body = firstOf(own >= i.value ? i.body : string());
        line << between << i.name << ' ' << std::setprecision(2) << i.value;
        between = ", ";
    }
    if (atEnd) Info << line.str().c_str() << nl;
    for (const errorIndicator& i : indicators)
    {
        if (i.value <= i.limit || !(atEnd || i.lasting) ||
            !warned.insert(group + ' ' + i.name))
            continue;
        const string where(i.body + (i.body.empty() ? "" : ", "));
        WarningInFunction << "group " << group << ": " << i.name.c_str()
                          << " is " << i.value << ", recommended: at most "
                          << i.limit << " (" << where.c_str() << "time " << time
                          << ')' << nl << "    Change " << i.remedy.c_str()
                          << endl;
    }
}
