// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Measures and state of a capsule

#include "capsuleGroup.H"
#include "dictionaryChecks.H"
#include <cmath>

// Surface integrals of the shape. Products of the series are integrated
// exactly by the load grid up to the third degree in x
Foam::capsuleGroup::geometry Foam::capsuleGroup::measure(const numbers& x) const
{
    membrane_->harmonics().gradient(x.data(), xt_.data(), xp_.data());
    return measure(x, xt_, xp_);
}

Foam::capsuleGroup::geometry
Foam::capsuleGroup::measure(const numbers& x, const numbers& xt,
                            const numbers& xp) const
{
    const sphericalHarmonics& grid = membrane_->harmonics();
    const label n = grid.nPoints();
    grid.values(x.data(), onGrid_.data());

    geometry m{0, 0, Zero, Zero};
    const vector origin(onGrid_[0], onGrid_[n], onGrid_[2 * n]);
    for (label k = 0; k < n; ++k)
    {
        // Relative to a point of the surface: no digits lost far from 0
        const vector r(vector(onGrid_[k], onGrid_[n + k], onGrid_[2 * n + k]) -
                       origin);
        const vector t(xt[k], xt[n + k], xt[2 * n + k]);
        const vector p(xp[k], xp[n + k], xp[2 * n + k]);
        const vector dS(grid.weight(k) * (t ^ p));
        const scalar flux = r & dS;
        m.area += mag(dS);
        m.volume += flux / 3;
        m.centre += flux / 4 * r;
        m.moments += flux / 5 * sqr(r);
    }
    m.centre /= m.volume;
    m.moments -= m.volume * sqr(m.centre);
    m.centre += origin;
    return m;
}

Foam::bodyGroup::makeList Foam::capsuleGroup::identify() const
{
    return {{"harmonics", scalar(harmonics().degree())},
            {"radius", radius_},
            {"area", referenceArea_}};
}

// The step, then fields of coefficients, then which of those that not all capsules
// have: 1 previous, 2 the lags, 4 load and 8 memory of the near field
Foam::scalarList Foam::capsuleGroup::state(const label i) const
{
    const capsule& c = capsules_[i];
    DynamicList<scalar> s;
    s.append(c.lastDeltaT);
    for (const numbers* v : {&c.x, &c.velocity, &c.previous, &c.lag,
                             &c.lagBefore, &c.onFluid, &c.nearMemory})
    {
        s.append(UList<scalar>(const_cast<double*>(v->data()), v->size()));
    }
    s.append(scalar((c.previous.empty() ? 0 : 1) + (c.lag.empty() ? 0 : 2) +
                    (c.onFluid.empty() ? 0 : 4) +
                    (c.nearMemory.empty() ? 0 : 8)));
    return scalarList(std::move(s));
}

Foam::label Foam::capsuleGroup::degreeOf(const scalarList& state)
{
    const label size = state.size() - 2;
    if (size <= 0 || !(state.last() >= 0 && state.last() < 16)) return -1;
    const label parts = partsOf(state);
    const label sets = 2 + (parts & 1) + (parts & 2) + (parts & 4) / 4 +
                       (parts & 8) / 8 * capsuleNearField::memorySize;
    const label N = label(std::lround(std::sqrt(size / (3.0 * sets)))) - 1;
    return 3 * sets * (N + 1) * (N + 1) == size ? N : -1;
}

Foam::point Foam::capsuleGroup::centreOf(const scalarList& state,
                                         const label body,
                                         const dictionary& source) const
{
    if (degreeOf(state) != harmonics().degree())
    {
        firstRankSpeaks();
        FatalIOErrorInFunction(source)
            << "the saved state of body " << body << " of group " << name()
            << " has " << state.size() << " numbers where "
            << 2 + 2 * initial_.size()
            << " belong to its harmonics: was the entry harmonics changed?"
            << exit(FatalIOError);
    }
    return vector(state[1], state[2], state[3]) /
           std::sqrt(4 * constant::mathematical::pi);
}

void Foam::capsuleGroup::setState(const label i, const scalarList& state,
                                  const dictionary& source)
{
    capsule& c = capsules_[i];
    centreOf(state, mine()[i], source);
    c.lastDeltaT = state[0];
    const label parts = partsOf(state);
    const scalar* at = state.cdata() + 1;
    const auto read = [&](const bool there, const bool wanted, numbers& v,
                          const label times = 1)
    {
        if (!there) return;
        const label n = times * label(c.x.size());
        if (wanted) v.assign(at, at + n);
        at += n;
    };
    read(true, true, c.x);
    read(true, true, c.velocity);
    read(parts & 1, bool(stabilised_), c.previous);
    read(parts & 2, bool(penalty_), c.lag);
    read(parts & 2, bool(penalty_), c.lagBefore);
    read(parts & 4, bool(nearField_), c.onFluid);
    read(parts & 8, bool(nearField_), c.nearMemory,
         capsuleNearField::memorySize);
    startAt(c);
}
