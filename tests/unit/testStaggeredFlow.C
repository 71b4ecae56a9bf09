// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The flow engine against exact solutions and against itself: orders in space
// and time, what must be conserved, what must stay stable

#include "testBox.H"
#include <cmath>
#include <cstdlib>
#include <new>

// Counts what the program allocates
static long allocations = 0;

void* operator new(const std::size_t n)
{
    ++allocations;
    if (void* p = std::malloc(n)) return p;
    throw std::bad_alloc();
}
void operator delete(void* p) noexcept
{
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept
{
    std::free(p);
}

using namespace Foam;

namespace
{
const scalar pi = constant::mathematical::pi;
const FixedList<bool, 3> periodic(false);
const FixedList<bool, 3> wallsInY({false, true, false});

//- Velocity after a run of equal steps
staggeredField velocityOf(const staggeredFlow& flow, const test::box& b)
{
    staggeredField u(uniformGrid::New(b.mesh()).box());
    flow.velocity(u);
    return u;
}

struct outcome
{
    staggeredField u;
    scalar divergence; // largest of all steps
};

//- Runs to a time; the step alternates between dt(1 +- wobble)
template<class Force>
outcome run(test::box& b, const char* controls, const scalar end,
            const label steps, const scalar wobble, Force setForce)
{
    auto flow = b.flow(controls);
    const scalar dt = end / steps;
    scalar divergence = 0;
    for (label n = 0; n < steps; ++n)
    {
        flow->force().clear();
        setForce(flow->force());
        const scalar now = dt * (1 + (n % 2 ? -wobble : wobble));
        flow->step(now);
        divergence = max(divergence, flow->divergence());
    }
    return {velocityOf(*flow, b), divergence};
}

outcome run(test::box& b, const char* controls, const scalar end,
            const label steps, const scalar wobble = 0)
{
    return run(b, controls, end, steps, wobble, [](staggeredField&) {});
}

scalar difference(const staggeredField& a, const staggeredField& b)
{
    scalar sum = 0, n = 0;
    for (direction d = 0; d < 3; ++d)
    {
        sum += sumSqr(a[d] - b[d]);
        n += a[d].size();
    }
    return std::sqrt(sum / n);
}

//- Largest difference to a velocity in space
template<class Velocity>
scalar errorOf(const staggeredField& u, const test::box& b, Velocity exact)
{
    const uniformGrid& grid = uniformGrid::New(b.mesh());
    scalar largest = 0;
    for (label i = 0; i < u.box().count(); ++i)
    {
        for (direction d = 0; d < 3; ++d)
        {
            vector x(u.box().cell(i));
            for (direction e = 0; e < 3; ++e)
            {
                x[e] = (x[e] + (e == d ? 0 : 0.5)) * grid.h()[e];
            }
            largest = max(largest, mag(u[d][i] - exact(x)[d]));
        }
    }
    return largest;
}

void expectOrder(const std::string& what, const double order,
                 const double least, const double most = 1e9)
{
    std::printf("    %-58s %9.3f  (%.2f", what.c_str(), order, least);
    std::printf(most < 1e9 ? " to %.2f)\n" : " or more)\n", most);
    EXPECT_GE(order, least) << what;
    EXPECT_LE(order, most) << what;
}

//- A flow without symmetry in a periodic cube of side 2 pi: two Taylor-Green
//  vortices of different wave vectors, oblique to each other
vector vortices(const vector& x)
{
    return vector(std::cos(x.x()) * std::sin(x.y()) + 0.5 * std::cos(x.z()),
                  -std::sin(x.x()) * std::cos(x.y()),
                  0.4 * std::sin(x.x() + 0.2) * std::cos(2 * x.y()));
}

//- A vortex between no-slip walls at y = 0 and 1, x and z of period 2: speed 1
vector walledVortex(const vector& x)
{
    const scalar s = std::sin(pi * x.y()), c = std::cos(pi * x.y());
    return vector(2 * s * c * std::cos(pi * x.x()),
                  sqr(s) * (std::sin(pi * x.x()) + 0.5 * std::cos(pi * x.z())),
                  -s * c * std::sin(pi * x.z()));
}

//- Order in time: differences of runs with n, 2n, 4n steps
template<class Start>
scalar timeOrder(const labelVector& n, const vector& L,
                 const FixedList<bool, 3>& walls, const scalar nu,
                 const Start start, const char* controls, const scalar end,
                 const label steps, const scalar wobble = 0)
{
    std::vector<staggeredField> u;
    for (const label refinement : {1, 2, 4})
    {
        test::box b(n, L, walls, nu);
        b.start(start);
        const outcome o(run(b, controls, end, refinement * steps, wobble));
        EXPECT_LE(o.divergence, 1e-14);
        u.push_back(o.u);
    }
    return std::log2(difference(u[0], u[1]) / difference(u[1], u[2]));
}
} // namespace

TEST(StaggeredFlow, TaylorGreenInSpace)
{
    // Two-dimensional vortex, exact; the velocity decays by exp(-2 nu t)
    const scalar nu = 0.05, end = 0.5;
    const auto exact = [&](const vector& x)
    {
        return std::exp(-2 * nu * end) *
               vector(std::cos(x.x()) * std::sin(x.y()),
                      -std::sin(x.x()) * std::cos(x.y()), 0);
    };
    const auto start = [&](const vector& x)
    { return std::exp(2 * nu * end) * exact(x); };

    scalar before = 0;
    for (const label n : {16, 32, 64})
    {
        test::box b(labelVector(n, n, 4), vector(2 * pi, 2 * pi, 1), periodic,
                    nu);
        b.start(start);
        const outcome o(run(b, "", end, 8 * n));
        const scalar e = errorOf(o.u, b, exact);
        EXPECT_LE(o.divergence, 1e-14);
        if (before)
        {
            expectOrder("Taylor-Green, order in space, " + std::to_string(n),
                        std::log2(before / e), 1.95, 2.05);
        }
        before = e;
    }
}

TEST(StaggeredFlow, orderInTimePeriodic)
{
    struct scheme
    {
        const char* controls;
        scalar nu;
        label steps;
        scalar wobble;
    };
    for (const scheme& s :
         {scheme{"diffusion explicit;", 0.002, 40, 0},
          scheme{"diffusion ADI;", 0.02, 40, 0},
          scheme{"diffusion ADI;", 0.02, 40, 0.3},
          scheme{"diffusion FFT;", 0.02, 40, 0},
          scheme{"diffusion explicit;", 0.002, 40, 0.3},
          scheme{"timeScheme RK3; diffusion explicit;", 0.002, 20, 0},
          scheme{"timeScheme RK3; diffusion ADI;", 0.02, 20, 0}})
    {
        expectOrder(std::string("periodic, order in time, ") + s.controls +
                        (s.wobble ? " steps alternate +-30 %" : ""),
                    timeOrder(labelVector(16, 16, 16),
                              vector(2 * pi, 2 * pi, 2 * pi), periodic, s.nu,
                              vortices, s.controls, 2, s.steps, s.wobble),
                    1.9);
    }
}

TEST(StaggeredFlow, orderInTimeBetweenWalls)
{
    // nu dt/h^2 of the coarsest of three runs, at a Courant number of 0.3
    const label n = 16;
    const scalar h = 1.0 / n, dt = 0.3 * h;
    for (const scalar number : {0.1, 0.5, 2.5})
    {
        for (const char* diffusion : {"diffusion ADI;", "diffusion FFT;"})
        {
            char what[100];
            std::snprintf(what, sizeof(what),
                          "walled vortex, order in time, nu dt/h^2 %.1f %s",
                          number, diffusion);
            expectOrder(what,
                        timeOrder(labelVector(2 * n, n, 2 * n), vector(2, 1, 2),
                                  wallsInY, number * h * h / dt, walledVortex,
                                  diffusion, 10 * dt, 10),
                        1.9);
        }
    }
}

TEST(StaggeredFlow, orderInSpaceBetweenWalls)
{
    // Successive grids, compared where the faces of the finer one average to
    // those of the coarser
    std::vector<staggeredField> u;
    std::vector<scalar> d;
    for (const label n : {16, 32, 64})
    {
        test::box b(labelVector(2 * n, n, 4), vector(2, 1, 4.0 / n), wallsInY,
                    0.05);
        b.start(
            [](const vector& x)
            {
                const vector v(walledVortex(x));
                return vector(
                    v.x(), sqr(std::sin(pi * x.y())) * std::sin(pi * x.x()), 0);
            });
        u.push_back(run(b, "", 0.25, 10 * n).u);
        if (u.size() < 2) continue;

        const staggeredField &fine = u[u.size() - 1], &coarse = u[u.size() - 2];
        scalar sum = 0;
        for (label i = 0; i < coarse.box().count(); ++i)
        {
            const labelVector c(coarse.box().cell(i));
            if (c.z()) continue;
            for (direction e = 0; e < 2; ++e)
            {
                labelVector f(2 * c.x(), 2 * c.y(), 0), g(f);
                ++g[1 - e];
                sum += sqr(coarse[e][i] - 0.5 * (fine[e][fine.box().index(f)] +
                                                 fine[e][fine.box().index(g)]));
            }
        }
        d.push_back(std::sqrt(sum) / n);
    }
    expectOrder("walled vortex, order in space, 16 32 64",
                std::log2(d[0] / d[1]), 1.95, 2.05);
}

TEST(StaggeredFlow, stableAtLargeViscousSteps)
{
    const label n = 16;
    test::box b(labelVector(n, n, n), vector(1, 1, 1), wallsInY, 1);
    b.start([](const vector& x)
            { return vector(test::noise(x), 0, test::noise(x, 7)); });
    const scalar dt = 10.0 / sqr(scalar(n));
    for (const char* diffusion : {"diffusion ADI;", "diffusion FFT;"})
    {
        const outcome o(run(b, diffusion, 200 * dt, 200));
        staggeredField zero(o.u.box());
        test::expectBelow(
            std::string("noise after 200 steps of nu dt/h^2 = 10, ") +
                diffusion,
            difference(o.u, zero), 1e-2);
    }
}

TEST(StaggeredFlow, CouetteStartUp)
{
    // From rest at t = 0, exact from t0 on: walls at y = 0 (at rest) and 1
    const scalar nu = 1, t0 = 0.02, end = 0.08;
    const auto exactAt = [&](const scalar t)
    {
        return [=](const vector& x)
        {
            scalar u = x.y();
            for (label k = 1; k < 60; ++k)
            {
                u += 2 / (k * pi) * (k % 2 ? -1 : 1) *
                     std::exp(-sqr(k * pi) * nu * t) * std::sin(k * pi * x.y());
            }
            return vector(u, 0, 0);
        };
    };
    const auto after =
        [&](const label n, const label steps, const char* controls)
    {
        test::box b(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n), wallsInY,
                    nu);
        b.moveWalls(Zero, vector(1, 0, 0));
        b.start(exactAt(t0));
        return errorOf(run(b, controls, end, steps).u, b, exactAt(t0 + end));
    };

    // nu dt/h^2 = 0.1 on every grid: space and time together
    expectOrder("Couette start-up, order in space, nu dt/h^2 0.1",
                std::log2(after(16, 205, "") / after(32, 819, "")), 1.95, 2.05);
    expectOrder("Couette start-up, order in space, explicit",
                std::log2(after(16, 410, "diffusion explicit;") /
                          after(32, 1638, "diffusion explicit;")),
                1.95, 2.05);

    // In time at a fixed grid: differences of successive steps
    for (const scalar number : {0.1, 0.5, 2.5})
    {
        const label n = 32;
        const scalar dt = number / sqr(scalar(n));
        const label steps = max(label(end / dt + 0.5), label(8));
        std::vector<staggeredField> u;
        for (const label r : {1, 2, 4})
        {
            test::box b(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n),
                        wallsInY, nu);
            b.moveWalls(Zero, vector(1, 0, 0));
            b.start(exactAt(t0));
            u.push_back(run(b, "diffusion ADI;", steps * dt, r * steps).u);
        }
        expectOrder("Couette start-up, order in time, nu dt/h^2 " +
                        std::to_string(number).substr(0, 3),
                    std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                    1.9);
    }
}

TEST(StaggeredFlow, PoiseuilleErrsByTheKnownAmount)
{
    // Steady between walls at y = 0, 1: g y (1 - y)/(2 nu), plus g h^2/(8 nu)
    // from the mirrored velocity beyond the walls
    const label n = 12;
    const scalar nu = 0.7, g = 3, h = 1.0 / n;
    for (const char* diffusion : {"diffusion ADI;", "diffusion FFT;"})
    {
        test::box b(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n), wallsInY,
                    nu);
        const outcome o(run(b, diffusion, 40, 1500, 0,
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

TEST(StaggeredFlow, flowRateIsHeld)
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
        flow->hold(0, 1);
        const scalar dt = 0.05 * h * h / nu;
        scalar worst = 0;
        for (label i = 0; i < 8000; ++i)
        {
            flow->force().clear();
            flow->step(dt);
            worst = max(worst, mag(average(velocityOf(*flow, b)[0]) - 1));
        }
        test::expectBelow(std::string("mean velocity held, ") + controls, worst,
                          1e-13);

        // From the discrete profile, g h^2/(8 nu) included, summed over cells
        const scalar g = 12 * nu / (1 + 2 * sqr(h));
        test::expectBelow("    pressure gradient against plane Poiseuille flow",
                          mag(flow->meanGradient() / g - 1), 1e-10);
    }
}

TEST(StaggeredFlow, kineticEnergyWithoutViscosity)
{
    for (const char* controls : {"", "timeScheme RK3;"})
    {
        const auto drift = [&](const label steps)
        {
            test::box b(labelVector(16, 16, 16), vector(2 * pi, 2 * pi, 2 * pi),
                        periodic, 0);
            b.start(vortices);
            auto flow = b.flow(controls);
            flow->step(1e-12); // makes the start divergence-free
            const auto energy = [&]()
            {
                const staggeredField u(velocityOf(*flow, b));
                return sumSqr(u[0]) + sumSqr(u[1]) + sumSqr(u[2]);
            };
            const scalar before = energy(), dt = 2.0 / steps;
            for (label n = 0; n < steps; ++n)
            {
                flow->force().clear();
                flow->step(dt);
            }
            return mag(energy() / before - 1);
        };
        const scalar coarse = drift(40), fine = drift(80);
        test::expectBelow(
            std::string("energy drift in 2 time units, 80 steps ") + controls,
            fine, 1e-3);
        expectOrder("    its order in time", std::log2(coarse / fine), 1.9);
    }
}

TEST(StaggeredFlow, StokesModeHasNoConvection)
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
    const outcome o(run(b, "convection off;", 1, 400));
    test::expectBelow("Stokes mode, decay of a large vortex",
                      errorOf(o.u, b,
                              [&](const vector& x)
                              { return std::exp(-rate) * start(x); }) /
                          1e3,
                      1e-5);
}

TEST(StaggeredFlow, oscillatingWall)
{
    // A wall that moves with sin(t): order in time, the walls read each step
    // from a condition that changes
    std::vector<staggeredField> u;
    for (const label steps : {20, 40, 80})
    {
        test::box b(labelVector(4, 32, 4), vector(1, 1, 1), wallsInY, 0.5);
        auto flow = b.flow("diffusion ADI;");
        const scalar dt = 2.0 / steps;
        for (label n = 1; n <= steps; ++n)
        {
            const scalar t = n * dt;
            b.moveWalls(Zero, vector(sqr(std::sin(t)), 0, 0));
            flow->wallsMove();
            flow->force().clear();
            flow->step(dt);
        }
        u.push_back(velocityOf(*flow, b));
    }
    expectOrder("oscillating wall, order in time",
                std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                1.9);
}

TEST(StaggeredFlow, layersOfTwoViscosities)
{
    // Shear across two layers: lower half nu = 1, upper half nu = ratio. Steady:
    // the stress is continuous. Then a decay: error against dt
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
        const scalar shear = 2 * ratio / (1 + ratio); // of the lower layer
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
            char what[100];
            std::snprintf(what, sizeof(what),
                          "layers 1 : %g, nu_max dt/h^2 %g, steady error",
                          ratio, number);
            test::expectBelow(
                what,
                errorOf(run(b, "diffusion ADI;", steps * dt, steps).u, b,
                        exact),
                1e-9);
        }

        // Differences of runs with steps of dt, dt/2, dt/4
        std::vector<staggeredField> u;
        for (const label r : {1, 2, 4})
        {
            test::box c(labelVector(4, n, 4), vector(4.0 / n, 1, 4.0 / n),
                        wallsInY, 1);

            forAll(*c.nu, i)
            {
                (*c.nu)[i] = c.mesh().C()[i].y() < 0.5 ? 1 : ratio;
            }
            c.start([](const vector& x)
                    { return vector(std::sin(pi * x.y()), 0, 0); });
            const scalar dt = 0.5 / sqr(scalar(n)) / largest;
            u.push_back(run(c, "diffusion ADI;", 200 * dt, 200 * r).u);
        }
        std::printf("        decay, nu_max dt/h^2 = 0.5, 0.25: error %.2e "
                    "%.2e\n",
                    4.0 / 3 * difference(u[0], u[1]),
                    4.0 / 3 * difference(u[1], u[2]));
        expectOrder("    decay, order in time",
                    std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                    1.9);
    }
}

TEST(StaggeredFlow, dropOfOtherViscosity)
{
    // All terms of the stress: a smooth drop in a box with walls
    const label n = 16;
    for (const scalar ratio : {0.1, 10.0, 100.0})
    {
        const scalar largest = max(ratio, scalar(1));
        const auto make = [&]()
        {
            std::unique_ptr<test::box> b(new test::box(
                labelVector(n, n, n), vector(1, 1, 1), wallsInY, 1));
            forAll(*b->nu, i)
            {
                const scalar r =
                    mag(b->mesh().C()[i] - vector(0.5, 0.5, 0.5)) - 0.25;
                (*b->nu)[i] = 1 + (ratio - 1) * 0.5 * (1 - std::tanh(r * n));
            }
            return b;
        };
        const auto start = [](const vector& x)
        {
            return vector(std::sin(pi * x.y()) * std::sin(2 * pi * x.z()), 0,
                          std::sin(pi * x.y()));
        };

        std::vector<staggeredField> u;
        const scalar dt = 0.25 / sqr(scalar(n)) / largest;
        for (const label r : {1, 2, 4})
        {
            auto b = make();
            b->start(start);
            const outcome o(run(*b, "diffusion ADI;", 20 * dt, 20 * r));
            EXPECT_LE(o.divergence, 1e-14);
            u.push_back(o.u);
        }
        char what[100];
        std::snprintf(what, sizeof(what),
                      "drop, viscosity ratio %g, order in "
                      "time",
                      ratio);
        expectOrder(what,
                    std::log2(difference(u[0], u[1]) / difference(u[1], u[2])),
                    1.9);

        for (const scalar number : {1.0, 10.0})
        {
            const auto noiseAfter = [&](const label steps)
            {
                auto b = make();
                b->start(
                    [](const vector& x)
                    { return vector(test::noise(x), 0, test::noise(x, 7)); });
                const outcome o(run(*b, "diffusion ADI;",
                                    steps * number / sqr(scalar(n)) / largest,
                                    steps));
                return difference(o.u, staggeredField(o.u.box()));
            };
            const scalar before = noiseAfter(400), after = noiseAfter(1600);
            std::snprintf(what, sizeof(what),
                          "    noise kept from step 400 to 1600, nu_max dt/h^2 "
                          "= %g, of %.1e",
                          number, before);
            test::expectBelow(what, after / before, 0.7);
        }
    }
}

TEST(StaggeredFlow, wallsMustMoveAsOne)
{
    test::box b(labelVector(4, 4, 4), vector(1, 1, 1), wallsInY, 1);
    b.moveWalls(Zero, vector(1, 0, 2));
    EXPECT_EQ(staggeredFlow::unsupported(*b.U, *b.p), "");
    b.U->boundaryFieldRef()[3][5] = Zero;
    EXPECT_EQ(staggeredFlow::unsupported(*b.U, *b.p),
              "the velocity of a wall must be uniform, and it is not on the "
              "upper side in y");
    b.moveWalls(vector(0, 0.1, 0), Zero);
    EXPECT_EQ(staggeredFlow::unsupported(*b.U, *b.p),
              "the velocity of a wall must be tangential, and it is not on the "
              "lower side in y");

    // A wall that goes wrong on the way
    b.moveWalls(Zero, Zero);
    auto flow = b.flow("");
    flow->wallsMove();
    flow->step(0.001);
    b.U->boundaryFieldRef()[3][5] = vector(1, 0, 0);
    EXPECT_THROW(flow->step(0.001), Foam::IOerror);
}

TEST(StaggeredFlow, stepAllocatesNothing)
{
    for (const char* controls : {"diffusion explicit;", "diffusion ADI;",
                                 "diffusion FFT;", "timeScheme RK3;"})
    {
        test::box b(labelVector(8, 8, 8), vector(1, 1, 1), wallsInY, 1e-3);
        auto flow = b.flow(controls);
        flow->hold(0, 1);
        flow->step(0.01);
        const long before = allocations;
        for (label i = 0; i < 3; ++i)
        {
            flow->force().clear();
            flow->step(0.01);
        }
        test::expectBelow(std::string("allocations in three steps, ") +
                              controls,
                          allocations - before, 0);
        flow->fill();
        EXPECT_GT(allocations, before) << "allocations are not counted";
    }
}

TEST(StaggeredFlow, refusesWrongInput)
{
    const auto message = [](const scalar nu, const char* controls,
                            const FixedList<bool, 3>& walls)
    {
        test::box b(labelVector(4, 4, 4), vector(1, 1, 1), walls, nu);
        try
        {
            b.flow(controls)->step(1);
        }
        catch (const Foam::IOerror& e)
        {
            return std::string(e.message());
        }
        return std::string();
    };
    const auto expectIn = [](const std::string& all, const char* part) {
        EXPECT_NE(all.find(part), std::string::npos)
            << all << " lacks " << part;
    };

    expectIn(message(0.01, "timeScheme RK4;", wallsInY), "AB2 RK3");
    expectIn(message(0.01, "diffusion implicit;", wallsInY),
             "auto ADI FFT explicit");
    expectIn(message(1, "diffusion explicit;", wallsInY),
             "explicit diffusion is unstable above");
    expectIn(message(1, "diffusion FFT;", FixedList<bool, 3>(true)),
             "where two directions have walls");
}
