// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactLaw.H"
#include "dictionaryChecks.H"
#include "rangeCheck.H"
#include "mathematicalConstants.H"

Foam::contactLaw::contactLaw(
    const dictionary& dict, const uniformGrid& grid, const scalar range,
    const std::function<contactStrength(scalar)>& strength,
    const dimensionSet& dimensions, const scalar deltaT, const scalar borne)
    : law_(readEnum(
          Enum<lawType>({{MORSE, "Morse"}, {EXPONENTIAL, "exponential"}}), dict,
          "law", MORSE)),
      range_(dict.found("range") ? readPositive(dict, "range", dimLength)
                                 : range),
      strength_(0),
      given_(dict.found("strength")),
      rangeGiven_(dict.found("range"))
{
    checkEntries(dict, {"law", "range", "strength"});
    const scalar h = cmptMax(grid.h()), most = 0.5 * cmptMin(grid.length());
    if (range_ < 0.5 * h * (1 - 1e-6) || range_ > most * (1 + 1e-6))
    {
        refuse(dict, "range", Foam::name(range_),
               Foam::name(0.5 * h) + " (half a cell) to " + Foam::name(most) +
                   " (half the box)");
    }
    const contactStrength otherwise(strength(range_));
    strength_ = otherwise.value;
    reason_ = otherwise.reason;
    most_ = otherwise.most;
    maxDeltaT_ = otherwise.deltaT;
    const scalar bears = maxDeltaT_(GREAT);
    if (deltaT > 1.05 * bears)
    {
        IOWarningInFunction(dict)
            << "contacts of this scene (" << reason_.c_str()
            << ") are too stiff for deltaT " << deltaT << nl
            << "    Bodies in contact may swing or pass each other: reduce "
               "deltaT to "
            << bears << ", or take a larger range than " << range_ << endl;
    }
    if (!given_)
    {
        setClosest();
        return;
    }

    // In contact a Morse law has 25 S
    strength_ = readPositive(dict, "strength", dimensions);
    most_ = max(most_, 25 * strength_);
    reason_ = "given";
    setClosest();
    checkRanges(dict,
                {{"strength", "strength/" + Foam::name(borne),
                  strength_ / borne, 0, GREAT, 0, 10,
                  "a contact stiffer than deltaT bears throws bodies apart"}});
}

void Foam::contactLaw::at(const scalar d, scalar& P, scalar& slope) const
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

void Foam::contactLaw::setClosest()
{
    const scalar x = most_ / strength_;
    const scalar e =
        0.5 + std::sqrt(0.25 + x * (std::exp(3.0) - std::exp(1.5)));
    closest_ = law_ == EXPONENTIAL
                   ? range_ * (0.5 - std::log(x + std::exp(-1.5)) / 3)
                   : range_ * (1 - std::log(e) / 3);
}

bool Foam::contactLaw::raiseDefaults(const scalarList& defaults)
{
    if (given_ || defaults.size() != 3) return false;
    if (mag(defaults[2] - range_) > 1e-9 * range_)
    {
        if (!rangeGiven_ && Pstream::master())
        {
            WarningInFunction
                << "the range of contacts by default is " << range_
                << ", and was " << defaults[2] << " at the start of the run"
                << nl << "    Write range " << defaults[2]
                << "; in the model of interactions to go on with that" << endl;
        }
        return false;
    }
    const bool differ = defaults[0] > strength_ * (1 + 1e-9);
    strength_ = max(strength_, defaults[0]);
    most_ = max(most_, defaults[1]);
    setClosest();
    return differ;
}

Foam::scalar Foam::contactLaw::at(const scalar d) const
{
    if (d >= range_) return 0;
    scalar P, slope;
    at(max(d, max(closest(), scalar(0))), P, slope);
    return P;
}

Foam::scalar Foam::contactLaw::between(const scalar r, const scalar d) const
{
    if (d >= range_) return 0;
    scalar P, slope;
    at(max(d, closest()), P, slope);
    return (P / sqr(r) + slope / r) / (2 * constant::mathematical::pi);
}

Foam::string Foam::contactLaw::describe(const word& unit,
                                        const uniformGrid& grid) const
{
    return string(law_ == MORSE ? "Morse" : "exponential") + ", range " +
           Foam::name(range_) + " = " + Foam::name(range_ / cmptMax(grid.h())) +
           " h, strength " + Foam::name(strength_) + " " + unit + " (" +
           reason_ + ")";
}
