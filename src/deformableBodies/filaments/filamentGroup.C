// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filamentGroup.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "filamentReport.H"
#include "judgedRatio.H"
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
      report_(new filamentReport(*this))
{
    const groupEntries entries(this->name(), dict, scene_);
    checkEntries(dict, {"type", "length", "diameter", "segments",
                        "bendingRigidity", "densityRatio", "ends", "positions",
                        "directions", "placement", "gravity", "coupling",
                        "shearPlane", "scheme", "thicknessCouple", "baseMotion",
                        "bow", "restart", "outside"});

    properties_.length = readPositive(dict, "length", dimLength);
    const scalar diameter = readPositive(dict, "diameter", dimLength);

    // The fluid tells nothing apart within a cell
    h_ = std::cbrt(scene.grid.cellVolume());
    properties_.segments = entries.byAccuracy<label>(
        "segments", {16, 32, 64},
        [](const scalar wanted)
        { return label(std::ceil(std::sqrt(20 / wanted))); });
    if (twoWay() && !dict.found("segments"))
    {
        properties_.segments =
            max(label(3), min(properties_.segments,
                              // Eight cells are eight in all systems of units
                              label(properties_.length / h_ * (1 + 1e-9))));
    }
    if (properties_.segments < 3 || properties_.segments > 10000)
    {
        refuse(dict, "segments", Foam::name(properties_.segments),
               "3 to 10000");
    }
    properties_.rigidity =
        readNumber(dict, "bendingRigidity", dimForce * dimArea);
    if (!(properties_.rigidity >= 0))
    {
        refuse(dict, "bendingRigidity", Foam::name(properties_.rigidity),
               "0 and greater");
    }

    const wordList ends(dict.getOrDefault<wordList>("ends", {"free", "free"}));
    if (ends.size() != 2)
    {
        refuse(dict, "ends", Foam::name(ends.size()) + " words",
               "two of free hinged clamped");
    }
    forAll(ends, e)
    {
        if (!endNames.found(ends[e]))
        {
            refuse(dict, "ends", ends[e], "two of free hinged clamped");
        }
        properties_.ends[e] = endNames[ends[e]];
    }

    shearPlane_ = entries.shearPlane();

    // Mass and weight. In two-way coupling the fluid in its place is solved
    crossSection_ = 0.25 * constant::mathematical::pi * sqr(diameter);
    const scalar ratio = dict.found("densityRatio")
                             ? readPositive(dict, "densityRatio", dimless)
                             : 1;
    if (twoWay() && ratio < 1)
    {
        refuse(dict, "densityRatio", Foam::name(ratio),
               "1 and greater in two-way coupling");
    }
    properties_.mass = (ratio - (twoWay() ? 1 : 0)) * crossSection_ * scene.rho;
    entries.addWeight(entries.gravity(), ratio - (alone() ? 0 : 1));
    properties_.scheme =
        readEnum(schemeNames, dict, "scheme", filament::IMPLICIT);
    if (!alone() && properties_.scheme != filament::IMPLICIT)
    {
        refuse(dict, "scheme", schemeNames[properties_.scheme],
               "implicit, or coupling none");
    }
    thickness_ =
        twoWay() ? 2 * markerLine::radius(scene.kernel) * h_ : diameter;
    readCouplingEntries(dict);

    readStart(dict);
    judgeSize(dict);

    const scalar fraction = nBodies() * properties_.length * 0.25 *
                            constant::mathematical::pi * sqr(thickness_) /
                            cmptProduct(scene.grid.length());
    scene_.effects.declare("filament", true,
                           Foam::name(nBodies()) + " filaments of " +
                               Foam::name(properties_.segments) +
                               " segments, " + ends[0] + " " + ends[1] +
                               ", volume fraction " + Foam::name(fraction));
}

Foam::filamentGroup::~filamentGroup() {}

const Foam::bodyReport& Foam::filamentGroup::report() const
{
    return *report_;
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
    if (!dict.found("placement")) dict.get<vectorField>("directions");
    const scalar L0 = properties_.length;
    start_ =
        groupEntries(name(), dict, scene_)
            .start({(0.5 * thickness_ + mag(bow_)) * vector::one, 0.5 * L0},
                   L0 * 0.25 * constant::mathematical::pi * sqr(thickness_),
                   -0.5 * L0, vector(1, 0, 0), twoWay());
    const vector L(scene_.grid.length());
    for (direction d = 0; d < 3; ++d)
    {
        if (scene_.grid.periodic(d) && properties_.length > 0.5 * L[d])
        {
            IOWarningInFunction(dict)
                << "filaments of length " << properties_.length
                << " in a periodic box of " << L[d] << " in direction "
                << vector::componentNames[d]
                << ": they meet their own images; keep below half the box"
                << endl;
        }
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

void Foam::filamentGroup::judgeSize(const dictionary& dict) const
{
    const scalar diameter =
        std::sqrt(4 / constant::mathematical::pi * crossSection_);
    List<judgedRatio> ratios({
        {"diameter", "diameter/length", diameter / properties_.length, 0, 0.5,
         0, 0.5, "the theory is that of slender bodies"},
    });
    if (twoWay())
    {
        ratios.append(
            {"diameter",
             "diameter/(diameter that the fluid feels, " +
                 Foam::name(thickness_ / h_) + " h)",
             diameter / thickness_, 0, 3, 0.5, 1.5,
             diameter > thickness_
                 ? "the drag is that of a thinner fibre: use larger cells"
                 : "the drag is that of a thicker fibre, only mass and weight "
                   "are those of the diameter: use cells of " +
                       Foam::name(diameter * h_ / thickness_) +
                       ", or coupling oneWay, where drag is that of the "
                       "diameter"});
    }
    judge(dict, ratios);
}

void Foam::filamentGroup::insertBody(const label i, const label number)
{
    body x(filament(properties_, firstShape(number)));
    x.line.clamp(0, start_.directions[number]);
    x.line.clamp(1, start_.directions[number]);
    x.U.setSize(points_.size(), Zero);
    x.X.setSize(markersEach());
    x.forces.setSize(twoWay() ? markersEach() : 0, Zero);
    x.start = x.line.places()[movedEnd() * properties_.segments];
    bodies_.insert(bodies_.begin() + i, x);
}

void Foam::filamentGroup::eraseBody(const label i)
{
    bodies_.erase(bodies_.begin() + i);
}

Foam::point Foam::filamentGroup::initialCentre(const label number) const
{
    return average(firstShape(number));
}

Foam::bodyPoints Foam::filamentGroup::initialPoints(const label number) const
{
    const vectorField X(firstShape(number));
    return pointsOf(number, X, vectorField(X.size(), Zero));
}

Foam::boundBox Foam::filamentGroup::bounds(const label i,
                                           const bool smallest) const
{
    const filament& line = bodies_[i].line;
    return smallest ? boundBox(line.places(), false) : line.roughBounds();
}

Foam::boundBox Foam::filamentGroup::forcedBounds(const label i) const
{
    vectorField X(points_.size());
    forAll(X, k)
    {
        X[k] = points_[k](bodies_[i].line.places());
    }
    return boundBox(X, false);
}

Foam::point Foam::filamentGroup::centre(const label i) const
{
    return average(bodies_[i].line.places());
}

// What joins them to the fluid: drag, markers, thickness
void Foam::filamentGroup::readCouplingEntries(const dictionary& dict)
{
    properties_.dragRatio = 1;
    if (dict.found("baseMotion"))
    {
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
    if (alone()) return;

    // Of cells that are not cubes the diameter depends on the direction
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
    const scalar slender = std::log(2 * L / thickness_);
    if (twoWay() ? L < 3 * h_ * (1 - 1e-9) : slender < 1.807)
    {
        refuse(dict, twoWay() ? "length" : "diameter",
               Foam::name(twoWay() ? L : thickness_),
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
        // Nothing but drag holds its nodes: one point for each
        makePoints(properties_.segments + 1,
                   min(inset, 0.5 * properties_.ds()));
    }
    else if (twoWay())
    {
        // Closer than a cell the fluid cannot tell points from each other
        makePoints(label((L - 2 * inset) / h_ + 0.5) + 1, inset);
    }
    else
    {
        drag_ = 4 * pi * scene_.mu / (slender + 0.193);
        properties_.dragRatio = 2 * pi * scene_.mu / (slender - 0.807) / drag_;
        makePoints(properties_.segments, 0.5 * properties_.ds());
    }

    const bool on =
        dict.getOrDefault<bool>("thicknessCouple", L < 50 * thickness_);
    if (on)
    {
        const scalar r = L / thickness_, re = 1.24 * r / std::sqrt(std::log(r));
        const label N = properties_.segments;
        const scalar ds = properties_.ds();
        if (twoWay() && ds > 9 * h_)
        {
            refuse(dict, "segments", Foam::name(N),
                   Foam::name(label(L / (9 * h_)) + 1) +
                       " and more with thicknessCouple, whose points are to be "
                       "no more than nine cells apart");
        }
        couple_.reset(twoWay()
                          ? new thicknessCouple(N, ds, inset, scene_.kernel,
                                                scene_.mu, h_)
                          : new thicknessCouple(N, ds, inset,
                                                drag_ * sqr(L / re) / 12, h_));
    }
    scene_.effects.declare("thicknessCouple", on,
                           Foam::name(L / thickness_) + " diameters of " +
                               (twoWay()
                                    ? Foam::name(thickness_ / h_) + " cells"
                                    : Foam::name(thickness_) + " m") +
                               " long");
}

// Segments of equal length along the curve
Foam::vectorField Foam::filamentGroup::firstShape(const label number) const
{
    const vector t0(start_.directions[number] / mag(start_.directions[number]));
    const label N = properties_.segments;
    vectorField X(N + 1, start_.positions[number]);
    for (label i = 1; i <= N; ++i)
    {
        const scalar s = constant::mathematical::pi * (i - 0.5) / N;
        vector t(t0 + constant::mathematical::pi / properties_.length *
                          std::cos(s) * bow_);
        t /= mag(t);
        X[i] = X[i - 1] + properties_.ds() * t;
    }
    return X;
}

void Foam::filamentGroup::checkStart(const label i,
                                     const dictionary& dict) const
{
    const label number = mine()[i];
    groupEntries::checkWalls(dict, scene_.grid, number, bounds(i, true));
}
