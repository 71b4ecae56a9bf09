// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsuleReport.H"
#include "gridValues.H"
#include <Eigen/Eigenvalues>

Foam::string Foam::capsuleReport::describe() const
{
    const flowScales& flow = group_.scene_.flow;
    const scalar Gs = group_.shell_->model().shearModulus(),
                 Ks = group_.shell_->model().areaModulus();
    const scalar Es = 4 * Gs * Ks / (Gs + Ks);
    OStringStream os;
    os.precision(4);
    os << group_.nBodies() << " of radius a " << group_.radius_ << ", a/h "
       << group_.radius_ / cmptMax(group_.scene_.grid.h()) << ", N "
       << group_.harmonics().degree() << ", volume fraction "
       << group_.nBodies() * group_.referenceVolume_ /
              cmptProduct(group_.scene_.grid.length());
    if (flow.rate > 0)
    {
        os << ", Re "
           << group_.scene_.rho * flow.rate * sqr(group_.radius_) /
                  group_.scene_.mu
           << ", Ca_G " << group_.scene_.mu * flow.rate * group_.radius_ / Gs
           << ", Ca_E " << group_.scene_.mu * flow.rate * group_.radius_ / Es;
    }
    else if (flow.speed > 0)
    {
        os << ", Re "
           << group_.scene_.rho * flow.speed * group_.radius_ / group_.scene_.mu
           << ", mu U/Gs " << group_.scene_.mu * flow.speed / Gs;
    }
    const scalar modulus = group_.shell_->bendingModulus();
    if (modulus > 0)
    {
        os << ", E_B/(a^2 Gs) " << modulus / sqr(group_.radius_) / Gs;
    }
    return os.str();
}

std::vector<Foam::bodyColumn> Foam::capsuleReport::columns() const
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
            {"lambdaMax", "of-the-stress-free-length", true},
            {"velocityX", "m/s"},
            {"velocityY", "m/s"},
            {"velocityZ", "m/s"},
            {"axisX", "1"},
            {"axisY", "1"},
            {"axisZ", "1"},
            {"spin", "1/s"}};
}

Foam::scalarList Foam::capsuleReport::sample(const label i) const
{
    const std::vector<double>& x = group_.capsules_[i].x;
    scalar energy;
    const scalar stretch =
        group_.shell_->elastic().stretches(x.data(), energy).stretch;
    const auto m(group_.shell_->measureLast(x));
    energy += group_.shell_->bendingEnergy(x);

    // Equivalent ellipsoid: moments V a^2/5. Iterations keep the digits that
    // formulas lose where axes are nearly equal
    const tensor full(5 / m.volume * m.moments);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(
        Eigen::Map<const Eigen::Matrix3d>(full.cdata()));
    const Eigen::Vector3d squares(principal.eigenvalues());

    // Longest axis, along the first direction of the shear plane rather than against it; none
    // of shapes that have no longest one
    Eigen::Vector3d longest(principal.eigenvectors().col(2));
    if (squares[2] - squares[1] < 1e-9 * squares[2]) longest.setZero();
    if (longest[group_.shearPlane_[0]] < 0) longest *= -1;
    const auto axis = [&](const int k)
    { return std::sqrt(std::max(squares[k], 0.0)); };
    const scalar breadth = axis(0), width = axis(1), length = axis(2);

    // Direction of the longest axis in the shear plane; a circle has none
    const direction f = group_.shearPlane_[0], g = group_.shearPlane_[1];
    const scalar across = 0.5 * (full(f, f) - full(g, g)), fg = full(f, g);
    const bool round =
        std::hypot(across, fg) < 1e-12 * (full(f, f) + full(g, g)) / 2;
    const scalar inclination =
        round ? 0 : 90 / constant::mathematical::pi * std::atan2(fg, across);

    // Motion; the surface turns from the first direction of the shear plane to the second
    const auto motion = group_.shell_->motionLast(
        x, group_.capsules_[i].velocity, m.centre, m.volume);
    const direction n = 3 - f - g;
    const scalar spin = (g == (f + 1) % 3 ? 1 : -1) * motion.spin[n];

    return {m.centre.x(),
            m.centre.y(),
            m.centre.z(),
            m.volume / group_.referenceVolume_,
            m.area / group_.referenceArea_,
            (length - breadth) / (length + breadth),
            inclination,
            length,
            breadth,
            width,
            energy,
            stretch,
            motion.velocity.x(),
            motion.velocity.y(),
            motion.velocity.z(),
            longest[0],
            longest[1],
            longest[2],
            spin};
}

Foam::bodySurface Foam::capsuleReport::surface(const label i) const
{
    const auto& c = group_.capsules_[i];
    const sphericalHarmonics& grid = group_.shell_->grid();
    const label n = grid.nPoints(), nPhi = grid.nPhi();

    const auto vectors = [&](const std::vector<double>& values)
    {
        vectorField v(n);
        for (label k = 0; k < n; ++k)
        {
            v[k] = vectorAt(values, k);
        }
        return v;
    };

    std::vector<double> onGrid(3 * n), xt(3 * n), xp(3 * n);
    bodySurface s;
    s.vectorNames = {"velocity", "load"};
    s.scalarNames = {"tension1", "tension2", "curvature", "area"};
    s.vectors.setSize(2);
    s.scalars.setSize(4, scalarField(n));

    grid.values(c.velocity.data(), onGrid.data());
    s.vectors[0] = vectors(onGrid);

    // Load per deformed area [N/m^2]: q is per solid angle
    std::vector<double> q, T1(n), T2(n);
    group_.shell_->load(c.x, q);
    grid.values(q.data(), onGrid.data());
    s.vectors[1] = vectors(onGrid);
    grid.gradient(c.x.data(), xt.data(), xp.data());
    for (label k = 0; k < n; ++k)
    {
        const scalar perAngle = mag(vectorAt(xt, k) ^ vectorAt(xp, k));
        s.vectors[1][k] /= perAngle;
        s.scalars[3][k] = grid.weight(k) * perAngle;
    }
    group_.shell_->elastic().tensions(c.x.data(), T1.data(), T2.data());
    s.scalars[0] = scalarField(UList<scalar>(T1.data(), n));
    s.scalars[1] = scalarField(UList<scalar>(T2.data(), n));
    bending::curvature(grid, c.x.data(), T1.data());
    s.scalars[2] = scalarField(UList<scalar>(T1.data(), n));

    grid.values(c.x.data(), onGrid.data());
    s.points = vectors(onGrid);

    s.faces = ringFaces(grid.nTheta(), nPhi);
    return s;
}
