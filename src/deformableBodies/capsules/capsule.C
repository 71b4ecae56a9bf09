// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsule.H"
#include "capsuleNearField.H"
#include "DynamicList.H"
#include "mathematicalConstants.H"
#include <cmath>
#include <numeric>

namespace
{
const Foam::scalar sqrt4Pi = std::sqrt(4 * Foam::constant::mathematical::pi);

//- Last number of a state: which fields there are
Foam::label partsOf(const Foam::scalarList& state)
{
    return Foam::label(state.last());
}
} // namespace

Foam::scalar Foam::capsule::volume() const
{
    return std::inner_product(x.begin(), x.end(), volumeGradient.begin(), 0.0) /
           3;
}

Foam::point Foam::capsule::centre() const
{
    return vector(x[0], x[1], x[2]) / sqrt4Pi;
}

Foam::point Foam::capsule::centreOf(const scalarList& state)
{
    return vector(state[1], state[2], state[3]) / sqrt4Pi;
}

Foam::scalarList Foam::capsule::state() const
{
    DynamicList<scalar> s;
    s.append(lastDeltaT);
    for (const coefficients* v :
         {&x, &velocity, &previous, &lag, &lagBefore, &onFluid, &nearMemory})
    {
        s.append(UList<scalar>(const_cast<double*>(v->data()), v->size()));
    }
    s.append(nUnsteady);
    s.append(scalar((previous.empty() ? 0 : 1) + (lag.empty() ? 0 : 2) +
                    (onFluid.empty() ? 0 : 4) + (nearMemory.empty() ? 0 : 8)));
    return scalarList(std::move(s));
}

Foam::label Foam::capsule::degreeOf(const scalarList& state)
{
    const label size = state.size() - 3;
    if (size <= 0 || !(state.last() >= 0 && state.last() < 16)) return -1;
    const label parts = partsOf(state);
    const label sets = 2 + (parts & 1) + (parts & 2) + (parts & 4) / 4 +
                       (parts & 8) / 8 * capsuleNearField::memorySize;
    const label N = label(std::lround(std::sqrt(size / (3.0 * sets)))) - 1;
    return 3 * sets * (N + 1) * (N + 1) == size ? N : -1;
}

void Foam::capsule::restore(const scalarList& state, const bool hasPrevious,
                            const bool hasLag, const bool hasNearField)
{
    lastDeltaT = state[0];
    nUnsteady = label(state[state.size() - 2]);
    const label parts = partsOf(state);
    const scalar* cursor = state.cdata() + 1;
    const auto read = [&](const bool there, const bool wanted, coefficients& v,
                          const label times = 1)
    {
        if (!there) return;
        const label n = times * label(x.size());
        if (wanted) v.assign(cursor, cursor + n);
        cursor += n;
    };
    read(true, true, x);
    read(true, true, velocity);
    read(parts & 1, hasPrevious, previous);
    read(parts & 2, hasLag, lag);
    read(parts & 2, hasLag, lagBefore);
    read(parts & 4, hasNearField, onFluid);
    read(parts & 8, hasNearField, nearMemory, capsuleNearField::memorySize);
}
