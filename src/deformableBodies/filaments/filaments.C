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
    checkEntries(dict,
                 {"type", "length", "diameter", "segments", "bendingRigidity",
                  "densityRatio", "ends", "positions", "directions", "gravity",
                  "coupling", "shearPlane", "scheme"});
    if (twoWay())
    {
        refuse(dict, "coupling", "twoWay",
               "oneWay or none; filaments do not act on the fluid yet");
    }

    properties_.length = readPositive(dict, "length", dimLength);
    const scalar diameter = readPositive(dict, "diameter", dimLength);
    radius_ = 0.5 * diameter;
    properties_.segments = byAccuracy<label>(dict, "segments", 16, 32, 64);
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

    // Mass, weight, drag
    const scalar displaced =
        scene.rho * constant::mathematical::pi * sqr(radius_);
    const scalar ratio = dict.found("densityRatio")
                             ? readPositive(dict, "densityRatio", dimless)
                             : 1;
    properties_.mass = ratio * displaced;
    if (readGravity(dict))
    {
        weight_ = (ratio - (alone() ? 0 : 1)) * displaced * scene.g;
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
    properties_.dragRatio = 1;
    if (!alone())
    {
        const scalar slender = std::log(properties_.length / radius_);
        if (slender < 1)
        {
            refuse(dict, "diameter", Foam::name(diameter),
                   "less than " +
                       Foam::name(2 * properties_.length / std::exp(1.0)) +
                       " at this length, for the drag of a slender body");
        }
        const scalar pi = constant::mathematical::pi;
        drag_ = 4 * pi * scene.mu / (slender + 0.193);
        properties_.dragRatio = 2 * pi * scene.mu / (slender - 0.807) / drag_;
    }

    const pointField positions(readPositions(dict));
    const vectorField directions(dict.lookup("directions"));
    if (directions.size() != positions.size())
    {
        refuse(dict, "directions", Foam::name(directions.size()) + " vectors",
               "as many as positions, " + Foam::name(positions.size()));
    }
    filaments_.reserve(mine().size());
    forAll(positions, body)
    {
        if (!(mag(directions[body]) > 0))
        {
            refuse(dict, "directions", "(0 0 0)", "directions");
        }
        const filament x(properties_, positions[body], directions[body]);
        checkFits(dict, x, body);
        if (mine().found(body)) filaments_.push_back(x);
    }

    scene_.effects.declare("filament", true,
                           Foam::name(nBodies()) + " filaments of " +
                               Foam::name(properties_.segments) +
                               " segments, " + ends[0] + " " + ends[1]);
    scene_.effects.declare("gravity", weight_ != vector::zero,
                           weight_ != vector::zero ? "weight of the filaments"
                                                   : "none on the bodies");
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

Foam::label Foam::filaments::nMarkers() const
{
    return alone() ? 0 : label(filaments_.size()) * nNodes();
}

void Foam::filaments::markers(vector* X) const
{
    if (alone()) return;
    for (const filament& x : filaments_)
    {
        X = std::copy(x.places().begin(), x.places().end(), X);
    }
}

Foam::string Foam::filaments::move(const vector* U, const scalar dt)
{
    const auto timing(scene_.effects.time("filament"));
    const label n = nNodes();
    const vectorField f(n, weight_);
    const scalarField c(n, drag_);
    vectorField u(n, Zero);
    string trouble;
    for (size_t i = 0; i < filaments_.size(); ++i)
    {
        if (!alone())
        {
            std::copy(U, U + n, u.begin());
            U += n;
        }
        if (!filaments_[i].step(dt, f, c, u))
        {
            trouble = "body " + Foam::name(mine()[i]) + " of group " + name() +
                      ": no tension holds its length, even in a 64th of the "
                      "step";
        }
    }
    return trouble;
}

Foam::wordList Foam::filaments::columns() const
{
    return {"x",      "y",          "z",        "tipX",
            "tipY",   "tipZ",       "endToEnd", "lengthError",
            "energy", "maxTension", "angle",    "iterations"};
}

Foam::scalarList Foam::filaments::sample(const label i) const
{
    const filament& x = filaments_[i];
    const vectorField& X = x.places();
    const label N = properties_.segments;
    vector centre(Zero);
    for (label k = 0; k < N; ++k)
    {
        centre += 0.5 / N * (X[k] + X[k + 1]);
    }
    const vector across(X[N] - X[0]);
    return {centre.x(),
            centre.y(),
            centre.z(),
            X[N].x(),
            X[N].y(),
            X[N].z(),
            mag(across),
            x.lengthError(),
            x.kineticEnergy() + x.bendingEnergy(),
            max(x.tensions()),
            180 / constant::mathematical::pi *
                std::atan2(across[shearPlane_[1]], across[shearPlane_[0]]),
            scalar(x.iterations())};
}

// A tube of six sides, so that it is seen as thick as it is
Foam::bodySurface Foam::filaments::surface(const label i) const
{
    const filament& x = filaments_[i];
    const vectorField& X = x.places();
    const label N = properties_.segments, sides = 6, n = sides * (N + 1);

    bodySurface s;
    s.vectorNames = {"velocity"};
    s.scalarNames = {"tension", "curvature"};
    s.vectors.setSize(1, vectorField(n));
    s.scalars.setSize(2, scalarField(n));
    s.points.setSize(n);
    vector e(Zero);
    for (label k = 0; k <= N; ++k)
    {
        const label before = max(k - 1, label(0)), after = min(k + 1, N);
        vector t(X[after] - X[before]);
        t /= mag(t);

        // The frame follows the filament without turning about it
        if (k == 0) e = mag(t.x()) < 0.7 ? vector(1, 0, 0) : vector(0, 1, 0);
        e -= (e & t) * t;
        e /= mag(e);
        const scalar curvature =
            k > 0 && k < N
                ? mag(X[k + 1] - 2 * X[k] + X[k - 1]) / sqr(properties_.ds())
                : 0;
        const scalar tension = 0.5 * (x.tensions()[max(k - 1, label(0))] +
                                      x.tensions()[min(k, N - 1)]);
        for (label j = 0; j < sides; ++j)
        {
            const scalar a = constant::mathematical::twoPi * j / sides;
            const label p = sides * k + j;
            s.points[p] =
                X[k] + radius_ * (std::cos(a) * e + std::sin(a) * (t ^ e));
            s.vectors[0][p] = x.velocities()[k];
            s.scalars[0][p] = tension;
            s.scalars[1][p] = curvature;
        }
    }
    DynamicList<face> faces;
    for (label k = 0; k < N; ++k)
    {
        for (label j = 0; j < sides; ++j)
        {
            const label a = sides * k + j, b = sides * k + (j + 1) % sides;
            face quad(4);
            quad[0] = a;
            quad[1] = b;
            quad[2] = b + sides;
            quad[3] = a + sides;
            faces.append(quad);
        }
    }
    s.faces.transfer(faces);
    return s;
}

Foam::scalarList Foam::filaments::state(const label i) const
{
    DynamicList<scalar> s;
    filaments_[i].save(s);
    return scalarList(std::move(s));
}

void Foam::filaments::setState(const label i, const scalarList& state,
                               const dictionary& source)
{
    if (state.size() != filaments_[i].stateSize())
    {
        FatalIOErrorInFunction(source)
            << "the saved state of body " << mine()[i] << " has "
            << state.size() << " numbers where " << filaments_[i].stateSize()
            << " belong to its segments: was the entry segments changed?"
            << exit(FatalIOError);
    }
    filaments_[i].restore(state.cdata());
}
