// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "uniformBoxes.H"
#include "addToRunTimeSelectionTable.H"
#include "boxLattice.H"
#include "cyclicPolyPatch.H"
#include "planeTransform.H"

namespace Foam
{
defineTypeNameAndDebug(uniformBoxes, 0);
addToRunTimeSelectionTable(decompositionMethod, uniformBoxes, dictionary);
} // namespace Foam

namespace
{
using namespace Foam;

//- Values that the busiest rank sends in a step: those beside its cuts seven times, and
//  those of planes of the fast transform that other ranks hold, there and back
int64_t sent(const labelVector& cells, const labelVector& blocks,
             const FixedList<bool, 3>& periodic, const direction swept)
{
    const label ranks = blocks.x() * blocks.y() * blocks.z();
    int64_t most = 0;
    for (label rank = 0; rank < ranks; ++rank)
    {
        const labelVector at(rank % blocks.x(), rank / blocks.x() % blocks.y(),
                             rank / blocks.x() / blocks.y());
        labelVector lo, size;
        for (direction d = 0; d < 3; ++d)
        {
            const label least = cells[d] / blocks[d],
                        larger = cells[d] % blocks[d];
            lo[d] = at[d] * least + min(at[d], larger);
            size[d] = least + (at[d] < larger ? 1 : 0);
        }
        const int64_t all = int64_t(size.x()) * size.y() * size.z();
        int64_t faces = 0;
        for (direction d = 0; d < 3; ++d)
        {
            const int sides = blocks[d] == 1 ? 0
                              : periodic[d]
                                  ? 2
                                  : (at[d] > 0) + (at[d] + 1 < blocks[d]);
            faces += sides * all / size[d];
        }
        const label n = cells[swept];
        const label begin =
            max(lo[swept], planeTransform::firstDealt(n, rank, ranks));
        const label end = min(lo[swept] + size[swept],
                              planeTransform::firstDealt(n, rank + 1, ranks));
        const int64_t own = max(end - begin, 0) * (all / size[swept]);
        most = max(most, 7 * faces + 2 * (all - own));
    }
    return most;
}

//- Values that the busiest rank sends, with the direction that will be swept
int64_t sent(const labelVector& cells, const labelVector& blocks,
             const FixedList<bool, 3>& periodic)
{
    int64_t least =
        sent(cells, blocks, periodic, planeTransform::swept(cells, periodic));
    if (!periodic[0] || !periodic[1] || !periodic[2]) return least;
    for (direction d = 0; d < 3; ++d)
    {
        if (cells[d] > 1)
        {
            least = min(least, sent(cells, blocks, periodic, d));
        }
    }
    return least;
}

//- Directions in which the mesh has cyclic patches (collective)
FixedList<bool, 3> periodicDirections(const polyMesh& mesh)
{
    FixedList<bool, 3> periodic(false);
    for (const polyPatch& pp : mesh.boundaryMesh())
    {
        if (!isA<cyclicPolyPatch>(pp) || pp.empty()) continue;
        const vector s(cmptMag(mesh.faceAreas()[pp.start()]));
        periodic[s.x() > s.y() && s.x() > s.z() ? 0
                 : s.y() > s.z()                ? 1
                                                : 2] = true;
    }
    for (bool& p : periodic)
    {
        reduce(p, orOp<bool>());
    }
    return periodic;
}

std::string text(const labelVector& n)
{
    return Foam::name(n.x()) + " x " + Foam::name(n.y()) + " x " +
           Foam::name(n.z());
}
} // namespace

Foam::uniformBoxes::uniformBoxes(const dictionary& decompDict,
                                 const word& regionName)
    : decompositionMethod(decompDict, regionName)
{
}

Foam::labelVector Foam::uniformBoxes::counts(const labelVector& cells,
                                             const label ranks,
                                             const FixedList<bool, 3>& periodic)
{
    // In the order of preference
    labelVector best(labelVector::zero);
    for (label x = 1; x <= min(ranks, cells.x()); ++x)
    {
        if (ranks % x) continue;
        for (label y = 1; y <= min(ranks / x, cells.y()); ++y)
        {
            const labelVector n(x, y, ranks / x / y);
            if (ranks / x % y || n.z() > cells.z()) continue;
            if (best == labelVector::zero ||
                sent(cells, n, periodic) < sent(cells, best, periodic))
            {
                best = n;
            }
        }
    }
    return best;
}

Foam::label Foam::uniformBoxes::part(const label n, const label parts,
                                     const label item)
{
    const label least = n / parts, larger = n % parts;
    const label inLarger = larger * (least + 1);
    return item < inLarger ? item / (least + 1)
                           : larger + (item - inLarger) / least;
}

Foam::labelVector
Foam::uniformBoxes::readCounts(const labelVector& cells,
                               const FixedList<bool, 3>& periodic) const
{
    const dictionary& coeffs =
        findCoeffsDict(typeName + "Coeffs", selectionType::NULL_DICT);
    labelVector n;
    if (coeffs.readIfPresent("n", n))
    {
        const bool fits = cmptMin(n) > 0 && cmptMin(cells - n) >= 0;
        if (!fits || n.x() * n.y() * n.z() != nDomains())
        {
            FatalIOErrorInFunction(coeffs)
                << "entry n has the value " << n << nl
                << "    allowed: three numbers with the product " << nDomains()
                << " (numberOfSubdomains), at most " << text(cells).c_str()
                << " (the cells)" << exit(FatalIOError);
        }
        return n;
    }

    n = nDomains() > 0 ? counts(cells, nDomains(), periodic)
                       : labelVector::zero;
    if (n == labelVector::zero)
    {
        // The nearest numbers that can be had
        label below = max(min(nDomains() - 1, cmptProduct(cells)), label(1));
        while (counts(cells, below) == labelVector::zero)
        {
            --below;
        }
        FatalIOErrorInFunction(decompDict_)
            << "entry numberOfSubdomains has the value " << nDomains() << nl
            << "    allowed: products of three numbers of blocks with at least "
            << "one layer of cells each," << nl << "    at most "
            << text(cells).c_str() << "; the next lower one is " << below
            << exit(FatalIOError);
    }
    return n;
}

Foam::labelList Foam::uniformBoxes::decompose(const polyMesh& mesh,
                                              const pointField& points,
                                              const scalarField&) const
{
    const boxLattice lattice(mesh);
    const auto refuse = [&](const string& reason)
    {
        FatalIOErrorInFunction(decompDict_)
            << "entry method has the value uniformBoxes, which "
            << reason.c_str() << nl
            << "    allowed: other methods, such as scotch"
            << exit(FatalIOError);
    };
    if (!lattice.valid())
    {
        refuse("needs a mesh that is one box of equal hexahedra along the "
               "axes, but " +
               lattice.reason);
    }
    if (returnReduce(points.size() != mesh.nCells(), orOp<bool>()))
    {
        refuse("cannot keep cells together as the constraints ask for");
    }

    const labelVector n(readCounts(lattice.n, periodicDirections(mesh)));
    Info << typeName << ": " << text(lattice.n).c_str() << " cells in "
         << text(n).c_str() << " blocks" << endl;

    labelList rank(points.size());
    forAll(rank, celli)
    {
        labelVector block;
        for (direction d = 0; d < 3; ++d)
        {
            block[d] = part(lattice.n[d], n[d], lattice.cells[celli][d]);
        }
        rank[celli] = block.x() + n.x() * (block.y() + n.y() * block.z());
    }
    return rank;
}

Foam::labelList Foam::uniformBoxes::decompose(const labelListList&,
                                              const pointField&,
                                              const scalarField&) const
{
    NotImplemented;
    return labelList();
}

Foam::labelList Foam::uniformBoxes::decompose(const CompactListList<label>&,
                                              const pointField&,
                                              const scalarField&) const
{
    NotImplemented;
    return labelList();
}
