// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "rigidGroup.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "rangeCheck.H"
#include "mathematicalConstants.H"
#include "patchOrder.H"
#include "rigidReport.H"
#include "turnTo.H"
#include <cmath>

namespace Foam
{
defineTypeNameAndDebug(rigidGroup, 0);
addToRunTimeSelectionTable(bodyGroup, rigidGroup, dictionary);
} // namespace Foam

namespace
{
using namespace Foam;

//- Points of the surface for contacts and loads per marker. They are a third as far apart as
//  markers: at the spacing of the markers the force between touching surfaces is too small
const label pointsPerMarker = 9;

//- Number of distances at which the product of two kernels is tabulated
const label nProducts = 200;

//- Depth of the markers below the surface without near field, so that the drag is that of
//  the radius [cells]
scalar insetOf(const deltaKernel::kernelType kernel)
{
    return kernel == deltaKernel::Roma3 ? 0.3 : 0.45;
}

//- The integral of phi(s) phi(s - r) over s, for r >= 0 in cells
scalar productOf(const deltaKernel& kernel, const scalar r)
{
    const label n = 60;
    const scalar width = 2 * kernel.reach() / n;
    scalar sum = 0;
    for (label i = 0; i < n; ++i)
    {
        const scalar s = -kernel.reach() + (i + 0.5) * width;
        sum += width * kernel.phi(s) * kernel.phi(s - r);
    }
    return sum;
}
} // namespace

Foam::rigidGroup::rigidGroup(const word& name, const dictionary& dict,
                             const bodyScene& scene)
    : directForcing(name, dict, scene),
      shape_(readDict(dict, "shape", "type sphere; radius 1e-6;")),
      h_(std::cbrt(scene.grid.cellVolume())),
      report_(new rigidReport(*this))
{
    forcing_ = forcingType::ofSurfaces;
    const vector& semiAxes = shape_.semiAxes();
    madeWith_ = {{"semiAxisX", semiAxes.x()},
                 {"semiAxisY", semiAxes.y()},
                 {"semiAxisZ", semiAxes.z()}};
    const groupEntries entries(this->name(), dict, scene_);
    checkEntries(dict,
                 withCoeffs(dict,
                            {"type", "shape", "positions", "directions",
                             "placement", "densityRatio", "gravity", "velocity",
                             "angularVelocity", "nearField", "markerSpacing",
                             "coupling", "restart", "outside"},
                            {"velocity", "angularVelocity"}));
    if (!twoWay())
    {
        refuse(dict, "coupling", withoutFluid() ? "none" : "oneWay",
               "twoWay: what moves a rigid body is the force between it and "
               "the fluid");
    }
    densityRatio_ = dict.found("densityRatio")
                        ? readPositive(dict, "densityRatio", dimless)
                        : 1;
    heavy_ = entries.gravity();
    if (heavy_ && !dict.found("densityRatio"))
    {
        refuse(dict, "gravity", "on", "off, or a densityRatio with it");
    }
    entries.addWeight(heavy_, densityRatio_ - scene_.densityAround);
    readMotion(dict);

    const scalar spacing = entries.byAccuracy<scalar>(
        "markerSpacing", {1.5, 1.3, 1},
        [](const scalar wanted) { return wanted < 0.005 ? 1 : 1.3; });
    if (spacing < 0.5 || spacing > 1.5)
    {
        refuse(dict, "markerSpacing", Foam::name(spacing), "0.5 to 1.5");
    }
    checkSize(dict);
    setNearField(dict, spacing);
    makeMarkers(spacing);
    start_ = entries.start({shape_.semiAxes(), 0}, shape_.volume(), 0,
                           shape_.axis(), twoWay());

    scene_.effects.declare("rigid", true,
                           Foam::name(nBodies()) + " rigid bodies, " +
                               Foam::name(markers_.size()) + " markers each");
}

void Foam::rigidGroup::readMotion(const dictionary& dict)
{
    if (dict.found("velocity"))
    {
        velocity_ = Function1<vector>::New("velocity", dict);
        held_ = true;
    }
    if (dict.found("angularVelocity"))
    {
        angularVelocity_ = Function1<vector>::New("angularVelocity", dict);
    }
}

void Foam::rigidGroup::checkSize(const dictionary& dict) const
{
    const vector L(scene_.grid.length());
    const scalar h = cmptMax(scene_.grid.h());
    checkRanges(
        dict,
        {{"shape", "longest/shortest side of the cells",
          h / cmptMin(scene_.grid.h()), 0, GREAT, 0, 1.25,
          "the kernel is another in each direction, and drag and "
          "rotation with it"},
         {"shape", "radius/h", shape_.radius() / h, 1, 250, 2, 25,
          "a surface needs some cells to be one, and time and memory of the "
          "near field grow with the fourth power of their number (at 40: 3 "
          "GB on each rank)"},
         {"shape", "smallest semi-axis/h", cmptMin(shape_.semiAxes()) / h, 1,
          GREAT, 2, GREAT, "a surface needs some cells to be one"},
         {"shape", "diameter/side of the box",
          2 * cmptMax(shape_.semiAxes()) / cmptMin(L), 0, 1, 0, 0.7,
          "it meets its own image or both sides"}});
}

void Foam::rigidGroup::setNearField(const dictionary& dict,
                                    const scalar spacing)
{
    // The error near walls is larger
    const bool walls = !scene_.grid.periodic();
    const groupEntries::nearField entry(
        groupEntries(name(), dict, scene_)
            .readNearField(
                "", densityRatio_ < 1 || walls ? -1 : errorOfCells(false)));
    const bool on = entry.whyNot.empty();
    if (on)
    {
        nearField_.reset(new nearField(scene_.kernel.type(), h_, scene_.mu,
                                       max(scalar(1), 1.43 * spacing) * h_));
    }
    if (!on && densityRatio_ < 1)
    {
        refuse(dict, "densityRatio", Foam::name(densityRatio_),
               "1 and greater without the near field (" +
                   (entry.whyNot == "off" ? string("nearField off")
                                          : entry.whyNot) +
                   "): the exchange with a lighter body grows");
    }
    scene_.effects.declare(
        "nearField", on,
        on ? string("velocity that the kernel smooths away")
           : entry.whyNot);
}

// Markers at the wanted spacing, and points of the surface
void Foam::rigidGroup::makeMarkers(const scalar spacing)
{
    const scalar inset =
        nearField_ ? 0 : insetOf(scene_.kernel.type()) * h_;
    const label n =
        2 * max(label(6),
                label(std::ceil(0.5 * shape_.area() / sqr(spacing * h_))));
    vectorField markerAreas;
    shape_.points(n, inset, markers_, markerAreas);
    if (densityRatio_ < 1)
    {
        const tensor volume(sum(markerAreas * markers_));
        perVolume_ = inv(volume) & markerAreas;
    }
    shape_.points(pointsPerMarker * n, 0, surface_, areas_);

    // The markers keep the order of the spiral, which is that of their forces in a state
    const labelList order(patchOrder(surface_));
    surface_ = vectorField(surface_, order);
    areas_ = vectorField(areas_, order);
    findOverlap();
    if (nearField_) findNearMobility();
}

// Distances are in cells of any direction, on average over three positions of the body
void Foam::rigidGroup::findOverlap()
{
    const scalar width = 2 * scene_.kernel.reach();
    scalarField psi(nProducts);
    forAll(psi, i)
    {
        psi[i] = productOf(scene_.kernel, width * i / (psi.size() - 1));
    }
    // The spiral rises along z
    const scalar furthest = std::sqrt(3.0) * width * h_;
    overlap_.setSize(markers_.size(), 0);
    for (const vector& axis :
         {vector(0, 0, 1), vector(1, 0, 1), vector(1, 1, 1)})
    {
        const vectorField X(turnTo(axis / mag(axis)) & markers_);
        forAll(X, k)
        {
            forAll(X, l)
            {
                if (mag(markers_[l].z() - markers_[k].z()) > furthest) continue;
                const point& x = X[l];
                scalar product = 1.0 / 3;
                for (direction d = 0; d < 3 && product > 0; ++d)
                {
                    const scalar at = mag(x[d] - X[k][d]) / h_ / width;
                    product *= at < 1 ? psi[label(at * (psi.size() - 1))] : 0;
                }
                overlap_[k] += product;
            }
        }
    }
}

// The mobility is the velocity of the markers by a unit force on each, or follows from the
// largest eigenvalue
void Foam::rigidGroup::findNearMobility()
{
    const label n = markers_.size();
    // Higher degrees are lost in round-off
    const label degree =
        min(label(32),
            max(label(1), label(1.6 * shape_.radius() / h_ * (1 + 1e-6))));
    projection_.reset(new coarsePoints(nearDirections(n), degree, n));
    vectorField u(n);
    for (direction d = 0; d < 3; ++d)
    {
        vector push(Zero);
        push[d] = 1;
        nearField_->velocity(markers_.cdata(), vectorField(n, push).cdata(), n,
                             u.data());
        for (const vector& v : u)
        {
            nearMobility_ = max(nearMobility_, v[d]);
            meanNearMobility_ += v[d] / (3 * n);
        }
    }

    // Forces grow if the gain exceeds 2/eigenvalue. Power iterations find the largest one, from
    // below: 0.7 in place of 0.5 has a margin
    vectorField F(n);
    forAll(F, k)
    {
        F[k] =
            vector(std::sin(1.0 + k), std::sin(2.0 + 3 * k), std::cos(5.0 * k));
    }
    scalar largest = 0, before = -1;
    for (label i = 0; i < 100 && mag(largest - before) > 1e-3 * largest; ++i)
    {
        before = largest;
        F /= std::sqrt(sum(magSqr(F)));
        nearField_->velocity(markers_.cdata(), F.cdata(), n, u.data());
        largest = std::sqrt(sum(magSqr(u)));
        F = u;
    }
    nearMobility_ = max(nearMobility_, 0.7 * largest);
}

// Measured on spheres in a periodic box and in shear (tests/validation/rigidSphere)
Foam::scalar Foam::rigidGroup::errorOfCells(const bool nearField) const
{
    const scalar radius = shape_.radius() / h_;
    if (radius < 3 * (1 - 1e-6) || !isSphere() || scene_.insideBodies)
        return -1;
    return nearField ? 0.003 * sqr(3 / radius) : 0.064 / radius;
}
