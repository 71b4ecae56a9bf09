// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "uniformGrid.H"
#include "boxLattice.H"
#include "dictionaryChecks.H"
#include "ofAllRanks.H"
#include "syncTools.H"
#include "cyclicPolyPatch.H"
#include "processorPolyPatch.H"

namespace Foam
{
defineTypeNameAndDebug(uniformGrid, 0);
} // namespace Foam

namespace
{
using namespace Foam;

//- Centres of the faces that coupled boundary faces meet on the other side [m], by
//  components: vectors would be turned
FixedList<scalarField, 3> centresBeyond(const fvMesh& mesh)
{
    const label begin = mesh.nInternalFaces();
    const SubField<vector> centres(mesh.faceCentres(), mesh.nFaces() - begin,
                                   begin);
    FixedList<scalarField, 3> beyond;
    for (direction d = 0; d < 3; ++d)
    {
        beyond[d] = centres.component(d);
        syncTools::swapBoundaryFaceList(mesh, beyond[d]);
    }
    return beyond;
}

//- Reason why no uniform box has such a coupled patch; else empty
string wrongCoupling(const polyPatch& pp)
{
    if (pp.coupled() && !isA<cyclicPolyPatch>(pp) &&
        !isA<processorPolyPatch>(pp))
    {
        return "of coupled patches it takes cyclic ones only, and patch " +
               pp.name() + " is of type " + pp.type();
    }
    if (isA<coupledPolyPatch>(pp) &&
        !refCast<const coupledPolyPatch>(pp).parallel())
    {
        return "patch " + pp.name() + " is turned onto its neighbour";
    }
    return string::null;
}

//- True if a boundary face lies in a side of the box. Between two ranks inside the box the
//  cell is at the side only by its other face: the position of the face decides
bool inSide(const uniformGrid& grid, const label facei)
{
    const fvMesh& mesh = grid.mesh();
    const direction d = grid.faceDirection(facei);
    const label n = grid.n()[d];
    const scalar x = mesh.faceCentres()[facei][d];
    const scalar origin = grid.origin()[d], h = grid.h()[d];
    return grid.ijk(mesh.faceOwner()[facei])[d] ==
               (grid.lowerSide(facei) ? 0 : n - 1) &&
           (x < origin + 0.5 * h || x > origin + (n - 0.5) * h);
}

//- Distance of a coupled face from the one that it meets [m], less the length of the box
//  between two sides of it. beyond: see centresBeyond()
scalar mismatch(const uniformGrid& grid, const label facei,
                const FixedList<scalarField, 3>& beyond)
{
    const fvMesh& mesh = grid.mesh();
    const label i = facei - mesh.nInternalFaces();
    const direction d = grid.faceDirection(facei);
    const point& x = mesh.faceCentres()[facei];
    const scalar length = grid.n()[d] * grid.h()[d];
    vector away(beyond[0][i] - x.x(), beyond[1][i] - x.y(),
                beyond[2][i] - x.z());
    if (inSide(grid, facei))
    {
        away[d] += grid.lowerSide(facei) ? -length : length;
    }
    return mag(away);
}
} // namespace

Foam::uniformGrid::uniformGrid(const fvMesh& mesh)
    : MeshObject<fvMesh, GeometricMeshObject, uniformGrid>(mesh),
      periodic_(false)
{
    const boxLattice lattice(mesh);
    origin_ = lattice.origin;
    h_ = lattice.h;
    n_ = lattice.n;
    reason_ = lattice.reason;
    number(lattice.cells);
    if (valid()) reason_ = recogniseSides();
}

void Foam::uniformGrid::number(const List<labelVector>& cells)
{
    labelVector lo(labelVector::max), hi(labelVector::min);
    for (const labelVector& c : cells)
    {
        lo = min(lo, c);
        hi = max(hi, c);
    }
    if (cells.size())
    {
        box_.lo = lo;
        box_.size = hi - lo + labelVector::one;
    }
    index_.setSize(cells.size());
    forAll(index_, celli)
    {
        index_[celli] = box_.index(cells[celli]);
    }
}

void Foam::uniformGrid::orientFaces()
{
    const vectorField& areas = mesh_.faceAreas();
    faceDir_.setSize(areas.size());
    forAll(faceDir_, facei)
    {
        const vector s(cmptMag(areas[facei]));
        const direction d =
            (s.x() > s.y() && s.x() > s.z()) ? 0 : (s.y() > s.z() ? 1 : 2);
        faceDir_[facei] = d + (areas[facei][d] < 0 ? 4 : 0);
    }
}

Foam::string Foam::uniformGrid::recogniseSides()
{
    orientFaces();
    const FixedList<scalarField, 3> beyond(centresBeyond(mesh_));

    // A side of the box is periodic where all its faces are coupled
    labelVector coupled(labelVector::zero), closed(labelVector::zero);
    string other;
    for (const polyPatch& pp : mesh_.boundaryMesh())
    {
        const string wrong(wrongCoupling(pp));
        if (!wrong.empty())
        {
            other = wrong;
            continue;
        }
        forAll(pp, i)
        {
            const label facei = pp.start() + i;
            const direction d = faceDirection(facei);
            const bool atSide = inSide(*this, facei);
            if (atSide) (pp.coupled() ? coupled : closed)[d] = 1;
            if (!pp.coupled() && !atSide)
            {
                other = "patch " + pp.name() + " has faces inside the box";
            }
            if (pp.coupled() &&
                mismatch(*this, facei, beyond) > 1e-3 * cmptMin(h_))
            {
                other = "the faces of patch " + pp.name() +
                        " do not face those of its neighbour";
            }
        }
    }
    reduce(coupled, maxOp<labelVector>());
    reduce(closed, maxOp<labelVector>());

    const string reason(firstOf(other));
    if (!reason.empty()) return reason;
    for (direction d = 0; d < 3; ++d)
    {
        if (coupled[d] && closed[d])
        {
            return "direction " + string(vector::componentNames[d]) +
                   " is periodic on a part of its side only";
        }
        periodic_[d] = coupled[d];
    }
    return string::null;
}

Foam::label Foam::uniformGrid::cellAbove(const label facei) const
{
    if (facei < mesh_.nInternalFaces())
    {
        return lowerSide(facei) ? mesh_.faceOwner()[facei]
                                : mesh_.faceNeighbour()[facei];
    }
    return lowerSide(facei) ? mesh_.faceOwner()[facei] : -1;
}

void Foam::uniformGrid::require(const dictionary& dict, const string& who) const
{
    if (!valid())
    {
        waitForMaster();
        FatalIOErrorInFunction(dict)
            << who.c_str() << " needs a mesh that is one box of equal "
            << "hexahedra along the axes, but " << reason_.c_str()
            << exit(FatalIOError);
    }
}

void Foam::uniformGrid::requirePeriodic(const dictionary& dict,
                                        const string& who) const
{
    require(dict, who);
    for (direction d = 0; d < 3; ++d)
    {
        if (periodic_[d]) continue;
        waitForMaster();
        FatalIOErrorInFunction(dict)
            << who.c_str() << " needs a box that is periodic in all "
            << "directions, but " << vector::componentNames[d] << " is not"
            << exit(FatalIOError);
    }
}

void Foam::uniformGrid::toStaggered(const surfaceScalarField& phi,
                                    staggeredField& u) const
{
    // Faces of walls, and positions of other ranks' cells
    u.clear();
    lowerFaces(phi, [&](const label celli, const direction d, const scalar x)
               { u[d][index_[celli]] = x; });
}

void Foam::uniformGrid::toFlux(const staggeredView& u,
                               surfaceScalarField& flux) const
{
    const fvMesh& mesh = mesh_;

    const auto fluxOf = [&](const label facei)
    {
        const label celli = cellAbove(facei);
        if (celli < 0) return 0.0;
        const direction d = faceDirection(facei);
        const label index = u.index(ijk(celli) - box_.lo);
        const scalar value = faceArea(d) * (u.factor * u.first[d][index]);
        return lowerSide(facei) ? -value : value;
    };
    forAll(flux, facei)
    {
        flux[facei] = fluxOf(facei);
    }

    // The upper side of a coupled pair takes the (outward) flux of the lower
    const label begin = mesh.nInternalFaces();
    scalarField other(mesh.nFaces() - begin);
    forAll(other, i)
    {
        other[i] = fluxOf(begin + i);
    }
    syncTools::swapBoundaryFaceList(mesh, other);

    surfaceScalarField::Boundary& bf = flux.boundaryFieldRef();
    forAll(bf, patchi)
    {
        const polyPatch& pp = mesh.boundaryMesh()[patchi];
        forAll(bf[patchi], i)
        {
            const label facei = pp.start() + i;
            bf[patchi][i] = !pp.coupled()      ? 0
                            : lowerSide(facei) ? fluxOf(facei)
                                               : -other[facei - begin];
        }
    }
}

Foam::List<Foam::labelVector> Foam::uniformGrid::cells() const
{
    List<labelVector> all(index_.size());
    forAll(all, celli)
    {
        all[celli] = ijk(celli);
    }
    return all;
}

Foam::List<Foam::cellBox> Foam::uniformGrid::allBoxes() const
{
    const List<labelList> corners(
        ofAllRanks(labelList({box_.lo.x(), box_.lo.y(), box_.lo.z(),
                              box_.size.x(), box_.size.y(), box_.size.z()})));

    List<cellBox> boxes(Pstream::nProcs());
    forAll(boxes, proci)
    {
        const labelList& c = corners[proci];
        boxes[proci].lo = labelVector(c[0], c[1], c[2]);
        boxes[proci].size = labelVector(c[3], c[4], c[5]);
    }
    return boxes;
}
