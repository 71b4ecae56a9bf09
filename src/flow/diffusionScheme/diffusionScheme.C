// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "diffusionScheme.H"
#include "dictionaryChecks.H"

Foam::diffusionScheme::diffusionScheme(const uniformGrid& grid,
                                       const dictionary& controls,
                                       const bool bodies,
                                       const bool wasExplicit)
    : grid_(grid),
      controls_(controls),
      asked_(readWord(controls, "diffusion", {"auto", "ADI", "FFT", "explicit"},
                      "auto"))
{
    state_.isExplicit = wasExplicit;
    const label nWalled =
        3 - grid.periodic(0) - grid.periodic(1) - grid.periodic(2);
    if (asked_ == "FFT" && nWalled > 1)
    {
        refuse(controls, "diffusion", "FFT",
               "auto, ADI or explicit where two directions have walls");
    }
    mayTransform_ =
        asked_ == "FFT" || (asked_ == "auto" && bodies && nWalled < 2);
    lags_ = asked_ == "auto" && bodies && nWalled > 1;
}

Foam::scalar
Foam::diffusionScheme::maxDeltaT(const scalar nu,
                                 const explicitScheme& scheme) const
{
    return asked_ == "explicit" && nu > 0
               ? scheme.explicitLimit() / grid_.diffusionNumber(nu, 1)
               : GREAT;
}

bool Foam::diffusionScheme::choose(const scalar nu, const scalar dt,
                                   const explicitScheme& scheme)
{
    const state before(state_);
    const scalar limit = scheme.explicitLimit();
    const scalar number = grid_.diffusionNumber(nu, dt);
    if (asked_ == "explicit" && number > (1 + 1e-6) * limit)
    {
        refuse(controls_, "diffusion",
               "explicit at nu dt/h^2 = " + Foam::name(number),
               "auto, ADI or FFT, or a smaller deltaT: explicit diffusion is "
               "unstable above " +
                   Foam::name(limit));
    }

    // A change discards the history of AB2: not back and forth where dt varies about
    // the limit
    const bool free = scheme.RK3() || before.isExplicit ||
                      !(before.chosen || scheme.hasHistory());
    const scalar below = (free ? 1 : 0.75) * limit;
    state_.isExplicit =
        asked_ == "explicit" || (asked_ == "auto" && number < below);
    state_.byTransforms = mayTransform_ && (asked_ == "FFT" || number > 1);
    state_.chosen = true;
    if (lags_ && number > 2)
    {
        WarningInFunction
            << "diffusion by ADI at nu dt/h^2 = " << Foam::name(number)
            << " lags behind the forces of bodies; fast transforms need two "
               "periodic directions"
            << nl << "    Reduce deltaT from " << Foam::name(dt) << " to "
            << Foam::name(2 * dt / number) << endl;
        lags_ = false;
    }
    auto& solver = implicit_[state_.byTransforms];
    if (!state_.isExplicit && !solver)
    {
        solver.reset(new implicitDiffusion(grid_, state_.byTransforms));
    }
    if (before.chosen && before.isExplicit == state_.isExplicit &&
        before.byTransforms == state_.byTransforms)
    {
        return false;
    }
    Info << "Diffusion: "
         << (state_.isExplicit     ? "explicit"
             : state_.byTransforms ? "implicit by fast transforms"
                                   : "implicit by ADI")
         << " at nu dt/h^2 = " << number << endl;
    return true;
}
