// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "nucleusReader.H"
#include "dictionaryChecks.H"
#include "rangeCheck.H"
#include "mathematicalConstants.H"
#include "periodicBox.H"

Foam::nucleusReader::nucleusReader(const dictionary& capsules,
                                   const bodyGroup& host,
                                   const uniformGrid& grid)
    : capsules_(capsules),
      nucleus_(readDict(capsules, "nucleus", "type rigid; radiusRatio 0.5;")),
      host_(host),
      grid_(grid)
{
    checkEntries();
    const bodyPoints surface(host.points(-1));
    if (!surface.isSurface() || host.forcing() != forcingType::none)
    {
        refuse(capsules, "nucleus", valueOf(*capsules.findEntry("nucleus")),
               "nuclei of capsules");
    }
    hostRadius_ = std::cbrt(sum(surface.positions & surface.areas) /
                            (4 * constant::mathematical::pi));
    if (nucleus_.get<word>("type") == "rigid")
    {
        Foam::checkEntries(
            nucleus_,
            withCoeffs(nucleus_,
                       {"type", "radiusRatio", "offset", "densityRatio",
                        "gravity", "velocity", "angularVelocity", "nearField",
                        "markerSpacing"},
                       {"velocity", "angularVelocity"}));
    }
    const scalar ratio = readPositive(nucleus_, "radiusRatio", dimless);
    if (ratio >= 1)
    {
        refuse(nucleus_, "radiusRatio", Foam::name(ratio), "below 1");
    }
    radius_ = ratio * hostRadius_;
    checkRanges(nucleus_, {{"radiusRatio", "radius of the nucleus/h",
                            radius_ / cmptMax(grid.h()), 1, GREAT, 2, GREAT,
                            "a surface needs some cells to be one"}});
}

void Foam::nucleusReader::checkEntries() const
{
    if (!host_.twoWay())
    {
        refuse(capsules_, "nucleus", valueOf(*capsules_.findEntry("nucleus")),
               "nuclei in groups of coupling twoWay");
    }
    requireEntry(nucleus_, "type");
    const word type(nucleus_.get<word>("type"));
    if (type != "rigid" && type != "capsule")
    {
        refuse(nucleus_, "type", type, "(rigid capsule)");
    }
    for (const word entry : {"restart", "outside", "nucleus", "coupling"})
    {
        if (nucleus_.found(entry))
        {
            refuse(nucleus_, entry, valueOf(*nucleus_.findEntry(entry)),
                   "that of the capsules, for both");
        }
    }
    for (const word entry : {"shape", "positions", "directions", "placement"})
    {
        if (nucleus_.found(entry))
        {
            refuse(nucleus_, entry, valueOf(*nucleus_.findEntry(entry)),
                   "radiusRatio and offset, which say how large a nucleus is "
                   "and where in its capsule");
        }
    }
}

// To the plane of each point of the membrane, where the foot lies in the point's patch
Foam::scalar Foam::nucleusReader::toMembrane(const label body,
                                             const point& x) const
{
    const bodyPoints membrane(host_.initialPoints(body));
    const scalar patch = 2 * max(mag(membrane.areas));
    scalar nearest = GREAT;
    forAll(membrane.positions, k)
    {
        const vector r(membrane.positions[k] - x);
        const scalar toPlane = (r & membrane.areas[k]) / mag(membrane.areas[k]);
        const bool inPatch = magSqr(r) < sqr(toPlane) + patch;
        nearest = min(nearest, inPatch ? toPlane : mag(r));
    }
    return nearest;
}

Foam::dictionary Foam::nucleusReader::group()
{
    // offset is along the axes of the box, where each capsule may be turned
    const vector offset(nucleus_.getOrDefault<vector>("offset", Zero));
    pointField positions(host_.nBodies());
    forAll(positions, body)
    {
        const point centre(host_.initialCentre(body));
        positions[body] = intoBox(grid_, centre + offset);
        if (body > 0 && host_.start().directions.empty()) continue;

        const scalar nearest = toMembrane(body, centre + offset);
        gap_ = min(gap_, nearest - radius_);
        if (nearest > radius_) continue;
        refuse(nucleus_, "radiusRatio",
               Foam::name(radius_ / hostRadius_) + ", a radius of " +
                   Foam::name(radius_) + ",",
               "nuclei inside the capsule, whose membrane comes as close as " +
                   Foam::name(nearest) + " to their centre");
    }

    dictionary nuclei(nucleus_);
    nuclei.remove("radiusRatio");
    nuclei.remove("offset");
    dictionary shape;
    shape.add("type", word("sphere"));
    shape.add("radius", radius_);
    nuclei.add("shape", shape);

    // A dictionary keeps numbers as text: all digits
    const unsigned precision = IOstream::defaultPrecision(17);
    nuclei.add("positions", positions);
    IOstream::defaultPrecision(precision);
    if (capsules_.found("outside"))
    {
        nuclei.add("outside", capsules_.get<word>("outside"), true);
    }
    return nuclei;
}
