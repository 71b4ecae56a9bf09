// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "CourantGuard.H"
#include "dictionaryChecks.H"
#include "fvc.H"
#include "lastStep.H"
#include "ofAllRanks.H"
#include "volFields.H"

namespace
{
using namespace Foam;

//- Half the flux through the faces of each cell, per volume: |u|/h [1/s]
scalarField rates(const surfaceScalarField& phi)
{
    return scalarField(0.5 * fvc::surfaceSum(mag(phi))().primitiveField() /
                       phi.mesh().V().field());
}

//- Centre of the cell whose velocity is not finite, or else fastest (collective)
point worstCell(const surfaceScalarField& phi)
{
    const scalarField fast(rates(phi));
    label worst = 0;
    forAll(fast, celli)
    {
        if (!std::isfinite(fast[worst])) break;
        if (!(fast[celli] <= fast[worst])) worst = celli;
    }
    Tuple2<scalar, point> mine(0, point(Zero));
    if (fast.size())
    {
        const scalar f = fast[worst];
        mine = Tuple2<scalar, point>(std::isfinite(f) ? f : GREAT,
                                     phi.mesh().C()[worst]);
    }
    const List<Tuple2<scalar, point>> all(ofAllRanks(mine));
    Tuple2<scalar, point> where(all[0]);
    for (const Tuple2<scalar, point>& one : all)
    {
        if (one.first() > where.first()) where = one;
    }
    return where.second();
}
} // namespace

constexpr Foam::scalar Foam::CourantGuard::notFinite;

void Foam::CourantGuard::expect(const scalar stable, const string& who,
                                const bool isExplicit, const string& remedy)
{
    stable_ = stable;
    who_ = who;
    largest_ = isExplicit ? 20 : GREAT;
    remedy_ = remedy;
}

Foam::scalar Foam::CourantGuard::CourantNo(const surfaceScalarField& phi)
{
    const scalarField all(rates(phi));
    bool bad = false;
    for (const scalar rate : all)
    {
        bad = bad || !(rate < VGREAT);
    }
    if (returnReduce(bad, orOp<bool>())) return notFinite;
    return phi.time().deltaTValue() * gMax(all);
}

Foam::string Foam::CourantGuard::wrong(const scalar Co) const
{
    if (!unsolved_.empty()) return unsolved_;
    const scalar dt = phi_.time().deltaTValue();
    if (!(Co < GREAT)) return "the velocity is not finite";
    if (Co > largest_)
    {
        return "Courant number " + Foam::name(Co) + ", limit " +
               Foam::name(largest_);
    }
    if (dt < 1e-6 * longest_)
    {
        return "the time step has shrunk from " + Foam::name(longest_) +
               " to " + Foam::name(dt);
    }
    return string::null;
}

void Foam::CourantGuard::warn(const scalar Co, const scalar rate)
{
    // An adjusted step is adjusted to the velocity before: 5 % are allowed
    const Time& time = phi_.time();
    if (Co <= 1.05 * stable_ || !warning_.due(stepIndex(time))) return;
    warning_.warned(stepIndex(time));
    if (!Pstream::master()) return;
    const string now(stepEntry(time) + " from " + Foam::name(Co / rate) +
                     " to less than " + Foam::name(stable_ / rate));
    const string adjusted("adjustTimeStep yes; maxCo " +
                          Foam::name(0.5 * stable_) +
                          "; in system/controlDict");
    const bool isAdjusted =
        time.controlDict().getOrDefault<bool>("adjustTimeStep", false);
    WarningInFunction << "Courant number " << Foam::name(Co) << " at time "
                      << time.timeName() << " is above " << Foam::name(stable_)
                      << ", the largest for " << who_.c_str() << nl << "    "
                      << (isAdjusted
                              ? "Write " + adjusted
                              : "Reduce " + now + ", or write " + adjusted)
                             .c_str()
                      << (remedy_.empty() ? "" : ", or ") << remedy_.c_str()
                      << endl;
}

void Foam::CourantGuard::check(const scalar Co, const scalar rate,
                               const std::function<void()>& beforeStop,
                               const string& failed)
{
    longest_ = max(longest_, phi_.time().deltaTValue());
    const string reason(failed.empty() ? wrong(Co) : failed);
    if (!reason.empty()) stop(reason, rate, beforeStop);
    const scalar borne = stableStep(rate);
    if (borne > 0 && (Co <= stable_ || borne_ == 0))
    {
        borne_ = borne_ > 0 ? min(borne_, borne) : borne;
    }
    warn(Co, rate);
}

bool Foam::CourantGuard::solved(const word& field, const scalar residual)
{
    unsolved_.clear();
    if (residual < 10) return true;
    unsolved_ = "the linear solver of " + field + " diverges, residual " +
                Foam::name(residual) + ", at Courant number " +
                Foam::name(CourantNo(phi_));
    return false;
}

void Foam::CourantGuard::stop(const string& reason, const scalar rate,
                              const std::function<void()>& beforeStop) const
{
    const Time& time = phi_.time();
    const bool starting = time.timeIndex() == time.startTimeIndex();
    if (!starting) beforeStop();
    const point where(worstCell(phi_));
    const string nearest(nearest_ ? nearest_(where) : string());
    if (!starting) lastStep::writeBeforeStop(time, reason);

    const scalar dt = time.deltaTValue();
    const scalar borne = borne_ > 0 ? borne_ : stableStep(max(rate, VSMALL));
    OStringStream allowed;
    if (borne < dt)
    {
        allowed << "allowed: " << stepEntry(time) << " up to about "
                << Foam::name(borne) << ", for " << who_.c_str();
    }
    else
    {
        allowed << "deltaT was below the flow's own limit, "
                << Foam::name(borne) << ": "
                << (bodies_ ? "bodies, forces" : "forces")
                << " or conditions need a smaller one";
    }
    waitForMaster();
    FatalErrorInFunction
        << (starting ? "the time step is too large" : "the flow diverges")
        << " at time " << time.timeName() << ", cell at " << where
        << (nearest.empty() ? "" : ", near ") << nearest.c_str() << ": "
        << reason.c_str() << ", deltaT " << Foam::name(dt) << nl << "    "
        << allowed.str().c_str() << nl
        << (starting ? ""
                     : "    The state has been written to this time; start "
                       "again from an earlier one")
        << exit(FatalError);
}
