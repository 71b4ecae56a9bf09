// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "duplicateEntries.H"
#include "dictionaryChecks.H"
#include "IFstream.H"
#include "Pstream.H"
#include "StringStream.H"
#include <set>
#include <vector>

namespace
{
using namespace Foam;

//- Open bracket of the text: the name of a dictionary and the names of its entries so
//  far, or a list
struct textBlock
{
    std::string name;
    bool isDictionary;
    std::set<std::string> names;
};

//- Path of the first name that comes twice in a dictionary. what: set to "two
//  dictionaries" or "two values"
string firstRepeated(const fileName& file, string& what)
{
    IFstream is(file);
    std::vector<textBlock> open{{"", true, {}}};
    std::string first; // first word of the present entry
    label nTokens = 0; // tokens of the present entry so far
    bool directive = false;
    const auto comesTwice = [&]()
    {
        // $group and #calc are replaced by other text and may come often
        return first[0] != '$' && first[0] != '#' &&
               !open.back().names.insert(first).second;
    };
    const auto path = [&]()
    {
        std::string names;
        for (const textBlock& b : open)
        {
            if (!b.name.empty()) names += b.name + "/";
        }
        return names + first;
    };
    for (token t(is); t.good(); is >> t)
    {
        if (t.isPunctuation())
        {
            const char c = t.pToken();
            const bool inDictionary = open.back().isDictionary;
            if (c == token::BEGIN_BLOCK && inDictionary && nTokens == 1)
            {
                if (comesTwice())
                {
                    what = "two dictionaries";
                    return path();
                }
                open.push_back({first, true, {}});
                nTokens = 0;
            }
            else if (c == token::BEGIN_BLOCK || c == token::BEGIN_LIST)
            {
                open.push_back({"", false, {}});
            }
            else if (c == token::END_BLOCK || c == token::END_LIST)
            {
                if (open.size() == 1) return "";
                const bool closed = open.back().isDictionary;
                open.pop_back();
                if (closed) nTokens = 0;
            }
            else if (c == token::END_STATEMENT && inDictionary)
            {
                if (nTokens > 0 && comesTwice())
                {
                    what = "two values";
                    return path();
                }
                nTokens = 0;
            }
            continue;
        }
        OStringStream os;
        os << t;
        const std::string text(os.str());
        if (text.compare(0, 3, "#if") == 0) return "";
        if (!open.back().isDictionary) continue;
        if (directive)
        {
            directive = false;
        }
        else if (nTokens == 0 && text[0] == '#')
        {
            // #include "file" has no semicolon
            directive = true;
        }
        else if (nTokens++ == 0)
        {
            first = text;
        }
    }
    return "";
}
} // namespace

void Foam::refuseDuplicates(const dictionary& dict, const fileName& file)
{
    string repeated, what;
    if (Pstream::master()) repeated = firstRepeated(file, what);
    Pstream::scatter(repeated);
    Pstream::scatter(what);
    if (repeated.empty()) return;
    refuse(
        dict, repeated, what,
        what == "two values"
            ? "one: OpenFOAM uses one of two values of the same name without "
              "a message"
            : "one: OpenFOAM merges two dictionaries of the same name; give "
              "the second another name");
}
