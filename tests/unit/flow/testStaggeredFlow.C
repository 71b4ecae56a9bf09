// This file is part of deformableBodies. License: GPL-3.0-or-later.

// A step of the flow engine: memory, restore, wrong input. Orders:
// tests/verification/studies

#include "testFlow.H"
#include <cerrno>
#include <cstdlib>
#include <new>

// Allocations of the program so far
static long allocations = 0;

#ifndef __SANITIZE_ADDRESS__ // has these functions of its own
void* operator new(const std::size_t n)
{
    ++allocations;
    if (void* p = std::malloc(n)) return p;
    throw std::bad_alloc();
}
// alignedVector takes its memory from this one
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
#endif

using namespace Foam;
using namespace test;

TEST(StaggeredFlow, turnedBoxWithLayersApart)
{
    // Layers of 128 x 64 cells are not next to each other in memory (cellBox::stride());
    // of the same flow in a box that is turned they are
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
                    flow->mean().hold(flow == inA.get() ? 0 : 1, 0.5, 0,
                                      flow->force());
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

TEST(StaggeredFlow, stepAllocatesNothing)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "allocations are not counted";
#endif
    for (const char* controls : {"diffusion explicit;", "diffusion ADI;",
                                 "diffusion FFT;", "timeScheme RK3;"})
    {
        test::box b(labelVector(8, 8, 8), vector(1, 1, 1), wallsInY, 1e-3);
        auto flow = b.flow(controls);
        flow->mean().hold(0, 1, 0, flow->force());
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

// Steps from one state are the same to the last bit, however often they are taken back
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
        staggeredState before;
        flow->save(before);
        flow->restore(before);
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
