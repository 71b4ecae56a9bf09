// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "flowSources.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "fvMatrices.H"
#include "resultFile.H"
#include "stateObject.H"

namespace
{
using namespace Foam;

const wordList explicitTypes({"buoyancyForce", "actuationDiskSource",
                              "radialActuationDiskSource", "rotorDisk",
                              "tabulatedAccelerationSource",
                              "vectorCodedSource", "vectorSemiImplicitSource"});

//- Explicit sources that read no fields
const wordList constantTypes({"buoyancyForce"});

//- The source of one option; per unit mass and volume of the cell, negative
fvVectorMatrix matrixOf(fv::option& o, const volVectorField& U)
{
    fvVectorMatrix eqn(U, dimVolume * dimAcceleration);
    const label fieldi = o.applyToField(U.name());
    if (fieldi >= 0 && o.isActive())
    {
        o.setApplied(fieldi);
        o.addSup(eqn, fieldi);
    }
    return eqn;
}

//- True if the diagonal is not zero on any rank
bool isImplicit(const fvVectorMatrix& eqn)
{
    const bool here = eqn.hasDiag() && max(mag(eqn.diag())) > 0;
    return returnReduce(here, orOp<bool>());
}

//- Axis of a vector; 3 if it has none
direction axisOf(const vector& v)
{
    for (direction d = 0; d < 3; ++d)
    {
        if (mag(v[d]) == mag(v)) return d;
    }
    return 3;
}
} // namespace

Foam::string Foam::flowSources::unsupported(const fv::option& o,
                                            const volVectorField& U)
{
    if (o.type() == "deformableBodies" || isA<fv::lowModeForcing>(o) ||
        const_cast<fv::option&>(o).applyToField(U.name()) < 0)
    {
        return string::null;
    }
    if (o.type() == "meanVelocityForce")
    {
        const direction d = axisOf(o.coeffs().get<vector>("Ubar"));
        if (d > 2 || !uniformGrid::New(U.mesh()).periodic(d))
        {
            return "Ubar of fvOption " + o.name() +
                   " is not along one periodic direction";
        }
        if (o.coeffs().getOrDefault<word>("selectionMode", "all") != "all")
        {
            return "fvOption " + o.name() + " does not act on all cells";
        }
        return string::null;
    }
    if (!explicitTypes.found(o.type()))
    {
        return "it does not know fvOption " + o.name() + " of type " + o.type();
    }
    for (const word code : {"codeCorrect", "codeConstrain"})
    {
        if (!o.coeffs().getOrDefault<string>(code, "").empty())
        {
            return "fvOption " + o.name() + " has " + code;
        }
    }
    if (o.type() == "vectorSemiImplicitSource" &&
        isImplicit(matrixOf(const_cast<fv::option&>(o), U)))
    {
        return "fvOption " + o.name() + " has an implicit part";
    }
    return string::null;
}

void Foam::flowSources::refuseNoDirection(const fvMesh& mesh)
{
    // OpenFOAM makes options that are not active as well
    for (const dictionary& coeffs :
         optionsOfType(mesh, "meanVelocityForce", true))
    {
        if (mag(coeffs.getOrDefault<vector>("Ubar", vector::one)) > 0) continue;
        refuse(coeffs, "Ubar", "(0 0 0)",
               "a velocity, as the pressure gradient is along it; for no net "
               "flux in x one far below that of the flow, Ubar (1e-12 0 0)");
    }
}

void Foam::flowSources::checkFields(const fv::optionList& options,
                                    const volVectorField& U)
{
    const uniformGrid& grid = uniformGrid::New(U.mesh());
    for (const fv::option& o : static_cast<const PtrList<fv::option>&>(options))
    {
        const dictionary& coeffs = o.coeffs();
        if (o.applyToField(U.name()) < 0)
        {
            const entry* fields = coeffs.findEntry("fields");
            const string what("option " + o.name() + " of type " + o.type());
            if (fields && (o.type() == "meanVelocityForce" ||
                           explicitTypes.found(o.type())))
            {
                refuse(coeffs, "fields", valueOf(*fields),
                       "(" + U.name() + "), as " + what +
                           " acts on no other field of this solver");
            }
            IOWarningInFunction(coeffs)
                << what.c_str() << " does not act on " << U.name()
                << ", but on "
                << (fields ? valueOf(*fields) : string("other fields")).c_str()
                << ": it has no effect unless something solves for these"
                << endl;
            continue;
        }
        if (o.type() != "meanVelocityForce" || !grid.valid()) continue;
        const vector Ubar(coeffs.get<vector>("Ubar"));
        for (direction d = 0; d < 3; ++d)
        {
            if (grid.periodic(d) || !(mag(Ubar[d]) > 1e-9 * mag(Ubar)))
                continue;
            refuse(
                coeffs, "Ubar", valueOf(*coeffs.findEntry("Ubar")),
                string("velocities along periodic directions; the sides in ") +
                    vector::componentNames[d] + " of fvOption " + o.name() +
                    " are walls, or open and have a flow of their own");
        }
    }
}

Foam::string Foam::flowSources::unsupported(const fv::optionList& options,
                                            const volVectorField& U)
{
    label n = 0;
    for (const fv::option& o : static_cast<const PtrList<fv::option>&>(options))
    {
        const string reason(unsupported(o, U));
        if (!reason.empty()) return reason;
        if (o.type() == "meanVelocityForce" && ++n > 1)
        {
            return "there is more than one meanVelocityForce";
        }
    }
    return string::null;
}

Foam::flowSources::flowSources(fv::optionList& options, volVectorField& U,
                               staggeredFlow& flow, effectTable& effects)
    : U_(U),
      flow_(flow),
      effects_(effects)
{
    for (fv::option& o : static_cast<PtrList<fv::option>&>(options))
    {
        if (o.applyToField(U.name()) < 0) continue;
        auto* forcing = dynamic_cast<fv::lowModeForcing*>(&o);
        if (forcing) forcings_.push_back(forcing);
        if (explicitTypes.found(o.type()))
        {
            explicit_.push_back(&o);
            readFields_ = readFields_ || !constantTypes.found(o.type());
        }
        if (o.type() == "meanVelocityForce")
        {
            held_ = &o;
            Ubar_ = o.coeffs().get<vector>("Ubar");

            // File and entry are those of OpenFOAM's own option
            const word name(o.name() + "Properties");
            const auto before = stateOfTime(U.mesh(), name);
            if (before)
            {
                gradient_ = before->get<scalar>("gradient");
                wasHeld_ = before->getOrDefault<bool>("held", true);
            }
            state_.reset(new stateObject<IOdictionary>(
                name, "uniform", U.mesh(),
                [this](Ostream& os)
                {
                    os.precision(17);
                    os.writeEntry("gradient", gradient_);
                    os.writeEntry("held", Switch(wasHeld_));
                }));
        }
    }
    const bool any = forcings_.size() || explicit_.size() || held_;
    effects_.declare("sources", any,
                     any ? "constant/fvOptions" : "none in constant/fvOptions");
}

void Foam::flowSources::add()
{
    // Options may be active for some time only
    if (held_ && held_->isActive())
    {
        const direction d = axisOf(Ubar_);
        flow_.mean().hold(d, Ubar_[d], sign(Ubar_[d]) * gradient_,
                          flow_.force());
    }
    else
    {
        flow_.mean().release();
        gradient_ = 0;
        wasHeld_ = false;
    }
    if (forcings_.empty() && explicit_.empty()) return;

    const auto timing(effects_.time("sources"));
    for (fv::lowModeForcing* forcing : forcings_)
    {
        if (forcing->isActive()) forcing->addTo(flow_.force());
    }
    for (fv::option* o : explicit_)
    {
        const fvVectorMatrix eqn(matrixOf(*o, U_));
        if (isImplicit(eqn))
        {
            waitForMaster();
            FatalIOErrorInFunction(o->coeffs())
                << "fvOption " << o->name() << " has an implicit part, which "
                << "the staggered algorithm does not know; use flowAlgorithm "
                << "pimple" << exit(FatalIOError);
        }
        flow_.fields().addCells(eqn.source(),
                                -1 / uniformGrid::New(U_.mesh()).cellVolume(),
                                flow_.force());
    }
}

std::vector<Foam::scalarList> Foam::flowSources::save() const
{
    std::vector<scalarList> all;
    for (const fv::lowModeForcing* forcing : forcings_)
    {
        all.push_back(forcing->state());
    }
    return all;
}

void Foam::flowSources::restore(const std::vector<scalarList>& states)
{
    for (size_t i = 0; i < states.size(); ++i)
    {
        forcings_[i]->setState(states[i]);
    }
    flow_.mean().forget();
}

void Foam::flowSources::report()
{
    if (!held_ || !held_->isActive())
    {
        flow_.mean().forget();
        return;
    }

    // The first step brings the flow to this mean, once
    gradient_ =
        wasHeld_ ? sign(Ubar_[axisOf(Ubar_)]) * flow_.mean().gradient() : 0;
    wasHeld_ = true;
    const scalar mean = flow_.mean().meanGradient();
    flow_.mean().forget();
    Info << "Pressure gradient source: uncorrected Ubar = "
         << flow_.mean().meanBefore() << ", pressure gradient = " << mean
         << endl;
    if (Pstream::master())
    {
        if (!file_.valid())
        {
            file_ =
                newResultFile(U_.time(), held_->name(), "pressureGradient.dat");
            *file_ << "# time gradient uncorrectedUbar" << nl
                   << "# [s] [m/s^2] [m/s]" << endl;
            file_->precision(12);
        }
        *file_ << U_.time().value() << ' ' << mean << ' '
               << flow_.mean().meanBefore() << endl;
    }
}
