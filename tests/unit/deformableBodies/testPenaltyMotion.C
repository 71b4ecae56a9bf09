// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "penaltyMotion.H"
#include "testBox.H"
#include "testShapes.H"

using namespace test;

// A membrane at rest under tension passes its load to the fluid, also after a step that is far
// shorter or longer than the last one
TEST(PenaltyMotion, anotherStepLeavesTheLoad)
{
    const int N = 6;
    const sphericalHarmonics grid(N, N + 2);
    effectTable effects(mesh().time(), "penaltyMotion");
    effects.declare("penalty", true, "test");
    IStringStream is("membrane { law neoHookean; Gs 1; }");
    const dictionary dict(is);
    const capsuleShell shell(N, 1.5, dict, sphere(N), effects);
    const penaltyMotion motion({shell, grid, 1, 1, 0, effects}, 0.1);

    capsule c;
    c.x = sphere(N);
    for (double& x : c.x)
    {
        x *= 1.1;
    }
    numbers tension;
    shell.load(c.x, tension);
    const auto largest = [](const numbers& v)
    {
        return std::abs(*std::max_element(
            v.begin(), v.end(), [](const double a, const double b)
            { return std::abs(a) < std::abs(b); }));
    };
    const auto step = [&](const double dt)
    {
        motion.beforeMove(c, dt);
        c.lastDeltaT = dt;
        numbers off(c.load);
        for (size_t j = 0; j < off.size(); ++j)
        {
            off[j] -= tension[j];
        }
        return largest(off) / largest(tension);
    };
    motion.start(c);
    double off = 0;
    for (int i = 0; i < 40; ++i)
    {
        off = step(1e-3);
    }
    EXPECT_LT(off, 1e-3);
    for (const double part : {2, 8, 32, 1})
    {
        EXPECT_LT(step(1e-3 / part), 1e-3) << part;
    }
}
