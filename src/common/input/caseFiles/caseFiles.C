// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "fileOperation.H"
#include "IFstream.H"
#include "OSspecific.H"
#include "polyMesh.H"
#include "StringStream.H"
#include "Time.H"
#include <algorithm>
#include <cctype>

namespace
{
using namespace Foam;

//- Text of a file; empty if the file cannot be opened
std::string textOf(const fileName& file)
{
    IFstream is(file);
    if (!is.good()) return std::string();
    return std::string(std::istreambuf_iterator<char>(is.stdStream()), {});
}

//- Reason why a file cannot be read as className; empty if there is no file
string whatIsWrong(const fileName& file, const word& className)
{
    switch (Foam::type(file, false))
    {
    case fileName::DIRECTORY:
        return "it is a directory";
    case fileName::LINK:
        if (Foam::type(file) == fileName::UNDEFINED)
        {
            return "it is a link to nothing";
        }
        if (Foam::type(file) == fileName::DIRECTORY)
        {
            return "it is a link to a directory";
        }
        break;
    case fileName::UNDEFINED:
        if (!isFile(file)) return ""; // isFile() also finds file.gz
        break;
    default:
        break;
    }

    if (!IFstream(file).good()) return "it cannot be opened";
    const std::string text(textOf(file));
    if (std::all_of(text.begin(), text.end(),
                    [](const unsigned char c) { return std::isspace(c); }))
    {
        return "it is empty";
    }
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
    {
        return "it begins with a byte-order mark (save it as UTF-8 without)";
    }
    if (text.compare(0, 2, "\xFF\xFE") == 0 ||
        text.compare(0, 2, "\xFE\xFF") == 0)
    {
        return "it is UTF-16 (save it as UTF-8)";
    }
    if (text.find("FoamFile") == std::string::npos)
    {
        return "it has no header";
    }
    return "its header is damaged or names another class than " + className;
}

//- First bracket of a token stream that does not match; empty if all do
string wrongBrackets(ISstream& is)
{
    std::string open; // closing brackets that are still to come
    if (is.lineNumber() < 1) is.lineNumber(1);
    for (token t(is); t.good(); is >> t)
    {
        if (!t.isPunctuation()) continue;
        const char c = t.pToken();
        if (c == token::BEGIN_BLOCK) open += token::END_BLOCK;
        if (c == token::BEGIN_LIST) open += token::END_LIST;
        if (c != token::END_BLOCK && c != token::END_LIST) continue;
        if (open.empty() || open.back() != c)
        {
            return "line " + Foam::name(is.lineNumber()) + " has " +
                   string(1, c) + " without an opening bracket";
        }
        open.pop_back();
    }
    if (open.empty()) return "";
    return string(1, open.back()) + " is missing at its end";
}

//- wrongBrackets, or the reason why OpenFOAM cannot read a token
string wrongTokens(ISstream& is)
{
    const bool throwing = FatalIOError.throwExceptions();
    string wrong;
    try
    {
        wrong = wrongBrackets(is);
    }
    catch (const IOerror& error)
    {
        wrong = is.eof() ? string("a value is incomplete at its end")
                         : error.message();
    }
    FatalIOError.throwExceptions(throwing);
    return wrong;
}

std::string lowerCase(std::string name)
{
    for (char& c : name)
    {
        c = char(std::tolower(static_cast<unsigned char>(c)));
    }
    return name;
}
} // namespace

void Foam::refuseUnreadable(const IOobject& io, const word& className)
{
    const Time& time = io.time();
    const fileName found(fileHandler().filePath(true, io, className));
    fileName file;
    string wrong;
    if (Pstream::master())
    {
        fileNameList paths({found, io.objectPath()});
        if (io.instance() == time.constant() || io.instance() == time.system())
        {
            paths.append(time.globalPath() / io.instance() / io.db().dbDir() /
                         io.local() / io.name());
        }
        for (const fileName& path : paths)
        {
            if (!wrong.empty() || path.empty()) continue;
            file = path;
            wrong = whatIsWrong(file, className);
        }
    }
    Pstream::scatter(file);
    Pstream::scatter(wrong);
    if (wrong.empty()) return;

    FatalErrorInFunction << "file " << file.c_str()
                         << " cannot be read: " << wrong.c_str() << nl
                         << "    It must begin with" << nl
                         << "    FoamFile { version 2.0; format ascii; class "
                         << className << "; object " << io.name() << "; }"
                         << exit(FatalError);
}

Foam::string Foam::wrongBrackets(const std::string& text)
{
    IStringStream is(text);
    return wrongTokens(is);
}

void Foam::requireBrackets(const IOobject& io, const word& className)
{
    const fileName file(fileHandler().filePath(true, io, className));
    string wrong;
    if (Pstream::master())
    {
        // Binary numbers may contain the characters of brackets
        const std::string text(textOf(file));
        const std::string header(text.substr(0, text.find('}')));
        if (header.find("binary;") == string::npos)
        {
            IFstream is(file);
            wrong = wrongTokens(is);
        }
    }
    Pstream::scatter(wrong);
    if (wrong.empty()) return;

    FatalErrorInFunction << "file " << file.c_str()
                         << " cannot be read: " << wrong.c_str() << nl
                         << "    allowed: brackets that match"
                         << exit(FatalError);
}

std::unique_ptr<Foam::IOdictionary> Foam::stateOfTime(const objectRegistry& db,
                                                      const word& name)
{
    const IOobject io(name, db.time().timeName(), "uniform", db,
                      IOobject::MUST_READ, IOobject::NO_WRITE, false);
    if (!IOobject(io).typeHeaderOk<IOdictionary>(true, true, false))
    {
        refuseUnreadable(io, IOdictionary::typeName);
        return nullptr;
    }
    const bool throwing = FatalIOError.throwExceptions();
    std::unique_ptr<IOdictionary> state;
    try
    {
        state.reset(new IOdictionary(io));
    }
    catch (const IOerror& error)
    {
        // Reset first: OpenFOAM leaves out a functionObject whose exception it catches
        FatalIOError.throwExceptions(throwing);
        FatalIOErrorInFunction(dictionary(io.objectPath()))
            << "the file is damaged: " << error.message().c_str() << nl
            << "    Delete the file, so that " << name << " starts afresh, or "
            << "start from an earlier time" << exit(FatalIOError);
    }
    FatalIOError.throwExceptions(throwing);
    return state;
}

Foam::fileName Foam::fileWithOtherCapitals(const IOobject& io)
{
    fileName found;
    if (Pstream::master())
    {
        const Time& time = io.time();
        const fileName right(time.globalPath() / io.instance() /
                             io.db().dbDir() / io.name());
        const fileNameList folders(
            {right.path(), time.globalPath() / time.system()});
        for (const fileName& folder : folders)
        {
            for (const fileName& name : readDir(folder, fileName::FILE))
            {
                if (folder / name != right &&
                    lowerCase(name) == lowerCase(io.name()))
                {
                    found = folder / name;
                }
            }
        }
    }
    Pstream::scatter(found);
    return found;
}

Foam::List<Foam::dictionary>
Foam::optionsOfType(const polyMesh& mesh, const word& type, const bool all)
{
    List<dictionary> found;
    for (const word& place : {mesh.time().constant(), mesh.time().system()})
    {
        const IOdictionary options(IOobject("fvOptions", place, mesh,
                                            IOobject::READ_IF_PRESENT,
                                            IOobject::NO_WRITE, false));
        for (const entry& e : options)
        {
            if (e.isDict() && e.dict().getOrDefault<word>("type", "") == type &&
                (all || e.dict().getOrDefault<bool>("active", true)))
            {
                found.append(e.dict().optionalSubDict(type + "Coeffs"));
            }
        }
    }
    return found;
}

Foam::fileName Foam::outputFolder(const polyMesh& mesh, const fileName& folder)
{
    return mesh.time().globalPath() / folder / mesh.dbDir();
}
