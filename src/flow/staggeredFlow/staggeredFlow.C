// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "staggeredFlow.H"
#include "dictionaryChecks.H"
#include "fixedValueFvPatchFields.H"
#include "writtenObject.H"

namespace
{
//- Courant number that RK3 bears, and that AB2 is left whatever the viscosity: there a
//  wave grows by e in 80 of its periods. Share of the damping by viscosity that AB2 may
//  give back to a wave
const Foam::scalar stableRK3 = 1.7, leastAB2 = 0.2, shareAB2 = 0.5;
} // namespace

Foam::staggeredFlow::staggeredFlow(volVectorField& U, volScalarField& p,
                                   surfaceScalarField& phi,
                                   const volScalarField& nu,
                                   const dictionary& controls,
                                   effectLedger& effects, const bool bodies)
    : mesh_(U.mesh()),
      grid_(uniformGrid::New(mesh_)),
      block_(grid_),
      box_(block_.box()),
      effects_(effects),
      controls_(controls),
      timeScheme_(
          readWord(controls, "timeScheme", {"auto", "AB2", "RK3"}, "auto")),
      diffusion_(readWord(controls, "diffusion",
                          {"auto", "ADI", "FFT", "explicit"}, "auto")),
      convection_(controls.getOrDefault<bool>("convection", true)),
      U_(U),
      p_(p),
      phi_(phi),
      force_(box_)
{
    const label nWalled =
        3 - grid_.periodic(0) - grid_.periodic(1) - grid_.periodic(2);
    if (diffusion_ == "FFT" && nWalled > 1)
    {
        refuse(controls, "diffusion", "FFT",
               "auto, ADI or explicit where two directions have walls");
    }
    mayTransform_ =
        diffusion_ == "FFT" || (diffusion_ == "auto" && bodies && nWalled < 2);
    lags_ = diffusion_ == "auto" && bodies && nWalled > 1;

    // First, as making it takes memory for a moment
    poisson_.reset(new fastHelmholtz(grid_, sidesOf(grid_), block_.places()));
    u_ = componentArrays(block_.size());
    last_ = componentArrays(box_.nPlaces());
    pressure_.assign(block_.size(), 0);
    correction_.assign(block_.size(), 0);

    for (const fvPatchVectorField& Ub : U.boundaryField())
    {
        wallsChange_ = wallsChange_ ||
                       (!Ub.coupled() &&
                        Ub.type() != fixedValueFvPatchVectorField::typeName);
    }
    reduce(wallsChange_, orOp<bool>());
    wallsLook_ = lookAtFields(U);
    readWalls(U, walls_);

    setViscosity(nu);
    readState();
}

void Foam::staggeredFlow::setViscosity(const volScalarField& nu,
                                       const scalar highest)
{
    nuMax_ = max(highest, gMax(nu.primitiveField()));
    nuMin_ = gMin(nu.primitiveField());
    if (nuMax_ - nuMin_ <= 1e-12 * nuMax_) return;

    // Also of places that no cell has
    nu_.resize(block_.size(), nuMax_);
    block_.set(nu, nu_.data());

    // The harmonic mean of the four cells at an edge: exact for shear across
    // layers, where the stress is what is continuous
    for (direction g = 0; g < 3; ++g)
    {
        const label sa = block_.stride(g == 0 ? 1 : 0);
        const label sb = block_.stride(g == 2 ? 1 : 2);
        nuEdge_[g].resize(block_.size());
        const label end = block_.place(box_.size);
        for (label q = block_.place(0, 0, 0); q <= end; ++q)
        {
            nuEdge_[g][q] = 4 / (1 / nu_[q] + 1 / nu_[q - sa] +
                                 1 / nu_[q - sb] + 1 / nu_[q - sa - sb]);
        }
    }
}

void Foam::staggeredFlow::hold(const direction component, const scalar mean,
                               const scalar likelyGradient)
{
    holdsMean_ = true;
    heldComponent_ = component;
    heldMean_ = mean;
    likelyGradient_ = likelyGradient;
    for (scalar& f : force_[component])
    {
        f += likelyGradient;
    }
}

// On walls above it is in the halo, which updateVelocity() fills
void Foam::staggeredFlow::stopOnWalls()
{
    for (direction d = 0; d < 3; ++d)
    {
        if (!block_.wallBelow(d)) continue;
        block_.layerPlaces(d, 0, [&](const label q) { u_[d][q] = 0; });
        box_.layer(d, 0,
                   [&](const label i) { increment()[d][i] = last_[d][i] = 0; });
    }
}

// Halo, then the points beyond walls: tangential components mirrored about the
// wall's velocity, normal ones zero on the wall
void Foam::staggeredFlow::updateVelocity()
{
    const FixedList<scalar*, 3> all({u_[0].data(), u_[1].data(), u_[2].data()});
    block_.update(all);
    for (direction c = 0; c < 3; ++c)
    {
        double* u = all[c];
        block_.beyondWalls(
            [&](const label q, const label inside, const direction d,
                const label side)
            { u[q] = c == d ? 0 : 2 * walls_[d][side][c] - u[inside]; });
    }
}

Foam::staggeredView Foam::staggeredFlow::velocity() const
{
    return staggeredView(u_, block_.place(0, 0, 0), block_.stride(1),
                         block_.stride(2));
}

void Foam::staggeredFlow::velocity(staggeredField& u) const
{
    block_.rows(
        [&](const label q, const label n)
        {
            for (direction d = 0; d < 3; ++d)
            {
                std::copy_n(u_[d].cdata() + q, box_.size.x(), u[d].data() + n);
            }
        });
}

void Foam::staggeredFlow::setVelocity(const staggeredField& u)
{
    block_.rows(
        [&](const label q, const label n)
        {
            for (direction d = 0; d < 3; ++d)
            {
                std::copy_n(u[d].cdata() + n, box_.size.x(), u_[d].data() + q);
            }
        });
    rates_.clear();
    stopOnWalls();
    updateVelocity();
}

void Foam::staggeredFlow::addCells(const vectorField& cells,
                                   const scalar factor)
{
    // The pressure correction is free between steps
    for (direction d = 0; d < 3; ++d)
    {
        const scalarField half(0.5 * factor * cells.component(d));
        block_.set(half, correction_.data());
        block_.rows(
            [&](const label q, const label n)
            {
                const double* c = correction_.data() + q;
                for (label i = 0; i < box_.size.x(); ++i)
                {
                    force_[d][n + i] += c[i] + c[i - block_.stride(d)];
                }
            });
    }
}

Foam::scalar Foam::staggeredFlow::maxDeltaT() const
{
    return diffusion_ == "explicit" && nuMax_ > 0
               ? explicitLimit() / grid_.diffusionNumber(nuMax_, 1)
               : GREAT;
}

void Foam::staggeredFlow::takeRK3()
{
    RK3_ = true;
    hasLast_ = false;
    history_.reset();
    if (timeScheme_ == "auto")
    {
        scheme_.reset(new writtenObject<IOdictionary>(
            "timeScheme", "uniform", mesh_,
            [](Ostream& os) { os.writeEntry("timeScheme", "RK3"); }));
    }
    increment_.reset(new staggeredField(box_));
    stages_ = {{8.0 / 15, 0, 8.0 / 15},
               {5.0 / 12, -17.0 / 60, 2.0 / 15},
               {3.0 / 4, -5.0 / 12, 1.0 / 3}};
}

void Foam::staggeredFlow::chooseTimeScheme(const scalar deltaT,
                                           const bool adjusted)
{
    // Measured cost of a step of RK3 over one of AB2 (doc/developer/speed.md)
    const scalar dearer = 2.3;
    if (timeScheme_ != "auto" || RK3_ || !convection_) return;
    const scalar rate = max(CourantNo(1), VSMALL);
    if (!(rate < GREAT)) return; // the flow diverges
    const scalar borne = stableCourantNo() / rate;
    const scalar gain = adjusted
                            ? min(deltaT, stableRK3 / rate) / (dearer * borne)
                            : deltaT / borne;
    if (!(gain > 1)) return;
    takeRK3();
    Info << "Time scheme: RK3, as AB2 bears steps up to " << Foam::name(borne)
         << " s (Courant number " << Foam::name(borne * rate) << "), not "
         << Foam::name(deltaT) << endl;
}

void Foam::staggeredFlow::setLimits(stepLimits& limits, const bool mayChoose)
{
    const scalar deltaT = mesh_.time().deltaTValue();
    limits.setCourantNo(CourantNo(deltaT));
    if (mayChoose)
    {
        const scalar others = min(limits.smallestOther(), maxDeltaT());
        chooseTimeScheme(limits.adjusted() ? others : deltaT,
                         limits.adjusted());
    }
    limits.set("diffusion", maxDeltaT(), "diffusion explicit",
               maxDeltaT() < GREAT ? "" : "implicit where needed");
    const scalar stable = stableCourantNo();
    if (!(stable < GREAT)) return;
    limits.guard().expect(stable, "the stability of timeScheme " + timeScheme(),
                          true,
                          RK3_ ? ""
                               : "timeScheme RK3; in PIMPLE of "
                                 "system/fvSolution");
}

void Foam::staggeredFlow::chooseDiffusion(const scalar dt)
{
    const bool wasExplicit = explicit_, byTransforms = transforms_;
    const scalar limit = explicitLimit();
    const scalar number = grid_.diffusionNumber(nuMax_, dt);
    if (diffusion_ == "explicit" && number > 1.04 * limit)
    {
        refuse(controls_, "diffusion",
               "explicit at nu dt/h^2 = " + Foam::name(number),
               "auto, ADI or FFT, or a smaller deltaT: explicit diffusion is "
               "unstable above " +
                   Foam::name(1.04 * limit));
    }

    // AB2 starts afresh: not back and forth where dt varies about the limit
    const scalar below =
        (RK3_ || explicit_ || !(chosen_ || hasLast_) ? 1 : 0.75) * limit;
    explicit_ =
        diffusion_ == "explicit" || (diffusion_ == "auto" && number < below);
    transforms_ = mayTransform_ && (diffusion_ == "FFT" || number > 1);
    if (lags_ && number > 2)
    {
        WarningInFunction
            << "diffusion by ADI at nu dt/h^2 = " << Foam::name(number)
            << " lags behind the forces of bodies; fast transforms need two "
               "periodic directions"
            << nl << "    Reduce deltaT from " << Foam::name(dt) << " to "
            << Foam::name(2 * dt / number) << endl;
        lags_ = false;
    }
    if (!explicit_ && !implicit_[transforms_])
    {
        implicit_[transforms_].reset(new implicitDiffusion(grid_, transforms_));
    }
    const bool other = explicit_ != wasExplicit || transforms_ != byTransforms;
    if (chosen_ && !other) return;

    chosen_ = true;
    if (explicit_ != wasExplicit) hasLast_ = false;
    responseTo_ = -1;
    Info << "Diffusion: "
         << (explicit_     ? "explicit"
             : transforms_ ? "implicit by fast transforms"
                           : "implicit by ADI")
         << " at nu dt/h^2 = " << number << endl;
    if (history_) history_->rename(historyName(explicit_));
}

void Foam::staggeredFlow::begin(const scalar dt)
{
    chooseDiffusion(dt);
    filled_ = false;

    wallsBefore_ = walls_;
    wallsAfter_ = walls_;
    if (wallsChange_)
    {
        for (fvPatchVectorField& Ub : U_.boundaryFieldRef())
        {
            if (!Ub.coupled()) Ub.evaluate();
        }
        const string reason(readWalls(U_, wallsAfter_));
        if (!reason.empty())
        {
            firstRankSpeaks();
            FatalIOErrorInFunction(controls_)
                << "flowAlgorithm staggered cannot go on at time "
                << mesh_.time().timeName() << ": " << reason.c_str()
                << "; use flowAlgorithm pimple" << exit(FatalIOError);
        }
    }

    if (!RK3_)
    {
        const scalar c0 = hasLast_ ? -0.5 * dt / lastDt_ : 0;
        stages_ = {{1 - c0, c0, 1}};
        lastDt_ = dt;
        hasLast_ = true;
    }
    stage_ = 0;
    stepDt_ = dt;
    gradient_ = likelyGradient_ * dt;
    likelyGradient_ = 0;
}

void Foam::staggeredFlow::restore(const staggeredState& s)
{
    static_cast<staggeredState&>(*this) = s;
    rates_.clear();
    responseTo_ = -1;
    filled_ = false;
    force_.clear();
    if (history_) history_->rename(historyName(explicit_));
}

// Largest by place in a row: these do not wait for each other. NaN stays. One function, not
// inlined: a run that goes on has the digits of one that was not stopped
void Foam::staggeredFlow::takeRates(const label q) const
{
    const double r0 = 1 / grid_.h().x(), r1 = 1 / grid_.h().y(),
                 r2 = 1 / grid_.h().z();
    const double* a = u_[0].cdata() + q;
    const double* b = u_[1].cdata() + q;
    const double* c = u_[2].cdata() + q;
    double *largest = rates_.data(), *steepest = steepness_.data();
#pragma GCC ivdep
    for (label i = 0; i < box_.size.x(); ++i)
    {
        const double rate =
            std::abs(a[i]) * r0 + std::abs(b[i]) * r1 + std::abs(c[i]) * r2;
        const bool take = (rate > largest[i]) | (rate != rate);
        largest[i] = take ? rate : largest[i];
        const double steep =
            rate * rate * (a[i] * a[i] + b[i] * b[i] + c[i] * c[i]);
        steepest[i] = steep > steepest[i] ? steep : steepest[i];
    }
}

Foam::vector2D Foam::staggeredFlow::largestRates() const
{
    if (rates_.empty())
    {
        rates_.assign(box_.size.x(), 0);
        steepness_.assign(box_.size.x(), 0);
        block_.rows([&](const label q, const label) { takeRates(q); });
    }
    vector2D largest(Zero);
    for (std::size_t i = 0; i < rates_.size(); ++i)
    {
        largest.x() = max(largest.x(), rates_[i] < VGREAT ? rates_[i] : VGREAT);
        largest.y() = max(largest.y(), steepness_[i]);
    }
    reduce(largest, maxOp<vector2D>());
    return largest;
}

Foam::scalar Foam::staggeredFlow::CourantNo(const scalar dt) const
{
    const scalar rate = largestRates().x();
    return rate < VGREAT ? dt * rate : CourantGuard::notFinite;
}

// A wave of central differences in a velocity u that is uniform around it turns by
// w = sum_d u_d dt/h_d sin(theta_d) a step, grows with AB2 by w^4/4 and is damped by
// 4 nu dt sum_d sin^2(theta_d/2)/h_d^2: none grows, the first of five cells, up to
// dt^3 = 6.75 nu/(r |u|)^2. Up to half of that no wave gets back more than half of what
// viscosity takes. The square root: terms of higher order, fitted to the roots of AB2 with
// Crank-Nicolson or explicit diffusion (tests/unit/flow)
Foam::scalar Foam::staggeredFlow::stableCourantNo() const
{
    if (!convection_) return GREAT;
    if (RK3_) return stableRK3;
    const vector2D largest(largestRates());
    if (!(largest.y() > VSMALL && largest.x() < VGREAT)) return 1;
    const scalar Co =
        largest.x() * std::cbrt(shareAB2 * 6.75 * nuMin_ / largest.y());
    return min(scalar(1), max(leastAB2, Co / std::sqrt(1 + 0.8 * sqr(Co))));
}

Foam::scalar Foam::staggeredFlow::divergence()
{
    updateVelocity();
    scalar largest = 0, speed = SMALL;
    const vector& h = grid_.h();
    block_.rows(
        [&](const label q, const label)
        {
            for (label i = q; i < q + box_.size.x(); ++i)
            {
                scalar sum = 0;
                for (direction d = 0; d < 3; ++d)
                {
                    sum += (u_[d][i + block_.stride(d)] - u_[d][i]) / h[d];
                    speed = max(speed, mag(u_[d][i]));
                }
                largest = max(largest, mag(sum));
            }
        });
    reduce(largest, maxOp<scalar>());
    reduce(speed, maxOp<scalar>());
    return largest * cmptMin(h) / speed;
}
