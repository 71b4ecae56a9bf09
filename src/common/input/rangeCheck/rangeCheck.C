// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "rangeCheck.H"
#include "dictionaryChecks.H"
#include "StringStream.H"

namespace
{
//- Number with four digits, for messages
Foam::string digits(const Foam::scalar x)
{
    Foam::OStringStream os;
    os.precision(4);
    os << x;
    return os.str();
}

//- True if x is in the range, which has no end from GREAT on. A relative 1e-9 is allowed at
//  its ends, as round-off moves ratios that were meant to be there
bool within(const Foam::scalar x, const Foam::scalar least,
            const Foam::scalar most)
{
    return x >= least * (1 - 1e-9) &&
           (most >= Foam::GREAT || x <= most * (1 + 1e-9));
}
} // namespace

Foam::string Foam::rangeOf(const scalar least, const scalar most)
{
    if (most >= GREAT) return "at least " + digits(least);
    if (least <= 0) return "at most " + digits(most);
    return digits(least) + " to " + digits(most);
}

void Foam::checkRanges(const dictionary& dict, const List<rangeCheck>& ratios)
{
    for (const rangeCheck& r : ratios)
    {
        const string value(r.name + " = " + digits(r.value));
        if (!within(r.value, r.least, r.most))
        {
            refuse(dict, r.entry, value,
                   rangeOf(r.least, r.most) + ": " + r.reason);
        }
        if (!within(r.value, r.recommendedLeast, r.recommendedMost))
        {
            IOWarningInFunction(dict)
                << "entry " << r.entry << ": " << value.c_str()
                << ", recommended: "
                << rangeOf(r.recommendedLeast, r.recommendedMost).c_str()
                << ": " << r.reason.c_str() << endl;
        }
    }
}
