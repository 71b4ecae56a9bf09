// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testBox.H"
#include "zeroGradientFvPatchFields.H"

using namespace Foam;

test::box::box(const labelVector& n, const vector& length,
               const FixedList<bool, 3>& walls, const scalar viscosity,
               const word& wallType)
{
    const auto point = [&](label i, label j, label k)
    { return i + (n.x() + 1) * (j + (n.y() + 1) * k); };
    const auto cell = [&](const labelVector& c)
    { return c.x() + n.x() * (c.y() + n.y() * c.z()); };

    pointField points((n.x() + 1) * (n.y() + 1) * (n.z() + 1));
    for (label k = 0; k <= n.z(); ++k)
    {
        for (label j = 0; j <= n.y(); ++j)
        {
            for (label i = 0; i <= n.x(); ++i)
            {
                points[point(i, j, k)] =
                    vector(i * length.x() / n.x(), j * length.y() / n.y(),
                           k * length.z() / n.z());
            }
        }
    }

    // Set the lower face of a cell in direction d
    const auto faceBelow = [&](const labelVector& c, const direction d)
    {
        const label i = c.x(), j = c.y(), k = c.z();
        return d == 0   ? face({point(i, j, k), point(i, j + 1, k),
                                point(i, j + 1, k + 1), point(i, j, k + 1)})
               : d == 1 ? face({point(i, j, k), point(i, j, k + 1),
                                point(i + 1, j, k + 1), point(i + 1, j, k)})
                        : face({point(i, j, k), point(i + 1, j, k),
                                point(i + 1, j + 1, k), point(i, j + 1, k)});
    };

    DynamicList<face> faces;
    DynamicList<label> owner, neighbour;
    const auto eachCell = [&](auto visit)
    {
        for (label k = 0; k < n.z(); ++k)
        {
            for (label j = 0; j < n.y(); ++j)
            {
                for (label i = 0; i < n.x(); ++i)
                {
                    visit(labelVector(i, j, k));
                }
            }
        }
    };
    eachCell(
        [&](const labelVector& c)
        {
            for (direction d = 0; d < 3; ++d)
            {
                labelVector up(c);
                if (++up[d] == n[d]) continue;
                faces.append(faceBelow(up, d));
                owner.append(cell(c));
                neighbour.append(cell(up));
            }
        });

    wordList names;
    labelList starts;
    for (direction d = 0; d < 3; ++d)
    {
        for (const bool upper : {false, true})
        {
            names.append(word(vector::componentNames[d]) +
                         (upper ? "Upper" : "Lower"));
            starts.append(faces.size());
            eachCell(
                [&](const labelVector& c)
                {
                    if (c[d] != (upper ? n[d] - 1 : 0)) return;
                    labelVector above(c);
                    if (upper) ++above[d];
                    const face f(faceBelow(above, d));
                    faces.append(upper ? f : f.reverseFace());
                    owner.append(cell(c));
                });
        }
    }
    starts.append(faces.size());

    static label number = 0;
    const Time& time = test::mesh().time();
    mesh_.reset(
        new fvMesh(IOobject("box" + Foam::name(number++), time.timeName(), time,
                            IOobject::NO_READ, IOobject::NO_WRITE),
                   std::move(points), faceList(std::move(faces)),
                   std::move(owner), std::move(neighbour)));
    List<polyPatch*> patches(6);
    wordList forU(6), forP(6);
    forAll(patches, i)
    {
        const bool wall = walls[i / 2];
        dictionary dict;
        dict.add("type", wall ? "wall" : "cyclic");
        dict.add("nFaces", starts[i + 1] - starts[i]);
        dict.add("startFace", starts[i]);
        if (!wall) dict.add("neighbourPatch", names[i ^ 1]);
        patches[i] =
            polyPatch::New(names[i], dict, i, mesh_->boundaryMesh()).ptr();
        forU[i] = wall ? wallType : word("cyclic");
        forP[i] =
            wall ? zeroGradientFvPatchScalarField::typeName : word("cyclic");
    }
    mesh_->addFvPatches(patches);

    const auto io = [&](const char* name)
    { return IOobject(name, time.timeName(), *mesh_); };
    U.reset(new volVectorField(io("U"), *mesh_,
                               dimensionedVector(dimVelocity, Zero), forU));
    p.reset(new volScalarField(
        io("p"), *mesh_, dimensionedScalar(sqr(dimVelocity), Zero), forP));
    nu.reset(new volScalarField(
        io("nu"), *mesh_, dimensionedScalar("nu", dimViscosity, viscosity)));
    phi.reset(new surfaceScalarField(
        io("phi"), *mesh_, dimensionedScalar(dimVolume / dimTime, Zero)));
    phi->setOriented();
}

void test::box::moveWalls(const vector& lower, const vector& upper)
{
    U->boundaryFieldRef()[2] == lower;
    U->boundaryFieldRef()[3] == upper;
}

std::unique_ptr<staggeredFlow> test::box::flow(const char* controls)
{
    effects.reset(new effectTable(mesh_->time()));
    for (const word name : {"momentum", "diffusion", "pressure", "fields"})
    {
        effects->declare(name, true, "");
    }
    IStringStream is(controls);
    return std::unique_ptr<staggeredFlow>(
        new staggeredFlow(*U, *p, *phi, *nu, dictionary(is), *effects));
}
