// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "layerMeans.H"
#include "testBox.H"

using namespace Foam;

// A velocity across the layers that vanishes on both walls, and is the same seen from either
TEST(layerMeans, velocityAcrossTheLayersIsOfTheirMiddles)
{
    const label n = 8;
    test::box box(labelVector(4, n, 4), vector(1, 1, 1), {false, true, false},
                  1);
    box.start([](const point& x) { return vector(0, x.y() * (1 - x.y()), 0); });
    const auto flow = box.flow("");
    const layerMeans means(uniformGrid::New(box.mesh()), 0, 1,
                           flow->velocityAndHalo());
    for (label j = 0; j < n; ++j)
    {
        const scalar lower = scalar(j) / n, upper = scalar(j + 1) / n;
        const scalar v = lower * (1 - lower), w = upper * (1 - upper);
        EXPECT_NEAR(means.u[j].y(), 0.5 * (v + w), 1e-13);
        EXPECT_NEAR(means.squares[j].y(), 0.5 * (sqr(v) + sqr(w)), 1e-13);
    }
}
