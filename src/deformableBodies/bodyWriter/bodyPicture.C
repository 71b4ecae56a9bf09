// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyPicture.H"
#include "foamVtkOutput.H"

Foam::bodyPicture::fields Foam::bodyPicture::pack(const bodySurface& s)
{
    DynamicList<scalarField> p;
    const auto add = [&](const vectorField& v)
    {
        for (direction d = 0; d < 3; ++d)
        {
            p.append(scalarField(v.component(d)));
        }
    };
    add(s.points);
    for (const vectorField& v : s.vectors)
    {
        add(v);
    }
    p.append(s.scalars);
    return fields(std::move(p));
}

Foam::bodyPicture::bodyPicture(const fileName& file, const scalar time,
                               const bodySurface& layout)
    : vtk::fileWriter(vtk::fileTag::POLY_DATA, vtk::formatType::INLINE_BASE64),
      layout_(layout)
{
    open(file, false);
    writeTimeValue(time);
}

// Scalars and vectors are written in single precision
template<class Type, class Values>
void Foam::bodyPicture::array(const word& name, const label n, Values values)
{
    using component =
        typename std::conditional<std::is_same<Type, label>::value, label,
                                  float>::type;
    constexpr direction nComponents = pTraits<Type>::nComponents;
    format().beginDataArray<component, nComponents>(name);
    format().writeSize(uint64_t(n) * nComponents * sizeof(component));
    for (label i = 0; i < n; ++i)
    {
        vtk::write(format(), Type(values(i)));
    }
    format().flush();
    format().endDataArray();
}

void Foam::bodyPicture::write(const UList<label>& numbers,
                              const List<fields>& bodies)
{
    const label nPoints = bodies[0][0].size();
    const label nAll = bodies.size() * nPoints;
    const label nFaces = layout_.faces.size();
    DynamicList<label> corners;
    labelList ends(nFaces);
    forAll(layout_.faces, f)
    {
        corners.append(layout_.faces[f]);
        ends[f] = corners.size();
    }
    const label nCorners = corners.size();
    const auto cells =
        layout_.lines ? vtk::fileTag::LINES : vtk::fileTag::POLYS;
    const auto vectors = [&](const label k)
    {
        return [&bodies, nPoints, k](const label i)
        {
            const fields& b = bodies[i / nPoints];
            const label pointi = i % nPoints;
            return vector(b[k][pointi], b[k + 1][pointi], b[k + 2][pointi]);
        };
    };
    const auto scalars = [&](const label k)
    {
        return [&bodies, nPoints, k](const label i)
        { return bodies[i / nPoints][k][i % nPoints]; };
    };

    enter_Piece();
    format().tag(vtk::fileTag::PIECE, vtk::fileAttr::NUMBER_OF_POINTS, nAll,
                 layout_.lines ? vtk::fileAttr::NUMBER_OF_LINES
                               : vtk::fileAttr::NUMBER_OF_POLYS,
                 bodies.size() * nFaces);
    format().tag(vtk::fileTag::POINTS);
    array<vector>("Points", nAll, vectors(0));
    format().endTag(vtk::fileTag::POINTS);
    format().tag(cells);
    array<label>("connectivity", bodies.size() * nCorners,
                 [&](const label i)
                 { return i / nCorners * nPoints + corners[i % nCorners]; });
    array<label>("offsets", bodies.size() * nFaces,
                 [&](const label i)
                 { return i / nFaces * nCorners + ends[i % nFaces]; });
    format().endTag(cells);

    const label nVectors = layout_.vectorNames.size();
    enter_PointData(nAll, 1 + nVectors + layout_.scalarNames.size());
    array<scalar>("body", nAll,
                  [&](const label i) { return numbers[i / nPoints]; });
    forAll(layout_.vectorNames, v)
    {
        array<vector>(layout_.vectorNames[v], nAll, vectors(3 * (v + 1)));
    }
    forAll(layout_.scalarNames, s)
    {
        array<scalar>(layout_.scalarNames[s], nAll,
                      scalars(3 * (nVectors + 1) + s));
    }
    endPiece();
}
