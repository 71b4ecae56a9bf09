// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "entryHistory.H"
#include "dictionaryChecks.H"
#include "SHA1.H"
#include <map>

namespace
{
using namespace Foam;

const std::string digest("SHA1 ");

void addEntries(entryHistory& all, const dictionary& dict, const string& within,
                const wordList& except)
{
    for (const entry& e : dict)
    {
        if (except.found(e.keyword())) continue;
        const string name(within + e.keyword());
        if (e.isDict())
        {
            addEntries(all, e.dict(), name + ".", wordList());
            continue;
        }
        string value(valueOf(e));
        if (value.size() > 200) value = digest + SHA1(value).str(false);
        all.append(Tuple2<string, string>(name, value));
    }
}
} // namespace

Foam::entryHistory Foam::entriesOf(const dictionary& dict,
                                   const wordList& except)
{
    entryHistory all;
    addEntries(all, dict, "", except);
    return all;
}

Foam::List<Foam::changedEntry> Foam::changes(const entryHistory& then,
                                             const entryHistory& now)
{
    std::map<std::string, std::pair<string, string>> values;
    for (const auto& e : then)
    {
        values[e.first()].first = e.second();
    }
    for (const auto& e : now)
    {
        values[e.first()].second = e.second();
    }
    List<changedEntry> all;
    for (const auto& v : values)
    {
        if (v.second.first == v.second.second) continue;
        all.append(changedEntry{v.first, v.second.first, v.second.second});
    }
    return all;
}

Foam::string Foam::changedEntry::text() const
{
    const auto shown = [](const string& value) -> string
    {
        if (value.empty()) return "not given";
        return value.compare(0, digest.size(), digest) == 0 ? string("(...)")
                                                            : value;
    };
    return name + ' ' + shown(then) + ", now " + shown(now);
}
