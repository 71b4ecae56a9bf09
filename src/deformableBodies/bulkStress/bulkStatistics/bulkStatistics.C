// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bulkStatistics.H"
#include "dictionaryChecks.H"
#include "sumOverRanks.H"
#include "volFields.H"

Foam::bulkStatistics::bulkStatistics(const bodySystem& system)
    : system_(system),
      layers_(
          [&system](const direction f, const direction g)
          {
              return layerMeans(system.grid, f, g,
                                system.mesh.lookupObject<volVectorField>("U"));
          })
{
}

void Foam::bulkStatistics::read(const dictionary& dict)
{
    entry_ = dictionary(dict.name());
    const entry* given = dict.findEntry("bulkStress");
    if (given) entry_.add(*given);
}

Foam::scalarField Foam::bulkStatistics::forces(const direction f,
                                               const direction g) const
{
    staggeredField faces(system_.grid.box());
    system_.spreadLoads(identity(system_.groups.size()), faces);
    scalarField sums(system_.grid.n()[g], Zero);
    // Cells of this rank only: boxes of ranks may overlap
    const uniformGrid& grid = system_.grid;
    forAll(grid.index(), celli)
    {
        sums[grid.ijk(celli)[g]] += faces[f][grid.index()[celli]];
    }
    sums *= system_.grid.cellVolume();
    sumOverRanks(sums);
    return sums;
}

void Foam::bulkStatistics::watchStress(const bool implicit,
                                       const dictionary* function)
{
    const fileName name(function ? function->name() : fileName::null);
    if (stress_ && name == function_) return;
    if (stress_)
    {
        refuse(*function, "bulkStress", "a second functionObject of that type",
               "one");
    }
    function_ = name;
    stress_ = bulkStress::New(function ? *function : entry_, system_, layers_,
                              implicit);
}
