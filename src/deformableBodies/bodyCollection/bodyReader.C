// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyReader.H"
#include "bodyStateFile.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "sceneNumbers.H"

Foam::bodyReader::bodyReader(const IOdictionary& dict, bodySystem& system)
    : dict_(dict),
      transport_(IOobject("transportProperties", system.mesh.time().constant(),
                          system.mesh, IOobject::MUST_READ, IOobject::NO_WRITE,
                          false)),
      system_(system)
{
}

void Foam::bodyReader::read()
{
    checkMesh();
    checkTimeSchemes();
    readFluid();
    system_.neighbours.reset(new blockNeighbours(system_.grid));
    system_.ownership.reset(new bodyOwnership(*system_.neighbours));
    system_.markers.reset(
        new markerSet(system_.grid, deltaKernel(dict_), *system_.neighbours));
    system_.accuracy = bodyAccuracy(dict_);
    system_.flow = scalesAtStart(system_.mesh);
    const bodyScene around(scene(system_.flow));
    if (system_.firstFlow.speed < 0) system_.firstFlow = system_.flow;
    readGroups(around);
    readNeighbourField(around);
    readSampleInterval();
    declareCoupling();
    readViscosityRatios();
    given_.append(
        entriesOf(dict_, {"FoamFile", "variables", "bodies", "restart",
                          "removed", "sampleInterval", "bulkStress", "wrap"}));
    const auto keep = [&](const string& name, const auto& value)
    {
        OStringStream os;
        os.precision(12);
        os << value;
        given_.last().append({name, os.str()});
    };
    keep("rho of the fluid", system_.rho);
    if (!system_.nu->isMean()) keep("nu of the fluid", system_.nu->value());
    if (mag(around.g) > 0) keep("constant/g", around.g);
    for (const entry& e : dict_.subOrEmptyDict("interactions"))
    {
        keep("interactions." + e.keyword(), "active");
    }
    readLoads();
    readInteractions(scene(system_.firstFlow));
    system_.effects.declare("boxChecks", true,
                            "bodies that leave their block or the box, or "
                            "come close");
}

void Foam::bodyReader::checkMesh() const
{
    system_.grid.require(dict_, "deformableBodies");
    for (direction d = 0; d < 3; ++d)
    {
        if (system_.mesh.geometricD()[d] < 0)
        {
            waitForMaster();
            FatalIOErrorInFunction(dict_)
                << "deformableBodies needs three dimensions, but direction "
                << vector::componentNames[d] << " has patches of type empty"
                << nl << "    allowed: cyclic patches in place of them, and "
                << "several cells. The dry run of stock solvers replaces the "
                << "mesh: use deformableBodyFoam -dry-run"
                << exit(FatalIOError);
        }
    }
    if (system_.mesh.dynamic())
    {
        waitForMaster();
        FatalIOErrorInFunction(dict_)
            << "deformableBodies needs a mesh that does not move or change"
            << exit(FatalIOError);
    }
}

void Foam::bodyReader::checkTimeSchemes() const
{
    const dictionary schemes(
        system_.mesh.schemesDict().subOrEmptyDict("ddtSchemes"));
    for (const entry& e : schemes)
    {
        if (!e.isStream()) continue;
        const string scheme(e.stream().toString());
        for (const word notInTime :
             {"steadyState", "localEuler", "CoEuler", "SLTS"})
        {
            if (scheme.find(notInTime) == string::npos) continue;
            refuse(schemes, e.keyword(), scheme,
                   "Euler, backward or CrankNicolson: bodies move in time, so "
                   "that solvers of steady flow cannot carry them");
        }
    }
}

void Foam::bodyReader::readFluid()
{
    const fvMesh& mesh = system_.mesh;
    system_.rho = readPositive(transport_, "rho", dimDensity);
    system_.nu.reset(new fluidViscosity(mesh, transport_, dict_));
    dictionary saved;
    fileName file;
    if (mesh.time().value() == 0) return;
    bool continues = false;
    for (const entry& group : dict_.subOrEmptyDict("bodies"))
    {
        continues = continues || restartOf(group.keyword()) != "initial";
    }
    if (!continues || !bodyStateFile::read(mesh, saved, file)) return;
    const dictionary before(saved.subOrEmptyDict(bodyStateFile::allGroups));
    if (system_.nu->isMean() && before.found("nu"))
    {
        system_.nu->restore(before.get<scalar>("nu"));
    }
    system_.flowDeltaT = before.getOrDefault<scalar>("flowDeltaT", -1);
    system_.firstFlow.speed = before.getOrDefault<scalar>("flowSpeed", -1);
    system_.firstFlow.rate = before.getOrDefault<scalar>("flowRate", -1);
    const dictionary loads(before.subOrEmptyDict("loads"));
    for (const word& group : loads.toc())
    {
        if (restartOf(group) != "initial")
            system_.firstLoads.insert(group, loads.get<scalar>(group));
    }
}

Foam::word Foam::bodyReader::restartOf(const word& group) const
{
    const word all(dict_.getOrDefault<word>("restart", "continue"));
    const dictionary* bodies = dict_.findDict("bodies");
    if (!bodies) return all;
    for (const entry& e : *bodies)
    {
        const word name(e.keyword());
        if (e.isDict() && (name == group || (e.dict().found("nucleus") &&
                                             nucleiOf(name) == group)))
            return e.dict().getOrDefault<word>("restart", all);
    }
    return all;
}

// Samples of many bodies at each step would cost a good part of it
void Foam::bodyReader::readSampleInterval()
{
    label nBodies = 0;
    for (const bodyGroup& group : system_.groups)
    {
        nBodies += group.nBodies();
    }
    system_.sampleInterval = dict_.getOrDefault<label>(
        "sampleInterval", max(label(1), nBodies / 16));
    if (system_.sampleInterval < 1)
    {
        refuse(dict_, "sampleInterval", Foam::name(system_.sampleInterval),
               "1 and greater");
    }
}

void Foam::bodyReader::declareCoupling() const
{
    const bool inFluid = !system_.withoutFluid, feedback = system_.twoWay();
    if (inFluid && !system_.nu->known())
    {
        refuse(
            dict_, "nu", "none",
            "the viscosity of the fluid [m^2/s]: the solver has no model that "
            "tells it");
    }
    system_.effects.declare(
        "interpolation", inFluid,
        inFluid ? deltaKernel::names[system_.markers->kernel().type()] +
                      " kernel at face centres"
                : word("coupling none"));
    system_.effects.declare("spreading", feedback,
                            !feedback ? "coupling oneWay or none"
                            : system_.periodicBox()
                                ? "loads act on the fluid, less their mean, "
                                  "which nothing holds in a box without walls"
                                : "loads act on the fluid");
}

void Foam::bodyReader::readViscosityRatios()
{
    // A fluid that does not feel the bodies has its own viscosity everywhere
    const label n = system_.groups.size();
    scalarList ratios(n, scalar(1));
    bool unfelt = false;
    forAll(ratios, g)
    {
        const scalar ratio = system_.groups[g].inside()
                                 ? system_.groups[g].inside()->viscosityRatio()
                                 : 1;
        if (system_.groups[g].twoWay())
            ratios[g] = ratio;
        else
            unfelt = unfelt || ratio != 1;
    }
    const bool contrast = ratios != scalarList(n, scalar(1));
    if (contrast)
    {
        const word model(transport_.get<word>("transportModel"));
        if (model != "Newtonian")
        {
            refuse(transport_, "transportModel", model,
                   "Newtonian where bodies have a viscosityRatio");
        }
        system_.contrast.reset(new viscosityContrast(
            system_.mesh, readPositive(transport_, "nu", dimViscosity),
            ratios));
    }
    system_.effects.declare(
        "viscosityRatio", contrast,
        contrast ? "up to " + Foam::name(max(ratios)) + ", down to " +
                       Foam::name(min(ratios))
        : unfelt ? string("coupling oneWay: the fluid does not feel the bodies")
                 : string("same fluid inside"));
}

void Foam::bodyReader::readLoads()
{
    const dictionary& loads =
        readDictIfPresent(dict_, "loads", "pull { type deadLoad; group ...; }");
    const wordList names(system_.groupNames());
    for (const word& name : loads.toc())
    {
        const dictionary& load =
            readDict(loads, name, "type deadLoad; group ...; force (0 -1 0);");
        const word group(load.get<word>("group"));
        const label g = names.find(group);
        if (g < 0)
        {
            refuse(load, "group", group, oneOf(names));
        }
        system_.forces.append(
            bodyForce::New(load, system_.groups[g].points(-1)).ptr());
        system_.effects.declare(system_.forces.last().effect(), true, name);
        if (system_.forces.last().selectsPointsAtStart() &&
            system_.groups[g].start().directions.size())
        {
            refuse(load, "type", load.get<word>("type"),
                   "loads of other types on a group with directions or "
                   "placement: its patches are those of bodies that are not "
                   "turned (positions alone)");
        }
        if (!system_.groups[g].takesForces())
        {
            refuse(load, "group", group,
                   "a group that acts on the fluid: capsules that are only "
                   "carried by it (coupling oneWay) feel no force");
        }
    }
    if (loads.empty()) system_.effects.declare("loads", false, "none given");
}

void Foam::bodyReader::readInteractions(const bodyScene& scene)
{
    dictionary interactions(
        dict_, readDictIfPresent(dict_, "interactions", "repulsion {}"));
    string reason(interactions.empty() ? "none given"
                                       : "bodies that come close");
    if (!nucleated_.empty() && !interactions.found("repulsion"))
    {
        interactions.add("repulsion", dictionary());
        reason = "repulsion, which keeps the nuclei of " + nucleated_ +
                 " inside and acts between all bodies";
    }
    system_.effects.declare("interactions", !interactions.empty(), reason);
    if (interactions.empty()) return;
    bool nearField = bool(system_.between);
    forAll(system_.groups, g)
    {
        const bodyGroup& group = system_.groups[g];
        if (interactionScene::takesPart(group) && group.points(-1).isSurface())
        {
            nearField = nearField && system_.between->actBetween(g, g);
        }
    }
    system_.interactions.reset(new bodyInteractions(
        interactions, system_.mesh, system_.groups, scene, nearField));
}
