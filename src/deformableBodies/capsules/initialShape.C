// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "initialShape.H"
#include "capsule.H"
#include "dictionaryChecks.H"
#include "IFstream.H"
#include "MeshedSurface.H"
#include "OSspecific.H"
#include "packing.H"
#include "stringOps.H"
#include "triSurface.H"
#include "triSurfaceSearch.H"
#include <cmath>
#include <functional>

namespace
{
using namespace Foam;

//- Entry file of a shape; FatalIOError if the file does not exist
fileName fileOf(const dictionary& dict)
{
    requireEntry(dict, "file");
    const fileName given(dict.get<fileName>("file"));
    const fileName file(fileName(given).expand());
    if (!isFile(file))
    {
        refuse(dict, "file", given,
               "a file that can be read; without / at its start it is looked "
               "for in the folder where the program was started, " +
                   cwd());
    }
    return file;
}

//- Entry scale, 1 if it is not given
scalar scaleOf(const dictionary& dict)
{
    return dict.found("scale") ? readPositive(dict, "scale", dimless) : 1;
}

//- Format of a surface from the extension of its file, in any letter case
word formatOf(const dictionary& dict)
{
    const fileName given(dict.get<fileName>("file"));
    const fileName file(given.ext() == "gz" ? given.lessExt() : given);
    const word format(stringOps::lower(file.ext()));
    wordHashSet known(MeshedSurface<labelledTri>::readTypes());
    known.insert("ftr");
    known.insert("stl");
    known.insert("stlb");
    if (!known.found(format))
    {
        refuse(dict, "file", given,
               "surfaces in a file that ends in one of " +
                   oneOf(known.sortedToc()) +
                   ", such as surfaceConvert and surfaceMeshConvert write; or "
                   "the state of a run, with an entry group");
    }
    return given.ext() == "gz" ? word("gz") : format;
}

//- Closed triangulated surface that is star-shaped about its centre of volume
class starSurface
{
    const dictionary& dict_;
    triSurface surface_;
    triSurfaceSearch search_;
    point centre_ = Zero;

    //- Distance from the centre that is beyond all points of the surface [m]
    scalar reach_;

    void refuseFile(const string& why) const
    {
        waitForMaster();
        FatalIOErrorInFunction(dict_)
            << "entry file: " << dict_.get<fileName>("file").c_str() << " "
            << why.c_str() << nl
            << "    allowed: a closed triangulated surface without holes,"
            << " all of which is seen from its centre" << exit(FatalIOError);
    }

    //- FatalIOError unless all triangles have the same orientation: the two triangles at
    //  an edge must pass it in opposite directions
    void requireOrientation() const
    {
        forAll(surface_.edges(), edgei)
        {
            const edge& e = surface_.edges()[edgei];
            const label first = surface_.edgeFaces()[edgei][0],
                        second = surface_.edgeFaces()[edgei][1];
            if (surface_.localFaces()[first].edgeDirection(e) !=
                surface_.localFaces()[second].edgeDirection(e))
            {
                continue;
            }
            const point corner(surface_.localPoints()[e[0]]);
            refuseFile("has triangles that turn different ways, numbers " +
                       Foam::name(first) + " and " + Foam::name(second) +
                       " at (" + Foam::name(corner.x()) + ' ' +
                       Foam::name(corner.y()) + ' ' + Foam::name(corner.z()) +
                       "): surfaceOrient makes them turn the same way");
        }
    }

public:
    explicit starSurface(const dictionary& dict)
        : dict_(dict),
          surface_(fileOf(dict), formatOf(dict), scaleOf(dict)),
          search_(surface_)
    {
        for (const labelList& faces : surface_.edgeFaces())
        {
            if (faces.size() != 2)
            {
                refuseFile("is open, or edges belong to more than two faces");
            }
        }
        requireOrientation();
        scalar volume = 0;
        const pointField& points = surface_.points();
        for (const labelledTri& t : surface_)
        {
            const vector &a = points[t[0]], &b = points[t[1]],
                         &c = points[t[2]];
            const scalar v = (a & (b ^ c)) / 6;
            volume += v;
            centre_ += v * (a + b + c) / 4;
        }
        const scalar size = mag(boundBox(points, false).span());
        if (mag(volume) < 1e-6 * pow3(size))
        {
            refuseFile("encloses no volume: it crosses itself");
        }
        centre_ /= volume;
        reach_ = 2 * size;
    }

    //- Point of the surface in the direction e from the centre, relative to the centre
    point pointAlong(const vector& e) const
    {
        List<List<pointIndexHit>> met;
        search_.findLineAll(pointField(1, centre_),
                            pointField(1, centre_ + reach_ * e), met);
        if (met[0].empty())
            refuseFile("has a hole, or its centre lies outside");

        const scalar distance = mag(met[0][0].hitPoint() - centre_);
        for (const pointIndexHit& hit : met[0])
        {
            // A ray through an edge meets two triangles at the same distance
            if (mag(mag(hit.hitPoint() - centre_) - distance) > 1e-6 * distance)
            {
                refuseFile(
                    "is not star-shaped: the ray from its centre along (" +
                    Foam::name(e.x()) + " " + Foam::name(e.y()) + " " +
                    Foam::name(e.z()) + ") meets it more than once");
            }
        }
        return distance * e;
    }
};

//- Coefficients of a body of a restart file, relative to their mean, times the entry scale.
//  turn: rotation of the shape
std::vector<double> savedShape(const dictionary& dict,
                               const sphericalHarmonics& grid,
                               const tensor& turn)
{
    const scalar scale = scaleOf(dict);
    const fileName file(fileOf(dict));
    const auto refuseState = [&](const string& why)
    { refuse(dict, "file", file, "a state of bodies with " + why); };

    IFstream is(file);
    const dictionary saved(is);
    const word group(dict.get<word>("group"));
    if (!saved.found(group)) refuseState("a group " + group);
    const List<scalarList> states(saved.get<List<scalarList>>(group));
    const label body = dict.getOrDefault<label>("body", 0);
    if (body < 0 || body >= states.size())
    {
        refuseState("a body " + Foam::name(body) + " in group " + group);
    }

    const label N = capsule::degreeOf(states[body]);
    if (N < 1) refuseState("coefficients of capsules");
    const sphericalHarmonics other(N, N + 2);
    std::vector<double> coeffs(3 * grid.nCoeffs());
    for (int n = 1; n <= min(N, label(grid.degree())); ++n)
    {
        for (int m = 0; m <= n; ++m)
        {
            for (int sine = 0; sine <= (m ? 1 : 0); ++sine)
            {
                const scalar* x =
                    states[body].cdata() + 1 + 3 * other.index(n, m, sine);
                const vector turned(turn & vector(x[0], x[1], x[2]));
                for (direction d = 0; d < 3; ++d)
                {
                    coeffs[3 * grid.index(n, m, sine) + d] = scale * turned[d];
                }
            }
        }
    }
    return coeffs;
}

//- Point of a surface [m] in each direction of the unit sphere
using pointOf = std::function<vector(const vector&)>;

//- Shapes of the types sphere, ellipsoid and biconcave
pointOf sphere(const dictionary& dict)
{
    checkEntries(dict, {"type", "radius", "axis"});
    const scalar R = readPositive(dict, "radius", dimLength);
    return [=](const vector& e) { return R * e; };
}

pointOf ellipsoid(const dictionary& dict)
{
    checkEntries(dict, {"type", "semiAxes", "axis"});
    requireEntry(dict, "semiAxes");
    const vector s(dict.get<vector>("semiAxes"));
    if (!(cmptMin(s) > 0))
    {
        refuse(dict, "semiAxes", Foam::name(cmptMin(s)),
               "three numbers greater than 0");
    }
    return [=](const vector& e) { return cmptMultiply(s, e); };
}

pointOf biconcave(const dictionary& dict)
{
    checkEntries(dict, {"type", "radius", "axis"});
    const scalar R = readPositive(dict, "radius", dimLength);
    return [=](const vector& e)
    {
        const scalar r2 = sqr(e.x()) + sqr(e.y());
        return R * vector(e.x(), e.y(),
                          0.5 * e.z() * (0.207 + 2.003 * r2 - 1.123 * sqr(r2)));
    };
}

//- Coefficients (nCoeffs x 3) of a shape given by its points. turn: rotation of the shape
std::vector<double> expand(const pointOf& shape, const sphericalHarmonics& grid,
                           const tensor& turn)
{
    const int n = grid.nPoints();
    std::vector<double> values(3 * n), coeffs(3 * grid.nCoeffs());
    for (int k = 0; k < n; ++k)
    {
        const double t = grid.theta(k / grid.nPhi());
        const double p = grid.phi(k % grid.nPhi());
        const vector x(turn &
                       shape(vector(std::sin(t) * std::cos(p),
                                    std::sin(t) * std::sin(p), std::cos(t))));
        for (direction d = 0; d < 3; ++d)
        {
            values[d * n + k] = x[d];
        }
    }
    grid.analysis(values.data(), coeffs.data());
    return coeffs;
}
} // namespace

std::vector<double> Foam::initialShape(const dictionary& dict,
                                       const sphericalHarmonics& grid)
{
    requireEntry(dict, "type");
    const word type(dict.get<word>("type"));
    const vector axis(dict.getOrDefault<vector>("axis", vector(0, 0, 1)));
    if (!(mag(axis) > 0)) refuse(dict, "axis", "(0 0 0)", "a direction");
    const tensor turn(turnTo(axis / mag(axis)));

    if (type == "sphere") return expand(sphere(dict), grid, turn);
    if (type == "ellipsoid") return expand(ellipsoid(dict), grid, turn);
    if (type == "biconcave") return expand(biconcave(dict), grid, turn);
    if (type != "fromFile")
    {
        refuse(dict, "type", type, "(sphere ellipsoid biconcave fromFile)");
    }
    checkEntries(dict, {"type", "file", "scale", "axis", "group", "body"});
    if (dict.found("group")) return savedShape(dict, grid, turn);
    if (dict.found("body"))
    {
        refuse(dict, "body", valueOf(*dict.findEntry("body")),
               "shapes from the state of a run, with an entry group");
    }
    const starSurface surface(dict);
    return expand([&](const vector& e) { return surface.pointAlong(e); }, grid,
                  turn);
}
