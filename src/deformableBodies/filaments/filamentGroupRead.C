// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filamentGroup.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "filamentReport.H"
#include "markerLine.H"
#include "mathematicalConstants.H"
#include <cmath>

namespace Foam
{
defineTypeNameAndDebug(filamentGroup, 0);
addToRunTimeSelectionTable(bodyGroup, filamentGroup, dictionary);

static const Enum<filament::endType> endNames{
    {filament::FREE, "free"},
    {filament::HINGED, "hinged"},
    {filament::CLAMPED, "clamped"},
};

static const Enum<filament::schemeType> schemeNames{
    {filament::IMPLICIT, "implicit"},
    {filament::TWO_STEP, "twoStep"},
    {filament::TWO_STEP_CENTRED, "twoStepCentred"},
};
} // namespace Foam

Foam::filamentGroup::filamentGroup(const word& name, const dictionary& dict,
                                   const bodyScene& scene)
    : directForcing(name, dict, scene),
      h_(std::cbrt(scene.grid.cellVolume())),
      report_(new filamentReport(*this))
{
    checkEntries(dict, {"type", "length", "diameter", "segments",
                        "bendingRigidity", "densityRatio", "ends", "positions",
                        "directions", "placement", "gravity", "coupling",
                        "shearPlane", "scheme", "thicknessCouple", "baseMotion",
                        "bow", "restart", "outside"});
    properties_.length = readPositive(dict, "length", dimLength);
    const scalar diameter = readPositive(dict, "diameter", dimLength);
    crossSection_ = 0.25 * constant::mathematical::pi * sqr(diameter);
    effectiveDiameter_ =
        twoWay() ? 2 * markerLine::radius(scene.kernel) * h_ : diameter;
    readSegments(dict);
    forcing_ = twoWay() ? forcingType::ofLines : forcingType::none;
    madeWith_ = {{"length", properties_.length},
                 {"segments", scalar(properties_.segments)}};
    properties_.rigidity =
        readNumber(dict, "bendingRigidity", dimForce * dimArea);
    if (!(properties_.rigidity >= 0))
    {
        refuse(dict, "bendingRigidity", Foam::name(properties_.rigidity),
               "0 and greater");
    }
    readEnds(dict);
    shearPlane_ = groupEntries(this->name(), dict, scene_).shearPlane();
    readMass(dict);
    readCoupling(dict);
    readStart(dict);
    checkSize(dict);

    const scalar fraction =
        nBodies() * properties_.length * 0.25 * constant::mathematical::pi *
        sqr(effectiveDiameter_) / cmptProduct(scene.grid.length());
    scene_.effects.declare("filament", true,
                           Foam::name(nBodies()) + " filaments of " +
                               Foam::name(properties_.segments) +
                               " segments, " + endNames[properties_.ends[0]] +
                               " " + endNames[properties_.ends[1]] +
                               ", volume fraction " + Foam::name(fraction));
}

// In two-way coupling segments are at least a cell long, the resolution of the fluid
void Foam::filamentGroup::readSegments(const dictionary& dict)
{
    label& n = properties_.segments;
    n = groupEntries(name(), dict, scene_)
            .byAccuracy<label>(
                "segments", {16, 32, 64},
                [](const scalar wanted)
                { return label(std::ceil(std::sqrt(20 / wanted))); });
    if (twoWay() && !dict.found("segments"))
    {
        // With a margin for the round-off of L/h
        n = max(label(3), min(n, label(properties_.length / h_ * (1 + 1e-9))));
    }
    if (n < 3 || n > 10000)
    {
        refuse(dict, "segments", Foam::name(n), "3 to 10000");
    }
}

void Foam::filamentGroup::readEnds(const dictionary& dict)
{
    const wordList ends(dict.getOrDefault<wordList>("ends", {"free", "free"}));
    if (ends.size() != 2)
    {
        refuse(dict, "ends", valueOf(*dict.findEntry("ends")),
               "two of free hinged clamped");
    }
    forAll(ends, e)
    {
        if (!endNames.found(ends[e]))
        {
            refuse(dict, "ends", ends[e], "two of free hinged clamped");
        }
        properties_.ends[e] = endNames[ends[e]];
        held_ = held_ || properties_.ends[e] != filament::FREE;
    }
    if (!dict.found("baseMotion")) return;
    const dictionary& motion = readDict(
        dict, "baseMotion", "displacement sine; displacementCoeffs {...}");
    checkEntries(motion,
                 withCoeffs(motion, {"displacement"}, {"displacement"}));
    if (properties_.ends[movedEnd()] == filament::FREE)
    {
        refuse(dict, "ends", "(free free)",
               "one end hinged or clamped beside baseMotion");
    }
    base_ = Function1<vector>::New("displacement", motion);
}

// In two-way coupling the fluid in its place is solved
void Foam::filamentGroup::readMass(const dictionary& dict)
{
    const groupEntries entries(name(), dict, scene_);
    const scalar ratio = dict.found("densityRatio")
                             ? readPositive(dict, "densityRatio", dimless)
                             : 1;
    if (twoWay() && ratio < 1)
    {
        refuse(dict, "densityRatio", Foam::name(ratio),
               "1 and greater in two-way coupling");
    }
    properties_.mass =
        (ratio - (twoWay() ? 1 : 0)) * crossSection_ * scene_.rho;
    isPendulum_ = withoutFluid() && entries.gravity();
    entries.addWeight(entries.gravity(), ratio - (withoutFluid() ? 0 : 1));
    properties_.scheme =
        readEnum(schemeNames, dict, "scheme", filament::IMPLICIT);
    if (!withoutFluid() && properties_.scheme != filament::IMPLICIT)
    {
        refuse(dict, "scheme", schemeNames[properties_.scheme],
               "implicit, or coupling none");
    }
}

// Positions, directions and shape at the start
void Foam::filamentGroup::readStart(const dictionary& dict)
{
    bow_ = dict.getOrDefault<vector>("bow", Zero);
    if (mag(bow_) > 0.3 * properties_.length)
    {
        refuse(dict, "bow", Foam::name(mag(bow_)) + " m",
               "up to 0.3 of the length");
    }
    if (!dict.found("placement")) requireEntry(dict, "directions");
    const scalar L0 = properties_.length;
    start_ = groupEntries(name(), dict, scene_)
                 .start({(0.5 * effectiveDiameter_ + mag(bow_)) * vector::one,
                         0.5 * L0},
                        L0 * 0.25 * constant::mathematical::pi *
                            sqr(effectiveDiameter_),
                        -0.5 * L0, vector(1, 0, 0), twoWay());
    scalar shortest = GREAT;
    for (direction d = 0; d < 3; ++d)
        if (scene_.grid.periodic(d))
            shortest = min(shortest, scene_.grid.length()[d]);
    if (properties_.length > 0.5 * shortest)
    {
        IOWarningInFunction(dict)
            << "filaments of length " << properties_.length
            << " in a periodic box of " << shortest
            << ": they meet their own images; keep below half the box" << endl;
    }
    const bool heldAtBoth = properties_.ends[0] != filament::FREE &&
                            properties_.ends[1] != filament::FREE;
    for (const vector& t : start_.directions)
    {
        if (mag(bow_) > 0 && !(mag(bow_ ^ t) > 1e-6 * mag(bow_) * mag(t)))
        {
            OStringStream given;
            given << bow_;
            refuse(dict, "bow", given.str(),
                   "a bow across the direction of the filament");
        }

        // Held and straight, any tension would do
        if (heldAtBoth && !(mag(bow_ ^ t) > 1e-6 * properties_.length * mag(t)))
        {
            OStringStream given;
            given << bow_;
            refuse(dict, "bow", given.str(),
                   "a bow across the direction where both ends are held, as a "
                   "straight filament could not move");
        }
    }
}

// Drag, markers, couple of the thickness
void Foam::filamentGroup::readCoupling(const dictionary& dict)
{
    properties_.dragRatio = 1;
    if (withoutFluid()) return;

    // In cells that are not cubes the effective diameter depends on the direction
    const scalar stretch = cmptMax(scene_.grid.h()) / cmptMin(scene_.grid.h());
    if (twoWay() && stretch > 1.25 * (1 + 1e-6))
    {
        refuse(dict, "coupling",
               "twoWay on cells of sides 1 : " + Foam::name(stretch),
               "cells of sides up to 1 : 1.25, or oneWay (in two-way coupling "
               "the cells are the thickness of a filament; beyond, drag and "
               "rotation err by more than 5 and 8 %)");
    }

    const scalar pi = constant::mathematical::pi, L = properties_.length;
    const scalar slender = std::log(2 * L / effectiveDiameter_);
    if (twoWay() ? L < 3 * h_ * (1 - 1e-9) : slender < 1.807)
    {
        refuse(dict, twoWay() ? "length" : "diameter",
               Foam::name(twoWay() ? L : effectiveDiameter_),
               twoWay() ? "3 cells and more, " + Foam::name(3 * h_) +
                              " m here, as it is 1.5 to 2 cells thick"
                        : "less than " + Foam::name(2 * L / std::exp(1.807)) +
                              " at this length, for the drag of a slender "
                              "body");
    }
    const scalar inset =
        twoWay() ? markerLine::endInset(scene_.kernel) * h_ : 0;
    const bool limp = properties_.rigidity == 0 && properties_.mass == 0;
    if (twoWay() && limp)
    {
        // Nothing but drag holds its nodes: points at most 1.5 cells apart, one at each
        const label each = label(std::ceil(properties_.ds() / (1.5 * h_)));
        makePoints(each * properties_.segments + 1,
                   min(inset, 0.5 * properties_.ds()));
    }
    else if (twoWay())
    {
        // Closer than a cell the fluid cannot tell points from each other
        makePoints(label((L - 2 * inset) / h_ + 0.5) + 1, inset);
    }
    else
    {
        dragAcross_ = 4 * pi * scene_.mu / (slender + 0.193);
        properties_.dragRatio =
            2 * pi * scene_.mu / (slender - 0.807) / dragAcross_;
        makePoints(properties_.segments, 0.5 * properties_.ds());
    }

    makeCouple(dict, inset);
}

void Foam::filamentGroup::makeCouple(const dictionary& dict, const scalar inset)
{
    const scalar L = properties_.length;
    const bool on =
        dict.getOrDefault<bool>("thicknessCouple", L < 50 * effectiveDiameter_);
    if (on)
    {
        const scalar r = L / effectiveDiameter_,
                     re = 1.24 * r / std::sqrt(std::log(r));
        const label N = properties_.segments;
        const scalar ds = properties_.ds();
        if (twoWay() && ds > 9 * h_)
        {
            refuse(dict, "segments", Foam::name(N),
                   Foam::name(label(L / (9 * h_)) + 1) +
                       " and more with thicknessCouple, whose points are to be "
                       "no more than nine cells apart");
        }
        couple_.reset(
            twoWay() ? new thicknessCouple(N, ds, inset, scene_.kernel,
                                           scene_.mu, h_)
                     : new thicknessCouple(N, ds, inset,
                                           dragAcross_ * sqr(L / re) / 12, h_));
        couple_->setWalls(scene_.grid);
    }
    scene_.effects.declare(
        "thicknessCouple", on,
        Foam::name(L / effectiveDiameter_) + " diameters of " +
            (twoWay() ? Foam::name(effectiveDiameter_ / h_) + " cells"
                      : Foam::name(effectiveDiameter_) + " m") +
            " long");
}

void Foam::filamentGroup::makePoints(const label n, const scalar inset)
{
    points_.setSize(n);
    const scalar ds = properties_.ds();
    forAll(points_, k)
    {
        const scalar s =
            (inset + k * (properties_.length - 2 * inset) / (n - 1)) / ds;
        points_[k].segment = min(label(s), properties_.segments - 1);
        points_[k].at = s - points_[k].segment;
    }
}
