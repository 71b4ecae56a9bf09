// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "rigidStep.H"
#include "scalarField.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
//- Markers of a body of unlike sides, gains and properties; forces of the last step
struct scene
{
    rigidStep::properties body{2, 3, vector(1, 2, 1.5), 0.7, 0};
    scalar dt = 0.1;
    vectorField r, U, forces, w;
    scalarField gain;

    scene()
        : r(6, Zero),
          U(6, vector(0.3, -0.2, 0.1)),
          forces(6, Zero),
          gain(6, 2)
    {
        forAll(r, k)
        {
            const direction d = k / 2;
            r[k][d] = (1 + 0.2 * d) * (k % 2 ? -1 : 1);
        }
    }

    rigidStep step() const { return {body, dt, r, U, gain, w}; }
};

rigidStep::motion atRest()
{
    rigidStep::motion m;
    m.centre = Zero;
    m.turn = quaternion::I;
    return m;
}

const rigidStep::load none{Zero, Zero, nullptr, nullptr};
} // namespace

TEST(RigidStep, startsWithTheFluid)
{
    scene s;
    const vector W(0.2, 0.5, -0.4);
    s.U += W ^ s.r;
    s.body.inertia = Zero; // the fluid inside turns as well
    rigidStep::motion m(atRest());
    s.step().start(m, none);
    EXPECT_LT(mag(m.velocity - vector(0.3, -0.2, 0.1)), 1e-14);
    EXPECT_LT(mag(m.angularVelocity - W), 1e-14);

    // The motion goes on without a force
    s.step().advance(m, s.forces, none);
    EXPECT_LT(max(mag(s.forces)), 1e-13);
    EXPECT_LT(mag(m.angularVelocity - W), 1e-13);
}

TEST(RigidStep, forcesBalanceMomentum)
{
    scene s;
    forAll(s.gain, k)
    {
        s.gain[k] += 0.1 * k;
    }
    s.forces = s.r ^ vector(0.1, 0.2, 0.3);
    rigidStep::motion m(atRest());
    m.velocity = vector(0.1, 0.7, -0.3);
    m.angularVelocity = vector(0.5, 0, 0.2);
    const vector before(m.velocity), weight(0, -2, 0);
    s.step().advance(m, s.forces, {weight, Zero, nullptr, nullptr});
    const vector inertia((s.body.densityRatio - 1) * s.body.fluidMass / s.dt *
                         (m.velocity - before));
    EXPECT_LT(mag(inertia + sum(s.forces) - weight), 1e-12);
    EXPECT_LT(mag(m.centre - 0.5 * s.dt * (before + m.velocity)), 1e-15);
}

TEST(RigidStep, prescribedMotionIsKept)
{
    scene s;
    rigidStep::motion m(atRest());
    const vector V(0, 1, 0), W(0, 0, 2);
    s.step().advance(m, s.forces, {vector(5, 5, 5), Zero, &V, &W});
    EXPECT_LT(mag(m.velocity - V), 1e-15);
    EXPECT_LT(mag(m.angularVelocity - W), 1e-15);

    // Each marker answers to its slip
    forAll(s.forces, k)
    {
        const vector slip(V + (W ^ s.r[k]) - s.U[k]);
        EXPECT_LT(mag(s.forces[k] - s.gain[k] * slip), 1e-13);
    }
}

TEST(RigidStep, lightBodiesAnswerMoreToTheFluidInside)
{
    // A gain of 5 times the missing mass over dt at least, so that the exchange of body
    // and fluid does not grow
    scene s;
    s.body.densityRatio = 0.1;
    s.body.fluidMass = 1000;
    s.w = s.r;
    for (vector& w : s.w)
    {
        w /= 2 * magSqr(w); // sum w r = I
    }
    rigidStep::motion m(atRest());
    s.step().advance(m, s.forces, none);
    const scalar missing = (1 - s.body.densityRatio) * s.body.fluidMass / s.dt;
    const vector slip(m.velocity - s.U[0]);
    EXPECT_NEAR(mag(sum(s.forces)) / mag(slip) / (5 * missing), 1, 1e-10);

    // Flow along the surface feels no more than the gains
    s.forces = Zero;
    forAll(s.U, k)
    {
        s.U[k] = s.r[k] ^ vector(1, 2, 3);
    }
    m = atRest();
    const vector held(Zero);
    s.step().advance(m, s.forces, {Zero, Zero, &held, &held});
    EXPECT_LT(max(mag(s.forces + s.gain * s.U)), 1e-12);
}

// Without a fluid: markers without gain do not feel it, and nearly all of the mass is the body's
TEST(RigidStep, freeEllipsoidKeepsItsAngularMomentum)
{
    scene s;
    s.body = {1000, 3, vector(5, 5, 2), 0.7, 0};
    s.gain = 1e-12;
    s.U = Zero;
    s.dt = 0.02;
    rigidStep::motion m(atRest());
    m.angularVelocity = vector(0.6, 0.1, 0.9);
    const auto momentum = [&]()
    {
        const tensor R(m.turn.R());
        return R & (tensor(5, 0, 0, 0, 5, 0, 0, 0, 2) &
                    (R.T() & m.angularVelocity));
    };
    const vector L(momentum());
    const scalar energy = L & m.angularVelocity;
    for (label i = 0; i < 1000; ++i)
    {
        vectorField forces(6, Zero);
        s.step().advance(m, forces, none);
    }
    EXPECT_LT(mag(momentum() - L), 5e-3 * mag(L));
    EXPECT_LT(mag((momentum() & m.angularVelocity) / energy - 1), 5e-3);
}
