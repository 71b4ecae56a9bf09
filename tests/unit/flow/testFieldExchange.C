// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "testFlow.H"

using namespace Foam;
using namespace test;

namespace
{
vector start(const vector& x)
{
    return vector(std::sin(2 * pi * x.y()), 0.3 + std::cos(2 * pi * x.x()), 0);
}
} // namespace

// Each component is constant along its direction
TEST(FieldExchange, cellsAverageTheFaces)
{
    test::box b(labelVector(8, 8, 4), vector(1, 1, 0.5), periodic, 0.01);
    b.start(start);
    const scalarField phi(b.phi->primitiveField());
    auto flow = b.flow("");
    flow->fill();
    scalar worst = 0;
    forAll(*b.U, celli)
    {
        const vector& x = b.mesh().C()[celli];
        worst = max(worst, mag((*b.U)[celli] - start(x)));
    }
    test::expectBelow("U at cells against the velocity of both faces", worst,
                      1e-14);
    test::expectBelow("phi after fill()",
                      gMax(mag(b.phi->primitiveField() - phi)),
                      1e-16);
}

// The fields as filled change nothing; a change of phi, or else of U, does
TEST(FieldExchange, takesOverChanges)
{
    test::box b(labelVector(8, 8, 4), vector(1, 1, 0.5), periodic, 0.01);
    b.start(start);
    auto flow = b.flow("");
    const staggeredField before(velocityOf(*flow, b));
    const auto changed = [&]()
    {
        flow->takeOver();
        return difference(velocityOf(*flow, b), before);
    };

    // Not filled: changes of the fields are ignored
    b.U->primitiveFieldRef() = vector(5, 0, 0);
    EXPECT_EQ(changed(), 0);
    flow->fill();
    EXPECT_EQ(changed(), 0);

    b.U->primitiveFieldRef() += vector(0, 0, 3);
    test::expectBelow("uniform change of U", mag(changed() - std::sqrt(3.0)),
                      1e-14);
    flow->fill();
    b.start([](const vector& x) { return start(x) + vector(0, 0, 6); });
    test::expectBelow("change of phi", mag(changed() - std::sqrt(12.0)), 1e-14);
}

TEST(FieldExchange, levelOfThePressure)
{
    test::box b(labelVector(8, 8, 4), vector(1, 1, 0.5), periodic, 0.01);
    b.start(start);
    auto flow = b.flow("");
    flow->fields().setReference(17, 2.5);
    step(*flow, 0.01);
    flow->fill();
    EXPECT_DOUBLE_EQ((*b.p)[17], 2.5);
    EXPECT_GT(gMax(b.p->primitiveField()) - gMin(b.p->primitiveField()), 0.1);
}

// Values at cells go half to each of their faces
TEST(FieldExchange, addedCellsKeepTheirSum)
{
    test::box b(labelVector(6, 5, 4), vector(1, 1, 1), periodic, 0.01);
    auto flow = b.flow("");
    vectorField cells(b.mesh().nCells());
    vector sum(Zero);
    forAll(cells, celli)
    {
        const vector& x = b.mesh().C()[celli];
        cells[celli] =
            vector(test::noise(x), test::noise(x, 1), test::noise(x, 2));
        sum += cells[celli];
    }
    flow->fields().addCells(cells, -2, flow->force());
    scalar worst = 0;
    for (direction d = 0; d < 3; ++d)
    {
        worst = max(worst, mag(Foam::sum(flow->force()[d]) + 2 * sum[d]));
    }
    test::expectBelow("sum over the staggered points", worst, 1e-12);
}
