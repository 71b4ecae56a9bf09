// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "sampledBodies.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "functionTimes.H"
#include "OSspecific.H"
#include "resultFile.H"
#include "stateObject.H"

//- State of a functionObject
class Foam::functionObjects::sampledBodies::sums
    : public stateObject<IOdictionary>
{
public:
    using stateObject<IOdictionary>::stateObject;
};

Foam::functionObjects::sampledBodies::~sampledBodies() = default;

Foam::functionObjects::sampledBodies::sampledBodies(const word& name,
                                                    const Time& time,
                                                    const dictionary& dict,
                                                    const word& type)
    : fvMeshFunctionObject(name, time, dict),
      entries_(std::make_shared<dictionary>(dict)),
      timeStart_(dict.getOrDefault<scalar>("timeStart", -GREAT)),
      bodies_(bodyCollection::New(mesh_)),
      last_(max(time.value(), timeStart_))
{
    uniformGrid::New(mesh_).require(dict, type);
    if (sums* before = mesh_.getObjectPtr<sums>(name))
    {
        OStringStream text;
        before->writeData(text);
        taken_.reset(new dictionary(IStringStream(text.str())()));
        before->checkOut();
    }
    if (mesh_.foundObject<regIOobject>(name))
    {
        refuse(dict.parent(), name, type,
               "another name, as the mesh has an object of this one");
    }
    if (postProcess)
    {
        Info << "functionObject " << name << " of type " << type
             << ": no output with -postProcess, as it needs the run" << nl;
    }
    const scalar end = time.endTime().value();
    if (timeStart_ >= end)
    {
        refuse(dict, "timeStart", Foam::name(timeStart_),
               "times before endTime, " + Foam::name(end));
    }
}

void Foam::functionObjects::sampledBodies::requireBodies(
    const dictionary& dict) const
{
    if (!bodies_.empty()) return;
    refuse(dict, "type", dict.get<word>("type"),
           "cases with constant/deformableBodies: there are no bodies");
}

void Foam::functionObjects::sampledBodies::requireMotion(
    const bodyCollection& bodies, const fvMeshFunctionObject& function)
{
    if (bodies.empty() || bodies.haveMoved()) return;
    FatalErrorInFunction << "functionObject " << function.name()
                         << ": no bodies move in this "
                         << "solver" << nl
                         << "    allowed: cases with an option of type "
                         << "deformableBodies in constant/fvOptions"
                         << exit(FatalError);
}

std::unique_ptr<Foam::dictionary>
Foam::functionObjects::sampledBodies::savedState() const
{
    std::unique_ptr<dictionary> state;
    if (taken_)
        state.reset(new dictionary(*taken_));
    else if (const auto saved = stateOfTime(mesh_, name()))
        state.reset(new dictionary(*saved));
    if (!state) return state;
    if (state->getOrDefault<scalar>("timeStart", timeStart_) != timeStart_)
    {
        Info << "functionObject " << name() << " starts afresh: its timeStart "
             << "is not that of the state" << nl;
        return nullptr;
    }
    if (!taken_ && bodies_.system().startsAfresh())
    {
        Info << "functionObject " << name() << " starts afresh: bodies start "
             << "from the dictionary" << nl;
        return nullptr;
    }
    return state;
}

void Foam::functionObjects::sampledBodies::keepState()
{
    if (!postProcess && !taken_ && Pstream::master())
    {
        keepLaterResults(time_, name(), time_.value());
    }
    taken_.reset();
    const auto write = [this](Ostream& os)
    {
        if (due()()) execute();
        OStringStream text;
        text.precision(17);
        text << "last " << (isOver() ? time_.value() : last_) << ';' << nl
             << "timeStart " << timeStart_ << ';' << nl;
        writeState(text);
        os << text.str().c_str();
    };
    state_.reset(new sums(name(), "uniform", mesh_, write));
}

bool Foam::functionObjects::sampledBodies::isLast() const
{
    return isLastStep(time_) ||
           time_.value() + time_.deltaTValue() * (1 - 1e-6) >
               entries_->getOrDefault<scalar>("timeEnd", GREAT);
}

bool Foam::functionObjects::sampledBodies::isOver() const
{
    return time_.value() > entries_->getOrDefault<scalar>("timeEnd", GREAT);
}

std::function<bool()> Foam::functionObjects::sampledBodies::due() const
{
    const std::weak_ptr<dictionary> entries(entries_);
    const Time& time = time_;
    return [entries, &time]()
    {
        const auto now = entries.lock();
        return now && isExecuted(*now, time);
    };
}

bool Foam::functionObjects::sampledBodies::read(const dictionary& dict)
{
    const auto others = [](dictionary entries)
    {
        for (const word times :
             {"executeControl", "executeInterval", "writeControl",
              "writeInterval", "timeEnd", "enabled", "log"})
        {
            entries.remove(times);
        }
        return entries;
    };
    if (others(dict) != others(*entries_))
    {
        WarningInFunction << "functionObject " << name() << ": only times of "
                          << "samples and of output can be changed during the "
                          << "run" << nl << "    Other entries are those of "
                          << "the start" << endl;
    }
    if (isOver()) last_ = time_.value();
    *entries_ = dict;
    return fvMeshFunctionObject::read(dict);
}

Foam::scalar Foam::functionObjects::sampledBodies::elapsed()
{
    const scalar dt = time_.value() - last_;
    if (postProcess || dt < 0.5 * time_.deltaTValue()) return 0;
    requireMotion(bodies_, *this);
    last_ = time_.value();
    return dt;
}

Foam::fileName Foam::functionObjects::sampledBodies::folder() const
{
    const fileName dir(time_.globalPath() / "postProcessing" / name() /
                       time_.timeName());
    mkDir(dir);
    return dir;
}
