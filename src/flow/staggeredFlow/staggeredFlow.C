// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "staggeredFlow.H"
#include "fixedValueFvPatchFields.H"
#include "zeroGradientFvPatchFields.H"

Foam::string Foam::staggeredFlow::unsupported(const volVectorField& U,
                                              const volScalarField& p)
{
    const uniformGrid& grid = uniformGrid::New(U.mesh());
    if (!grid.valid()) return "the mesh is no uniform box: " + grid.reason();

    const bool whole = grid.ijk().size() == grid.box().count();
    if (!returnReduce(whole && grid.ijk().size(), andOp<bool>()))
    {
        return "the decomposition is not one of rectangular blocks (method "
               "simple or hierarchical)";
    }

    for (direction d = 0; d < 3; ++d)
    {
        if (grid.n()[d] < 3)
        {
            return "there are fewer than three cells in direction " +
                   string(vector::componentNames[d]);
        }
    }

    string reason;
    forAll(U.boundaryField(), patchi)
    {
        const fvPatchVectorField& Ub = U.boundaryField()[patchi];
        const fvPatchScalarField& pb = p.boundaryField()[patchi];
        if (Ub.coupled() || !Ub.size()) continue;

        const string where = " on patch " + Ub.patch().name();
        const vectorField n(Ub.patch().nf());
        const scalar tolerance = VSMALL + 1e-8 * (Ub.size() ? max(mag(Ub)) : 0);
        if (!isA<fixedValueFvPatchVectorField>(Ub) ||
            mag(max(Ub) - min(Ub)) > tolerance || max(mag(Ub & n)) > tolerance)
        {
            reason = "of conditions for U it knows cyclic and fixedValue, "
                     "uniform and tangential; it is " +
                     Ub.type() + where;
        }
        if (!isA<zeroGradientFvPatchScalarField>(pb))
        {
            reason = "of conditions for p it knows cyclic and zeroGradient; "
                     "it is " +
                     pb.type() + where;
        }
    }
    // Some rank's reason for all
    List<string> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = reason;
    Pstream::gatherList(all);
    Pstream::scatterList(all);
    for (const string& r : all)
    {
        if (!r.empty()) return r;
    }
    return string::null;
}

namespace
{
using namespace Foam;

//- Cells of a box in the order of its dense arrays
List<labelVector> cellsOf(const cellBox& box)
{
    List<labelVector> cells(box.count());
    label n = 0;
    for (label k = 0; k < box.size.z(); ++k)
    {
        for (label j = 0; j < box.size.y(); ++j)
        {
            for (label i = 0; i < box.size.x(); ++i)
            {
                cells[n++] = box.lo + labelVector(i, j, k);
            }
        }
    }
    return cells;
}
} // namespace

Foam::staggeredFlow::staggeredFlow(volVectorField& U, volScalarField& p,
                                   surfaceScalarField& phi, const scalar nu,
                                   effectLedger& effects)
    : mesh_(U.mesh()),
      grid_(uniformGrid::New(mesh_)),
      box_(grid_.box()),
      nu_(nu),
      effects_(effects),
      U_(U),
      p_(p),
      phi_(phi),
      convection_(IOobject("staggeredConvection", mesh_.time().timeName(),
                           mesh_, IOobject::READ_IF_PRESENT,
                           IOobject::AUTO_WRITE),
                  mesh_, dimensionedVector(dimAcceleration, Zero)),
      hasConvection_(convection_.headerOk())
{
    stride_[0] = 1;
    stride_[1] = box_.size.x() + 2;
    stride_[2] = stride_[1] * (box_.size.y() + 2);
    const label nHalo = stride_[2] * (box_.size.z() + 2);

    for (direction d = 0; d < 3; ++d)
    {
        u_[d].assign(nHalo, 0);
        h_[d].assign(box_.count(), 0);
        delta_[d].resize(box_.count());
    }
    p_halo_.assign(nHalo, 0);
    correction_.assign(nHalo, 0);
    divergence_.resize(box_.count());

    // Walls
    FixedList<FixedList<vector, 2>, 3> walls(
        FixedList<vector, 2>(vector(-GREAT, -GREAT, -GREAT)));
    forAll(U.boundaryField(), patchi)
    {
        const fvPatchVectorField& Ub = U.boundaryField()[patchi];
        if (Ub.coupled() || !Ub.size()) continue;
        const label facei = Ub.patch().patch().start();
        walls[grid_.faceDirection(facei)][grid_.lowerSide(facei) ? 0 : 1] =
            Ub[0];
    }
    for (direction d = 0; d < 3; ++d)
    {
        for (label side = 0; side < 2; ++side)
        {
            wall_[d][side] = returnReduce(walls[d][side], maxOp<vector>());
        }
    }

    FixedList<sideConditions, 3> sides;
    for (direction d = 0; d < 3; ++d)
    {
        sides[d].periodic = grid_.periodic(d);
        for (direction c = 0; c < 3; ++c)
        {
            diffusion_[c][d].reset(new lineSolver(grid_, d, c == d));
        }
    }
    poisson_.reset(new fastHelmholtz(grid_, sides, cellsOf(box_)));
    makeHalo();

    // Start from the fields
    staggeredField u(box_);
    grid_.toStaggered(phi, u);
    forAll(grid_.ijk(), celli)
    {
        const labelVector c(grid_.ijk()[celli] - box_.lo);
        const label q = place(c.x(), c.y(), c.z());
        const label i = box_.index(grid_.ijk()[celli]);
        for (direction d = 0; d < 3; ++d)
        {
            u_[d][q] = u[d][i];
            h_[d][i] = convection_[celli][d];
        }
        p_halo_[q] = p[celli];
    }
    updateHalo(p_halo_);
}

bool Foam::staggeredFlow::wallBelow(const direction d) const
{
    return !grid_.periodic(d) && box_.lo[d] == 0;
}

bool Foam::staggeredFlow::wallAbove(const direction d) const
{
    return !grid_.periodic(d) && box_.lo[d] + box_.size[d] == grid_.n()[d];
}

void Foam::staggeredFlow::makeHalo()
{
    const List<cellBox> boxes(grid_.allBoxes());
    DynamicList<label> rank, source, target;
    for (label k = -1; k <= box_.size.z(); ++k)
    {
        for (label j = -1; j <= box_.size.y(); ++j)
        {
            for (label i = -1; i <= box_.size.x(); ++i)
            {
                const labelVector local(i, j, k);
                labelVector c(box_.lo + local);
                bool inside = true, beyondWall = false;
                for (direction d = 0; d < 3; ++d)
                {
                    const label n = grid_.n()[d];
                    inside = inside && local[d] >= 0 && local[d] < box_.size[d];
                    beyondWall = beyondWall || (!grid_.periodic(d) &&
                                                (c[d] < 0 || c[d] >= n));
                    c[d] = (c[d] + n) % n;
                }
                if (inside || beyondWall) continue;

                forAll(boxes, proci)
                {
                    const cellBox& b = boxes[proci];
                    const labelVector l(c - b.lo);
                    if (cmptMin(l) >= 0 && l.x() < b.size.x() &&
                        l.y() < b.size.y() && l.z() < b.size.z())
                    {
                        rank.append(proci);
                        source.append(
                            (l.x() + 1) +
                            (b.size.x() + 2) *
                                ((l.y() + 1) + (b.size.y() + 2) * (l.z() + 1)));
                        target.append(place(i, j, k));
                        break;
                    }
                }
            }
        }
    }
    halo_.reset(new indexExchange(rank, source));
    haloPlaces_.transfer(target);
    haloValues_.resize(haloPlaces_.size());
}

void Foam::staggeredFlow::updateHalo(array& f)
{
    halo_->backward(f.data(), haloValues_.data());
    forAll(haloPlaces_, i)
    {
        f[haloPlaces_[i]] = haloValues_[i];
    }
}

// Halo, then the points beyond walls: tangential components mirrored about the
// wall's velocity, normal ones zero on the wall
void Foam::staggeredFlow::updateVelocity()
{
    for (direction c = 0; c < 3; ++c)
    {
        updateHalo(u_[c]);
        for (direction d = 0; d < 3; ++d)
        {
            const direction a = d == 0 ? 1 : 0, b = 3 - d - a;
            const auto eachOfSide = [&](const label at, const auto& set)
            {
                for (label s = -1; s <= box_.size[b]; ++s)
                {
                    for (label r = -1; r <= box_.size[a]; ++r)
                    {
                        labelVector l;
                        l[d] = at;
                        l[a] = r;
                        l[b] = s;
                        set(place(l.x(), l.y(), l.z()));
                    }
                }
            };
            double* u = u_[c].data();
            const label s = stride_[d];
            if (wallBelow(d))
            {
                const double w = 2 * wall_[d][0][c];
                eachOfSide(-1, [&](const label q)
                           { u[q] = c == d ? 0 : w - u[q + s]; });
            }
            if (wallAbove(d))
            {
                const double w = 2 * wall_[d][1][c];
                eachOfSide(box_.size[d], [&](const label q)
                           { u[q] = c == d ? 0 : w - u[q - s]; });
            }
        }
    }
}

void Foam::staggeredFlow::velocity(staggeredField& u) const
{
    label n = 0;
    for (label k = 0; k < box_.size.z(); ++k)
    {
        for (label j = 0; j < box_.size.y(); ++j)
        {
            const label q = place(0, j, k);
            for (label i = 0; i < box_.size.x(); ++i, ++n)
            {
                for (direction d = 0; d < 3; ++d)
                {
                    u[d][n] = u_[d][q + i];
                }
            }
        }
    }
}

void Foam::staggeredFlow::fill()
{
    const auto timing(effects_.time("fields"));
    updateVelocity();

    staggeredField u(box_);
    velocity(u);
    grid_.toFlux(u, phi_);

    forAll(grid_.ijk(), celli)
    {
        const labelVector c(grid_.ijk()[celli] - box_.lo);
        const label q = place(c.x(), c.y(), c.z());
        const label i = box_.index(grid_.ijk()[celli]);
        for (direction d = 0; d < 3; ++d)
        {
            U_[celli][d] = 0.5 * (u_[d][q] + u_[d][q + stride_[d]]);
            convection_[celli][d] = h_[d][i];
        }
        p_[celli] = p_halo_[q];
    }
    Info << "Largest divergence, relative to max|u|/h: " << divergence()
         << endl;
    U_.correctBoundaryConditions();
    p_.correctBoundaryConditions();
    convection_.correctBoundaryConditions();
}
