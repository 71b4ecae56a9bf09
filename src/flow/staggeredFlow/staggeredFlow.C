// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "staggeredFlow.H"

// The Poisson solver comes first, as its construction takes memory for a moment
Foam::staggeredFlow::staggeredFlow(volVectorField& U, volScalarField& p,
                                   surfaceScalarField& phi,
                                   const volScalarField& nu,
                                   const dictionary& controls,
                                   effectTable& effects, const bool bodies)
    : grid_(uniformGrid::New(U.mesh())),
      block_(grid_),
      effects_(effects),
      convection_(controls.getOrDefault<bool>("convection", true)),
      poisson_(grid_, sidesOf(grid_), block_.indices()),
      scheme_(grid_, U.mesh(), controls, bodies),
      diffusion_(grid_, controls, bodies, scheme_.withDiffusion()),
      nu_(block_),
      walls_(U, controls),
      mean_(grid_, block_),
      fields_(grid_, block_, U, p, phi),
      u_(block_.size()),
      pressure_(block_.size(), 0),
      correction_(block_.size(), 0),
      force_(block_.box()),
      rates_(block_, grid_.h())
{
    setViscosity(nu);
    fields_.read(u_, pressure_);
    velocityChanged();
}

Foam::staggeredField& Foam::staggeredFlow::increment()
{
    if (!scheme_.RK3()) return force_;
    if (!increment_) increment_.reset(new staggeredField(block_.box()));
    return *increment_;
}

void Foam::staggeredFlow::velocityChanged()
{
    rates_.forget();
    stopOnWalls();
    updateVelocity();
}

// Upper walls lie in the halo, which updateVelocity() fills
void Foam::staggeredFlow::stopOnWalls()
{
    staggeredField& change = increment();
    componentArrays& last = scheme_.last();
    for (direction d = 0; d < 3; ++d)
    {
        if (!block_.wallBelow(d)) continue;
        block_.layerPlaces(d, 0, [&](const label q) { u_[d][q] = 0; });
        block_.box().layer(
            d, 0, [&](const label i) { change[d][i] = last[d][i] = 0; });
    }
}

// Halo, then the points beyond walls: tangential components mirrored about the
// wall's velocity, normal ones zero on the wall
void Foam::staggeredFlow::updateVelocity()
{
    const FixedList<scalar*, 3> all({u_[0].data(), u_[1].data(), u_[2].data()});
    const wallVelocities& walls = walls_.now();
    block_.update(all);
    for (direction c = 0; c < 3; ++c)
    {
        double* u = all[c];
        block_.beyondWalls(
            [&](const label q, const label inside, const direction d,
                const label side)
            { u[q] = c == d ? 0 : 2 * walls[d][side][c] - u[inside]; });
    }
}

void Foam::staggeredFlow::setViscosity(const volScalarField& nu,
                                       const scalarMinMax& range)
{
    nu_.set(nu, range);
}

Foam::staggeredView Foam::staggeredFlow::velocity() const
{
    return staggeredView(u_, block_.index(0, 0, 0), block_.stride(1),
                         block_.stride(2));
}

void Foam::staggeredFlow::velocity(staggeredField& u) const
{
    block_.rows(
        [&](const label q, const label n)
        {
            for (direction d = 0; d < 3; ++d)
            {
                std::copy_n(u_[d].cdata() + q, block_.box().size.x(),
                            u[d].data() + n);
            }
        });
}

void Foam::staggeredFlow::begin(const scalar dt)
{
    if (diffusion_.choose(nu_.max(), dt, scheme_))
    {
        mean_.forgetResponse();
        scheme_.setWithDiffusion(diffusion_.isExplicit());
    }
    fields_.outdate();
    walls_.begin();
    scheme_.begin(dt);
    mean_.begin(dt);
}

void Foam::staggeredFlow::save(staggeredState& s) const
{
    s.u = u_;
    s.pressure = pressure_;
    s.diffusion = diffusion_.save();
    s.walls = walls_.now();
}

void Foam::staggeredFlow::restore(const staggeredState& s)
{
    u_ = s.u;
    pressure_ = s.pressure;
    diffusion_.restore(s.diffusion);
    scheme_.setWithDiffusion(diffusion_.isExplicit());
    scheme_.forgetHistory();
    walls_.set(s.walls);
    rates_.forget();
    mean_.forgetResponse();
    fields_.outdate();
    force_.clear();
}

Foam::scalar Foam::staggeredFlow::CourantNo(const scalar dt) const
{
    const scalar rate = rates_.largest(u_).x();
    return rate < VGREAT ? dt * rate : CourantGuard::notFinite;
}

Foam::scalar Foam::staggeredFlow::stableCourantNo() const
{
    return convection_ ? scheme_.stableCourantNo(rates_.largest(u_), nu_.min())
                       : GREAT;
}

void Foam::staggeredFlow::chooseTimeScheme(const scalar deltaT,
                                           const bool adjusted)
{
    if (!convection_) return;
    scheme_.choose(deltaT, adjusted, max(CourantNo(1), VSMALL),
                   stableCourantNo());
}

void Foam::staggeredFlow::setLimits(stepLimits& limits, const bool mayChoose,
                                    const scalar mostCo)
{
    const scalar deltaT = fields_.time().deltaTValue();
    limits.setCourantNo(CourantNo(deltaT));
    const auto byDiffusion = [&]()
    { return diffusion_.maxDeltaT(nu_.max(), scheme_); };
    if (mayChoose)
    {
        const scalar others = min(min(limits.smallestOther(), byDiffusion()),
                                  mostCo / max(CourantNo(1), SMALL));
        chooseTimeScheme(limits.adjusted() ? others : deltaT,
                         limits.adjusted());
    }
    limits.set("diffusion", byDiffusion(), "diffusion explicit",
               byDiffusion() < GREAT ? "" : "implicit where needed");
    const scalar stable = min(stableCourantNo(), mostCo);
    if (!(stable < GREAT)) return;
    const bool byScheme = stable < mostCo;
    limits.guard().expect(stable,
                          byScheme
                              ? "the stability of timeScheme " + timeScheme()
                              : string("bodies, which pass a cell in a step"),
                          true,
                          byScheme && !scheme_.RK3()
                              ? "timeScheme RK3; in PIMPLE of system/fvSolution"
                              : "");
}

Foam::scalar Foam::staggeredFlow::divergence()
{
    updateVelocity();
    scalar largest = 0, speed = SMALL;
    const vector& h = grid_.h();
    block_.rows(
        [&](const label q, const label)
        {
            for (label i = q; i < q + block_.box().size.x(); ++i)
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

void Foam::staggeredFlow::fill()
{
    const auto timing(effects_.time("fields"));
    Info << "Largest divergence, relative to max|u|/h: " << divergence()
         << endl;
    fields_.fill(u_, pressure_);
}

void Foam::staggeredFlow::takeOver()
{
    if (!fields_.filled()) return;
    const auto timing(effects_.time("fields"));
    if (fields_.takeOver(u_, pressure_)) velocityChanged();
}
