// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "flowAlgorithm.H"
#include "dictionaryChecks.H"
#include "flowSources.H"
#include "staggeredFlow.H"

Foam::flowAlgorithm::flowAlgorithm(const dictionary& controls,
                                   const string& obstacle)
{
    enum algorithmType
    {
        AUTO,
        STAGGERED,
        PIMPLE
    };
    const Enum<algorithmType> words(
        {{AUTO, "auto"}, {STAGGERED, "staggered"}, {PIMPLE, "pimple"}});
    const algorithmType asked =
        readEnum(words, controls, "flowAlgorithm", AUTO);

    reason_ = asked == PIMPLE ? string("flowAlgorithm pimple") : obstacle;
    if (asked == STAGGERED && !obstacle.empty())
    {
        refuse(controls, "flowAlgorithm", "staggered",
               "pimple or auto here, as " + obstacle);
    }
}

Foam::flowAlgorithm::flowAlgorithm(const dictionary& controls,
                                   const volVectorField& U,
                                   const volScalarField& p,
                                   const fv::optionList& sources,
                                   const word& transport,
                                   const word& turbulence)
    : flowAlgorithm(controls,
                    controls.getOrDefault<word>("flowAlgorithm", "auto") ==
                            "pimple"
                        ? string()
                        : obstacle(U, p, sources, transport, turbulence))
{
}

Foam::string Foam::flowAlgorithm::obstacle(const volVectorField& U,
                                           const volScalarField& p,
                                           const fv::optionList& sources,
                                           const word& transport,
                                           const word& turbulence)
{
    const string flow(staggeredFlow::unsupported(U, p));
    if (!flow.empty()) return flow;
    if (turbulence != "Stokes" ||
        (transport != "Newtonian" && transport != "prescribed"))
    {
        return "it knows laminar flow of a fluid of given viscosity only "
               "(transportModel Newtonian or prescribed)";
    }
    return flowSources::unsupported(sources, U);
}
