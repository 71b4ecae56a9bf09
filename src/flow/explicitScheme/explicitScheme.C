// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "explicitScheme.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "lastStep.H"
#include "stepRatio.H"
#include "volFields.H"
#include "stateObject.H"

namespace
{
//- Stable Courant number of RK3; least one of AB2 whatever the viscosity, with which a
//  wave grows by e in 80 of its periods; share of the damping of a wave by viscosity that
//  AB2 may give back
const Foam::scalar stableRK3 = 1.7, leastAB2 = 0.2, shareAB2 = 0.5;

//- Measured cost of a step of RK3 over one of AB2 (doc/numerics.md)
const Foam::scalar costRatio = 2.3;

Foam::word termsName(const bool withDiffusion)
{
    return withDiffusion ? "staggeredExplicit" : "staggeredConvection";
}
} // namespace

Foam::explicitScheme::explicitScheme(const uniformGrid& grid,
                                     const fvMesh& mesh,
                                     const dictionary& controls,
                                     const bool bodies)
    : grid_(grid),
      mesh_(mesh),
      asked_(readWord(controls, "timeScheme", {"auto", "AB2", "RK3"}, "auto"))
{
    history_.last = componentArrays(grid.box().nPlaces());

    // Time forgets the length of the last step where deltaT is fixed
    history_.deltaT = lastStep::readSubStep(mesh.time());
    if (!(history_.deltaT > 0)) history_.deltaT = mesh.time().deltaTValue();

    const auto state = stateOfTime(mesh, "timeScheme");
    const word before(state ? state->getOrDefault<word>("timeScheme", "AB2")
                            : "AB2");
    nameFile_.reset(
        new stateObject<IOdictionary>("timeScheme", "uniform", mesh_,
                                      [this](Ostream& os) { writeName(os); }));

    // Beside bodies that act on the fluid auto is AB2
    const word automatic(bodies ? word("AB2") : before);
    if (asked_ == "auto" && automatic != before)
    {
        Info << "Time scheme: AB2, as bodies have been added; RK3 before"
             << endl;
    }
    if ((asked_ == "auto" ? automatic : asked_) == "RK3")
    {
        takeRK3();
        return;
    }
    // Terms beside a state of RK3 are of an older run
    readTerms(state ? state->getOrDefault<word>("terms",
                                                before == "RK3" ? "none" : "")
                    : word::null);
    termsFile_.reset(new stateObject<volVectorField>(
        termsName(history_.withDiffusion), "", mesh,
        [this](Ostream& os) { writeTerms(os); }));
}

void Foam::explicitScheme::writeName(Ostream& os) const
{
    os.writeEntry("timeScheme", word(RK3_ ? "RK3" : "AB2"));
    if (!RK3_) os.writeEntry("terms", termsName(history_.withDiffusion));
}

void Foam::explicitScheme::readTerms(const word& ofState)
{
    for (const bool withDiffusion : {false, true})
    {
        if (!ofState.empty() && ofState != termsName(withDiffusion)) continue;
        IOobject io(termsName(withDiffusion), mesh_.time().timeName(), mesh_,
                    IOobject::MUST_READ, IOobject::NO_WRITE, false);
        if (!io.typeHeaderOk<volVectorField>(true)) continue;

        const volVectorField field(io, mesh_);
        forAll(grid_.index(), celli)
        {
            for (direction d = 0; d < 3; ++d)
            {
                history_.last[d][grid_.index()[celli]] = field[celli][d];
            }
        }
        history_.withDiffusion = withDiffusion;
        history_.known = true;
    }
    if (!history_.known && mesh_.time().value() > 0)
    {
        WarningInFunction << "no history of timeScheme AB2 in time "
                          << mesh_.time().timeName() << ", file "
                          << termsName(false)
                          << ": the first step is one of explicit Euler"
                          << endl;
    }
}

void Foam::explicitScheme::writeTerms(Ostream& os) const
{
    const auto made = volVectorField::New(
        "last", mesh_, dimensionedVector(dimAcceleration, Zero));
    volVectorField& field = made.ref();
    forAll(field, celli)
    {
        for (direction d = 0; d < 3; ++d)
        {
            field[celli][d] = history_.last[d][grid_.index()[celli]];
        }
    }
    field.correctBoundaryConditions();
    field.writeData(os);
}

Foam::scalar Foam::explicitScheme::stableCourantNo(const vector2D& largest,
                                                   const scalar leastNu) const
{
    if (RK3_) return stableRK3;
    if (!(largest.y() > VSMALL && largest.x() < VGREAT)) return 1;
    const scalar Co =
        largest.x() * std::cbrt(shareAB2 * 6.75 * leastNu / largest.y());
    return min(scalar(1), max(leastAB2, Co / std::sqrt(1 + 0.8 * sqr(Co))));
}

void Foam::explicitScheme::choose(const scalar deltaT, const bool adjusted,
                                  const scalar rate, const scalar stable)
{
    if (asked_ != "auto" || RK3_ || !(rate < GREAT)) return;
    const scalar borne = stable / rate;
    const scalar gain =
        adjusted ? min(deltaT, stableRK3 / rate) / (costRatio * borne)
                 : deltaT / borne;
    if (!(gain > 1)) return;
    takeRK3();
    Info << "Time scheme: RK3, as AB2 bears steps up to " << Foam::name(borne)
         << " s (Courant number " << Foam::name(borne * rate) << "), not "
         << Foam::name(deltaT) << endl;
}

void Foam::explicitScheme::takeRK3()
{
    RK3_ = true;
    history_.known = false;
    termsFile_.reset();
    stages_ = {{8.0 / 15, 0, 8.0 / 15},
               {5.0 / 12, -17.0 / 60, 2.0 / 15},
               {3.0 / 4, -5.0 / 12, 1.0 / 3}};
}

void Foam::explicitScheme::begin(const scalar deltaT)
{
    if (!RK3_)
    {
        const scalar weightLast =
            -0.5 * stepRatio(deltaT, history_.known ? history_.deltaT : 0);
        stages_ = {{1 - weightLast, weightLast, 1}};
        history_.deltaT = deltaT;
        history_.known = true;
    }
    stage_ = 0;
    deltaT_ = deltaT;
}

Foam::scalar Foam::explicitScheme::passed() const
{
    scalar sum = 0;
    for (label i = 0; i <= stage_; ++i)
    {
        sum += stages_[i].dtFraction;
    }
    return sum;
}

// The terms of a step that is taken back may not be finite
void Foam::explicitScheme::forgetHistory()
{
    history_.known = false;
    for (direction d = 0; d < 3; ++d)
    {
        std::fill(history_.last[d].begin(), history_.last[d].end(), 0);
    }
}

void Foam::explicitScheme::setWithDiffusion(const bool yes)
{
    if (history_.withDiffusion == yes) return;
    history_.withDiffusion = yes;
    history_.known = false;
    if (termsFile_) termsFile_->rename(termsName(yes));
}
