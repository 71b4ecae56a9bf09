// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "dictionaryChecks.H"
#include "OSspecific.H"
#include "ofAllRanks.H"
#include <cctype>

void Foam::waitForMaster()
{
    if (Pstream::parRun() && !Pstream::master()) sleep(5);
}

void Foam::checkEntries(const dictionary& dict, const wordList& allowed)
{
    for (const word& key : dict.toc())
    {
        if (!allowed.found(key))
        {
            waitForMaster();
            FatalIOErrorInFunction(dict)
                << "unknown entry " << key << " in " << dict.name() << nl
                << "    allowed: " << oneOf(allowed).c_str()
                << exit(FatalIOError);
        }
    }
}

void Foam::requireEntry(const dictionary& dict, const word& name)
{
    if (dict.findEntry(name)) return;
    waitForMaster();
    FatalIOErrorInFunction(dict)
        << "entry " << name << " is missing in " << dict.name() << nl
        << "    entries that are there: " << oneOf(dict.toc()).c_str()
        << exit(FatalIOError);
}

Foam::wordList Foam::withCoeffs(const dictionary& dict, wordList allowed,
                                const wordList& functions)
{
    for (const word& name : functions)
    {
        const entry* function = dict.findEntry(name, keyType::LITERAL);
        if (function && function->isStream() && function->stream().size() &&
            function->stream()[0].isWord())
        {
            allowed.append(name + "Coeffs");
        }
    }
    return allowed;
}

void Foam::refuse(const dictionary& dict, const word& name, const string& value,
                  const string& allowed)
{
    waitForMaster();
    FatalIOErrorInFunction(dict)
        << "entry " << name << " has the value " << value.c_str() << nl
        << "    allowed: " << allowed.c_str() << exit(FatalIOError);
}

void Foam::checkDimensions(const dictionary& dict, const word& name,
                           const dimensionSet& dims)
{
    ITstream is(dict.lookup(name));
    is.rewind();
    token first(is);
    if (first.isWord()) is >> first;
    if (first != token::BEGIN_SQR) return;
    is.putBack(first);
    const dimensionSet given(is);
    if (given == dims) return;
    OStringStream allowed;
    allowed << dims;
    refuse(dict, name, valueOf(*dict.findEntry(name)),
           "dimensions " + allowed.str() + ", or a number without");
}

Foam::scalar Foam::readNumber(const dictionary& dict, const word& name,
                              const dimensionSet& dims)
{
    requireEntry(dict, name);
    const entry& given = *dict.findEntry(name);
    bool isNumber = false;
    if (given.isStream())
    {
        for (const token& t : given.stream())
        {
            isNumber = isNumber || t.isNumber();
        }
    }
    if (!isNumber) refuse(dict, name, valueOf(given), "a number");
    checkDimensions(dict, name, dims);
    const scalar value = dimensionedScalar(name, dims, dict).value();
    if (!(mag(value) < 1e100))
    {
        refuse(dict, name, valueOf(given), "numbers smaller than 1e100");
    }
    return value;
}

Foam::scalar Foam::readPositive(const dictionary& dict, const word& name,
                                const dimensionSet& dims)
{
    const scalar value = readNumber(dict, name, dims);
    if (!(value > 0))
    {
        refuse(dict, name, Foam::name(value), "numbers greater than 0");
    }
    return value;
}

Foam::string Foam::valueOf(const entry& e)
{
    OStringStream os;
    os.precision(10);
    if (e.isStream())
    {
        for (const token& t : e.stream())
        {
            os << t << ' ';
        }
    }
    else
    {
        for (const entry& one : e.dict())
        {
            os << one.keyword() << ' ' << valueOf(one).c_str()
               << (one.isStream() ? "; " : " ");
        }
    }

    // Join the lines; drop blanks inside brackets
    std::string line;
    for (const char c : std::string(os.str()))
    {
        const bool blank = std::isspace(static_cast<unsigned char>(c));
        if (blank && (line.empty() || line.back() == ' ' ||
                      line.back() == '(' || line.back() == '['))
            continue;
        if ((c == ')' || c == ']' || c == ';') && !line.empty() &&
            line.back() == ' ')
            line.pop_back();
        line += blank ? ' ' : c;
    }
    if (!line.empty() && line.back() == ' ') line.pop_back();
    return e.isStream() ? line : "{ " + line + " }";
}

const Foam::dictionary& Foam::readDict(const dictionary& dict, const word& name,
                                       const string& example)
{
    requireEntry(dict, name);
    const entry* found = dict.findEntry(name, keyType::LITERAL);
    if (found && !found->isDict())
    {
        refuse(dict, name, valueOf(*found),
               "a dictionary, such as " + name + " { " + example + " }");
    }
    return dict.subDict(name);
}

const Foam::dictionary& Foam::readDictIfPresent(const dictionary& dict,
                                                const word& name,
                                                const string& example)
{
    return dict.found(name) ? readDict(dict, name, example) : dictionary::null;
}

Foam::string Foam::firstOf(const string& sentence)
{
    for (const string& s : ofAllRanks(sentence))
    {
        if (!s.empty()) return s;
    }
    return string::null;
}

Foam::string Foam::oneOf(const wordList& words)
{
    string all;
    for (const word& w : words)
    {
        all += (all.empty() ? "" : " ") + w;
    }
    return "(" + all + ")";
}

Foam::word Foam::readWord(const dictionary& dict, const word& name,
                          const wordList& words, const word& otherwise)
{
    const word value(dict.getOrDefault<word>(name, otherwise));
    if (!words.found(value)) refuse(dict, name, value, oneOf(words));
    return value;
}

Foam::FixedList<Foam::direction, 2>
Foam::readPlane(const dictionary& dict, const word& name,
                const FixedList<direction, 2>& otherwise)
{
    if (!dict.found(name)) return otherwise;
    const wordList axes({"x", "y", "z"}), plane(dict.get<wordList>(name));
    FixedList<direction, 2> directions(direction(0));
    bool valid = plane.size() == 2 && plane[0] != plane[1];
    for (label k = 0; valid && k < 2; ++k)
    {
        valid = axes.found(plane[k]);
        directions[k] = axes.find(plane[k]);
    }
    if (!valid)
    {
        refuse(dict, name, valueOf(*dict.findEntry(name)),
               "two different ones of x y z, such as (x y)");
    }
    return directions;
}
