// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The staggered flow against exact solutions; conservation and stability. Orders:
// tests/verification/studies

#include "testFlow.H"
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <new>

// Count the allocations of the program
static long allocations = 0;

void* operator new(const std::size_t n)
{
    ++allocations;
    if (void* p = std::malloc(n)) return p;
    throw std::bad_alloc();
}
// alignedVector allocates by posix_memalign
extern "C" int posix_memalign(void** memory, const std::size_t alignment,
                              const std::size_t n) noexcept
{
    ++allocations;
    *memory = aligned_alloc(alignment, n);
    return *memory ? 0 : ENOMEM;
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
using namespace test;

TEST(StaggeredFlow, stableAtLargeViscousSteps)
{
    const label n = 16;
    test::box b(labelVector(n, n, n), vector(1, 1, 1), wallsInY, 1);
    b.start([](const vector& x)
            { return vector(test::noise(x), 0, test::noise(x, 7)); });
    const scalar dt = 10.0 / sqr(scalar(n));
    for (const char* diffusion : {"diffusion ADI;", "diffusion FFT;"})
    {
        const flowRun o(run(b, diffusion, 200 * dt, 200));
        staggeredField zero(o.u.box());
        test::expectBelow(
            std::string("noise after 200 steps of nu dt/h^2 = 10, ") +
                diffusion,
            difference(o.u, zero), 1e-2);
    }
}

// Noise in a uniform flow: at the Courant number of the limit AB2 amplifies a wave by half
// of what viscosity dissipates, at 2^(1/3) times this number by all of it. The critical
// waves have about five cells
TEST(StaggeredFlow, wavesOfFiveCellsDoNotGrow)
{
    struct flowCase
    {
        const char* controls;
        vector U, h;
        scalar nu;
    };
    const vector cubes(1, 1, 1);
    for (const flowCase& f :
         {flowCase{"diffusion explicit;", vector(1, 0, 0), cubes, 0.0025},
          flowCase{"diffusion explicit;", vector(0, 0, 1), cubes, 0.02},
          flowCase{"diffusion ADI;", vector(1, 0, 0), cubes, 0.02},
          flowCase{"diffusion FFT;", vector(0, 1, 0), cubes, 0.2},
          flowCase{"diffusion explicit;", vector(1, 1, 0), cubes, 0.02},
          flowCase{"diffusion explicit;", vector(1, 0, 0), vector(3, 1, 2),
                   0.05}})
    {
        const label n = 16;
        test::box b(labelVector(n, n, n), n * f.h, periodic, f.nu);
        b.start(
            [&](const vector& x)
            {
                const scalar a = 1e-6;
                return f.U + a * vector(test::noise(x), test::noise(x, 5),
                                        test::noise(x, 9));
            });
        for (const scalar share : {1.0, 1.5})
        {
            auto flow =
                b.flow((std::string("timeScheme AB2; ") + f.controls).c_str());
            const scalar Co = flow->stableCourantNo();
            const scalar dt = share * Co / flow->CourantNo(1);

            // Time in which waves along U decay by about e^2, waves of five cells by more
            const label nSteps = label(2 * magSqr(cmptMultiply(f.h, f.U)) /
                                       magSqr(f.U) / (f.nu * dt));
            const auto noiseAfter = [&](const label steps)
            {
                for (label i = 0; i < steps; ++i)
                {
                    step(*flow, dt);
                }
                staggeredField u(velocityOf(*flow, b));
                scalar sum = 0;
                for (direction d = 0; d < 3; ++d)
                {
                    const scalar mean = Foam::sum(u[d]) / u.box().count();
                    sum += Foam::sumSqr(u[d] - mean);
                }
                return std::sqrt(sum);
            };
            const scalar before = noiseAfter(nSteps);
            const scalar growth = noiseAfter(nSteps) / before;
            char what[128];
            std::snprintf(what, sizeof(what),
                          "noise at %g of Courant number %.3f, nu %g, ", share,
                          Co, f.nu);
            if (share > 1)
                test::expectBelow(what + std::string("1/growth"), 1 / growth,
                                  0.9);
            else
                test::expectBelow(what + std::string(f.controls), growth, 0.6);
        }
    }
}

TEST(StaggeredFlow, timeSchemeThatBearsTheStep)
{
    test::box b(labelVector(8, 8, 8), vector(8, 8, 8), periodic, 0.01);
    b.start([](const vector& x)
            { return vector(1 + 0.1 * std::sin(pi * x.y() / 4), 0, 0); });
    const auto chosen =
        [&](const char* controls, const scalar Co, const bool adjusted)
    {
        auto flow = b.flow(controls);
        const scalar dt = Co / flow->CourantNo(1);
        flow->chooseTimeScheme(dt, adjusted);
        step(*flow, dt);
        EXPECT_EQ(flow->nStages(), flow->timeScheme() == "RK3" ? 3 : 1);
        return flow->timeScheme();
    };
    // Limit of AB2: (3.4 nu/(u h))^(1/3) = 0.31 minus terms of higher order
    EXPECT_EQ(chosen("", 0.27, false), "AB2");
    EXPECT_EQ(chosen("", 0.4, false), "RK3");
    EXPECT_EQ(chosen("", 0.6, true), "AB2");
    EXPECT_EQ(chosen("", 1.5, true), "RK3");
    EXPECT_EQ(chosen("timeScheme AB2;", 1.5, true), "AB2");
    EXPECT_EQ(chosen("timeScheme RK3;", 0.3, false), "RK3");
    EXPECT_EQ(chosen("convection off;", 1.5, false), "AB2");
}

TEST(StaggeredFlow, PoiseuilleErrsByTheKnownAmount)
{
    // Steady flow between walls at y = 0, 1: g y (1 - y)/(2 nu), plus g h^2/(8 nu) from the
    // mirrored velocity beyond the walls
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
        const scalar dt = 0.05 * h * h / nu;
        scalar worst = 0;
        for (label i = 0; i < 8000; ++i)
        {
            // With the last gradient as the first guess, and without a guess
            flow->force().clear();
            const scalar guess = i % 2 ? flow->meanGradient() : 0;
            flow->hold(0, 1, guess);
            if (flow->force()[0][0] != guess)
                ADD_FAILURE() << "bodies do not see the gradient";
            step(*flow, dt);
            const staggeredField u(velocityOf(*flow, b));
            worst = max(worst, mag(sum(u[0]) / u.box().count() - 1));
        }
        test::expectBelow(std::string("mean velocity held, ") + controls, worst,
                          1e-13);

        // Flow rate of the discrete profile, g h^2/(8 nu) included, summed over cells
        const scalar g = 12 * nu / (1 + 2 * sqr(h));
        test::expectBelow("    pressure gradient against plane Poiseuille flow",
                          mag(flow->meanGradient() / g - 1), 1e-10);
    }
}

TEST(StaggeredFlow, turnedBoxWithLayersApart)
{
    // Layers of 128 x 64 cells are not contiguous in memory (cellBox::stride()); layers of
    // the same flow in a rotated box are
    const scalar nu = 0.01, dt = 0.003;
    const label n = 3;
    for (const bool walls : {false, true})
    {
        for (const char* controls :
             {"diffusion ADI;", "diffusion FFT;", "diffusion explicit;",
              "timeScheme RK3; diffusion ADI;"})
        {
            test::box a(labelVector(128, 64, 6), vector(4, 2, 0.1875),
                        FixedList<bool, 3>({false, walls, false}), nu);
            test::box b(labelVector(6, 128, 64), vector(0.1875, 4, 2),
                        FixedList<bool, 3>({false, false, walls}), nu);
            const auto velocity = [&](const vector& x)
            {
                const scalar z = std::sin(2 * pi * x.z() / 0.1875);
                return vector(std::sin(pi * x.y()) * std::cos(0.5 * pi * x.x()),
                              std::sin(pi * x.y()) * (1 + 0.1 * z),
                              0.3 * std::cos(pi * x.x()));
            };
            a.start(velocity);
            b.start(
                [&](const vector& x)
                {
                    const vector u(velocity(vector(x.y(), x.z(), x.x())));
                    return vector(u.z(), u.x(), u.y());
                });
            auto inA = a.flow(controls), inB = b.flow(controls);
            for (label i = 0; i < n; ++i)
            {
                for (auto* flow : {inA.get(), inB.get()})
                {
                    flow->hold(flow == inA.get() ? 0 : 1, 0.5, 0);
                    step(*flow, dt);
                }
            }
            const staggeredField uA(velocityOf(*inA, a)),
                uB(velocityOf(*inB, b));
            scalar worst = 0;
            uA.box().cells(
                [&](const label i, const labelVector& c)
                {
                    const label j =
                        uB.box().index(labelVector(c.z(), c.x(), c.y()));
                    for (direction d = 0; d < 3; ++d)
                    {
                        worst = max(worst, mag(uA[d][i] - uB[(d + 1) % 3][j]));
                    }
                });
            EXPECT_GT(uA.box().nPlaces(), uA.box().count());
            EXPECT_EQ(uB.box().nPlaces(), uB.box().count());
            test::expectBelow(std::string("turned flow, ") +
                                  (walls ? "walls, " : "periodic, ") + controls,
                              worst, 1e-13);
        }
    }
}

TEST(StaggeredFlow, StokesModeHasNoConvection)
{
    // Every solenoidal wave decays at its own rate, whatever its amplitude
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

TEST(StaggeredFlow, layersOfTwoViscosities)
{
    // Shear flow of two layers: lower half nu = 1, upper half nu = ratio. In the steady
    // state the stress is continuous
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
        const scalar shear =
            2 * ratio / (1 + ratio); // shear rate of the lower layer
        const auto exact = [&](const vector& x)
        {
            return vector(x.y() < 0.5 ? shear * x.y()
                                      : 1 - shear / ratio * (1 - x.y()),
                          0, 0);
        };
        const scalar largest = max(ratio, scalar(1));
        for (const scalar number : {0.5, 10.0, 200.0})
        {
            // Long enough for diffusion, for the explicit part of the splitting, which
            // converges like (1 - nu/nu_max)^(steps/2), and for Crank-Nicolson, which keeps
            // (1 - h^2/(nu dt))^steps of a wave of length 2 h
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

TEST(StaggeredFlow, dropOfOtherViscosity)
{
    const label n = 16;
    for (const scalar ratio : {0.1, 10.0, 100.0})
    {
        const scalar largest = max(ratio, scalar(1));
        char what[128];
        for (const scalar number : {1.0, 10.0})
        {
            const auto noiseAfter = [&](const label steps)
            {
                auto b = drop(n, ratio);
                b->start(
                    [](const vector& x)
                    { return vector(test::noise(x), 0, test::noise(x, 7)); });
                const flowRun o(run(*b, "diffusion ADI;",
                                    steps * number / sqr(scalar(n)) / largest,
                                    steps));
                return difference(o.u, staggeredField(o.u.box()));
            };
            const scalar before = noiseAfter(400), after = noiseAfter(1600);
            std::snprintf(
                what, sizeof(what),
                "    noise kept from step 400 to 1600, viscosity ratio "
                "%g, nu_max dt/h^2 = %g, of %.1e",
                ratio, number, before);
            test::expectBelow(what, after / before, 0.7);
        }
    }
}

TEST(StaggeredFlow, wallsMustMoveAsOne)
{
    test::box b(labelVector(4, 4, 4), vector(1, 1, 1), wallsInY, 1, "noSlip");
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

    // A wall whose velocity becomes invalid during the run
    b.moveWalls(Zero, Zero);
    auto flow = b.flow("");
    step(*flow, 0.001);
    b.U->boundaryFieldRef()[3][5] = vector(1, 0, 0);
    EXPECT_THROW(step(*flow, 0.001), Foam::IOerror);
}

TEST(StaggeredFlow, stepAllocatesNothing)
{
    for (const char* controls : {"diffusion explicit;", "diffusion ADI;",
                                 "diffusion FFT;", "timeScheme RK3;"})
    {
        test::box b(labelVector(8, 8, 8), vector(1, 1, 1), wallsInY, 1e-3);
        auto flow = b.flow(controls);
        flow->hold(0, 1, 0);
        step(*flow, 0.01);
        const long before = allocations;
        for (label i = 0; i < 3; ++i)
        {
            flow->force().clear();
            step(*flow, 0.01);
        }
        test::expectBelow(std::string("allocations in three steps, ") +
                              controls,
                          allocations - before, 0);
        flow->fill();
        EXPECT_GT(allocations, before) << "allocations are not counted";
    }
}

// A step that is restored and repeated gives the same result to the last bit
TEST(StaggeredFlow, canBeTakenBack)
{
    for (const char* controls :
         {"timeScheme AB2;", "timeScheme RK3;", "diffusion FFT;"})
    {
        test::box b(labelVector(8, 6, 6), vector(1, 1, 1), {false, true, false},
                    0.02);
        b.start([](const point& x)
                { return test::noise(x) * vector(1, 1, 1); });
        const auto flow = b.flow(controls);
        step(*flow, 0.01);
        const auto before = flow->save();
        const auto velocities = [&]()
        {
            staggeredField u(uniformGrid::New(b.mesh()).box());
            flow->velocity(u);
            return u;
        };
        const auto stepTwice = [&]()
        {
            for (const scalar dt : {0.02, 0.01})
            {
                flow->force().clear();
                flow->force()[0] = 0.3;
                step(*flow, dt);
            }
            return velocities();
        };
        const staggeredField once(stepTwice());
        flow->restore(before);
        EXPECT_NE(velocities()[0], once[0]);
        const staggeredField again(stepTwice());
        for (direction d = 0; d < 3; ++d)
        {
            EXPECT_EQ(once[d], again[d]) << controls;
        }
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
            step(*b.flow(controls), 1);
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
