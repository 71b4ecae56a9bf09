// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsuleGroup.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "capsuleReport.H"
#include "initialShape.H"
#include "judgedRatio.H"
#include "turnTo.H"
#include <cmath>

namespace Foam
{
defineTypeNameAndDebug(capsuleGroup, 0);
addToRunTimeSelectionTable(bodyGroup, capsuleGroup, dictionary);
} // namespace Foam

namespace
{
//- Enclosed by a surface [m^3], whichever way it turns
Foam::scalar volumeOf(const Foam::sphericalHarmonics& grid,
                      const std::vector<double>& coeffs)
{
    using namespace Foam;
    const label n = grid.nPoints();
    std::vector<double> x(3 * n), t(3 * n), p(3 * n);
    grid.values(coeffs.data(), x.data());
    grid.gradient(coeffs.data(), t.data(), p.data());
    const auto at = [n](const std::vector<double>& v, const label k)
    { return vector(v[k], v[n + k], v[2 * n + k]); };
    scalar volume = 0;
    for (label k = 0; k < n; ++k)
    {
        volume += grid.weight(k) / 3 * (at(x, k) & (at(t, k) ^ at(p, k)));
    }
    return mag(volume);
}
} // namespace

Foam::capsuleGroup::capsuleGroup(const word& name, const dictionary& dict,
                                 const bodyScene& scene)
    : bodyGroup(name, dict, scene),
      report_(new capsuleReport(*this))
{
    const groupEntries entries(this->name(), dict, scene_);
    takesForces_ = twoWay();
    checkEntries(dict,
                 {"type",           "shape",      "positions", "membrane",
                  "directions",     "placement",  "harmonics", "dealiasing",
                  "markerSpacing",  "shearPlane", "coupling",  "bending",
                  "viscosityRatio", "prestress",  "gravity",   "densityRatio",
                  "stressFree",     "motion",     "thickness", "filter",
                  "nearField",      "restart",    "outside",   "nucleus"});
    if (dict.found("viscosityRatio"))
    {
        viscosityRatio_ = readPositive(dict, "viscosityRatio", dimless);
    }

    if (alone())
    {
        refuse(dict, "coupling", "none",
               "oneWay or twoWay: capsules move with the fluid");
    }

    const dictionary& shape =
        readDict(dict, "shape", "type sphere; radius 1e-6;");
    const word form(shape.get<word>("type"));
    sphere_ = form == "sphere";
    round_ = sphere_ || form == "ellipsoid";
    nucleated_ = dict.found("nucleus");
    const label moved = degreeOfMesh(shape);
    const label degree = dict.getOrDefault<label>(
        "harmonics",
        min(moved, entries.byAccuracy<label>(
                       "harmonics", {12, 16, 24},
                       [this](const scalar wanted)
                       { return report_->enoughHarmonics(0.15 * wanted); })));
    if (degree < 4 || degree > 64)
    {
        refuse(dict, "harmonics", Foam::name(degree), "4 to 64");
    }
    const scalar dealiasing = dict.getOrDefault<scalar>("dealiasing", 1.5);
    if (dealiasing < 1 || dealiasing > 4)
    {
        refuse(dict, "dealiasing", Foam::name(dealiasing), "1 to 4");
    }
    const scalar spacing = entries.byAccuracy<scalar>(
        "markerSpacing", {1.3, 1.1, 0.6},
        [this](const scalar wanted)
        { return report_->enoughMarkers(0.1 * wanted); });
    if (spacing < 0.1 || spacing > 1.6)
    {
        refuse(dict, "markerSpacing", Foam::name(spacing), "0.1 to 1.6");
    }

    shearPlane_ = entries.shearPlane();

    const bool heavy = entries.gravity();
    if (heavy != dict.found("densityRatio"))
    {
        refuse(dict, "gravity", heavy ? "on" : "off",
               heavy ? "off, or a densityRatio with it"
                     : "on with a densityRatio");
    }
    if (heavy && !twoWay())
    {
        refuse(dict, "gravity", "on",
               "off with coupling oneWay: a capsule that the fluid does not "
               "feel is carried, whatever its weight");
    }
    entries.addWeight(
        heavy, heavy ? readPositive(dict, "densityRatio", dimless) - 1 : 0);

    // The first shape, about the origin, from values on a dense grid
    const sphericalHarmonics fine(degree, 2 * degree + 2);
    initial_ = initialShape(shape, fine);
    const numbers& initial = initial_;
    scalar extent = 0;
    {
        numbers values(3 * fine.nPoints());
        fine.values(initial.data(), values.data());
        const label n = fine.nPoints();
        for (label k = 0; k < n; ++k)
        {
            extent =
                max(extent,
                    mag(vector(values[k], values[n + k], values[2 * n + k])));
        }
    }

    // Markers: the largest circumference in h, stretched by a quarter. With fewer than
    // ten latitudes D errs by more than a per cent at large steps (a/h = 2)
    const scalar h = cmptMin(scene.grid.h());
    const scalar around = 1.25 * constant::mathematical::pi * extent / h;
    const label nTheta =
        max(max(degree + 1, label(10)), label(std::ceil(around / spacing)));
    if (nTheta > 1000)
    {
        refuse(dict, "shape", "of size " + Foam::name(extent),
               "sizes below " + Foam::name(extent * 1000 / nTheta) +
                   " on this mesh (1000 rings of markers)");
    }
    markers_.reset(new surfacePoints(degree, nTheta));
    markerSpacing_ = around / markers_->grid().nTheta();
    coeffs_.resize(initial.size());

    const scalar prestress = dict.getOrDefault<scalar>("prestress", 0);
    if (!(prestress > -1))
    {
        refuse(dict, "prestress", Foam::name(prestress), "greater than -1");
    }
    numbers stressFree(dict.found("stressFree")
                           ? initialShape(readDict(dict, "stressFree",
                                                   "type sphere; radius 1e-6;"),
                                          fine)
                           : initial);
    for (double& x : stressFree)
    {
        x /= 1 + prestress;
    }
    membrane_.reset(new membrane(
        degree, label(dealiasing * degree) + 1,
        readDict(dict, "membrane", "law neoHookean; Gs 1e-6;"), stressFree));

    xt_.resize(3 * membrane_->harmonics().nPoints());
    xp_.resize(xt_.size());
    onGrid_.resize(xt_.size());

    const geometry reference(measure(initial));
    referenceVolume_ = reference.volume;
    referenceArea_ = reference.area;
    radius_ = std::cbrt(0.75 / constant::mathematical::pi * referenceVolume_);

    const dictionary& bend = readDictIfThere(dict, "bending", "modulus 1e-19;");
    checkEntries(bend, {"modulus", "reference"});
    const scalar modulus =
        dict.found("bending")
            ? readNumber(bend, "modulus", dimForce * dimLength)
            : 0;
    if (modulus < 0)
    {
        refuse(bend, "modulus", Foam::name(modulus), "0 and greater");
    }
    if (modulus > 0)
    {
        bending_.reset(
            new bending(bend, membrane_->harmonics(), radius_, initial));
    }
    setNearField(dict, extent);
    setMotion(dict);
    setFilter(dict);

    if (degree > moved)
    {
        IOWarningInFunction(dict)
            << "entry harmonics: " << degree << " in group " << name
            << ", but the mesh moves degrees up to " << moved
            << " on a body of radius " << radius_ << " = " << radius_ / h
            << " h" << nl << "    Strain of higher degrees does not relax and "
            << "makes the tension noisy: leave the entry out, reduce it to "
            << moved << ", or use cells below " << 2.4 * radius_ / degree
            << endl;
    }

    readStart(dict);
    judgeSize(dict);

    scene_.effects.declare("membrane", true,
                           dict.subDict("membrane").get<word>("law") +
                               ", N = " + Foam::name(degree) + ", " +
                               Foam::name(nBodies()) + " capsules, " +
                               Foam::name(markers_->size()) + " markers each");
    scene_.effects.declare("bending", bool(bending_),
                           bending_
                               ? "modulus " + Foam::name(bending_->modulus())
                               : string("no bending modulus given"));
}

// The ellipsoid around the shape: that of the shape's extents about its own axis,
// grown in proportion until all points are in it. Shape and volume are those of a
// series of fixed degree: random places do not depend on harmonics and markers
void Foam::capsuleGroup::readStart(const dictionary& dict)
{
    const vector axis(
        dict.subDict("shape").getOrDefault<vector>("axis", vector(0, 0, 1)));
    axis_ = axis / mag(axis);
    const sphericalHarmonics grid(32, 66);
    const numbers shape(initialShape(dict.subDict("shape"), grid));
    const label n = grid.nPoints();
    numbers x(3 * n);
    grid.values(shape.data(), x.data());
    vectorField X(n);
    forAll(X, k)
    {
        X[k] = turnTo(axis_).T() & vector(x[k], x[n + k], x[2 * n + k]);
    }
    vector semiAxes(Zero);
    for (const vector& x : X)
    {
        semiAxes = max(semiAxes, cmptMag(x));
    }
    scalar furthest = 0;
    for (const vector& x : X)
    {
        furthest = max(furthest, mag(cmptDivide(x, semiAxes)));
    }
    semiAxes *= furthest;
    if (cmptMax(semiAxes) < 1.02 * cmptMin(semiAxes))
    {
        semiAxes = cmptMax(semiAxes) * vector::one;
    }
    start_ =
        groupEntries(name(), dict, scene_)
            .start({semiAxes, 0}, volumeOf(grid, shape), 0, axis_, twoWay());
}

Foam::tensor Foam::capsuleGroup::turnOf(const label body) const
{
    if (start_.directions.empty()) return tensor::I;
    return turnTo(start_.directions[body]) & turnTo(axis_).T();
}

void Foam::capsuleGroup::setFilter(const dictionary& dict)
{
    const scalar strength = dict.getOrDefault<scalar>("filter", 0);
    if (strength < 0)
    {
        refuse(dict, "filter", Foam::name(strength), "0 and greater");
    }
    if (strength == 0) return;

    const label degree = harmonics().degree();
    filter_.resize(coeffs_.size());
    for (label n = 0; n <= degree; ++n)
    {
        const double f = std::exp(-strength * std::pow(double(n) / degree, 8));
        for (label m = 0; m <= n; ++m)
        {
            for (direction d = 0; d < 3; ++d)
            {
                filter_[3 * harmonics().index(n, m, false) + d] = f;
                if (m) filter_[3 * harmonics().index(n, m, true) + d] = f;
            }
        }
    }
}

// The kernel filters waves below some 2.6 cells, 2 pi a/N = 2.6 h
Foam::label Foam::capsuleGroup::degreeOfMesh(const dictionary& shape) const
{
    const sphericalHarmonics grid(12, 26);
    const scalar volume = volumeOf(grid, initialShape(shape, grid));
    const scalar a = std::cbrt(0.75 / constant::mathematical::pi * volume);
    return max(
        label(round_ ? 6 : 12),
        label(min(scalar(64), 2.4 * a / cmptMax(scene_.grid.h()) + 0.5)));
}

void Foam::capsuleGroup::judgeSize(const dictionary& dict) const
{
    const label n = markers_->size();
    vectorField X(n);
    markers_->values(initial_.data(), X.data());
    const boundBox box(X, false);
    const vector h(scene_.grid.h()), L(scene_.grid.length());
    scalar toImage = GREAT;
    for (direction d = 0; d < 3; ++d)
    {
        if (scene_.grid.periodic(d))
        {
            toImage = min(toImage, (L[d] - box.span()[d]) / h[d]);
        }
    }
    List<judgedRatio> ratios({
        {"shape", "radius/h", radius_ / cmptMax(h), 1, GREAT, 2, GREAT,
         "the kernel spreads the membrane over three cells"},
    });
    if (twoWay())
    {
        ratios.append({"viscosityRatio", "viscosityRatio", viscosityRatio_, 0,
                       GREAT, 0.1, 10,
                       "it has been validated from 0.2 to 5; beyond, the mesh "
                       "smooths the step of the viscosity"});
        ratios.append({"positions", "volume fraction",
                       nBodies() * referenceVolume_ / cmptProduct(L), 0, 1, 0,
                       0.7,
                       "the capsules do not fit into the box side by side"});
        // Larger than the box: an error of its own
        if (toImage > 0)
        {
            ratios.append({"shape", "distance to its own image/h", toImage, 0,
                           GREAT, 3, GREAT,
                           "a capsule in a periodic box acts on itself"});
        }
    }
    judge(dict, ratios);
}

void Foam::capsuleGroup::insertBody(const label i, const label body)
{
    // The harmonic of degree 0 is 1/sqrt(4 pi)
    capsule c;
    c.x = initial_;
    const tensor turn(turnOf(body));
    for (size_t k = 0; k < c.x.size(); k += 3)
    {
        const vector x(turn & vector(c.x[k], c.x[k + 1], c.x[k + 2]));
        std::copy_n(&x[0], 3, &c.x[k]);
    }
    for (direction d = 0; d < 3; ++d)
    {
        c.x[d] += start_.positions[body][d] *
                  std::sqrt(4 * constant::mathematical::pi);
    }
    startAt(c);
    c.velocity.assign(c.x.size(), 0);
    if (penalty_) c.load = c.lag = c.lagBefore = c.velocity;
    capsules_.insert(capsules_.begin() + i, c);
}

void Foam::capsuleGroup::eraseBody(const label i)
{
    capsules_.erase(capsules_.begin() + i);
}

Foam::point Foam::capsuleGroup::initialCentre(const label body) const
{
    return start_.positions[body] +
           (turnOf(body) & vector(initial_[0], initial_[1], initial_[2])) /
               std::sqrt(4 * constant::mathematical::pi);
}

Foam::bodyPoints Foam::capsuleGroup::initialPoints(const label body) const
{
    bodyPoints p(points(-1));
    p.body = body;
    const tensor turn(turnOf(body));
    p.places = start_.positions[body] + (turn & p.places);
    p.areas = turn & p.areas;
    return p;
}

// By the addition theorem |sum over m of c_nm Y_nm| is at most |c_n| sqrt((2n + 1)/
// 4 pi): equal for a sphere, little more for what it becomes
Foam::boundBox Foam::capsuleGroup::bounds(const label i,
                                          const bool smallest) const
{
    const numbers& x = capsules_[i].x;
    if (smallest) return boundBox(capsules_[i].markers, false);
    vector reach(Zero);
    for (label n = 1; n <= harmonics().degree(); ++n)
    {
        vector squares(Zero);
        for (label m = 0; m <= n; ++m)
        {
            for (int sine = 0; sine <= (m ? 1 : 0); ++sine)
            {
                const double* c = &x[3 * harmonics().index(n, m, sine)];
                const vector v(c[0], c[1], c[2]);
                squares += cmptMultiply(v, v);
            }
        }
        for (direction d = 0; d < 3; ++d)
        {
            reach[d] += std::sqrt(
                (2 * n + 1) / (4 * constant::mathematical::pi) * squares[d]);
        }
    }
    return boundBox(centre(i) - reach, centre(i) + reach);
}

Foam::point Foam::capsuleGroup::centre(const label i) const
{
    const numbers& x = capsules_[i].x;
    return vector(x[0], x[1], x[2]) / std::sqrt(4 * constant::mathematical::pi);
}

void Foam::capsuleGroup::checkStart(const label i, const dictionary& dict) const
{
    const label body = mine()[i];
    const boundBox bounds(capsules_[i].markers, false);
    const vector length(scene_.grid.length());
    for (direction d = 0; d < 3; ++d)
    {
        if (bounds.span()[d] >= length[d])
        {
            firstRankSpeaks();
            FatalIOErrorInFunction(dict)
                << "body " << body << " is larger than the box: it spans "
                << bounds.span()[d] << " in direction "
                << vector::componentNames[d] << nl << "    allowed: less than "
                << length[d] << exit(FatalIOError);
        }
    }
    groupEntries::checkWalls(dict, scene_.grid, body, bounds);
}

Foam::scalar Foam::capsuleGroup::volume() const
{
    return capsules_.size() * referenceVolume_;
}

Foam::capsuleGroup::~capsuleGroup() {}

const Foam::bodyReport& Foam::capsuleGroup::report() const
{
    return *report_;
}
