// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "dictionaryChecks.H"

void Foam::checkEntries(const dictionary& dict, const wordList& allowed)
{
    for (const word& key : dict.toc())
    {
        if (!allowed.found(key))
        {
            FatalIOErrorInFunction(dict)
                << "unknown entry " << key << " in " << dict.name() << nl
                << "    allowed: " << flatOutput(allowed) << exit(FatalIOError);
        }
    }
}

void Foam::refuse(const dictionary& dict, const word& name, const string& value,
                  const string& allowed)
{
    FatalIOErrorInFunction(dict)
        << "entry " << name << " has the value " << value.c_str() << nl
        << "    allowed: " << allowed.c_str() << exit(FatalIOError);
}

Foam::scalar Foam::readPositive(const dictionary& dict, const word& name,
                                const dimensionSet& dims)
{
    const scalar value = dimensionedScalar(name, dims, dict).value();
    if (!(value > 0))
    {
        refuse(dict, name, Foam::name(value), "numbers greater than 0");
    }
    return value;
}

Foam::string Foam::firstOf(const string& sentence)
{
    List<string> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = sentence;
    Pstream::gatherList(all);
    Pstream::scatterList(all);
    for (const string& s : all)
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
