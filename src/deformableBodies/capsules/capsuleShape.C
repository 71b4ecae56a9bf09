// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What is measured, drawn and saved of a capsule

#include "capsuleGroup.H"
#include "dictionaryChecks.H"
#include <cmath>
#include <Eigen/Eigenvalues>

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

Foam::string Foam::capsuleGroup::describe(const flowScales& flow) const
{
    const scalar Gs = membrane_->model().shearModulus();
    OStringStream os;
    os.precision(4);
    os << nBodies() << " of radius a " << radius_ << ", a/h "
       << radius_ / cmptMax(scene_.grid.h()) << ", N " << harmonics().degree()
       << ", volume fraction "
       << nBodies() * referenceVolume_ / cmptProduct(scene_.grid.length());
    if (flow.rate > 0)
    {
        os << ", Re " << scene_.rho * flow.rate * sqr(radius_) / scene_.mu
           << ", Ca " << scene_.mu * flow.rate * radius_ / Gs;
    }
    else if (flow.speed > 0)
    {
        os << ", Re " << scene_.rho * flow.speed * radius_ / scene_.mu
           << ", mu U/Gs " << scene_.mu * flow.speed / Gs;
    }
    if (bending_)
        os << ", E_B/(a^2 Gs) " << bending_->modulus() / sqr(radius_) / Gs;
    return os.str();
}

std::vector<Foam::bodyColumn> Foam::capsuleGroup::columns() const
{
    return {{"x", "m"},
            {"y", "m"},
            {"z", "m"},
            {"volume", "of-the-start"},
            {"area", "of-the-start"},
            {"D", "(length-breadth)/(length+breadth)", true},
            {"inclination", "degrees"},
            {"length", "m"},
            {"breadth", "m"},
            {"width", "m"},
            {"energy", "J"},
            {"lambdaMax", "of-the-stress-free-length", true}};
}

Foam::scalarList Foam::capsuleGroup::sample(const label i) const
{
    const numbers& x = capsules_[i].x;
    scalar energy;
    const scalar stretch = membrane_->stretches(x.data(), energy).stretch;
    const geometry m(measure(x, membrane_->xTheta(), membrane_->xPhi()));
    if (bending_) energy += bending_->energy(x.data());

    // Equivalent ellipsoid: moments V a^2/5. Iterations keep the digits that
    // formulas lose where axes are nearly equal
    const tensor full(5 / m.volume * m.moments);
    const Eigen::Vector3d squares(
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
            Eigen::Map<const Eigen::Matrix3d>(full.cdata()),
            Eigen::EigenvaluesOnly)
            .eigenvalues());
    const auto axis = [&](const int k)
    { return std::sqrt(std::max(squares[k], 0.0)); };
    const scalar breadth = axis(0), width = axis(1), length = axis(2);

    // Its direction in the shear plane; a circle has none
    const direction f = shearPlane_[0], g = shearPlane_[1];
    const scalar across = 0.5 * (full(f, f) - full(g, g)), fg = full(f, g);
    const bool round =
        std::hypot(across, fg) < 1e-12 * (full(f, f) + full(g, g)) / 2;
    const scalar inclination =
        round ? 0 : 90 / constant::mathematical::pi * std::atan2(fg, across);

    return {m.centre.x(),
            m.centre.y(),
            m.centre.z(),
            m.volume / referenceVolume_,
            m.area / referenceArea_,
            (length - breadth) / (length + breadth),
            inclination,
            length,
            breadth,
            width,
            energy,
            stretch};
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

    s.faces = ringFaces(grid.nTheta(), nPhi);
    return s;
}

Foam::bodyGroup::identity Foam::capsuleGroup::identify() const
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
