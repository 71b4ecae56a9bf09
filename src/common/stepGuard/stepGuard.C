// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "stepGuard.H"
#include "dictionaryChecks.H"
#include "fvc.H"
#include "lastStep.H"
#include "volFields.H"

namespace
{
using namespace Foam;

//- Half the flux through the faces of each cell, per volume: |u|/h
scalarField rates(const surfaceScalarField& phi)
{
    return 0.5 * fvc::surfaceSum(mag(phi))().primitiveField() /
           phi.mesh().V().field();
}
} // namespace

void Foam::stepGuard::expect(const scalar stable, const string& who,
                             const bool isExplicit, const string& remedy)
{
    remedy_ = remedy;
    stable_ = stable;
    who_ = who;
    largest_ = isExplicit ? 20 : GREAT;
}

Foam::scalar Foam::stepGuard::CourantNo(const surfaceScalarField& phi)
{
    const scalarField all(rates(phi));
    bool bad = false;
    for (const scalar rate : all)
    {
        bad = bad || !(rate < VGREAT);
    }
    if (returnReduce(bad, orOp<bool>())) return GREAT * GREAT;
    return phi.time().deltaTValue() * gMax(all);
}

void Foam::stepGuard::check(const scalar Co, const std::function<void()>& fill)
{
    const Time& time = phi_.time();
    const scalar dt = time.deltaTValue();
    longest_ = max(longest_, dt);
    if (!(Co < GREAT))
    {
        stop("the velocity is not finite", Co, fill);
    }
    if (Co > largest_)
    {
        stop("Courant number " + Foam::name(Co) + ", limit " +
                 Foam::name(largest_),
             Co, fill);
    }
    if (dt < 1e-6 * longest_)
    {
        stop("the time step has shrunk from " + Foam::name(longest_) + " to " +
                 Foam::name(dt),
             Co, fill);
    }

    if (Co > 0 && (Co <= stable_ || borne_ == 0))
    {
        const scalar borne = min(stable_, scalar(1)) * dt / Co;
        borne_ = borne_ > 0 ? min(borne_, borne) : borne;
    }
    // An adjusted step is adjusted to the velocity before
    if (Co <= 1.05 * stable_ ||
        (warned_ >= 0 && time.timeIndex() < warned_ + pause))
    {
        return;
    }
    warned_ = time.timeIndex();
    if (Pstream::master())
    {
        WarningInFunction << "Courant number " << Foam::name(Co) << " at time "
                          << time.timeName() << " is above "
                          << Foam::name(stable_) << ", the largest for "
                          << who_.c_str() << nl << "    Reduce deltaT from "
                          << Foam::name(dt) << " to less than "
                          << Foam::name(stable_ * dt / Co)
                          << ", or write adjustTimeStep yes; maxCo "
                          << Foam::name(0.5 * stable_)
                          << "; in system/controlDict"
                          << (remedy_.empty() ? "" : ", or ") << remedy_.c_str()
                          << endl;
    }
}

void Foam::stepGuard::checkSolved(const word& field, const scalar residual,
                                  const std::function<void()>& fill) const
{
    if (residual < 10) return;
    const scalar Co = CourantNo(phi_);
    stop("the linear solver of " + field + " diverges, residual " +
             Foam::name(residual) + ", at Courant number " + Foam::name(Co),
         Co, fill);
}

void Foam::stepGuard::stop(const string& what, const scalar Co,
                           const std::function<void()>& fill) const
{
    const Time& time = phi_.time();
    const bool starting = time.timeIndex() == time.startTimeIndex();
    if (!starting) fill();

    // The cell where it is worst: not finite, or fastest
    const scalarField fast(rates(phi_));
    label worst = 0;
    forAll(fast, celli)
    {
        if (!std::isfinite(fast[worst])) break;
        if (!(fast[celli] <= fast[worst])) worst = celli;
    }
    List<Tuple2<scalar, point>> all(Pstream::nProcs());
    if (fast.size())
    {
        const scalar f = fast[worst];
        all[Pstream::myProcNo()] = Tuple2<scalar, point>(
            std::isfinite(f) ? f : GREAT, phi_.mesh().C()[worst]);
    }
    Pstream::gatherList(all);
    Pstream::scatterList(all);
    Tuple2<scalar, point> where(all[0]);
    for (const Tuple2<scalar, point>& one : all)
    {
        if (one.first() > where.first()) where = one;
    }

    if (!starting) lastStep::writeBeforeStop(time, what);
    const scalar dt = time.deltaTValue();
    const scalar borne =
        borne_ > 0 ? borne_ : min(stable_, scalar(1)) * dt / max(Co, VSMALL);
    OStringStream allowed;
    if (borne < dt)
    {
        allowed << "allowed: deltaT up to about " << Foam::name(borne)
                << ", for " << who_.c_str();
    }
    else
    {
        allowed << "deltaT was below the flow's own limit, "
                << Foam::name(borne) << ": "
                << (bodies_ ? "bodies, forces" : "forces")
                << " or conditions need a smaller one";
    }
    firstRankSpeaks();
    FatalErrorInFunction
        << (starting ? "the time step is too large" : "the flow diverges")
        << " at time " << time.timeName() << ", cell at " << where.second()
        << ": " << what.c_str() << ", deltaT " << Foam::name(dt) << nl << "    "
        << allowed.str().c_str() << nl
        << (starting ? ""
                     : "    What it looks like has been written to this "
                       "time; go on from an earlier one")
        << exit(FatalError);
}
