// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What is measured, drawn and saved of a capsule

#include "capsuleGroup.H"
#include <cmath>

// Surface integrals of the shape. Products of the series are integrated
// exactly by the load grid up to the third degree in x
Foam::capsuleGroup::geometry Foam::capsuleGroup::measure(const numbers& x) const
{
    const sphericalHarmonics& grid = membrane_->harmonics();
    const label n = grid.nPoints();
    grid.values(x.data(), onGrid_.data());
    grid.gradient(x.data(), xt_.data(), xp_.data());

    geometry m{0, 0, Zero, Zero};
    const vector origin(onGrid_[0], onGrid_[n], onGrid_[2 * n]);
    for (label k = 0; k < n; ++k)
    {
        // Relative to a point of the surface: no digits lost far from 0
        const vector r(vector(onGrid_[k], onGrid_[n + k], onGrid_[2 * n + k]) -
                       origin);
        const vector t(xt_[k], xt_[n + k], xt_[2 * n + k]);
        const vector p(xp_[k], xp_[n + k], xp_[2 * n + k]);
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

Foam::wordList Foam::capsuleGroup::columns() const
{
    return {"x",           "y",      "z",       "volume", "area",     "D",
            "inclination", "length", "breadth", "energy", "lambdaMax"};
}

Foam::scalarList Foam::capsuleGroup::sample(const label i) const
{
    const numbers& x = capsules_[i].x;
    const geometry m(measure(x));

    // Equivalent ellipsoid: moments V a^2/5; its section by the shear plane
    const scalar s = 5 / m.volume;
    const direction f = shearPlane_[0], g = shearPlane_[1];
    const tensor full(m.moments);
    const scalar ff = s * full(f, f), gg = s * full(g, g), fg = s * full(f, g);
    const scalar half = 0.5 * (ff + gg);
    const scalar root = std::hypot(0.5 * (ff - gg), fg);

    // A circle has no direction
    const bool round = root < 1e-12 * half;
    const scalar length = std::sqrt(half + root);
    const scalar breadth = std::sqrt(max(half - root, scalar(0)));

    return {m.centre.x(),
            m.centre.y(),
            m.centre.z(),
            m.volume / referenceVolume_,
            m.area / referenceArea_,
            (length - breadth) / (length + breadth),
            round
                ? 0
                : 90 / constant::mathematical::pi * std::atan2(2 * fg, ff - gg),
            length,
            breadth,
            membrane_->energy(x.data()) +
                (bending_ ? bending_->energy(x.data()) : 0),
            membrane_->stretches(x.data()).stretch};
}

Foam::bodySurface Foam::capsuleGroup::surface(const label i) const
{
    const capsule& c = capsules_[i];
    const sphericalHarmonics& grid = membrane_->harmonics();
    const label n = grid.nPoints(), nPhi = grid.nPhi();

    const auto vectors = [&](const numbers& values)
    {
        vectorField v(n);
        for (label k = 0; k < n; ++k)
        {
            v[k] = vector(values[k], values[n + k], values[2 * n + k]);
        }
        return v;
    };

    bodySurface s;
    s.vectorNames = {"velocity", "load"};
    s.scalarNames = {"tension1", "tension2", "curvature"};
    s.vectors.setSize(2);
    s.scalars.setSize(3);

    grid.values(c.velocity.data(), onGrid_.data());
    s.vectors[0] = vectors(onGrid_);

    // Load per deformed area [N/m^2]: q is per solid angle
    numbers q(coeffs_.size()), T1(n), T2(n);
    load(c.x, q);
    grid.values(q.data(), onGrid_.data());
    s.vectors[1] = vectors(onGrid_);
    grid.gradient(c.x.data(), xt_.data(), xp_.data());
    for (label k = 0; k < n; ++k)
    {
        const vector t(xt_[k], xt_[n + k], xt_[2 * n + k]);
        const vector p(xp_[k], xp_[n + k], xp_[2 * n + k]);
        s.vectors[1][k] /= mag(t ^ p);
    }
    membrane_->tensions(c.x.data(), T1.data(), T2.data());
    s.scalars[0] = scalarField(UList<scalar>(T1.data(), n));
    s.scalars[1] = scalarField(UList<scalar>(T2.data(), n));
    bending::curvature(grid, c.x.data(), T1.data());
    s.scalars[2] = scalarField(UList<scalar>(T1.data(), n));

    grid.values(c.x.data(), onGrid_.data());
    s.points = vectors(onGrid_);

    // Quadrilaterals, and one polygon over each pole
    DynamicList<face> faces;
    for (label r = 0; r + 1 < grid.nTheta(); ++r)
    {
        for (label j = 0; j < nPhi; ++j)
        {
            const label a = r * nPhi + j, b = r * nPhi + (j + 1) % nPhi;
            face quad(4);
            quad[0] = a;
            quad[1] = a + nPhi;
            quad[2] = b + nPhi;
            quad[3] = b;
            faces.append(quad);
        }
    }
    face north(nPhi), south(nPhi);
    for (label j = 0; j < nPhi; ++j)
    {
        north[j] = j;
        south[j] = n - 1 - j;
    }
    faces.append(north);
    faces.append(south);
    s.faces.transfer(faces);
    return s;
}

Foam::scalarList Foam::capsuleGroup::state(const label i) const
{
    const capsule& c = capsules_[i];
    DynamicList<scalar> s;
    s.append(c.lastDeltaT);
    for (const numbers* v :
         {&c.x, &c.velocity, &c.previous, &c.lag, &c.lagBefore})
    {
        s.append(UList<scalar>(const_cast<double*>(v->data()), v->size()));
    }
    return scalarList(std::move(s));
}

Foam::point Foam::capsuleGroup::centreOf(const scalarList& state,
                                         const label body,
                                         const dictionary& source) const
{
    const label n = initial_.size(), nParts = (state.size() - 1) / n;
    if (state.size() != 1 + nParts * n || nParts < 2 || nParts > 4)
    {
        FatalIOErrorInFunction(source)
            << "the saved state of body " << body << " of group " << name()
            << " has " << state.size() << " numbers where " << 1 + 2 * n
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
    const label n = c.x.size();
    const label nParts = (state.size() - 1) / n;
    centreOf(state, mine()[i], source);
    c.lastDeltaT = state[0];
    const auto begin = state.cdata() + 1;
    c.x.assign(begin, begin + n);
    c.xMid = c.x;
    c.velocity.assign(begin + n, begin + 2 * n);
    if (stabilised_ && nParts == 3)
    {
        c.previous.assign(begin + 2 * n, begin + 3 * n);
    }
    if (penalty_ && nParts == 4)
    {
        c.lag.assign(begin + 2 * n, begin + 3 * n);
        c.lagBefore.assign(begin + 3 * n, begin + 4 * n);
    }
}
