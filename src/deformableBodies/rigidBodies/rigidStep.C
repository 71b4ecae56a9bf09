// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "rigidStep.H"
#include <Eigen/LU>

namespace
{
using namespace Foam;
using matrix = Eigen::Matrix<scalar, 6, 6>;
using column = Eigen::Matrix<scalar, 6, 1>;

//- Inertia tensor in the axes of the box
tensor turned(const vector& I, const quaternion& turn)
{
    const tensor R(turn.R());
    return R & tensor(I.x(), 0, 0, 0, I.y(), 0, 0, 0, I.z()) & R.T();
}

//- Replace three equations by a prescribed velocity
void prescribe(matrix& A, column& b, const direction first, const vector* v)
{
    if (!v) return;
    for (direction i = 0; i < 3; ++i)
    {
        A.row(first + i).setZero();
        A(first + i, first + i) = 1;
        b[first + i] = (*v)[i];
    }
}
} // namespace

Foam::quaternion Foam::rotationBy(const vector& angle)
{
    return mag(angle) > 0 ? quaternion(angle / mag(angle), mag(angle))
                          : quaternion::I;
}

Foam::rigidStep::rigidStep(const properties& body, const scalar dt,
                           const vectorField& r, const vectorField& U,
                           const scalarField& gain, const vectorField& w)
    : body_(body),
      dt_(dt),
      r_(r),
      U_(U),
      gain_(gain),
      w_(w),
      sumGain_(sum(gain))
{
    forAll(r, k)
    {
        const tensor cross(0, r[k].z(), -r[k].y(), -r[k].z(), 0, r[k].x(),
                           r[k].y(), -r[k].x(), 0); // cross & W = W x r
        forceOfSpin_ += gain[k] * cross;
        torqueOfSpin_ += gain[k] * (cross.T() & cross);
        lever_ += gain[k] * r[k];
        sumU_ += gain[k] * U[k];
    }
    forAll(w, k)
    {
        innerVelocity_ += (w[k] & U[k]) * r[k];
    }

    // The fluid inside moves with V less the velocity of the near field, nearMobility
    // times F
    mass_ = (body.densityRatio - 1) * body.fluidMass / dt;
    innerMass_ = body.fluidMass / dt * body.nearMobility / r.size();
    addedGain_ = w.empty() ? 0
                         : max(scalar(0),
                               -5 * mass_ / (1 + innerMass_) - sumGain_);
}

void Foam::rigidStep::start(motion& m, const load& given) const
{
    m.velocity = sumU_ / sumGain_;
    vector swirl(Zero);
    forAll(r_, k)
    {
        swirl += gain_[k] * (r_[k] ^ (U_[k] - m.velocity));
    }
    m.angularVelocity = inv(torqueOfSpin_) & swirl;
    if (given.velocity) m.velocity = *given.velocity;
    if (given.angularVelocity) m.angularVelocity = *given.angularVelocity;
    m.innerAngularMomentum = turned(body_.inertia, m.turn) & m.angularVelocity;
}

Foam::rigidStep::answer Foam::rigidStep::solve(const motion& m,
                                               const vectorField& forces,
                                               const load& given) const
{
    const tensor inertia(turned(body_.inertia, m.turn));
    const vector& spin = m.angularVelocity;
    const answer first(solve(m, forces, given, inertia,
                             body_.densityRatio * (spin ^ (inertia & spin))));
    const scalar apart = cmptMax(body_.inertia) - cmptMin(body_.inertia);
    if (apart <= SMALL * cmptMax(body_.inertia)) return first;
    return solve(m, forces, given,
                 turned(body_.inertia, after(m, first.angularVelocity)), Zero);
}

Foam::quaternion Foam::rigidStep::after(const motion& m, const vector& W) const
{
    return rotationBy(0.5 * dt_ * (m.angularVelocity + W)) * m.turn;
}

Foam::rigidStep::answer Foam::rigidStep::solve(const motion& m,
                                               const vectorField& forces,
                                               const load& given,
                                               const tensor& lastInertia,
                                               const vector& gyroscopic) const
{
    const tensor firstInertia(turned(body_.inertia, m.turn));
    const scalar ratio = body_.densityRatio;
    const scalar relaxed = dt_ / (body_.relaxation + dt_);

    // Answer of the markers at rest
    vector force(Zero), torque(Zero);
    forAll(r_, k)
    {
        const vector f(forces[k] - gain_[k] * U_[k]);
        force += f;
        torque += r_[k] ^ f;
    }

    const tensor J((ratio - relaxed) / dt_ * lastInertia + torqueOfSpin_);
    const tensor cross(0, -lever_.z(), lever_.y(), lever_.z(), 0, -lever_.x(),
                       -lever_.y(), lever_.x(), 0); // cross & V = lever x V
    const scalar resistance =
        mass_ + (1 + innerMass_) * (sumGain_ + addedGain_);
    const vector push(given.force + mass_ * m.velocity +
                      innerMass_ * sum(forces) +
                      (1 + innerMass_) * (addedGain_ * innerVelocity_ - force));
    const vector twist(
        given.torque + ratio / dt_ * (firstInertia & m.angularVelocity) -
        gyroscopic - relaxed / dt_ * m.innerAngularMomentum - torque);
    matrix A(matrix::Zero());
    column b;
    for (direction i = 0; i < 3; ++i)
    {
        for (direction j = 0; j < 3; ++j)
        {
            A(i, j) = i == j ? resistance : 0;
            A(i, 3 + j) = (1 + innerMass_) * forceOfSpin_(i, j);
            A(3 + i, j) = cross(i, j);
            A(3 + i, 3 + j) = J(i, j);
        }
        b[i] = push[i];
        b[3 + i] = twist[i];
    }
    prescribe(A, b, 0, given.velocity);
    prescribe(A, b, 3, given.angularVelocity);
    const column y(A.partialPivLu().solve(b));
    return {vector(y[0], y[1], y[2]), vector(y[3], y[4], y[5]),
            given.velocity ? 0 : 1 / resistance, lastInertia};
}

void Foam::rigidStep::advance(motion& m, vectorField& forces,
                              const load& given) const
{
    const answer y(solve(m, forces, given));
    const vector &V = y.velocity, &W = y.angularVelocity;
    forAll(r_, k)
    {
        forces[k] += gain_[k] * (V + (W ^ r_[k]) - U_[k]);
    }
    forAll(w_, k)
    {
        forces[k] += addedGain_ * (r_[k] & (V - innerVelocity_)) * w_[k];
    }
    const scalar relaxed = dt_ / (body_.relaxation + dt_);
    m.innerAngularMomentum +=
        relaxed * ((y.inertia & W) - m.innerAngularMomentum);
    m.turn = after(m, W);
    m.turn /= mag(m.turn);
    m.centre += 0.5 * dt_ * (m.velocity + V);
    m.velocity = V;
    m.angularVelocity = W;
}
