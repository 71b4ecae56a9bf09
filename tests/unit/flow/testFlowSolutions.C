// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The flow engine against exact solutions

#include "testFlow.H"
#include <cmath>

using namespace Foam;
using namespace test;

TEST(FlowSolutions, PoiseuilleErrsByTheKnownAmount)
{
    // Steady between walls at y = 0, 1: g y (1 - y)/(2 nu), plus g h^2/(8 nu)
    // from the mirrored velocity beyond the walls
    const label n = 12;
    const scalar nu = 0.7, g = 3, h = 1.0 / n;
    for (const char* diffusion : {"diffusion ADI;", "diffusion FFT;"})
    {
        test::box b(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n), wallsInY,
                    nu);
        const flowRun o(run(b, diffusion, 40, 1500, 0,
                            [&](staggeredField& f) { f[0] = g; }));
        test::expectBelow(
            std::string("Poiseuille, g h^2/(8 nu) taken off, ") + diffusion,
            errorOf(o.u, b,
                    [&](const vector& x)
                    {
                        return vector(g / (2 * nu) * x.y() * (1 - x.y()) +
                                          g * h * h / (8 * nu),
                                      0, 0);
                    }),
            1e-13);
    }
}

TEST(FlowSolutions, flowRateIsHeld)
{
    const label n = 16;
    const scalar nu = 0.01, h = 1.0 / n;
    for (const char* controls : {"diffusion ADI;", "diffusion explicit;",
                                 "timeScheme RK3; diffusion ADI;"})
    {
        test::box b(labelVector(8, n, 8), vector(1, 1, 1), wallsInY, nu);
        b.start([](const vector& x)
                { return vector(1 + 0.1 * std::sin(2 * pi * x.z()), 0, 0); });
        auto flow = b.flow(controls);
        const scalar dt = 0.05 * h * h / nu;
        scalar worst = 0;
        for (label i = 0; i < 8000; ++i)
        {
            // With the last gradient as a guess and without one
            flow->force().clear();
            const scalar guess = i % 2 ? flow->mean().gradient() : 0;
            flow->mean().hold(0, 1, guess, flow->force());
            if (flow->force()[0][0] != guess)
                ADD_FAILURE() << "bodies do not see the gradient";
            step(*flow, dt);
            const staggeredField u(velocityOf(*flow, b));
            worst = max(worst, mag(sum(u[0]) / u.box().count() - 1));
        }
        test::expectBelow(std::string("mean velocity held, ") + controls, worst,
                          1e-13);

        // From the discrete profile, g h^2/(8 nu) included, summed over cells
        const scalar g = 12 * nu / (1 + 2 * sqr(h));
        test::expectBelow("    pressure gradient against plane Poiseuille flow",
                          mag(flow->mean().gradient() / g - 1), 1e-10);
    }
}

TEST(FlowSolutions, StokesModeHasNoConvection)
{
    // Every solenoidal wave decays by its own rate, whatever its amplitude
    const scalar nu = 1, h = 2 * pi / 16;
    const scalar rate = nu * 2 * (2 - 2 * std::cos(h)) / sqr(h);
    const auto start = [](const vector& x)
    {
        return 1e3 * vector(std::cos(x.x()) * std::sin(x.y()),
                            -std::sin(x.x()) * std::cos(x.y()), 0);
    };
    test::box b(labelVector(16, 16, 4), vector(2 * pi, 2 * pi, 1), periodic,
                nu);
    b.start(start);
    const flowRun o(run(b, "convection off;", 1, 400));
    test::expectBelow("Stokes mode, decay of a large vortex",
                      errorOf(o.u, b,
                              [&](const vector& x)
                              { return std::exp(-rate) * start(x); }) /
                          1e3,
                      1e-5);
}

TEST(FlowSolutions, withoutViscosityNothingDiffuses)
{
    const auto start = [](const vector& x)
    {
        return vector(std::cos(x.x()) * std::sin(x.y()),
                      -std::sin(x.x()) * std::cos(x.y()), 0);
    };
    for (const bool walls : {false, true})
    {
        test::box b(labelVector(16, 16, 4), vector(2 * pi, 2 * pi, 1),
                    walls ? wallsInY : periodic, 0);
        b.start(start);
        const flowRun explicitly(run(b, "diffusion explicit;", 0.5, 10));
        for (const char* controls : {"diffusion ADI;", "diffusion FFT;"})
        {
            b.start(start);
            const flowRun o(run(b, controls, 0.5, 10));
            test::expectBelow(std::string("nu 0, ") + controls +
                                  " against explicit",
                              difference(o.u, explicitly.u), 1e-13);
        }
    }
}

TEST(FlowSolutions, pressureBalancesAForceInOneStep)
{
    // A force that is a gradient, in waves of four cells, at nu dt/h^2 = 10
    const scalar h = 2 * pi / 16;
    const auto potential = [=](const label i)
    { return std::sin(4 * (i + 0.5) * h); };
    for (const char* controls :
         {"convection off; diffusion FFT;", "convection off; diffusion ADI;"})
    {
        test::box b(labelVector(16, 16, 4), vector(2 * pi, 2 * pi, 0.5 * pi),
                    periodic, 10 * sqr(h));
        b.start([](const vector&) { return vector(Zero); });
        auto flow = b.flow(controls);
        uniformGrid::New(b.mesh()).box().cells(
            [&](const label i, const labelVector& c)
            {
                flow->force()[0][i] =
                    (potential(c.x()) - potential(c.x() - 1)) / h;
            });
        step(*flow, 1);
        flow->fill();
        scalar worst = 0;
        forAll(*b.p, celli)
        {
            const scalar x = b.mesh().C()[celli].x();
            worst = max(worst, mag((*b.p)[celli] - std::sin(4 * x)));
        }
        test::expectBelow("pressure against the potential of a force", worst,
                          1e-10);
    }
}

TEST(FlowSolutions, layersOfTwoViscosities)
{
    // Shear across two layers: lower half nu = 1, upper half nu = ratio. Steady:
    // the stress is continuous
    const label n = 16;
    for (const scalar ratio : {0.1, 0.5, 2.0, 10.0, 100.0})
    {
        test::box b(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n), wallsInY,
                    1);
        b.moveWalls(Zero, vector(1, 0, 0));
        forAll(*b.nu, i)
        {
            (*b.nu)[i] = b.mesh().C()[i].y() < 0.5 ? 1 : ratio;
        }
        const scalar shear = 2 * ratio / (1 + ratio); // in the lower layer
        const auto exact = [&](const vector& x)
        {
            return vector(x.y() < 0.5 ? shear * x.y()
                                      : 1 - shear / ratio * (1 - x.y()),
                          0, 0);
        };
        const scalar largest = max(ratio, scalar(1));
        for (const scalar number : {0.5, 10.0, 200.0})
        {
            // Long enough for diffusion, for the split part, which converges
            // like (1 - nu/nu_max)^(steps/2), and for Crank-Nicolson, which
            // keeps (1 - h^2/(nu dt))^steps of a wave of length 2 h
            const scalar dt = number / sqr(scalar(n)) / largest;
            const scalar rest = 1 - min(ratio, 1 / ratio);
            const label steps = label(3 / min(ratio, scalar(1)) / dt) +
                                label(-60 / std::log(rest)) +
                                label(30 * number);
            char what[128];
            std::snprintf(what, sizeof(what),
                          "layers 1 : %g, nu_max dt/h^2 %g, steady error",
                          ratio, number);
            test::expectBelow(
                what,
                errorOf(run(b, "diffusion ADI;", steps * dt, steps).u, b,
                        exact),
                1e-9);
        }
    }
}
