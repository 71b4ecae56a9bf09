// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "repulsion.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"

namespace Foam
{
defineTypeNameAndDebug(repulsion, 0);
addToRunTimeSelectionTable(interactionModel, repulsion, dictionary);
} // namespace Foam

Foam::repulsion::repulsion(const dictionary& dict,
                           const interactionScene& scene)
    : law_(readEnum(
          Enum<lawType>({{MORSE, "Morse"}, {EXPONENTIAL, "exponential"}}), dict,
          "law", MORSE)),
      thickest_(scene.thickest)
{
    checkEntries(dict, {"law", "range", "strength"});
    if (scene.softest == 0)
    {
        refuse(dict.parent(), "repulsion", "{...}",
               "scenes with capsules that act on the fluid");
    }
    const scalar h = cmptMax(scene.grid.h());
    range_ =
        dict.found("range") ? readPositive(dict, "range", dimLength) : 1.5 * h;
    const scalar most = 0.5 * cmptMin(scene.grid.length());
    if (range_ < 0.5 * h || range_ > most)
    {
        refuse(dict, "range", Foam::name(range_),
               Foam::name(0.5 * h) + " (half a cell) to " + Foam::name(most) +
                   " (half the box)");
    }
    strength_ = 5 * scene.softest;
    string reason("5 Gs/a");
    if (scene.deltaT > 0 && 0.25 * scene.mu / scene.deltaT < strength_)
    {
        strength_ = 0.25 * scene.mu / scene.deltaT;
        reason = "mu/(4 deltaT)";
    }
    if (dict.found("strength"))
    {
        strength_ = readPositive(dict, "strength", dimPressure);
        reason = "given";
    }
    description_ = string(law_ == MORSE ? "Morse" : "exponential") +
                   ", range " + Foam::name(range_) + " = " +
                   Foam::name(range_ / h) + " h, strength " +
                   Foam::name(strength_) + " Pa (" + reason + ")";

    table_.setSize(2000);
    forAll(table_, i)
    {
        const scalar r = range_ * std::sqrt(i / (table_.size() - 1.0));
        table_[i] = between(r) / max(r, 0.01 * range_);
    }
}

void Foam::repulsion::pressure(const scalar d, scalar& P, scalar& slope) const
{
    const scalar b = 3 / range_;
    if (law_ == MORSE)
    {
        const scalar e = std::exp(b * (range_ - d));
        const scalar factor = strength_ / (std::exp(3.0) - std::exp(1.5));
        P = factor * e * (e - 1);
        slope = factor * b * e * (2 * e - 1);
    }
    else
    {
        const scalar e = strength_ * std::exp(b * (0.5 * range_ - d));
        P = e - strength_ * std::exp(-1.5);
        slope = b * e;
    }
}

Foam::scalar Foam::repulsion::between(const scalar distance) const
{
    // Closer than this only the direction counts
    const scalar d = max(distance, 0.05 * range_);
    if (d >= range_) return 0;
    scalar P, slope;
    pressure(d, P, slope);
    return (P / sqr(d) + slope / d) / (2 * constant::mathematical::pi);
}

void Foam::repulsion::add(const closePairs& pairs,
                          const interactingPoints& points, vectorField& F) const
{
    const scalar perSquare = (table_.size() - 1) / sqr(range_);
    for (const closePairs::pair& p : pairs.pairs())
    {
        const scalar t = points.radii[p.first] + points.radii[p.second];
        scalar perDistance; // f/r
        if (t == 0)
        {
            const scalar at = perSquare * magSqr(p.r);
            const label i = label(at);
            if (i + 1 >= table_.size()) continue;
            perDistance = table_[i] + (at - i) * (table_[i + 1] - table_[i]);
        }
        else
        {
            // Not between two fibres
            if (points.radii[p.first] > 0 && points.radii[p.second] > 0)
            {
                continue;
            }
            const scalar apart = mag(p.r);
            perDistance = between(apart - t) / max(apart, SMALL * range_);
        }
        const vector force(perDistance * points.sizes[p.first] *
                           points.sizes[p.second] * p.r);
        F[p.first] += force;
        if (p.bothHeld) F[p.second] -= force;
    }
}

Foam::scalar Foam::repulsion::ofWall(const scalar distance) const
{
    if (distance >= range_) return 0;
    scalar P, slope;
    pressure(max(distance, scalar(0)), P, slope);
    return P;
}
