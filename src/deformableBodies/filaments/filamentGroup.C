// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The filaments of a group: coming and going, geometry, slip

#include "filamentGroup.H"
#include "dictionaryChecks.H"
#include "filamentReport.H"
#include "rangeCheck.H"
#include "mathematicalConstants.H"

Foam::filamentGroup::~filamentGroup() {}

const Foam::bodyReport& Foam::filamentGroup::report() const
{
    return *report_;
}

Foam::vector Foam::filamentGroup::startDisplacement() const
{
    return base_.valid() ? base_->value(scene_.startTime) : vector::zero;
}

// Segments of equal length along the curve
Foam::vectorField Foam::filamentGroup::firstShape(const label number) const
{
    const vector t0(start_.directions[number] / mag(start_.directions[number]));
    const label N = properties_.segments;
    vectorField X(N + 1, start_.positions[number]);
    for (label i = 1; i <= N; ++i)
    {
        const scalar s = constant::mathematical::pi * (i - 0.5) / N;
        vector t(t0 + constant::mathematical::pi / properties_.length *
                          std::cos(s) * bow_);
        t /= mag(t);
        X[i] = X[i - 1] + properties_.ds() * t;
    }
    return X;
}

void Foam::filamentGroup::insertBody(const label i, const label number,
                                     const scalarList& state,
                                     const dictionary& source)
{
    const vectorField X(firstShape(number));
    body x(filament(properties_, X + startDisplacement()));
    x.line.clamp(0, start_.directions[number]);
    x.line.clamp(1, start_.directions[number]);
    x.U.setSize(points_.size(), Zero);
    x.X.setSize(markersEach());
    x.forces.setSize(twoWay() ? markersEach() : 0, Zero);
    x.start = X[movedEnd() * properties_.segments];
    if (state.size()) restore(x, number, state, source);
    bodies_.insert(bodies_.begin() + i, x);
}

void Foam::filamentGroup::eraseBody(const label i)
{
    bodies_.erase(bodies_.begin() + i);
}

Foam::point Foam::filamentGroup::initialCentre(const label number) const
{
    return average(firstShape(number)) + startDisplacement();
}

Foam::bodyPoints Foam::filamentGroup::initialPoints(const label number) const
{
    const vectorField X(firstShape(number) + startDisplacement());
    return pointsOf(number, X, vectorField(X.size(), Zero));
}

Foam::point Foam::filamentGroup::centre(const label i) const
{
    return average(bodies_[i].line.positions());
}

Foam::boundBox Foam::filamentGroup::bounds(const label i,
                                           const bool smallest) const
{
    const filament& line = bodies_[i].line;
    return smallest ? boundBox(line.positions(), false) : line.roughBounds();
}

Foam::boundBox Foam::filamentGroup::forcedBounds(const label i) const
{
    vectorField X(points_.size());
    forAll(X, k)
    {
        X[k] = points_[k](bodies_[i].line.positions());
    }
    return boundBox(X, false);
}

Foam::bodyPoints Foam::filamentGroup::pointsOf(const label number,
                                               const vectorField& X,
                                               const vectorField& V) const
{
    bodyPoints p{name(),
                 number,
                 X,
                 V,
                 vectorField(),
                 scalarField(X.size()),
                 crossSection_,
                 properties_.rigidity / pow3(properties_.ds())};
    forAll(X, i)
    {
        p.lengths[i] = properties_.lengthOf(i);
    }
    for (const label end : {0, 1})
    {
        p.held[end] = properties_.ends[end] != filament::FREE;
    }
    p.densityRatio =
        properties_.mass / (crossSection_ * scene_.rho) + (twoWay() ? 1 : 0);
    return p;
}

Foam::bodyPoints Foam::filamentGroup::points(const label i) const
{
    if (i < 0)
    {
        const vectorField X(firstShape(0));
        return pointsOf(-1, X - average(X), vectorField(X.size(), Zero));
    }
    const filament& x = bodies_[i].line;
    return pointsOf(mine()[i], x.positions(), x.velocities());
}

Foam::scalarList Foam::filamentGroup::state(const label i) const
{
    const body& x = bodies_[i];
    DynamicList<scalar> s;
    x.line.save(s);
    s.append(x.slip);
    s.append(x.dt);
    filament::save(x.U, s);
    filament::save(x.forces, s);
    s.append(x.power);
    filament::save(vectorField({x.line.clamp(0), x.line.clamp(1), x.start}), s);
    return scalarList(std::move(s));
}

Foam::point Foam::filamentGroup::centreOf(const scalarList& state,
                                          const label number,
                                          const dictionary& source) const
{
    const label N = properties_.segments;
    const label all = filament::stateSize(N) + 12 +
                      3 * (points_.size() + (twoWay() ? markersEach() : 0));
    if (state.size() != all)
    {
        waitForMaster();
        FatalIOErrorInFunction(source)
            << "the saved state of body " << number << " of group " << name()
            << " has " << state.size() << " numbers where " << all
            << " belong to its segments and coupling: was one of the entries "
            << "segments, coupling, thicknessCouple, kernel or the size of the "
            << "cells changed?" << exit(FatalIOError);
    }
    return average(filament::positionsOf(state.cdata(), N));
}

void Foam::filamentGroup::restore(body& x, const label number,
                                  const scalarList& state,
                                  const dictionary& source) const
{
    centreOf(state, number, source);
    x.line.restore(state.cdata());

    // Held ends stay where they are, unless they are moved
    for (const label end : {0, 1})
    {
        if (base_.valid() && end == movedEnd()) continue;
        x.line.moveEnd(end, x.line.positions()[end * properties_.segments]);
    }
    if (properties_.scheme == filament::IMPLICIT && x.line.lengthError() > 1e-6)
    {
        waitForMaster();
        FatalIOErrorInFunction(source)
            << "the saved state of body " << number
            << " has segments of another length: was the entry length or "
            << "scheme changed?" << exit(FatalIOError);
    }
    const scalar* at =
        state.cdata() + filament::stateSize(properties_.segments);
    x.slip = *at++;
    x.dt = *at++;
    at = filament::restore(at, x.U);
    at = filament::restore(at, x.forces);
    x.power = *at++;
    vectorField held(3);
    filament::restore(at, held);
    x.line.clamp(0, held[0]);
    x.line.clamp(1, held[1]);
    x.start = held[2];
}

void Foam::filamentGroup::checkSize(const dictionary& dict) const
{
    const scalar diameter =
        std::sqrt(4 / constant::mathematical::pi * crossSection_);
    List<rangeCheck> ratios({
        {"diameter", "diameter/length", diameter / properties_.length, 0, 0.5,
         0, 0.5, "the theory is that of slender bodies"},
    });
    const scalar L = properties_.length, B = properties_.rigidity;
    if (B > 0 && scene_.flow.rate > 0)
    {
        ratios.append({"bendingRigidity", "mu rate L^4/B",
                       scene_.mu * scene_.flow.rate * pow4(L) / B, 0, GREAT, 0,
                       1e9,
                       "look whether the units of bendingRigidity, of the "
                       "fluid and of the mesh fit together"});
    }
    if (twoWay())
    {
        ratios.append(
            {"diameter",
             "diameter/(diameter that the fluid feels, " +
                 Foam::name(effectiveDiameter_ / h_) + " h)",
             diameter / effectiveDiameter_, 0, 3, 0.5, 1.5,
             diameter > effectiveDiameter_
                 ? "the drag is that of a thinner fibre: use larger cells"
                 : "the drag is that of a thicker fibre, only mass and weight "
                   "are those of the diameter: use cells of " +
                       Foam::name(diameter * h_ / effectiveDiameter_) +
                       ", or coupling oneWay, where drag is that of the "
                       "diameter"});
    }
    checkRanges(dict, ratios);
}

Foam::scalar Foam::filamentGroup::fastest() const
{
    scalar speed = 0;
    for (const body& x : bodies_)
    {
        speed = max(speed, max(mag(x.line.velocities())));
    }
    return speed;
}

void Foam::filamentGroup::recordSlip(const vector* U)
{
    for (body& x : bodies_)
    {
        x.slip = 0;
        forAll(points_, k)
        {
            x.slip = max(x.slip, mag(points_[k](x.line.velocities()) - U[k]));
            largestSpeed_ = max(largestSpeed_, mag(U[k]));
        }
        x.power = 0;
        forAll(x.forces, k)
        {
            x.power += x.forces[k] & U[k];
        }
        U += markersEach();
    }
    if (steps_ >= 10 && !slipped_) checkSlip();
}

void Foam::filamentGroup::checkSlip()
{
    reduce(largestSpeed_, maxOp<scalar>());
    label worst = -1;
    scalar most = max(0.25 * largestSpeed_, 0.05 * h_ / lastDeltaT_);
    forAll(mine(), i)
    {
        if (bodies_[i].slip <= most) continue;
        most = bodies_[i].slip;
        worst = i;
    }
    string where;
    if (worst >= 0)
    {
        OStringStream os;
        os.precision(4);
        os << nameOfBody(mine()[worst]).c_str() << " at " << centre(worst)
           << " slips by " << most << " m/s, where the fluid at its group has "
           << "moved at up to " << largestSpeed_ << " m/s, at time "
           << lastTime_;
        where = os.str();
    }
    where = firstOf(where);
    if (where.empty()) return;
    slipped_ = true;
    if (Pstream::master())
    {
        WarningInFunction
            << where.c_str() << nl
            << "    Its force is not that of a fibre in this flow:"
            << " reduce deltaT" << endl;
    }
}
