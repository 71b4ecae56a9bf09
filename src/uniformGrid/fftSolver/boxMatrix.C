// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "boxMatrix.H"

namespace
{
using namespace Foam;

// Coefficients computed from a mesh of 10 digits differ by 1e-9 and more; a
// coefficient that is meant to vary does so by far more than this. Solutions
// are refined to the tolerance asked for with the true matrix.
const scalar constantTolerance = 1e-5;

//- Smallest, largest and sum of a set of values over all ranks
struct spread
{
    scalar low = GREAT, high = -GREAT, sum = 0, count = 0;

    void add(const scalar x, const scalar weight = 1)
    {
        low = min(low, x);
        high = max(high, x);
        sum += weight * x;
        count += weight;
    }

    bool any() const { return count > 0; }
    scalar mean() const { return sum / max(count, scalar(1)); }

    static void reduce(UList<spread>& all)
    {
        scalarField lows(all.size()), highs(all.size()), sums(2 * all.size());
        forAll(all, i)
        {
            lows[i] = all[i].low;
            highs[i] = all[i].high;
            sums[2 * i] = all[i].sum;
            sums[2 * i + 1] = all[i].count;
        }
        Pstream::listCombineGather(lows, minEqOp<scalar>());
        Pstream::listCombineScatter(lows);
        Pstream::listCombineGather(highs, maxEqOp<scalar>());
        Pstream::listCombineScatter(highs);
        Pstream::listCombineGather(sums, plusEqOp<scalar>());
        Pstream::listCombineScatter(sums);
        forAll(all, i)
        {
            all[i].low = lows[i];
            all[i].high = highs[i];
            all[i].sum = sums[2 * i];
            all[i].count = sums[2 * i + 1];
        }
    }
};

//- Diagonal without the contributions of neighbours and sides
scalarField restOfDiagonal(const lduMatrix::solver& s, const fvMesh& mesh)
{
    const lduMatrix& m = s.matrix();
    scalarField rest(m.diag());
    if (m.hasUpper())
    {
        const labelUList& l = m.lduAddr().lowerAddr();
        const labelUList& u = m.lduAddr().upperAddr();
        const scalarField &upper = m.upper(), &lower = m.lower();
        forAll(l, facei)
        {
            rest[l[facei]] += upper[facei];
            rest[u[facei]] += lower[facei];
        }
    }
    forAll(s.interfaceIntCoeffs(), patchi)
    {
        const scalarField& c = s.interfaceIntCoeffs()[patchi];
        const labelUList& cells = mesh.boundary()[patchi].faceCells();
        forAll(c, i)
        {
            rest[cells[i]] -= c[i];
        }
    }
    return rest;
}
} // namespace

const Foam::fvMesh& Foam::boxMatrix::mesh(const lduMatrix::solver& solver)
{
    const fvMesh* mesh = dynamic_cast<const fvMesh*>(&solver.matrix().mesh());
    if (!mesh)
    {
        FatalErrorInFunction << "FFT is asked to solve for "
                             << solver.fieldName()
                             << " on something that is not an fvMesh (a coarse "
                             << "level of GAMG?)" << exit(FatalError);
    }
    return *mesh;
}

Foam::boxMatrix::boxMatrix(const lduMatrix::solver& s)
    : mesh_(mesh(s)),
      grid_(uniformGrid::New(mesh_)),
      a_(Zero)
{
    if (!grid_.valid())
    {
        FatalErrorInFunction
            << "FFT cannot solve for " << s.fieldName()
            << ": it needs a mesh that is one box of equal hexahedra along "
            << "the axes, but " << grid_.reason().c_str()
            << ". Choose another solver in fvSolution (PCG, GAMG)"
            << exit(FatalError);
    }

    readNeighbours(s);
    readSides(s);
    readDiagonal(s);

    inverse_ = &fastHelmholtzCache::New(mesh_).get(sides_);
}

void Foam::boxMatrix::readNeighbours(const lduMatrix::solver& s)
{
    const lduMatrix& m = s.matrix();
    List<spread> entry(3);

    if (m.hasUpper())
    {
        const scalarField &upper = m.upper(), &lower = m.lower();
        forAll(upper, facei)
        {
            entry[grid_.faceDirection(facei)].add(upper[facei], 0.5);
            entry[grid_.faceDirection(facei)].add(lower[facei], 0.5);
        }
    }
    forAll(s.interfaces(), patchi)
    {
        if (!s.interfaces().set(patchi)) continue;
        const scalarField& c = s.interfaceBouCoeffs()[patchi];
        const label start = mesh_.boundaryMesh()[patchi].start();
        forAll(c, i)
        {
            // Both sides see the face: half each, so that the mean is that of the
            // box, however it is decomposed
            entry[grid_.faceDirection(start + i)].add(-c[i], 0.5);
        }
    }
    spread::reduce(entry);

    scalar largest = SMALL * VSMALL;
    for (direction d = 0; d < 3; ++d)
    {
        a_[d] = entry[d].any() ? -entry[d].mean() : 0;
        largest = max(largest, mag(a_[d]));
    }
    for (direction d = 0; d < 3; ++d)
    {
        if (entry[d].any() &&
            entry[d].high - entry[d].low > constantTolerance * largest)
        {
            reason_ = "the coefficients between neighbours in direction " +
                      string(vector::componentNames[d]) + " vary between " +
                      Foam::name(-entry[d].high) + " and " +
                      Foam::name(-entry[d].low) +
                      " (implicit convection, or a variable coefficient)";
        }
    }
}

void Foam::boxMatrix::readSides(const lduMatrix::solver& s)
{
    List<spread> entry(6);
    forAll(s.interfaceIntCoeffs(), patchi)
    {
        if (s.interfaces().set(patchi)) continue;
        const scalarField& c = s.interfaceIntCoeffs()[patchi];
        const label start = mesh_.boundaryMesh()[patchi].start();
        forAll(c, i)
        {
            const direction d = grid_.faceDirection(start + i);
            const label side = grid_.lowerSide(start + i) ? 0 : 1;
            entry[2 * d + side].add(c[i] / (a_[d] ? a_[d] : 1));
        }
    }
    spread::reduce(entry);

    for (direction d = 0; d < 3; ++d)
    {
        sides_[d].periodic = grid_.periodic(d);
        for (label side = 0; side < 2; ++side)
        {
            const spread& e = entry[2 * d + side];
            if (!e.any()) continue;

            const bool fixed = e.mean() > 1;
            sideConditions& c = sides_[d];
            (side ? c.upperDirichlet : c.lowerDirichlet) = fixed;
            const scalar expected = fixed ? 2 : 0;
            if (mag(e.low - expected) > constantTolerance ||
                mag(e.high - expected) > constantTolerance)
            {
                reason_ =
                    "the condition on the " + string(side ? "upper" : "lower") +
                    " side in direction " + string(vector::componentNames[d]) +
                    " is neither a fixed value nor a fixed gradient throughout";
            }
        }
    }
}

void Foam::boxMatrix::readDiagonal(const lduMatrix::solver& s)
{
    const scalarField rest(restOfDiagonal(s, mesh_));
    List<spread> entry(1);
    for (const scalar r : rest)
    {
        entry[0].add(r);
    }
    spread::reduce(entry);
    const spread& e = entry[0];

    const scalar scale = 2 * (mag(a_[0]) + mag(a_[1]) + mag(a_[2]));
    const scalar tolerance = constantTolerance * max(scale, mag(e.mean()));
    sigma_ = e.mean();

    if (e.high - e.low > tolerance)
    {
        // One entry may differ from all others: that of a reference cell
        const scalar withoutLow = (e.sum - e.low) / (e.count - 1);
        const scalar withoutHigh = (e.sum - e.high) / (e.count - 1);
        const bool low = mag(withoutLow - e.high) < tolerance;
        const bool high = mag(withoutHigh - e.low) < tolerance;
        if (low || high)
        {
            const scalar special = low ? e.low : e.high;
            sigma_ = low ? withoutLow : withoutHigh;
            hasReference_ = true;
            referenceShift_ = special - sigma_;
            referenceCell_ = rest.find(special);
        }
        else if (reason_.empty())
        {
            reason_ = "the diagonal varies between " + Foam::name(e.low) +
                      " and " + Foam::name(e.high) + " without its neighbours";
        }
    }

    // A pure Laplacian, up to round-off
    if (mag(sigma_) < constantTolerance * constantTolerance * scale) sigma_ = 0;
}

void Foam::boxMatrix::solve(scalarField& x, const scalarField& b) const
{
    inverse_->solve(x.data(), b.cdata(), sigma_, a_);
}

// (A + s e e^T) x = b with A singular: the sum of all rows gives
// x_e = sum(b)/s, then A x = b - s x_e e is compatible. With A regular:
// x = A^-1 b - A^-1 e s (A^-1 b)_e / (1 + s (A^-1 e)_e)
void Foam::boxMatrix::solveWithReference(scalarField& x,
                                         const scalarField& b) const
{
    if (!hasReference_)
    {
        solve(x, b);
        return;
    }

    const label cell = referenceCell_;
    const auto atReference = [cell](const scalarField& f)
    { return returnReduce(cell >= 0 ? f[cell] : 0, sumOp<scalar>()); };

    if (inverse_->singular(sigma_))
    {
        const scalar xe = gSum(b) / referenceShift_;
        scalarField rhs(b);
        if (cell >= 0) rhs[cell] -= referenceShift_ * xe;
        solve(x, rhs);
        x += xe - atReference(x);
    }
    else
    {
        scalarField e(b.size(), Zero);
        if (cell >= 0) e[cell] = 1;
        solve(e, e);
        solve(x, b);
        x -= e * (referenceShift_ * atReference(x) /
                  (1 + referenceShift_ * atReference(e)));
    }
}

void Foam::boxMatrix::precondition(scalarField& x, const scalarField& b) const
{
    solve(x, b);
    if (inverse_->singular(sigma_))
    {
        x += gAverage(b) / (a_[0] + a_[1] + a_[2]);
    }
}
