// This file is part of deformableBodies. License: GPL-3.0-or-later.
/*
Description
    A solver with libs (deformableBodies); moves bodies only if it applies
    fvOptions and these name the bodies. Otherwise nobody would look at
    constant/deformableBodies. So when the library is loaded into a solver, it looks
    whether that is so. Utilities load the library as well: a solver is the case's
    application, or what has a name as solvers of OpenFOAM have, with Foam at its
    end; not the converters, ...ToFoam, nor potentialFoam, which makes a start.
*/

#include "error.H"
#include "OSspecific.H"
#include <cstdio>
#include <fstream>
#include <sstream>
#ifdef __linux__
#include <link.h>
#include <unistd.h>
#endif

namespace
{
using namespace Foam;

std::string textOf(const fileName& file)
{
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

//- Entry application of controlDict
word applicationOf(const fileName& caseDir)
{
    std::istringstream text(textOf(caseDir / "system" / "controlDict"));
    char name[256];
    for (std::string line; std::getline(text, line);)
    {
        if (std::sscanf(line.c_str(), " application %255[^; \t]", name) == 1)
        {
            return word(name, false);
        }
    }
    return word::null;
}

//- Name of the program that runs. OpenFOAM keeps a FOAM_EXECUTABLE that it finds,
//  such as that of a program which started this one
word nameOfProgram()
{
#ifdef __linux__
    char path[4096];
    const ssize_t n = ::readlink("/proc/self/exe", path, sizeof(path));
    if (n > 0)
    {
        return word(fileName(std::string(path, size_t(n))).name(), false);
    }
#endif
    return word(getEnv("FOAM_EXECUTABLE"), false);
}

bool isSolver(const word& program, const fileName& caseDir)
{
    const auto endsWith = [&](const std::string& end)
    {
        return program.size() >= end.size() &&
               program.compare(program.size() - end.size(), end.size(), end) ==
                   0;
    };
    return applicationOf(caseDir) == program ||
           (endsWith("Foam") && !endsWith("ToFoam") &&
            !endsWith("otentialFoam"));
}

//- Has the program linked fvOptions, rather than this library? Objects are listed
//  in the order in which they were loaded
bool programAppliesOptions()
{
#ifdef __linux__
    const auto look = [](dl_phdr_info* info, size_t, void* answer)
    {
        const std::string name(info->dlpi_name);
        const bool found = name.find("libfvOptions.") != std::string::npos;
        *static_cast<bool*>(answer) = found;
        return int(found ||
                   name.find("libdeformableBodies.") != std::string::npos);
    };
    bool answer = false;
    dl_iterate_phdr(look, &answer);
    return answer;
#else
    return true;
#endif
}

//- Could an option of a file be of type deformableBodies?
bool optionsNameBodies(const fileName& file)
{
    const std::string text(textOf(file));
    const auto has = [&](const char* s)
    { return text.find(s) != std::string::npos; };
    return has("FoamFile") && (has("deformableBodies") || has("#"));
}

struct solverOfCase
{
    solverOfCase()
    {
        const fileName dir(getEnv("FOAM_CASE"));
        const word program(nameOfProgram());
        if (dir.empty() || !isFile(dir / "constant" / "deformableBodies") ||
            program == "deformableBodyFoam" || !isSolver(program, dir))
        {
            return;
        }
        string why;
        if (!programAppliesOptions())
        {
            why = program + " does not apply fvOptions";
        }
        else if (!optionsNameBodies(dir / "constant" / "fvOptions") &&
                 !optionsNameBodies(dir / "system" / "fvOptions"))
        {
            why = "there is no option of type deformableBodies in a file "
                  "constant/fvOptions or system/fvOptions with a FoamFile "
                  "header";
        }
        if (why.empty()) return;
        FatalErrorInFunction
            << why.c_str()
            << ": the bodies of constant/deformableBodies would not be looked "
            << "at" << nl
            << "    allowed: deformableBodyFoam, or bodies { type "
            << "deformableBodies; } in constant/fvOptions and a solver of "
            << "incompressible flow that applies it, as pimpleFoam and "
               "pisoFoam "
            << "do" << exit(FatalError);
    }
};

const solverOfCase checkSolver;
} // namespace
