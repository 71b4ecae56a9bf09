// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fieldExchange.H"

Foam::fieldExchange::fieldExchange(const uniformGrid& grid,
                                   const haloBlock& block, volVectorField& U,
                                   volScalarField& p, surfaceScalarField& phi)
    : grid_(grid),
      block_(block),
      U_(U),
      p_(p),
      phi_(phi)
{
}

Foam::scalar Foam::fieldExchange::level(const array& pressure) const
{
    if (!hasReference_) return 0;
    const scalar local =
        referenceCell_ < 0 ? 0 : pressure[block_.indexOf(referenceCell_)];
    return referenceValue_ - returnReduce(local, sumOp<scalar>());
}

void Foam::fieldExchange::velocityFromFlux(componentArrays& u) const
{
    grid_.lowerFaces(phi_,
                     [&](const label celli, const direction d, const scalar x)
                     { u[d][block_.indexOf(celli)] = x; });
}

template<class Visit>
void Foam::fieldExchange::averages(const componentArrays& u, Visit visit) const
{
    const UList<scalar> x[3] = {u[0], u[1], u[2]};
    forAll(grid_.index(), celli)
    {
        const label q = block_.indexOf(celli);
        vector mean;
        for (direction d = 0; d < 3; ++d)
        {
            mean[d] = 0.5 * (x[d][q] + x[d][q + block_.stride(d)]);
        }
        visit(celli, q, mean);
    }
}

void Foam::fieldExchange::read(componentArrays& u, array& pressure) const
{
    velocityFromFlux(u);
    block_.set(p_, pressure.data());
}

void Foam::fieldExchange::fill(const componentArrays& u, const array& pressure)
{
    U_.storeOldTimes();
    p_.storeOldTimes();
    phi_.storeOldTimes();
    grid_.toFlux(staggeredView(u, block_.index(0, 0, 0), block_.stride(1),
                               block_.stride(2)),
                 phi_);
    averages(u,
             [&](const label celli, const label q, const vector& mean)
             {
                 U_[celli] = mean;
                 p_[celli] = pressure[q];
             });
    if (hasReference_) p_.primitiveFieldRef() += level(pressure);
    U_.correctBoundaryConditions();
    p_.correctBoundaryConditions();
    filled_ = true;
}

bool Foam::fieldExchange::takeOver(componentArrays& u, array& pressure)
{
    // Differences of the fields to the arrays: of U, phi (as a velocity) and p
    vectorField dU(U_.size());
    const scalar pLevel = level(pressure);
    vector change(Zero), size(Zero);
    averages(u,
             [&](const label celli, const label q, const vector& mean)
             {
                 dU[celli] = U_[celli] - mean;
                 const scalar p = pressure[q] + pLevel;
                 change.z() = max(change.z(), mag(p_[celli] - p));
                 size.z() = max(size.z(), mag(p));
                 for (direction d = 0; d < 3; ++d)
                 {
                     change.x() = max(change.x(), mag(dU[celli][d]));
                     size.x() = max(size.x(), mag(u[d][q]));
                 }
             });
    grid_.lowerFaces(phi_,
                     [&](const label celli, const direction d, const scalar x) {
                         change.y() = max(change.y(),
                                          mag(x - u[d][block_.indexOf(celli)]));
                     });
    size.y() = size.x();
    reduce(change, maxOp<vector>());
    reduce(size, maxOp<vector>());
    const auto changed = [&](const direction which)
    { return change[which] > 1e-10 * size[which]; };
    const bool U = changed(0), phi = changed(1), p = changed(2);

    if (!told_ && (U || phi || p))
    {
        Info << "Between two steps" << (U ? " U" : "") << (phi ? " phi" : "")
             << (p ? " p" : "")
             << " changed (by a functionObject?): staggered takes that over"
             << endl;
        told_ = true;
    }
    if (phi)
    {
        velocityFromFlux(u);
    }
    else if (U)
    {
        addCells(dU, 1,
                 staggeredTarget(u, block_.index(0, 0, 0), block_.stride(1),
                                 block_.stride(2)));
    }
    if (p)
    {
        const scalarField mine(p_.primitiveField() - pLevel);
        block_.set(mine, pressure.data());
    }
    return U || phi;
}

void Foam::fieldExchange::addCells(const vectorField& cells,
                                   const scalar factor,
                                   const staggeredTarget& to) const
{
    array work(block_.size(), 0);
    const labelVector& n = block_.box().size;
    for (direction d = 0; d < 3; ++d)
    {
        const scalarField half(0.5 * factor * cells.component(d));
        block_.set(half, work.data());
        for (label k = 0; k < n.z(); ++k)
        {
            for (label j = 0; j < n.y(); ++j)
            {
                const double* c = work.data() + block_.index(0, j, k);
                double* x = to.first[d] + j * to.row + k * to.layer;
                for (label i = 0; i < n.x(); ++i)
                {
                    x[i] += c[i] + c[i - block_.stride(d)];
                }
            }
        }
    }
}
