// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyStatistics.H"
#include "addToRunTimeSelectionTable.H"
#include "bodyWriter.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "functionTimes.H"

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(bodyStatistics, 0);
addToRunTimeSelectionTable(functionObject, bodyStatistics, dictionary);
} // namespace functionObjects
} // namespace Foam

Foam::functionObjects::bodyStatistics::bodyStatistics(const word& name,
                                                      const Time& time,
                                                      const dictionary& dict)
    : sampledBodies(name, time, dict, typeName)
{
    checkFunctionEntries(dict,
                         {"groups", "bins", "maxDistance",
                          "concentrationRadius", "referenceVelocity", "plane"});
    requireBodies(dict);
    const groupStatistics::settings settings(readSettings(dict));
    const wordList all(bodies_.system().groupNames());
    const wordList wanted(dict.getOrDefault<wordList>("groups", all));
    if (wanted.empty()) refuse(dict, "groups", "()", oneOf(all));
    for (const word& group : wanted)
    {
        const label g = all.find(group);
        if (g < 0) refuse(dict, "groups", group, oneOf(all));
        groups_.emplace_back(bodies_.system().groups[g],
                             uniformGrid::New(mesh_), settings);
    }
    bodyCollection::New(mesh_).sampledBy(due());
    settings_ = textOf(settings);
    readState();
    keepState();
}

void Foam::functionObjects::bodyStatistics::writeState(Ostream& os) const
{
    os << "settings " << settings_ << ';' << nl << "groups" << nl << '{' << nl;
    for (const groupStatistics& g : groups_)
    {
        os << g.group().name() << nl << '{' << nl;
        g.writeState(os);
        os << '}' << nl;
    }
    os << '}' << nl;
}

Foam::groupStatistics::settings
Foam::functionObjects::bodyStatistics::readSettings(
    const dictionary& dict) const
{
    const uniformGrid& grid = uniformGrid::New(mesh_);
    scalar most = GREAT;
    for (direction d = 0; d < 3; ++d)
    {
        most = min(most, (grid.periodic(d) ? 0.5 : 1) * grid.length()[d]);
    }
    groupStatistics::settings s{
        dict.getOrDefault<label>("bins", 40),
        dict.found("maxDistance") ? readPositive(dict, "maxDistance", dimLength)
                                  : most,
        0,
        dict.getOrDefault<vector>("referenceVelocity", Zero),
        0,
        1};
    s.concentrationRadius =
        dict.found("concentrationRadius")
            ? readPositive(dict, "concentrationRadius", dimLength)
            : 0.5 * s.maxDistance;
    if (s.bins < 2 || s.bins > 1000)
    {
        refuse(dict, "bins", Foam::name(s.bins), "2 to 1000");
    }
    if (max(s.maxDistance, s.concentrationRadius) > most * (1 + 1e-9))
    {
        refuse(dict,
               s.maxDistance > most ? "maxDistance" : "concentrationRadius",
               Foam::name(max(s.maxDistance, s.concentrationRadius)),
               "up to " + Foam::name(most) +
                   ", half of each period, and the distance of other sides");
    }
    const auto plane(readPlane(dict, "plane", bodies_.system().flow.plane));
    s.f = plane[0];
    s.g = plane[1];
    return s;
}

void Foam::functionObjects::bodyStatistics::readState()
{
    const auto saved = savedState();
    if (!saved) return;
    if (saved->getOrDefault<string>("settings", "") != settings_)
    {
        Info << "functionObject " << name()
             << " starts afresh: its entries are "
             << "not those of the state" << nl;
        return;
    }
    last_ = saved->get<scalar>("last");
    const dictionary& groups = saved->subDict("groups");
    for (groupStatistics& g : groups_)
    {
        const dictionary* of = groups.findDict(g.group().name());
        if (of) g.readState(*of);
    }
}

Foam::string Foam::functionObjects::bodyStatistics::textOf(
    const groupStatistics::settings& s)
{
    OStringStream os;
    os.precision(6);
    os << s.bins << ' ' << s.maxDistance << ' ' << s.concentrationRadius << ' '
       << s.referenceVelocity << ' ' << label(s.f) << ' ' << label(s.g);
    return os.str();
}

bool Foam::functionObjects::bodyStatistics::execute()
{
    const scalar dt = elapsed();
    if (dt == 0) return true;
    for (groupStatistics& g : groups_)
    {
        const bodyReport& report = g.group().report();
        const List<scalarList> rows(bodyWriter::inOrder<scalarList>(
            g.group(), [&](const label i) { return report.sample(i); }));
        if (Pstream::master()) g.add(last_, dt, rows);
    }
    return !isLast() || write();
}

bool Foam::functionObjects::bodyStatistics::write()
{
    if (postProcess || !Pstream::master()) return true;
    for (const groupStatistics& g : groups_)
    {
        if (g.hasSamples()) g.write(folder() / g.group().name());
    }
    return true;
}
