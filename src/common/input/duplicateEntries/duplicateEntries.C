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

//- Search of the tokens of a dictionary file for a name that comes twice in a dictionary
class repeatedName
{
    std::vector<textBlock> open_{{"", true, {}}};

    std::string first_;    // first word of the present entry
    label nTokens_ = 0;    // tokens of the present entry so far
    bool include_ = false; // the next token is the file of an #include
    bool ended_ = false;

    //- Take the first word of the present entry for a name; end if its dictionary has the
    //  name already
    void take(const string& kind)
    {
        nTokens_ = 0;

        // $group and #calc are replaced by other text and may come often
        if (first_[0] == '$' || first_[0] == '#' ||
            open_.back().names.insert(first_).second)
        {
            return;
        }
        for (const textBlock& b : open_)
        {
            if (!b.name.empty()) path += b.name + "/";
        }
        path += first_;
        what = kind;
        ended_ = true;
    }

    //- Brackets and semicolons open and close blocks, and end entries
    void punctuation(const char c)
    {
        const bool inDictionary = open_.back().isDictionary;
        if (c == token::BEGIN_BLOCK && inDictionary && nTokens_ == 1)
        {
            take("two dictionaries");
            open_.push_back({first_, true, {}});
        }
        else if (c == token::BEGIN_BLOCK || c == token::BEGIN_LIST)
        {
            open_.push_back({"", false, {}});
        }
        else if (c == token::END_BLOCK || c == token::END_LIST)
        {
            ended_ = open_.size() == 1;
            if (ended_) return;
            open_.pop_back();
            if (inDictionary) nTokens_ = 0;
        }
        else if (c == token::END_STATEMENT && inDictionary)
        {
            if (nTokens_ > 0) take("two values");
        }
    }

    //- Words, numbers and strings belong to the present entry
    void text(const std::string& t)
    {
        ended_ = t.compare(0, 3, "#if") == 0;
        if (!open_.back().isDictionary) return;
        if (include_)
        {
            include_ = false;
        }
        else if (nTokens_ == 0 && t[0] == '#')
        {
            // #include "file" has no semicolon
            include_ = true;
        }
        else if (nTokens_++ == 0)
        {
            first_ = t;
        }
    }

public:
    //- Path of the name, empty if there is none, and "two dictionaries" or "two values"
    string path, what;

    explicit repeatedName(const fileName& file)
    {
        IFstream is(file);
        for (token t(is); t.good(); is >> t)
        {
            if (t.isPunctuation())
            {
                punctuation(t.pToken());
            }
            else
            {
                OStringStream os;
                os << t;
                text(os.str());
            }
            if (ended_) return;
        }
    }
};
} // namespace

void Foam::refuseDuplicates(const dictionary& dict, const fileName& file)
{
    string repeated, what;
    if (Pstream::master())
    {
        const repeatedName name(file);
        repeated = name.path;
        what = name.what;
    }
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
