// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "repeatedDictionary.H"
#include "dictionaryChecks.H"
#include "IFstream.H"
#include "Pstream.H"
#include "StringStream.H"
#include <set>
#include <vector>

namespace
{
using namespace Foam;

//- A block of the text: its name where it is a dictionary, and the names in it
struct textBlock
{
    std::string name;
    bool isDictionary;
    std::set<std::string> names;
};

string firstRepeated(const fileName& file)
{
    IFstream is(file);
    std::vector<textBlock> open{{"", true, {}}};
    std::string first; // word of an entry
    label nTokens = 0; // of that entry
    bool directive = false;
    for (token t(is); t.good(); is >> t)
    {
        if (t.isPunctuation())
        {
            const char c = t.pToken();
            const bool inDictionary = open.back().isDictionary;
            if (c == token::BEGIN_BLOCK && inDictionary && nTokens == 1)
            {
                if (!open.back().names.insert(first).second)
                {
                    std::string path;
                    for (const textBlock& b : open)
                    {
                        if (!b.name.empty()) path += b.name + "/";
                    }
                    return path + first;
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
            // #include "file" has no end of its own
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

void Foam::refuseRepeated(const dictionary& dict, const fileName& file)
{
    string repeated;
    if (Pstream::master()) repeated = firstRepeated(file);
    Pstream::scatter(repeated);
    if (!repeated.empty())
    {
        refuse(
            dict, repeated, "two dictionaries",
            "one: of two with the same name OpenFOAM would make one; give the "
            "second another name");
    }
}
