// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Rigid bodies and the fluid within a time step; what is reported and drawn of them

#include "rigidGroup.H"
#include "mathematicalConstants.H"
#include <Eigen/LU>

namespace
{
//- Rotation by the length of a vector about it
Foam::quaternion rotation(const Foam::vector& angle)
{
    return Foam::mag(angle) > 0
               ? Foam::quaternion(angle / Foam::mag(angle), Foam::mag(angle))
               : Foam::quaternion::I;
}
} // namespace

Foam::label Foam::rigidGroup::nMarkers() const
{
    return bodies_.size() * markers_.size();
}

// Light bodies: seen to diverge from nu dt/h^2 = 7 to 10 on
Foam::scalar Foam::rigidGroup::maxDeltaT() const
{
    return densityRatio_ < 1 ? 5 * sqr(h_) * scene_.rho / scene_.mu : GREAT;
}

void Foam::rigidGroup::markers(vector* X, const scalar dt)
{
    for (body& x : bodies_)
    {
        x.markers = x.centre + dt * x.velocity;
        if (isSphere())
        {
            x.markers += markers_;
        }
        else
        {
            x.markers +=
                (rotation(dt * x.angularVelocity) * x.turn).R() & markers_;
        }
        X = std::copy(x.markers.begin(), x.markers.end(), X);
    }
}

void Foam::rigidGroup::lines(label* line) const
{
    for (const label number : mine())
    {
        line = std::fill_n(line, markers_.size(), number);
    }
}

void Foam::rigidGroup::loads(vector* X, vector* F, scalar) const
{
    for (const body& x : bodies_)
    {
        X = std::copy(x.markers.begin(), x.markers.end(), X);
        F = std::copy(x.forces.begin(), x.forces.end(), F);
    }
}

Foam::vectorField Foam::rigidGroup::felt(const label i, const vector* U) const
{
    const body& x = bodies_[i];
    const label n = markers_.size();
    vectorField v(UList<vector>(const_cast<vector*>(U), n));
    if (nearField_)
    {
        const auto timing(scene_.effects.time("nearField"));
        vectorField more(n);
        nearField_->velocity(x.markers.cdata(), x.forces.cdata(), n,
                             more.data());
        v += more;
        if (hasNearPartner()) addOfPartner(i, x.markers.cdata(), n, v.data());
    }
    return v;
}

const Foam::bodyGroup::pointForces& Foam::rigidGroup::nearForces(const label i) const
{
    const body& x = bodies_[i];
    const tensor R(isSphere() ? tensor::I : x.turn.R());
    nearForces_.X.clear();
    for (const vector& r : markers_)
    {
        nearForces_.X.push_back(x.centre + (R & r));
    }
    nearForces_.F.assign(x.forces.begin(), x.forces.end());
    return nearForces_;
}

Foam::scalar Foam::rigidGroup::slipOf(const body& x, const vectorField& u)
{
    return max(
        mag(x.velocity + (x.angularVelocity ^ (x.markers - x.centre)) - u));
}

void Foam::rigidGroup::recordSlip(const vector* U)
{
    forAll(mine(), i)
    {
        body& x = bodies_[i];
        x.slip = slipOf(x, felt(i, U));
        U += markers_.size();
    }
}

Foam::scalarField Foam::rigidGroup::gains(const scalar* density,
                                          const bodyStep& s) const
{
    scalarField c(overlap_.size());
    forAll(c, k)
    {
        c[k] = 1 / (overlap_[k] * density[k] * s.impulseFraction * s.dt /
                        (scene_.rho * pow3(h_)) +
                    nearMobility_);
    }
    return c;
}

Foam::string Foam::rigidGroup::move(const vector* U, const scalar* density,
                                    const bodyStep& s)
{
    const auto timing(scene_.effects.time("rigid"));
    string trouble;
    forAll(mine(), i)
    {
        body& x = bodies_[i];
        const label n = markers_.size(), number = mine()[i];
        vector force(Zero), torque(Zero);
        if (scene_.forces.actOn(name(), number))
        {
            vectorField F(n, Zero);
            scene_.forces.add(
                name(), number, [&]() { return points(i); }, s.time,
                scene_.effects, F);
            force = sum(F);
            torque = sum((x.turn.R() & surface_) ^ F);
        }
        vectorField u(felt(i, U));

        // The velocity at the start of the step stands for that at its end: see
        // filamentGroup. Of the mesh's velocity only: the near field is that of
        // forces, and its change would be answered twice
        const vectorField now(UList<vector>(const_cast<vector*>(U), n));
        if (!s.predicted && x.dt > 0) u += 0.5 * (now - x.U);
        x.U = now;
        advance(x, u, gains(density, s), force, torque, s);

        // Implicit solvers of the fluid bear no such force for long
        const scalar cells = s.dt * slipOf(x, u) / h_;
        if (!(cells < 20))
        {
            OStringStream os;
            os << nameOf(i).c_str() << " at " << x.centre
               << ": the fluid passes its surface by " << Foam::name(cells)
               << " cells in a step, limit 20; its velocity is " << x.velocity
               << ", the force on the fluid " << sum(x.forces);
            trouble = os.str();
        }
        U += n;
        density += n;
    }
    return trouble;
}

// Six equations for V and W at the end of the step: see the header
void Foam::rigidGroup::advance(body& x, const vectorField& U,
                               const scalarField& gain, const vector& force,
                               const vector& torque, const bodyStep& s)
{
    using matrix = Eigen::Matrix<scalar, 6, 6>;
    const vector centre(x.centre + s.dt * x.velocity);
    const vectorField r(x.markers - centre);
    const tensor R(x.turn.R());
    const scalar a = shape_.radius(), fluid = scene_.rho * shape_.volume();
    const vector I(fluid * shape_.inertia());
    const tensor inertia(R & tensor(I.x(), 0, 0, 0, I.y(), 0, 0, 0, I.z()) &
                         R.T());
    const scalar tau = sqr(a) * scene_.rho / (20.2 * scene_.mu);
    const scalar follows = s.dt / (tau + s.dt);
    const scalar all = sum(gain);

    // What the markers answer to V, W and the fluid
    tensor shift(Zero), turn(Zero); // F, torque by W
    vector onF(Zero), onT(Zero), mean(Zero), lever(Zero);
    forAll(r, k)
    {
        const tensor cross(0, r[k].z(), -r[k].y(), -r[k].z(), 0, r[k].x(),
                           r[k].y(), -r[k].x(), 0); // cross & W = W x r
        shift += gain[k] * cross;
        turn += gain[k] * (cross.T() & cross);
        lever += gain[k] * r[k];
        mean += gain[k] * U[k];
        const vector f(x.forces[k] - gain[k] * U[k]);
        onF += f;
        onT += r[k] ^ f;
    }
    if (x.dt == 0)
    {
        // As the fluid moves, or as is prescribed
        x.velocity = mean / all;
        vector swirl(Zero);
        forAll(r, k)
        {
            swirl += gain[k] * (r[k] ^ (U[k] - x.velocity));
        }
        x.angularVelocity = inv(turn) & swirl;
        const scalar start = s.time - s.dt;
        if (velocity_.valid()) x.velocity = velocity_->value(start);
        if (angularVelocity_.valid())
            x.angularVelocity = angularVelocity_->value(start);
        x.spin = inertia & x.angularVelocity;
    }

    // The fluid inside moves with the mesh's part of V: less what the near field adds,
    // which changes with F. The mean slip of light bodies has a larger gain
    const scalar mass = (densityRatio_ - 1) * fluid / s.dt;
    const scalar lag = fluid / s.dt * meanNearMobility_ / r.size();
    const scalar more = max(scalar(0), -5 * mass / (1 + lag) - all) / all;

    matrix A(matrix::Zero());
    Eigen::Matrix<scalar, 6, 1> b;
    const tensor J((densityRatio_ - follows) / s.dt * inertia + turn);
    const tensor armOfMean(0, -lever.z(), lever.y(), lever.z(), 0, -lever.x(),
                           -lever.y(), lever.x(), 0); // & V = lever x V
    const vector push(force + mass * x.velocity + lag * sum(x.forces) +
                      (1 + lag) * (more * mean - onF));
    const vector twist(
        torque + densityRatio_ / s.dt * (inertia & x.angularVelocity) -
        densityRatio_ * (x.angularVelocity ^ (inertia & x.angularVelocity)) -
        follows / s.dt * x.spin - onT + more / all * (lever ^ mean));
    for (direction i = 0; i < 3; ++i)
    {
        for (direction j = 0; j < 3; ++j)
        {
            A(i, j) = i == j ? mass + (1 + lag) * (1 + more) * all : 0;
            A(i, 3 + j) = (1 + lag) * shift(i, j);
            A(3 + i, j) = (1 + more) * armOfMean(i, j);
            A(3 + i, 3 + j) = J(i, j);
        }
        b[i] = push[i];
        b[3 + i] = twist[i];
    }
    const auto prescribe =
        [&](const autoPtr<Function1<vector>>& motion, const direction first)
    {
        if (!motion.valid()) return;
        const vector v(motion->value(s.time));
        for (direction i = 0; i < 3; ++i)
        {
            A.row(first + i).setZero();
            A(first + i, first + i) = 1;
            b[first + i] = v[i];
        }
    };
    prescribe(velocity_, 0);
    prescribe(angularVelocity_, 3);
    const Eigen::Matrix<scalar, 6, 1> y(A.partialPivLu().solve(b));
    const vector V(y[0], y[1], y[2]), W(y[3], y[4], y[5]);

    const vector ofMean(more * (V - mean / all));
    forAll(r, k)
    {
        x.forces[k] += gain[k] * (V + (W ^ r[k]) - U[k] + ofMean);
    }
    x.spin += follows * ((inertia & W) - x.spin);
    x.turn = rotation(0.5 * s.dt * (x.angularVelocity + W)) * x.turn;
    x.turn /= mag(x.turn);
    x.centre += 0.5 * s.dt * (x.velocity + V);
    x.velocity = V;
    x.angularVelocity = W;
    x.dt = s.dt;
}

Foam::string Foam::rigidGroup::describe(const flowScales& flow) const
{
    const scalar a = shape_.radius();
    OStringStream os;
    os.precision(4);
    os << nBodies() << " of radius a " << a << ", a/h " << a / h_
       << ", density ratio " << densityRatio_ << ", volume fraction "
       << nBodies() * shape_.volume() / cmptProduct(scene_.grid.length());
    if (flow.rate > 0)
    {
        os << ", Re " << scene_.rho * flow.rate * sqr(a) / scene_.mu;
    }
    else if (flow.speed > 0)
    {
        os << ", Re " << scene_.rho * flow.speed * a / scene_.mu;
    }
    return os.str();
}

// Measured on spheres in a periodic box and in shear (tests/validation/rigidSphere)
Foam::scalar Foam::rigidGroup::errorOfCells(const bool nearField) const
{
    const scalar radius = shape_.radius() / h_;
    if (radius < 3 * (1 - 1e-6) || !isSphere() || scene_.insideBodies)
        return -1;
    return nearField ? 0.003 * sqr(3 / radius) : 0.064 / radius;
}

Foam::expectedErrors Foam::rigidGroup::errors(const flowScales&) const
{
    expectedErrors e{name(), "drag", {}};
    const scalar radius = shape_.radius() / h_;
    e.parts.push_back(
        {"cells", errorOfCells(bool(nearField_)),
         "a/h " + Foam::name(radius) +
             (scene_.insideBodies ? ", not measured inside a capsule"
              : isSphere()        ? ""
                                  : ", not measured on ellipsoids") +
             (nearField_ ? " with near field" : " without near field"),
         [this](const scalar left) -> string
         {
             return "cells of " +
                    atMost(shape_.radius() / (nearField_
                                                  ? 3 * std::sqrt(0.003 / left)
                                                  : 0.064 / left)) +
                    " m and smaller";
         }});
    e.parts.push_back(
        ofForcing(scene_.mu / scene_.rho, scene_.deltaT, h_, scene_.duration));
    return e;
}

std::vector<Foam::errorIndicator> Foam::rigidGroup::indicators() const
{
    scalar slip = 0;
    for (const body& x : bodies_)
    {
        // Of those that are held or lie still: the speed that the force stands for
        const scalar a = shape_.radius();
        const scalar speed = mag(x.velocity) + mag(x.angularVelocity) * a;
        const scalar ofForce = mag(sum(x.forces)) /
                               (6 * constant::mathematical::pi * scene_.mu * a);
        slip = max(slip, x.slip / max(max(speed, ofForce), VSMALL));
    }
    return {{"slip over speed", slip, 0.05, smallerSteps()}};
}

std::vector<Foam::bodyColumn> Foam::rigidGroup::columns() const
{
    return {{"x", "m"},
            {"y", "m"},
            {"z", "m"},
            {"velocityX", "m/s"},
            {"velocityY", "m/s"},
            {"velocityZ", "m/s"},
            {"angularVelocityX", "1/s"},
            {"angularVelocityY", "1/s"},
            {"angularVelocityZ", "1/s"},
            {"axisX", "1"},
            {"axisY", "1"},
            {"axisZ", "1"},
            {"forceX", "N"},
            {"forceY", "N"},
            {"forceZ", "N"},
            {"torqueX", "N-m"},
            {"torqueY", "N-m"},
            {"torqueZ", "N-m"},
            {"stressletXX", "N-m"},
            {"stressletXY", "N-m"},
            {"stressletXZ", "N-m"},
            {"stressletYY", "N-m"},
            {"stressletYZ", "N-m"},
            {"stressletZZ", "N-m"},
            {"slip", "m/s", true}};
}

// Force and torque are those on the fluid; the stresslet over the volume of the box
// is the body's part of the stress
Foam::scalarList Foam::rigidGroup::sample(const label i) const
{
    const body& x = bodies_[i];
    const vector force(sum(x.forces));
    vector torque(Zero);
    symmTensor stresslet(Zero);
    const tensor R(x.turn.R());
    forAll(markers_, k)
    {
        const vector r(isSphere() ? markers_[k] : R & markers_[k]);
        torque += r ^ x.forces[k];
        stresslet -= symm(r * x.forces[k]);
    }
    scalarList values;
    for (const vector& v : {vector(x.centre), x.velocity, x.angularVelocity,
                            vector(R & vector(0, 0, 1)), force, torque})
    {
        values.append(scalarList({v.x(), v.y(), v.z()}));
    }
    values.append(
        scalarList({stresslet.xx(), stresslet.xy(), stresslet.xz(),
                    stresslet.yy(), stresslet.yz(), stresslet.zz(), x.slip}));
    return values;
}

// Rings around the axis, and one polygon over each pole
Foam::bodySurface Foam::rigidGroup::surface(const label i) const
{
    const body& x = bodies_[i];
    const tensor R(x.turn.R());
    const label nTheta = 16, nPhi = 32;
    const scalar pi = constant::mathematical::pi;
    bodySurface s;
    s.points.setSize(nTheta * nPhi);
    for (label r = 0; r < nTheta; ++r)
    {
        const scalar t = pi * (r + 0.5) / nTheta;
        for (label j = 0; j < nPhi; ++j)
        {
            const scalar p = 2 * pi * j / nPhi;
            const vector on(
                cmptMultiply(shape_.semiAxes(),
                             vector(std::sin(t) * std::cos(p),
                                    std::sin(t) * std::sin(p), std::cos(t))));
            s.points[r * nPhi + j] = x.centre + (R & on);
        }
    }
    s.faces = ringFaces(nTheta, nPhi);
    s.vectorNames = {"velocity"};
    s.vectors.setSize(1);
    s.vectors[0] = x.velocity + (x.angularVelocity ^ (s.points - x.centre));
    return s;
}
