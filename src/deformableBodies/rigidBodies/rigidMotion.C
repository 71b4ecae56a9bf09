// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Rigid bodies and the fluid within a time step

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
        x.X = x.centre + dt * x.velocity;
        if (isSphere())
        {
            x.X += markers_;
        }
        else
        {
            x.X += (rotation(dt * x.angularVelocity) * x.turn).R() & markers_;
        }
        X = std::copy(x.X.begin(), x.X.end(), X);
    }
}

void Foam::rigidGroup::lines(label* line) const
{
    for (const label number : mine())
    {
        line = std::fill_n(line, markers_.size(), number);
    }
}

Foam::vectorField Foam::rigidGroup::surfaceVelocity(const label i,
                                                    const vector* U) const
{
    const body& x = bodies_[i];
    const label n = markers_.size();
    vectorField v(UList<vector>(const_cast<vector*>(U), n));
    if (nearField_)
    {
        const auto timing(scene_.effects.time("nearField"));
        vectorField own(n);
        nearField_->velocity(x.X.cdata(), x.forces.cdata(), n, own.data());
        v += own;
        Foam::add(corrections_, i, x.X.cdata(), n, v.data());
    }
    return v;
}

const Foam::nearSurface::sources&
Foam::rigidGroup::nearSources(const label i) const
{
    const body& x = bodies_[i];
    const tensor R(isSphere() ? tensor::I : x.turn.R());
    nearSources_.X.clear();
    for (const vector& r : markers_)
    {
        nearSources_.X.push_back(x.centre + (R & r));
    }
    nearSources_.F.assign(x.forces.begin(), x.forces.end());
    return nearSources_;
}

Foam::scalar Foam::rigidGroup::slipOf(const body& x, const vectorField& u)
{
    return max(mag(x.velocity + (x.angularVelocity ^ (x.X - x.centre)) - u));
}

void Foam::rigidGroup::recordSlip(const vector* U)
{
    forAll(mine(), i)
    {
        body& x = bodies_[i];
        x.slip = slipOf(x, surfaceVelocity(i, U));
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
        vectorField u(surfaceVelocity(i, U));

        // The change is that of the mesh's velocity only: the near field is that of
        // forces, and its change would be answered twice
        const vectorField change(x.change(U, x.dt == 0));
        if (!s.predicted) u += 0.5 * change;
        advance(x, u, gains(density, s), force, torque, s);

        // Implicit solvers of the fluid bear no such force for long
        const scalar cells = s.dt * slipOf(x, u) / h_;
        if (!(cells < 20))
        {
            OStringStream os;
            os << nameOfBody(mine()[i]).c_str() << " at " << x.centre
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
    const vectorField r(x.X - centre);
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
