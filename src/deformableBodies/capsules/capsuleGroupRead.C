// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsuleGroup.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "gridValues.H"
#include "capsuleReport.H"
#include "initialShape.H"
#include "rangeCheck.H"
#include "turnTo.H"
#include <cmath>

namespace Foam
{
defineTypeNameAndDebug(capsuleGroup, 0);
addToRunTimeSelectionTable(bodyGroup, capsuleGroup, dictionary);
} // namespace Foam

namespace
{
// Limits up to which the near field was measured to be better than none
// (tests/validation/nearField)
const Foam::scalar maxInertia = 20, maxViscosityRatio = 2;

//- Largest distance of a surface from the origin [m]
Foam::scalar furthest(const Foam::sphericalHarmonics& grid,
                      const std::vector<double>& coeffs)
{
    using namespace Foam;
    const label n = grid.nPoints();
    std::vector<double> x(3 * n);
    grid.values(coeffs.data(), x.data());
    scalar extent = 0;
    for (label k = 0; k < n; ++k)
    {
        extent = max(extent, mag(vectorAt(x, k)));
    }
    return extent;
}

//- Entry dealiasing: latitudes of the load grid over the degree
Foam::scalar readDealiasing(const Foam::dictionary& dict)
{
    using namespace Foam;
    const scalar dealiasing = dict.getOrDefault<scalar>("dealiasing", 1.5);
    if (dealiasing < 1 || dealiasing > 4)
    {
        refuse(dict, "dealiasing", Foam::name(dealiasing), "1 to 4");
    }
    return dealiasing;
}

//- Factors of the coefficients (nCoeffs x 3) by the entry filter; none: empty
std::vector<double> readFilter(const Foam::dictionary& dict,
                               const Foam::sphericalHarmonics& grid)
{
    using namespace Foam;
    const scalar strength = dict.getOrDefault<scalar>("filter", 0);
    if (strength < 0)
    {
        refuse(dict, "filter", Foam::name(strength), "0 and greater");
    }
    if (strength == 0) return {};

    const label degree = grid.degree();
    std::vector<double> filter(3 * grid.nCoeffs());
    for (size_t i = 0; i < filter.size(); ++i)
    {
        const double n = grid.degreeOf(i / 3);
        filter[i] = std::exp(-strength * std::pow(n / degree, 8));
    }
    return filter;
}
} // namespace

Foam::capsuleGroup::capsuleGroup(const word& name, const dictionary& dict,
                                 const bodyScene& scene)
    : bodyGroup(name, dict, scene),
      report_(new capsuleReport(*this))
{
    checkEntries(dict,
                 {"type",           "shape",      "positions", "membrane",
                  "directions",     "placement",  "harmonics", "dealiasing",
                  "markerSpacing",  "shearPlane", "coupling",  "bending",
                  "viscosityRatio", "prestress",  "gravity",   "densityRatio",
                  "stressFree",     "motion",     "thickness", "filter",
                  "nearField",      "restart",    "outside",   "nucleus"});
    if (withoutFluid())
    {
        refuse(dict, "coupling", "none",
               "oneWay or twoWay: capsules move with the fluid");
    }
    takesForces_ = twoWay();
    if (dict.found("viscosityRatio"))
    {
        viscosityRatio_ = readPositive(dict, "viscosityRatio", dimless);
    }
    const dictionary& shape =
        readDict(dict, "shape", "type sphere; radius 1e-6;");
    requireEntry(shape, "type");
    const word form(shape.get<word>("type"));
    sphere_ = form == "sphere";
    round_ = sphere_ || form == "ellipsoid";
    nucleated_ = dict.found("nucleus");
    const label meshDegree = degreeOfMesh(shape);
    const label degree = readDegree(dict, meshDegree);
    const scalar dealiasing = readDealiasing(dict);
    shearPlane_ = groupEntries(this->name(), dict, scene_).shearPlane();
    readGravity(dict);

    // The first shape, about the origin, from values on a dense grid
    const sphericalHarmonics fine(degree, 2 * degree + 2);
    initial_ = initialShape(shape, fine);
    const scalar extent = furthest(fine, initial_);
    makeMarkers(dict, degree, extent);
    const coefficients rest(stressFree(dict, fine));
    relaxesAbove_ = max(mostOfHighest, 1.5 * shareOfHighest(rest));
    shell_.reset(
        new capsuleShell(degree, dealiasing, dict, rest, scene_.effects));
    const capsuleShell::geometry reference(shell_->measure(initial_));
    referenceVolume_ = reference.volume;
    referenceArea_ = reference.area;
    radius_ = std::cbrt(0.75 / constant::mathematical::pi * referenceVolume_);
    shell_->readBending(dict, radius_, initial_);
    madeWith_ = {{"harmonics", scalar(degree)},
                 {"radius", radius_},
                 {"area", referenceArea_}};

    setNearField(dict, extent);
    const scalar ratio = viscosityRatio_ / scene_.viscosityAround;
    motion_ = capsuleMotion::New(dict,
                                 {*shell_, harmonics(), radius_,
                                  0.5 * (1 + ratio) * scene_.mu, scene_.rho,
                                  scene_.effects, ratio, !twoWay()},
                                 scene_, nearField_.get());
    filter_ = readFilter(dict, harmonics());
    warnOfHarmonics(dict, degree, meshDegree);
    readStart(dict);
    checkSize(dict);

    declareEffects(dict);
}

Foam::capsuleGroup::~capsuleGroup() {}

Foam::label Foam::capsuleGroup::readDegree(const dictionary& dict,
                                           const label meshDegree) const
{
    const auto enough = [this](const scalar wanted)
    { return report_->enoughHarmonics(0.15 * wanted); };
    const label byAccuracy =
        groupEntries(name(), dict, scene_)
            .byAccuracy<label>("harmonics", {12, 16, 24}, enough);
    const label degree =
        dict.getOrDefault<label>("harmonics", min(meshDegree, byAccuracy));
    if (degree < 4 || degree > 64)
    {
        refuse(dict, "harmonics", Foam::name(degree), "4 to 64");
    }
    return degree;
}

void Foam::capsuleGroup::readGravity(const dictionary& dict) const
{
    const groupEntries entries(name(), dict, scene_);
    const bool heavy = entries.gravity();
    if (heavy != dict.found("densityRatio"))
    {
        refuse(dict, "gravity", heavy ? "on" : "off",
               heavy ? "off, or a densityRatio with it"
                     : "on, as densityRatio is given: it acts by the weight");
    }
    if (heavy && !twoWay())
    {
        refuse(dict, "gravity", "on",
               "off with coupling oneWay: a capsule that the fluid does not "
               "feel is carried, whatever its weight");
    }
    entries.addWeight(heavy, heavy
                                 ? readPositive(dict, "densityRatio", dimless) -
                                       scene_.densityAround
                                 : 0);
}

// The largest circumference in h, stretched by a quarter. With fewer than ten latitudes
// D errs by more than a per cent at large steps (a/h = 2)
void Foam::capsuleGroup::makeMarkers(const dictionary& dict, const label degree,
                                     const scalar extent)
{
    const scalar spacing =
        groupEntries(name(), dict, scene_)
            .byAccuracy<scalar>("markerSpacing", {1.3, 1.1, 0.6},
                                [this](const scalar wanted) {
                                    return report_->enoughMarkers(0.1 * wanted);
                                });
    if (spacing < 0.1 || spacing > 1.6)
    {
        refuse(dict, "markerSpacing", Foam::name(spacing), "0.1 to 1.6");
    }
    const scalar h = cmptMin(scene_.grid.h());
    const scalar around = 1.25 * constant::mathematical::pi * extent / h;
    const label nTheta =
        max(max(degree + 1, label(10)), label(std::ceil(around / spacing)));
    if (nTheta > 1000)
    {
        refuse(dict, "shape", "of size " + Foam::name(extent),
               "sizes below " + Foam::name(extent * 1000 / nTheta) +
                   " on this mesh (1000 rings of markers)");
    }
    markers_.reset(new surfacePoints(degree, nTheta, degree));
    markerSpacing_ = around / markers_->grid().nTheta();
}

Foam::capsuleGroup::coefficients
Foam::capsuleGroup::stressFree(const dictionary& dict,
                               const sphericalHarmonics& fine) const
{
    const scalar prestress =
        dict.found("prestress") ? readNumber(dict, "prestress", dimless) : 0;
    if (!(prestress > -1))
    {
        refuse(dict, "prestress", Foam::name(prestress), "greater than -1");
    }
    coefficients shape(initial_);
    if (dict.found("stressFree"))
    {
        const dictionary& free =
            readDict(dict, "stressFree", "type sphere; radius 1e-6;");
        if (free.found("axis"))
        {
            refuse(free, "axis", valueOf(*free.findEntry("axis")),
                   "none: the axis is that of shape");
        }
        shape = initialShape(free, fine);
    }
    for (double& x : shape)
    {
        x /= 1 + prestress;
    }
    return shape;
}

void Foam::capsuleGroup::warnOfHarmonics(const dictionary& dict,
                                         const label degree,
                                         const label meshDegree) const
{
    if (degree <= meshDegree) return;
    const scalar h = cmptMax(scene_.grid.h());
    IOWarningInFunction(dict)
        << "entry harmonics: " << degree << " in group " << name()
        << ", but the mesh resolves degrees up to " << meshDegree
        << " on a body of radius " << radius_ << " = " << radius_ / h << " h"
        << nl << "    Strain of higher degrees does not relax and "
        << "makes the tension noisy: leave the entry out, reduce it to "
        << meshDegree << ", or use cells below " << 2.4 * radius_ / degree
        << endl;
}

// Limits of the near field: doc/choosing.md
void Foam::capsuleGroup::setNearField(const dictionary& dict,
                                      const scalar extent)
{
    string never;
    if (!twoWay())
        never = "coupling oneWay: no load acts on the fluid";
    else if (dict.getOrDefault<word>("motion", "auto") == "penalty")
        never = "motion penalty";
    const groupEntries::nearField entry(
        groupEntries(name(), dict, scene_)
            .readNearField(never, report_->errorOfCells(false)));

    // Reason why the near field is not known to be better than none, or empty
    const scalar h = scene_.grid.h().x();
    const scalar inertia =
        scene_.rho * shell_->inertialModulus() * sqr(h / scene_.mu) / radius_;
    string unknown;
    if (inertia > maxInertia)
        unknown = "rho E h^2/(mu^2 a) = " + Foam::name(inertia) +
                  " (E: Gs, or a third of the area modulus), known up to " +
                  Foam::name(maxInertia) + ", cells of " +
                  Foam::name(h * std::sqrt(maxInertia / inertia)) + " m";
    else if (viscosityRatio_ > maxViscosityRatio * scene_.viscosityAround)
        unknown = "viscosityRatio " +
                  Foam::name(viscosityRatio_ / scene_.viscosityAround) +
                  ", known up to " + Foam::name(maxViscosityRatio);

    const bool on = entry.on || (entry.automatic && unknown.empty());
    string note(entry.whyNot.empty() ? unknown : entry.whyNot);
    if (on)
    {
        nearField_.reset(new capsuleNearField(
            harmonics().degree(), scene_.kernel.type(), h, scene_.mu, extent));
        nearField_->setInertia(scene_.mu / scene_.rho, radius_);
        nearFieldKnown_ = unknown.empty();
        note = Foam::name(nearField_->nPoints()) + " points" +
               (unknown.empty() ? string("") : "; beyond what is known: ") +
               unknown;
    }
    scene_.effects.declare("nearField", on, note);
}
