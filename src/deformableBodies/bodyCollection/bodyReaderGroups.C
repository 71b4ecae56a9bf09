// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyReader.H"
#include "bodyStateFile.H"
#include "dictionaryChecks.H"
#include "rangeCheck.H"
#include "nucleusReader.H"

namespace
{
//- Entries that stand beside the dictionary bodies
const Foam::wordList besideBodies({"sampleInterval", "accuracy", "kernel",
                                   "coupling", "interactions", "loads", "wrap",
                                   "restart", "removed", "outside", "nu",
                                   "bulkStress", "neighbourField"});

//- Characters of a group's name, which becomes a file name
const char* const nameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.";
} // namespace

void Foam::bodyReader::readGroups(const bodyScene& scene)
{
    wordList allowed({"FoamFile", "variables", "bodies"});
    allowed.append(besideBodies);
    checkEntries(dict_, allowed);
    const dictionary& bodies =
        readDict(dict_, "bodies", "cells { type capsule; ... }");
    if (bodies.empty()) refuse(dict_, "bodies", "{}", "one group and more");

    bool inFluid = false;
    for (const word& name : bodies.toc())
    {
        checkGroup(bodies, name);
        const dictionary& group = readDict(bodies, name, "type capsule; ...");
        addGroup(name, group, scene);
        inFluid = inFluid || !system_.groups.last().withoutFluid();
        if (group.found("nucleus")) addNuclei(bodies, name, group, scene);
    }
    system_.withoutFluid = !inFluid;
}

void Foam::bodyReader::checkGroup(const dictionary& bodies,
                                  const word& name) const
{
    const dictionary* isGroup = bodies.findDict(name, keyType::LITERAL);
    if (besideBodies.found(name) && !(isGroup && isGroup->found("type")))
    {
        refuse(bodies, name, valueOf(*bodies.findEntry(name)),
               "groups of bodies; " + name + " belongs beside bodies {...}");
    }
    if (name == "nucleus" && isGroup && isGroup->found("radiusRatio"))
    {
        refuse(bodies, name, valueOf(*bodies.findEntry(name)),
               "groups of bodies; nucleus belongs in a group of capsules");
    }
    if (bodyStateFile::reserved(name))
    {
        refuse(dict_, "bodies", "a group " + name,
               "other names, as the state has an entry of this name");
    }
    if (name.find_first_not_of(nameCharacters) != string::npos)
    {
        refuse(dict_, "bodies", "a group with the name \"" + name + "\"",
               "names of letters, digits and _ - + .");
    }
}

void Foam::bodyReader::addGroup(const word& name, const dictionary& group,
                                const bodyScene& scene)
{
    for (const word& other : {word("interactions"), word("loads")})
    {
        if (!group.found(other)) continue;
        refuse(group, other, "{...}",
               "groups without it; " + other + " belongs beside bodies {...}");
    }
    system_.groups.append(bodyGroup::New(name, group, scene).ptr());
    given_.append(entriesOf(group, {"restart", "type", "nucleus"}));
}

void Foam::bodyReader::addNuclei(const dictionary& bodies, const word& name,
                                 const dictionary& group,
                                 const bodyScene& scene)
{
    const label host = system_.groups.size() - 1;
    const word inside(nucleiOf(name));
    if (bodies.found(inside))
    {
        refuse(bodies, inside, valueOf(*bodies.findEntry(inside)),
               "other names: the nuclei of " + name + " have this one");
    }
    nucleusReader reader(group, system_.groups[host], system_.grid);
    const dictionary nuclei(reader.group());
    bodyScene within(scene);
    within.insideBodies = true;
    within.coupling = bodyCoupling::twoWay; // capsules with nuclei have it, too
    within.viscosityAround = system_.groups[host].inside()->viscosityRatio();
    within.mu *= within.viscosityAround;
    within.densityAround = group.found("densityRatio")
                               ? readPositive(group, "densityRatio", dimless)
                               : 1;
    system_.groups.append(bodyGroup::New(inside, nuclei, within).ptr());
    system_.groups.last().setHost(host, system_.groups[host]);
    if (!system_.groups[host].nearSources() ||
        !system_.groups.last().nearSources())
    {
        checkRanges(
            group,
            {{"nucleus", "gap to the membrane/h",
              reader.gap() / cmptMax(system_.grid.h()), 0, GREAT, 10, GREAT,
              "without the near field of both (see its row in the "
              "table of effects) the fluid in between resists too "
              "much: D was 22 (rigid) and 42 % (capsule) low with 2 "
              "cells, 7 and 12 % with 5"}});
    }
    given_.append(entriesOf(nuclei, {"type", "positions"}));
    system_.effects.declare("nucleus", true, "in group " + name);
    nucleated_ = name;
}

void Foam::bodyReader::readNeighbourField(const bodyScene& scene)
{
    label nBodies = 0;
    bool nuclei = false;
    for (const bodyGroup& group : system_.groups)
    {
        if (!group.nearSources()) continue;
        nBodies += group.nBodies();
        nuclei = nuclei || (group.host() >= 0 &&
                            system_.groups[group.host()].nearSources());
    }
    const bool wanted = dict_.getOrDefault<Switch>("neighbourField", true);
    if (wanted && nBodies == 0 && dict_.found("neighbourField"))
    {
        refuse(dict_, "neighbourField", "on",
               "off, as no group has a near field (see its row in the table of "
               "effects)");
    }
    const bool between = wanted && nBodies > 0;
    system_.effects.declare("neighbourField", between || nuclei,
                            between ? "near field between bodies closer than 6 "
                                      "cells, and with walls closer "
                                      "than 3"
                            : nuclei
                                ? "of nuclei only: entry neighbourField off"
                            : wanted ? "no surface with a near field"
                                     : "entry neighbourField off");
    if (between || nuclei)
    {
        system_.between.reset(
            new neighbourField(system_.groups, scene, !between));
    }
    const bool films =
        between && squeezeFilms::arePossible(system_.groups, system_.grid);
    system_.effects.declare(
        "squeezeFilms", films,
        films     ? squeezeFilms::describe()
        : between ? "no rigid spheres that could be pressed together"
                  : "no near field between bodies");
    if (films)
    {
        system_.films.reset(
            new squeezeFilms(system_.groups, *system_.between, scene));
    }
}
