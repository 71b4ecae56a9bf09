// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "capsuleShell.H"
#include "dictionaryChecks.H"
#include "gridValues.H"

Foam::capsuleShell::capsuleShell(const label degree, const scalar dealiasing,
                                 const dictionary& dict,
                                 const coefficients& stressFree,
                                 effectTable& effects)
    : membrane_(degree, label(dealiasing * degree) + 1,
                readDict(dict, "membrane", "law neoHookean; Gs 1e-6;"),
                stressFree),
      effects_(effects),
      onGrid_(3 * grid().nPoints()),
      xt_(onGrid_.size()),
      xp_(onGrid_.size())
{
}

void Foam::capsuleShell::readBending(const dictionary& dict,
                                     const scalar radius,
                                     const coefficients& initial)
{
    const dictionary& bend =
        readDictIfPresent(dict, "bending", "modulus 1e-19;");
    checkEntries(bend, {"modulus", "reference"});
    const scalar modulus =
        dict.found("bending")
            ? readNumber(bend, "modulus", dimForce * dimLength)
            : 0;
    if (modulus < 0)
    {
        refuse(bend, "modulus", Foam::name(modulus), "0 and greater");
    }
    if (modulus > 0)
    {
        bending_.reset(new bending(bend, grid(), radius, initial));
    }
}

Foam::capsuleShell::geometry
Foam::capsuleShell::measure(const coefficients& x) const
{
    grid().gradient(x.data(), xt_.data(), xp_.data());
    geometry m{0, 0, Zero, Zero};
    measure(x, xt_, xp_, m);
    return m;
}

Foam::capsuleShell::geometry
Foam::capsuleShell::measureLast(const coefficients& x) const
{
    geometry m{0, 0, Zero, Zero};
    measure(x, membrane_.xTheta(), membrane_.xPhi(), m);
    return m;
}

void Foam::capsuleShell::measure(const coefficients& x, const coefficients& xt,
                                 const coefficients& xp, geometry& m) const
{
    const label n = grid().nPoints();
    grid().values(x.data(), onGrid_.data());

    // Relative to a point of the surface: no digits are lost far from 0
    const vector origin(vectorAt(onGrid_, 0));
    for (label k = 0; k < n; ++k)
    {
        const vector r(vectorAt(onGrid_, k) - origin);
        const vector dS(grid().weight(k) * (vectorAt(xt, k) ^ vectorAt(xp, k)));
        const scalar flux = r & dS;
        m.area += mag(dS);
        m.volume += flux / 3;
        m.centre += flux / 4 * r;
        m.moments += flux / 5 * sqr(r);
    }
    m.centre /= m.volume;
    m.moments -= m.volume * sqr(m.centre);
    m.centre += origin;
}

Foam::capsuleShell::motion
Foam::capsuleShell::motionLast(const coefficients& x, const coefficients& v,
                               const vector& X, const scalar volume) const
{
    const label n = grid().nPoints();
    const coefficients &xt = membrane_.xTheta(), &xp = membrane_.xPhi();
    coefficients velocities(onGrid_.size());
    grid().values(x.data(), onGrid_.data());
    grid().values(v.data(), velocities.data());
    vector flux(Zero), swirl(Zero), inertia(Zero), first(Zero);
    for (label k = 0; k < n; ++k)
    {
        const vector r(vectorAt(onGrid_, k) - X), u(vectorAt(velocities, k));
        const vector dS(grid().weight(k) * (vectorAt(xt, k) ^ vectorAt(xp, k)));
        const vector squares(cmptMultiply(r, r));
        flux += (u & dS) * r;
        swirl += mag(dS) * (r ^ u);
        first += mag(dS) * r;
        inertia += mag(dS) * (vector(1, 1, 1) * cmptSum(squares) - squares);
    }
    // The centre of the area is another one
    const vector velocity(flux / volume);
    swirl -= first ^ velocity;
    return {velocity, cmptDivide(swirl, inertia)};
}

void Foam::capsuleShell::volumeGradient(const coefficients& x,
                                        coefficients& g) const
{
    grid().gradient(x.data(), xt_.data(), xp_.data());
    volumeGradient(xt_, xp_, g);
}

void Foam::capsuleShell::volumeGradient(const coefficients& xt,
                                        const coefficients& xp,
                                        coefficients& g) const
{
    const label n = grid().nPoints();
    g.resize(3 * grid().nCoeffs());
    for (label k = 0; k < n; ++k)
    {
        for (label c = 0; c < 3; ++c)
        {
            const label a = ((c + 1) % 3) * n + k, b = ((c + 2) % 3) * n + k;
            onGrid_[c * n + k] = xt[a] * xp[b] - xt[b] * xp[a];
        }
    }
    grid().analysis(onGrid_.data(), g.data());
}

void Foam::capsuleShell::load(const coefficients& x, coefficients& q) const
{
    q.resize(x.size());
    membrane_.load(x.data(), q.data());
    if (bending_)
    {
        const auto timing(effects_.time("bending"));
        bending_->addLoad(x.data(), q.data());
    }
}

Foam::string Foam::capsuleShell::check(const coefficients& x) const
{
    const membrane::extremes e(membrane_.stretches(x.data()));
    if (!(e.stretch < 50))
    {
        return "largest stretch " + Foam::name(e.stretch) + ", limit 50";
    }
    if (!(e.area > 0.01))
    {
        grid().values(x.data(), onGrid_.data());
        OStringStream where;
        where << vectorAt(onGrid_, e.where);
        return "the membrane collapses at " + where.str() + ": its area is " +
               Foam::name(e.area) + " of the stress-free one, limit 0.01";
    }
    return "";
}
