// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What the dictionaries of a case say of its bodies

#include "bodyCollection.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "judgedRatio.H"
#include "mathematicalConstants.H"
#include "uniformDimensionedFields.H"

namespace
{
//- Of the sphere of the same volume
Foam::scalar radiusOf(const Foam::bodyPoints& surface)
{
    using namespace Foam;
    return std::cbrt(sum(surface.places & surface.areas) /
                     (4 * constant::mathematical::pi));
}
} // namespace

void Foam::bodyCollection::requireTimeSteps() const
{
    const dictionary schemes(mesh_.schemesDict().subOrEmptyDict("ddtSchemes"));
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

void Foam::bodyCollection::read(const IOdictionary& dict)
{
    const wordList beside({"sampleInterval", "accuracy", "kernel", "coupling",
                           "interactions", "loads", "wrap", "restart",
                           "removed", "outside", "nu"});
    wordList allowed({"FoamFile", "variables", "bodies"});
    allowed.append(beside);
    checkEntries(dict, allowed);

    const IOdictionary transport(
        IOobject("transportProperties", mesh_.time().constant(), mesh_,
                 IOobject::MUST_READ, IOobject::NO_WRITE, false));
    rho_ = readPositive(transport, "rho", dimDensity);
    nu_.reset(new fluidViscosity(mesh_, transport, dict));
    dictionary saved;
    fileName file;
    const bool continues =
        mesh_.time().value() > 0 &&
        dict.getOrDefault<word>("restart", "continue") != "initial";
    if (nu_->isMean() && continues && findState(saved, file))
    {
        const dictionary before(saved.subOrEmptyDict(stateEntries[2]));
        if (before.found("nu")) nu_->restore(before.get<scalar>("nu"));
    }

    neighbours_.reset(new blockNeighbours(grid_));
    ownership_.reset(new bodyOwnership(*neighbours_));
    markers_.reset(new markerSet(grid_, deltaKernel(dict), *neighbours_));

    accuracy_ = bodyAccuracy(dict);
    const Time& time = mesh_.time();
    const bodyScene scene{grid_,
                          markers_->kernel(),
                          solverBalances_,
                          rho_,
                          rho_ * nu_->value(),
                          readGravity(),
                          expectedDeltaT(),
                          adjusted(),
                          time.endTime().value() - time.startTime().value(),
                          accuracy_,
                          readCoupling(dict, bodyCoupling::twoWay),
                          removesOutside(dict, false),
                          forces_,
                          placed_,
                          effects_};
    bool feedback = false, inFluid = false;
    word nucleated; // a group, if any
    const dictionary& bodies =
        readDict(dict, "bodies", "cells { type capsule; ... }");
    if (bodies.empty()) refuse(dict, "bodies", "{}", "one group and more");
    const wordList notOfGroups({"restart", "type", "nucleus"});
    for (const word& name : bodies.toc())
    {
        const dictionary* isGroup = bodies.findDict(name, keyType::LITERAL);
        if (beside.found(name) && !(isGroup && isGroup->found("type")))
        {
            refuse(bodies, name, valueOf(*bodies.findEntry(name)),
                   "groups of bodies; " + name +
                       " belongs beside bodies {...}, "
                       "not into it");
        }
        if (stateEntries.found(name))
        {
            refuse(dict, "bodies", "a group " + name,
                   "other names, as the state has an entry of this name");
        }
        // It becomes a file name
        if (name.find_first_not_of(
                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQR"
                "STUVWXYZ0123456789_-+.") != string::npos)
        {
            refuse(dict, "bodies", "a group with the name \"" + name + "\"",
                   "names of letters, digits and _ - + .");
        }
        const dictionary& group = readDict(bodies, name, "type capsule; ...");
        groups_.append(bodyGroup::New(name, group, scene).ptr());
        given_.append(entriesOf(group, notOfGroups));
        feedback = feedback || groups_.last().twoWay();
        inFluid = inFluid || !groups_.last().alone();
        if (!group.found("nucleus")) continue;

        const label host = groups_.size() - 1;
        const word inside(name + "Nucleus");
        if (bodies.found(inside))
        {
            refuse(bodies, inside, valueOf(*bodies.findEntry(inside)),
                   "other names: the nuclei of " + name + " have this one");
        }
        const dictionary nuclei(nucleiOf(group, groups_[host]));
        bodyScene within(scene);
        within.mu *= groups_[host].viscosityRatio();
        within.insideBodies = true;
        groups_.append(bodyGroup::New(inside, nuclei, within).ptr());
        groups_.last().putInto(host, groups_[host]);
        if (!groups_.last().hasNearPartner())
        {
            const scalar gap = radiusOf(groups_[host].points(-1)) -
                               radiusOf(groups_.last().points(-1));
            judge(group,
                  {{"nucleus", "gap to the membrane/h",
                    gap / cmptMax(grid_.h()), 0, GREAT, 10, GREAT,
                    "without the near field of both (see its row in the "
                    "table of effects) the fluid in between resists too "
                    "much: D was 22 (rigid) and 42 % (capsule) low with 2 "
                    "cells, 7 and 12 % with 5"}});
        }
        given_.append(entriesOf(nuclei, {"type", "positions"}));
        effects_.declare("nucleus", true, "in group " + name);
        nucleated = name;
    }

    // Samples of many bodies at each step would cost a good part of it
    label nBodies = 0;
    forAll(groups_, g)
    {
        nBodies += groups_[g].nBodies();
    }
    sampleInterval_ =
        dict.getOrDefault<label>("sampleInterval", max(label(1), nBodies / 16));
    if (sampleInterval_ < 1)
    {
        refuse(dict, "sampleInterval", Foam::name(sampleInterval_),
               "1 and greater");
    }

    alone_ = !empty() && !inFluid;
    if (inFluid && !nu_->known())
    {
        refuse(
            dict, "nu", "none",
            "the viscosity of the fluid [m^2/s]: the solver has no model that "
            "tells it");
    }
    effects_.declare("interpolation", inFluid,
                     inFluid ? deltaKernel::names[markers_->kernel().type()] +
                                   " kernel at face centres"
                             : word("coupling none"));
    effects_.declare("spreading", feedback,
                     !feedback ? "coupling oneWay or none"
                     : periodicBox()
                         ? "loads act on the fluid, less their mean, which "
                           "nothing holds in a box without walls"
                         : "loads act on the fluid");
    readViscosityRatios(transport);
    given_.append(entriesOf(dict, {"FoamFile", "variables", "bodies", "restart",
                                   "removed", "sampleInterval", "wrap"}));
    readLoads(
        readDictIfThere(dict, "loads", "pull { type deadLoad; group ...; }"));
    dictionary interactions(
        dict, readDictIfThere(dict, "interactions", "repulsion {}"));
    string reason(interactions.empty() ? "none given"
                                       : "bodies that come close");
    if (!nucleated.empty() && !interactions.found("repulsion"))
    {
        interactions.add("repulsion", dictionary());
        reason = "repulsion, which keeps the nuclei of " + nucleated +
                 " inside and acts between all bodies";
    }
    effects_.declare("interactions", !interactions.empty(), reason);
    if (!interactions.empty())
    {
        interactions_.reset(
            new bodyInteractions(interactions, mesh_, groups_, scene));
    }
    effects_.declare("places", true,
                     "bodies that leave their block or the box, or come close");
}

Foam::dictionary Foam::bodyCollection::nucleiOf(const dictionary& group,
                                                const bodyGroup& host)
{
    const dictionary& given =
        readDict(group, "nucleus", "type rigid; radiusRatio 0.5;");
    if (!host.twoWay())
    {
        refuse(group, "nucleus", valueOf(*group.findEntry("nucleus")),
               "nuclei in groups of coupling twoWay");
    }
    const word type(given.get<word>("type"));
    if (type != "rigid" && type != "capsule")
    {
        refuse(given, "type", type, "(rigid capsule)");
    }
    for (const word entry : {"restart", "outside", "nucleus", "coupling"})
    {
        if (given.found(entry))
        {
            refuse(given, entry, valueOf(*given.findEntry(entry)),
                   "that of the capsules, for both");
        }
    }
    for (const word entry : {"shape", "positions", "directions", "placement"})
    {
        if (given.found(entry))
        {
            refuse(given, entry, valueOf(*given.findEntry(entry)),
                   "radiusRatio and offset, which say how large a nucleus is "
                   "and where in its capsule");
        }
    }
    const bodyPoints surface(host.points(-1));
    if (!surface.isSurface() || host.forcing() != forcingType::none)
    {
        refuse(group, "nucleus", valueOf(*group.findEntry("nucleus")),
               "nuclei of capsules");
    }
    const scalar ratio = readPositive(given, "radiusRatio", dimless);
    if (ratio >= 1)
    {
        refuse(given, "radiusRatio", Foam::name(ratio), "below 1");
    }
    const scalar radius = ratio * radiusOf(surface);
    judge(given, {{"radiusRatio", "radius of the nucleus/h",
                   radius / cmptMax(grid_.h()), 1, GREAT, 2, GREAT,
                   "a surface needs some cells to be one"}});

    // offset is along the axes of the box, where each capsule may be turned
    const vector offset(given.getOrDefault<vector>("offset", Zero));
    pointField positions(host.nBodies());
    forAll(positions, body)
    {
        const point centre(host.initialCentre(body));
        positions[body] = intoBox(grid_, centre + offset);
        if (body > 0 && host.directions().empty()) continue;

        // To the plane of each point, where its nearest place belongs to the point
        const bodyPoints turned(host.initialPoints(body));
        const scalar patch = 2 * max(mag(turned.areas));
        scalar nearest = GREAT;
        forAll(turned.places, k)
        {
            const vector r(turned.places[k] - centre - offset);
            const scalar toPlane = (r & turned.areas[k]) / mag(turned.areas[k]);
            const bool own = magSqr(r) < sqr(toPlane) + patch;
            nearest = min(nearest, own ? toPlane : mag(r));
        }
        if (nearest > radius) continue;
        refuse(given, "radiusRatio",
               Foam::name(ratio) + ", a radius of " + Foam::name(radius) + ",",
               "nuclei inside the capsule, whose membrane comes as close as " +
                   Foam::name(nearest) + " to their centre");
    }

    dictionary nuclei(given);
    nuclei.remove("radiusRatio");
    nuclei.remove("offset");
    dictionary shape;
    shape.add("type", word("sphere"));
    shape.add("radius", radius);
    nuclei.add("shape", shape);
    // As text: all digits
    const unsigned precision = IOstream::defaultPrecision(17);
    nuclei.add("positions", positions);
    IOstream::defaultPrecision(precision);
    if (group.found("outside"))
    {
        nuclei.add("outside", group.get<word>("outside"), true);
    }
    return nuclei;
}

void Foam::bodyCollection::readViscosityRatios(const dictionary& transport)
{
    // A fluid that does not feel the bodies has its own viscosity everywhere
    scalarList ratios(groups_.size(), scalar(1));
    bool unfelt = false;
    forAll(groups_, g)
    {
        const scalar ratio = groups_[g].viscosityRatio();
        if (groups_[g].twoWay())
            ratios[g] = ratio;
        else
            unfelt = unfelt || ratio != 1;
    }
    if (ratios != scalarList(groups_.size(), scalar(1)))
    {
        const word model(transport.get<word>("transportModel"));
        if (model != "Newtonian")
        {
            refuse(transport, "transportModel", model,
                   "Newtonian where bodies have a viscosityRatio");
        }
        contrast_.reset(new viscosityContrast(
            mesh_, readPositive(transport, "nu", dimViscosity), ratios));
    }
    effects_.declare("viscosityRatio", bool(contrast_),
                     contrast_ ? "up to " + Foam::name(max(ratios)) +
                                     ", down to " + Foam::name(min(ratios))
                     : unfelt ? string("coupling oneWay: the fluid does not "
                                       "feel the bodies")
                              : string("same fluid inside"));
}

void Foam::bodyCollection::readLoads(const dictionary& loads)
{
    wordList names(groups_.size());
    forAll(groups_, g)
    {
        names[g] = groups_[g].name();
    }
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
        forces_.append(bodyForce::New(load, groups_[g].points(-1)).ptr());
        effects_.declare(forces_.last().effect(), true, name);
        if (!groups_[g].takesForces())
        {
            refuse(load, "group", group,
                   "a group that acts on the fluid: capsules that are only "
                   "carried by it (coupling oneWay) feel no force");
        }
    }
    if (loads.empty()) effects_.declare("loads", false, "none given");
}

Foam::vector Foam::bodyCollection::readGravity() const
{
    const IOobject io("g", mesh_.time().constant(), mesh_, IOobject::MUST_READ,
                      IOobject::NO_WRITE, false);
    if (!isThere<uniformDimensionedVectorField>(io)) return Zero;
    const uniformDimensionedVectorField g(io);
    checkDimensions(g, dimAcceleration);
    return g.value();
}
