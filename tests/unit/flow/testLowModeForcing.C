// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testForcing.H"

using namespace Foam;
using namespace test;

TEST(LowModeForcing, evaluatedAtTheStaggeredPoints)
{
    // Partial sums equal the series at every point
    test::box b(labelVector(8, 10, 14), vector(1, 2, 3),
                FixedList<bool, 3>(false), 1);
    auto o = make(b, stirring);
    const auto& forcing = refCast<fv::lowModeForcing>(*o);
    const staggeredField f(forceOf(*o, b));
    const uniformGrid& grid = uniformGrid::New(b.mesh());
    scalar worst = 0;
    f.box().cells(
        [&](const label i, const labelVector& c)
        {
            for (direction d = 0; d < 3; ++d)
            {
                const point x(facePoint(grid, c, d));
                scalar sum = 0;
                for (const auto& m : forcing.modes())
                {
                    sum += std::real(
                        m.c[d] * std::polar(1.0, forcing.waveVector(m.m) & x));
                }
                worst = max(worst, mag(sum - f[d][i]));
            }
        });
    test::expectBelow("force at the staggered points against the series", worst,
                      1e-13);
}
