// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "heldMean.H"
#include <numeric>

Foam::heldMean::heldMean(const uniformGrid& grid, const haloBlock& block)
    : grid_(grid),
      block_(block)
{
}

void Foam::heldMean::hold(const direction component, const scalar mean,
                          const scalar likelyGradient, staggeredField& force)
{
    active_ = true;
    component_ = component;
    mean_ = mean;
    likelyGradient_ = likelyGradient;
    for (scalar& f : force[component])
    {
        f += likelyGradient;
    }
}

void Foam::heldMean::begin(const scalar dt)
{
    gradient_ = likelyGradient_ * dt;
    likelyGradient_ = 0;
}

void Foam::heldMean::correct(componentArrays& u, const scalar coefficient,
                             const solver& diffuse)
{
    const cellBox& box = block_.box();
    const scalar nAll =
        scalar(grid_.n().x()) * grid_.n().y() * grid_.n().z();
    const label nx = box.size.x();
    if (coefficient != coefficient_)
    {
        response_.assign(box.nPlaces(), 0);
        block_.rows([&](const label, const label n)
                    { std::fill_n(&response_[n], nx, 1); });
        if (coefficient > 0) diffuse(component_, response_.data());
        const scalar sum =
            std::accumulate(response_.begin(), response_.end(), 0.0);
        meanResponse_ = returnReduce(sum, sumOp<scalar>()) / nAll;
        coefficient_ = coefficient;
    }

    double* values = u[component_].data();
    scalar sum = 0;
    block_.rows(
        [&](const label q, const label)
        { sum += std::accumulate(values + q, values + q + nx, 0.0); });
    meanBefore_ = returnReduce(sum, sumOp<scalar>()) / nAll;

    const scalar push = (mean_ - meanBefore_) / meanResponse_;
    block_.rows(
        [&](const label q, const label n)
        {
            for (label i = 0; i < nx; ++i)
            {
                values[q + i] += push * response_[n + i];
            }
        });
    gradient_ += push;
}
