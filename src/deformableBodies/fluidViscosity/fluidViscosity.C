// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fluidViscosity.H"
#include "dictionaryChecks.H"
#include "turbulenceModel.H"
#include "volFields.H"

namespace
{
using namespace Foam;

//- Effective kinematic viscosity of the turbulence model; not valid if there is none
tmp<volScalarField> effective(const fvMesh& mesh)
{
    const auto* model =
        mesh.findObject<turbulenceModel>(turbulenceModel::propertiesName);
    return model ? model->nuEff() : tmp<volScalarField>();
}
} // namespace

Foam::fluidViscosity::fluidViscosity(const fvMesh& mesh,
                                     const dictionary& transport,
                                     const dictionary& bodies)
    : mesh_(mesh)
{
    const word fluid(
        transport.getOrDefault<word>("transportModel", "Newtonian"));
    const auto* model =
        mesh.findObject<turbulenceModel>(turbulenceModel::propertiesName);
    const word simulation(
        model ? model->getOrDefault<word>("simulationType", "laminar")
              : word("laminar"));
    const word stress(model ? model->type() : word("Stokes"));

    given_ = bodies.found("nu");
    varies_ = fluid != "Newtonian" || stress != "Stokes";
    uniform_ = !varies_;
    if (!varies_ && given_)
    {
        refuse(
            bodies, "nu", valueOf(*bodies.findEntry("nu")),
            "no such entry with transportModel Newtonian in laminar flow: nu "
            "is that of constant/transportProperties");
    }
    if (given_)
    {
        value_ = readPositive(bodies, "nu", dimViscosity);
        source_ = "entry nu of constant/deformableBodies";
    }
    else if (!varies_ || (!model && transport.found("nu")))
    {
        value_ = readPositive(transport, "nu", dimViscosity);
    }
    else if (!model)
    {
        known_ = false;
        value_ = 1;
        source_ = "not used: no flow";
    }
    const string name(stress == "Stokes" ? "transportModel " + fluid
                                         : simulation + " model " + stress);
    const wordList viscous(
        {"Stokes", "generalizedNewtonian", "lambdaThixotropic"});
    if (simulation == "laminar" && !viscous.found(stress))
    {
        varies_ = false;
        known_ = given_;
        if (!given_ && &bodies != &dictionary::null)
        {
            refuse(bodies, "nu", "none",
                   "a number [m^2/s] that bodies take for the viscosity of the "
                   "fluid: the " +
                       name + " has no single one");
        }
    }
    if (!varies_ || !model) return;

    if (!given_)
    {
        const tmp<volScalarField> nu(effective(mesh));
        value_ = gSum(nu().primitiveField() * mesh.V()) / gSum(mesh.V());
        source_ = "mean over the box, " + name;
    }
}

void Foam::fluidViscosity::restore(const scalar value)
{
    value_ = value;
    source_ += " when the bodies started";
}

void Foam::fluidViscosity::compare(const PtrList<bodyGroup>& groups)
{
    if (!varies_ || warned_) return;
    const tmp<volScalarField> nuEff(effective(mesh_));
    if (!nuEff.valid()) return;

    const uniformGrid& grid = uniformGrid::New(mesh_);
    const cellBox& box = grid.box();
    scalarField nu(box.nPlaces(), Zero);
    forAll(grid.index(), celli)
    {
        nu[grid.index()[celli]] = nuEff()[celli];
    }

    // Find the body whose ratio is furthest from 1
    scalar furthest = 1;
    string body;
    for (const bodyGroup& group : groups)
    {
        forAll(group.mine(), i)
        {
            scalar total = 0;
            label n = 0;
            for (const point& x : group.points(i).positions)
            {
                const labelVector cell(grid.cellAt(x));
                if (!box.contains(cell)) continue;
                total += nu[box.index(cell)];
                ++n;
            }
            const scalar ratio = n ? total / n / value_ : 1;
            const scalar apart = ratio < 1 ? 1 / ratio : ratio;
            if (!(apart > furthest)) continue;
            furthest = apart;
            body = group.nameOfBody(group.mine()[i]) +
                   ": the fluid there has " + Foam::name(ratio * value_);
        }
    }
    const scalar most = returnReduce(furthest, maxOp<scalar>());
    if (most < 1.1) return;
    warned_ = true;
    body = firstOf(furthest == most ? body : string::null);
    WarningInFunction
        << "viscosity at " << body.c_str() << " m^2/s at time "
        << mesh_.time().timeName() << ", bodies use " << value_ << " ("
        << source_.c_str() << ")" << nl
        << "    Near field, stabilised motion and the numbers of the log are "
           "wrong "
        << "by this ratio: set nu in constant/deformableBodies to that of the "
        << "fluid at the bodies, or nearField off in their groups" << endl;
}
