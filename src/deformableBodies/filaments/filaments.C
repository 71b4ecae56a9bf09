// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filaments.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "Enum.H"
#include "mathematicalConstants.H"
#include <cmath>

namespace Foam
{
defineTypeNameAndDebug(filaments, 0);
addToRunTimeSelectionTable(bodyGroup, filaments, dictionary);

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

Foam::filaments::filaments(const word& name, const dictionary& dict,
                           const bodyScene& scene)
    : bodyGroup(name, dict, scene)
{
    checkEntries(dict, {"type", "length", "diameter", "segments",
                        "bendingRigidity", "densityRatio", "ends", "positions",
                        "directions", "gravity", "coupling", "shearPlane",
                        "scheme", "thicknessCouple", "baseMotion", "bow"});

    properties_.length = readPositive(dict, "length", dimLength);
    const scalar diameter = readPositive(dict, "diameter", dimLength);

    // The fluid tells nothing apart within a cell
    h_ = std::cbrt(scene.grid.cellVolume());
    properties_.segments = byAccuracy<label>(dict, "segments", 16, 32, 64);
    if (twoWay() && !dict.found("segments"))
    {
        properties_.segments =
            max(label(3),
                min(properties_.segments, label(properties_.length / h_)));
    }
    if (properties_.segments < 3 || properties_.segments > 10000)
    {
        refuse(dict, "segments", Foam::name(properties_.segments),
               "3 to 10000");
    }
    properties_.rigidity =
        dimensionedScalar("bendingRigidity", dimForce * dimArea, dict).value();
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

    shearPlane_ = readShearPlane(dict);

    // Mass and weight. In two-way coupling the fluid in its place is solved
    displaced_ = 0.25 * constant::mathematical::pi * sqr(diameter) * scene.rho;
    const scalar ratio = dict.found("densityRatio")
                             ? readPositive(dict, "densityRatio", dimless)
                             : 1;
    if (twoWay() && ratio < 1)
    {
        refuse(dict, "densityRatio", Foam::name(ratio),
               "1 and greater in two-way coupling");
    }
    properties_.mass = (ratio - (twoWay() ? 1 : 0)) * displaced_;
    if (readGravity(dict))
    {
        weight_ = (ratio - (alone() ? 0 : 1)) * displaced_ * scene.g;
    }
    const word scheme(dict.getOrDefault<word>("scheme", "implicit"));
    if (!schemeNames.found(scheme))
    {
        refuse(dict, "scheme", scheme, "(implicit twoStep twoStepCentred)");
    }
    properties_.scheme = schemeNames[scheme];
    if (!alone() && scheme != "implicit")
    {
        refuse(dict, "scheme", scheme, "implicit, or coupling none");
    }
    thickness_ = twoWay() ? 2 * scene.kernel.lineRadius() * h_ : diameter;
    readCouplingEntries(dict);

    const pointField positions(readPositions(dict));
    const vectorField directions(dict.lookup("directions"));
    if (directions.size() != positions.size())
    {
        refuse(dict, "directions", Foam::name(directions.size()) + " vectors",
               "as many as positions, " + Foam::name(positions.size()));
    }

    const vector bow(dict.getOrDefault<vector>("bow", Zero));
    if (mag(bow) > 0.3 * properties_.length)
    {
        refuse(dict, "bow", Foam::name(mag(bow)) + " m",
               "up to 0.3 of the length");
    }
    filaments_.reserve(mine().size());
    forAll(positions, body)
    {
        if (!(mag(directions[body]) > 0))
        {
            refuse(dict, "directions", "(0 0 0)", "directions");
        }
        // Held and straight, any tension would do
        if (properties_.ends[0] != filament::FREE &&
            properties_.ends[1] != filament::FREE &&
            !(mag(bow ^ directions[body]) >
              1e-6 * properties_.length * mag(directions[body])))
        {
            OStringStream given;
            given << bow;
            refuse(dict, "bow", given.str(),
                   "a bow across the direction where both ends are held, as a "
                   "straight filament could not move");
        }

        filament x(properties_,
                   firstShape(positions[body], directions[body], bow));
        x.clamp(0, directions[body]);
        x.clamp(1, directions[body]);
        checkFits(dict, x, body);
        if (body % Pstream::nProcs() != Pstream::myProcNo()) continue;
        filaments_.push_back({x, vectorField(points_.size(), Zero), x.places(),
                              vectorField(markersEach()),
                              vectorField(twoWay() ? markersEach() : 0, Zero),
                              x.places()[movedEnd() * properties_.segments], 0,
                              1});
    }

    const scalar fraction = nBodies() * properties_.length * 0.25 *
                            constant::mathematical::pi * sqr(thickness_) /
                            cmptProduct(scene.grid.length());
    scene_.effects.declare("filament", true,
                           Foam::name(nBodies()) + " filaments of " +
                               Foam::name(properties_.segments) +
                               " segments, " + ends[0] + " " + ends[1] +
                               ", volume fraction " + Foam::name(fraction));
    scene_.effects.declare("gravity", weight_ != vector::zero,
                           weight_ != vector::zero ? "weight of the filaments"
                                                   : "none on the bodies");
}

// What joins them to the fluid: drag, markers, thickness
void Foam::filaments::readCouplingEntries(const dictionary& dict)
{
    properties_.dragRatio = 1;
    if (dict.found("baseMotion"))
    {
        const dictionary& motion = dict.subDict("baseMotion");
        checkEntries(motion, {"displacement"});
        if (properties_.ends[movedEnd()] == filament::FREE)
        {
            refuse(dict, "ends", "(free free)",
                   "one end hinged or clamped beside baseMotion");
        }
        base_ = Function1<vector>::New("displacement", motion);
    }
    if (alone()) return;

    const scalar pi = constant::mathematical::pi, L = properties_.length;
    const scalar slender = std::log(2 * L / thickness_);
    if (twoWay() ? L < 3 * h_ : slender < 1.807)
    {
        refuse(dict, twoWay() ? "length" : "diameter",
               Foam::name(twoWay() ? L : thickness_),
               twoWay() ? "3 cells and more, as it is 1.5 to 2 cells thick"
                        : "less than " + Foam::name(2 * L / std::exp(1.807)) +
                              " at this length, for the drag of a slender "
                              "body");
    }
    const scalar inset = twoWay() ? scene_.kernel.endInset() * h_ : 0;
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
        couple_.reset(new thicknessCouple(
            properties_.segments, properties_.ds(),
            twoWay() ? thicknessCouple::resolved(scene_.kernel, scene_.mu, h_)
                     : drag_ * sqr(L / re) / 12,
            inset, 1.5 * h_));
    }
    scene_.effects.declare("thicknessCouple", on,
                           Foam::name(L / thickness_) + " diameters of " +
                               (twoWay()
                                    ? Foam::name(thickness_ / h_) + " cells"
                                    : Foam::name(thickness_) + " m") +
                               " long");
}

// Segments of equal length along the curve
Foam::vectorField Foam::filaments::firstShape(const point& first,
                                              const vector& direction,
                                              const vector& bow) const
{
    const label N = properties_.segments;
    vectorField X(N + 1, first);
    for (label i = 1; i <= N; ++i)
    {
        const scalar s = constant::mathematical::pi * (i - 0.5) / N;
        vector t(direction / mag(direction) + constant::mathematical::pi /
                                                  properties_.length *
                                                  std::cos(s) * bow);
        t /= mag(t);
        X[i] = X[i - 1] + properties_.ds() * t;
    }
    return X;
}

void Foam::filaments::checkFits(const dictionary& dict, const filament& x,
                                const label body) const
{
    checkWalls(dict, body, boundBox(x.places(), false));
    const vector L(scene_.grid.length());
    for (direction d = 0; d < 3; ++d)
    {
        if (body == 0 && scene_.grid.periodic(d) &&
            properties_.length > 0.5 * L[d])
        {
            IOWarningInFunction(dict)
                << "filaments of length " << properties_.length
                << " in a periodic box of " << L[d] << " in direction "
                << vector::componentNames[d]
                << ": they meet their own images; keep below half the box"
                << endl;
        }
    }
}
