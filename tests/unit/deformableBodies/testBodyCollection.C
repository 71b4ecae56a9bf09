// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyCollection.H"
#include "OFstream.H"
#include "OSspecific.H"
#include "testBox.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
//- Write a dictionary to constant of the case, or of a region
void write(const char* name, const char* text, const word& region = "")
{
    if (!Pstream::master()) return;
    const fileName dir(test::mesh().time().globalPath() / "constant" / region);
    mkDir(dir);
    OFstream(dir / name)()
        << "FoamFile { version 2.0; format ascii; class dictionary; object "
        << name << "; }" << nl << text << endl;
}

//- Set a velocity that carries bodies through the box and shears them
staggeredField velocity()
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    staggeredField u(grid.box());
    for (const label i : grid.index())
    {
        const labelVector c(grid.box().cell(i));
        u[0][i] = 0.5 + 0.1 * std::sin(c.z() + 0.3);
        u[1][i] = grid.periodic(1) ? 0.2 : 0;
        u[2][i] = grid.periodic(2) ? -0.1 * std::cos(c.x() + 0.2) : 0;
    }
    return u;
}
} // namespace

// Two kinds of bodies in the middle of the box, which may be at the corner of all blocks
TEST(BodyCollection, aStepCanBeTakenBack)
{
    write("transportProperties", "transportModel Newtonian; rho 1; nu 1;");
    write(
        "deformableBodies",
        "bodies { cells { type capsule; shape { type sphere; radius 0.3; } "
        "harmonics 6; membrane { law neoHookean; Gs 1; } "
        "positions ((1.5 1 0.5) (0.4 0.6 0.5)); } "
        "threads { type filament; coupling oneWay; length 0.8; diameter 0.01; "
        "segments 8; bendingRigidity 1; positions ((1.1 1 0.5)); "
        "directions ((1 0 0)); } }");
    const Time& time = test::mesh().time();
    const scalar dt = time.deltaTValue();
    const_cast<Time&>(time).setDeltaT(0.01);
    {
        bodyCollection bodies(test::mesh(), true);
        staggeredField force(uniformGrid::New(test::mesh()).box());
        const staggeredField u(velocity());
        const auto steps = [&]()
        {
            for (label i = 0; i < 3; ++i)
            {
                force.clear();
                bodies.moveWithVelocity(u, force);
            }
            return bodies.save();
        };
        label nAll = 0;
        steps();
        const auto before = bodies.save();
        const auto once = steps();
        bodies.restore(before);
        const auto again = steps();
        forAll(once.states, g)
        {
            EXPECT_EQ(once.numbers[g], again.numbers[g]);
            EXPECT_EQ(once.states[g], again.states[g]);
            if (once.states[g].size() && before.numbers[g] == once.numbers[g])
            {
                EXPECT_NE(once.states[g], before.states[g]);
            }
            nAll += once.numbers[g].size();
        }
        EXPECT_EQ(returnReduce(nAll, sumOp<label>()), 3);
    }
    const_cast<Time&>(time).setDeltaT(dt);
    if (Pstream::master())
    {
        rm(time.globalPath() / "constant" / "deformableBodies");
    }
}

// Files of a mesh region have their own place, as that of another
// mesh of the same case must not be overwritten
TEST(BodyCollection, aRegionHasItsOwnPlace)
{
    if (Pstream::parRun()) return;
    const test::box box(labelVector(8, 8, 8), vector(2, 2, 2), {}, 1);
    const word region(box.mesh().name());
    const Time& time = test::mesh().time();
    const fileName root(time.globalPath());
    write("transportProperties", "transportModel Newtonian; rho 1; nu 1;",
          region);
    write("deformableBodies",
          "bodies { cells { type capsule; shape { type sphere; radius 0.5; } "
          "harmonics 4; membrane { law neoHookean; Gs 1; } "
          "positions ((1 1 1)); } }",
          region);
    {
        bodyCollection bodies(box.mesh(), true);
        staggeredField u(uniformGrid::New(box.mesh()).box());
        staggeredField force(u.box());
        bodies.moveWithVelocity(u, force);
        EXPECT_TRUE(bodies.write());
    }
    const fileName state(root / time.timeName() / region / "uniform");
    const fileNameList written(
        {state / "deformableBodies",
         root / "postProcessing" / region / "bodies" / "0" / "cells.dat",
         root / "postProcessing" / region / "effectCost" / "0" /
             "effectCost.dat",
         root / "postProcessing" / "VTK" / region / "bodies" /
             "cells.vtp.series"});
    for (const fileName& file : written)
    {
        EXPECT_TRUE(isFile(file)) << file;
    }

    // The restart file of the region is read again
    const bodyCollection again(box.mesh(), true);
    EXPECT_EQ(again.save().states[0].size(), 1);
    for (const fileName& dir : {state.path(), root / "constant" / region,
                                root / "postProcessing" / region,
                                root / "postProcessing" / "VTK" / region})
    {
        rmDir(dir);
    }
}
