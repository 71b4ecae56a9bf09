// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "flowAlgorithm.H"
#include "dictionaryChecks.H"
#include "flowSources.H"
#include "wallConditions.H"

Foam::flowAlgorithm::flowAlgorithm(const dictionary& controls,
                                   const std::function<string()>& obstacle)
{
    const word asked(readWord(controls, "flowAlgorithm",
                              {"auto", "staggered", "pimple"}, "auto"));
    reason_ = asked == "pimple" ? "flowAlgorithm pimple" : obstacle();
    if (asked == "staggered" && !staggered())
    {
        refuse(controls, "flowAlgorithm", "staggered",
               "pimple or auto here, as " + reason_);
    }
}

Foam::string Foam::flowAlgorithm::unsupported(const uniformGrid& grid)
{
    if (!grid.valid()) return "the mesh is no uniform box: " + grid.reason();
    for (direction d = 0; d < 3; ++d)
    {
        if (grid.n()[d] > 2) continue;
        return "there are fewer than three cells in direction " +
               string(vector::componentNames[d]);
    }
    return string::null;
}

Foam::string Foam::flowAlgorithm::obstacle(const volVectorField& U,
                                           const volScalarField& p,
                                           const fv::optionList& sources,
                                           const word& transport,
                                           const word& turbulence)
{
    const bool known = turbulence == "Stokes" &&
                       (transport == "Newtonian" || transport == "prescribed");
    const string models(
        known ? ""
              : "staggered supports laminar flow with transportModel Newtonian "
                "or prescribed only; turbulence is " +
                    turbulence + ", transportModel " + transport);
    const string mesh(unsupported(uniformGrid::New(U.mesh())));
    const string conditions(mesh.empty() ? wallConditions::unsupported(U, p)
                                         : mesh);
    string all;
    for (const string& one :
         {conditions, models, flowSources::unsupported(sources, U)})
    {
        if (!one.empty()) all += (all.empty() ? "" : "; ") + one;
    }
    return all;
}

void Foam::flowAlgorithm::requireSolvers(const dictionary& solution,
                                         const dictionary& controls) const
{
    if (staggered()) return;
    wordList needed({"pFinal"});
    if (controls.getOrDefault<label>("nCorrectors", 1) > 1) needed.append("p");
    if (controls.getOrDefault<bool>("momentumPredictor", true))
        needed.append("UFinal");
    const dictionary solvers(solution.subOrEmptyDict("solvers"));
    wordList missing;
    for (const word& field : needed)
    {
        if (!solvers.findEntry(field, keyType::REGEX)) missing.append(field);
    }
    if (missing.empty()) return;
    waitForMaster();
    FatalIOErrorInFunction(solution)
        << "the flow algorithm is pimple, not staggered: " << reason_.c_str()
        << nl << "    either change that" << nl
        << "    or give the solvers of pimple in system/fvSolution, which lacks "
        << oneOf(missing).c_str() << exit(FatalIOError);
}

void Foam::flowAlgorithm::checkViscosity(const dictionary& transport,
                                         const scalar least)
{
    if (least >= 0) return;
    refuse(transport, "nu", Foam::name(least), "0 and greater");
}

Foam::List<Foam::flowAlgorithm::effect>
Foam::flowAlgorithm::effects(const bool flows) const
{
    const string name(staggered() ? "staggered" : "pimple");
    DynamicList<effect> all;
    all.append({"momentum", flows, flows ? name : string("coupling none")});
    all.append({"pressure", flows,
                staggered() ? "fast transforms" : "pimple, PISO corrections"});
    if (!staggered() || !flows) return List<effect>(all);
    all.append({"diffusion", true, "its implicit part"});
    all.append({"fields", true, "U, p, phi when they are looked at"});
    return List<effect>(all);
}

void Foam::flowAlgorithm::declare(effectTable& table, const bool flows) const
{
    for (const effect& e : effects(flows))
    {
        table.declare(e.name, e.active, e.note);
    }
}

void Foam::flowAlgorithm::expect(CourantGuard& guard, const bool bodies,
                                 const label nOuterCorrectors) const
{
    if (bodies)
    {
        guard.expect(1, "bodies, which pass a cell in a step", true);
    }
    else if (!staggered() && nOuterCorrectors < 2)
    {
        guard.expect(5, "pimple with nOuterCorrectors 1", false);
    }
}

void Foam::flowAlgorithm::requireBlocks(const fvMesh& mesh,
                                        const dictionary& controls)
{
    const uniformGrid& grid = uniformGrid::New(mesh);
    const bool whole = grid.index().size() == grid.box().count();
    if (returnReduce(whole && grid.index().size(), andOp<bool>())) return;

    waitForMaster();
    FatalIOErrorInFunction(controls)
        << "only the decomposition keeps this case from the flow algorithm "
        << "staggered: the cells of a rank must be one rectangular block" << nl
        << "    either write method uniformBoxes; in system/decomposeParDict, "
        << "libs (deformableBodies); in system/controlDict, and run "
        << "decomposePar -force" << nl
        << "    or write PIMPLE { flowAlgorithm pimple; } in "
        << "system/fvSolution, which is far slower" << exit(FatalIOError);
}

void Foam::flowAlgorithm::checkControls(const dictionary& controls,
                                        const dictionary& schemes) const
{
    // Entries of its own, and those of pimple
    wordList known({"flowAlgorithm", "timeScheme", "diffusion", "convection",
                    "pRefCell", "pRefPoint", "pRefValue"});
    known.append(wordList({"nOuterCorrectors", "nCorrectors",
                           "nNonOrthogonalCorrectors", "momentumPredictor",
                           "residualControl", "turbOnFinalIterOnly"}));
    wordList unknown;
    for (const word& name : controls.toc())
    {
        if (!known.found(name)) unknown.append(name);
    }
    if (unknown.size())
    {
        IOWarningInFunction(controls)
            << "unknown entries, which have no effect: "
            << oneOf(unknown).c_str() << nl << "    known are "
            << oneOf(known).c_str() << endl;
    }
    if (!staggered())
    {
        for (const word name : {"timeScheme", "diffusion"})
        {
            if (!controls.found(name)) continue;
            IOWarningInFunction(controls)
                << "entry " << name << " has no effect with flowAlgorithm "
                << "pimple: its schemes are those of system/fvSchemes" << endl;
        }
        if (!controls.getOrDefault<bool>("convection", true))
        {
            refuse(controls, "convection", "off",
                   "on with flowAlgorithm pimple, which always has that term");
        }
        return;
    }

    string unused;
    const auto add = [&](const string& what)
    { unused += (unused.empty() ? "" : ", ") + what; };
    for (const entry& e : schemes.subOrEmptyDict("ddtSchemes"))
    {
        if (!e.isStream()) continue;
        const string scheme(e.stream().toString());
        if (scheme != "Euler" && scheme != "none")
        {
            add("ddtSchemes " + e.keyword() + ' ' + scheme);
        }
    }
    const label outer = controls.getOrDefault<label>("nOuterCorrectors", 1);
    if (outer > 1) add("nOuterCorrectors " + Foam::name(outer));
    if (controls.found("momentumPredictor")) add("momentumPredictor");
    if (unused.empty()) return;
    Info << "Flow algorithm staggered does not use " << unused.c_str()
         << ": its time scheme is timeScheme "
         << controls.getOrDefault<word>("timeScheme", "auto")
         << " in PIMPLE, in one pass a step" << nl << endl;
}
