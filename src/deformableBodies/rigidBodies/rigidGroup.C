// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The rigid bodies of a group: coming and going, geometry

#include "rigidGroup.H"
#include "dictionaryChecks.H"
#include "rigidReport.H"
#include "turnTo.H"

Foam::rigidGroup::~rigidGroup() {}

const Foam::bodyReport& Foam::rigidGroup::report() const
{
    return *report_;
}

// Rotation at the start from the axes of the shape to those of the box
Foam::quaternion Foam::rigidGroup::turnOf(const label number) const
{
    return quaternion(turnTo(
        start_.directions.empty() ? shape_.axis() : start_.directions[number]));
}

Foam::bodyPoints Foam::rigidGroup::pointsOf(const label number,
                                            const point& centre,
                                            const tensor& R, const vector& V,
                                            const vector& W) const
{
    bodyPoints p{name(),
                 number,
                 vectorField(R & surface_),
                 vectorField(),
                 vectorField(R & areas_),
                 scalarField(),
                 0,
                 GREAT,
                 shape_.volume()};
    p.velocities = V + (W ^ p.positions);
    p.positions += centre;
    p.densityRatio = densityRatio_;
    return p;
}

Foam::bodyPoints Foam::rigidGroup::points(const label i) const
{
    if (i < 0) return pointsOf(-1, Zero, turnTo(shape_.axis()), Zero, Zero);
    const body& x = bodies_[i];
    return pointsOf(mine()[i], x.centre, x.turn.R(), x.velocity,
                    x.angularVelocity);
}

void Foam::rigidGroup::contactPoints(const label i, vector* X, vector* V) const
{
    const body& x = bodies_[i];
    const tensor R(x.turn.R());
    forAll(surface_, k)
    {
        const vector r(R & surface_[k]);
        X[k] = x.centre + r;
        V[k] = x.velocity + (x.angularVelocity ^ r);
    }
}

Foam::point Foam::rigidGroup::initialCentre(const label number) const
{
    return start_.positions[number];
}

Foam::bodyPoints Foam::rigidGroup::initialPoints(const label number) const
{
    return pointsOf(number, start_.positions[number], turnOf(number).R(), Zero,
                    Zero);
}

Foam::boundBox Foam::rigidGroup::bounds(const label i, const bool) const
{
    const body& x = bodies_[i];
    const tensor R(x.turn.R());
    vector reach;
    for (direction d = 0; d < 3; ++d)
    {
        reach[d] = mag(
            cmptMultiply(vector(R(d, 0), R(d, 1), R(d, 2)), shape_.semiAxes()));
    }
    return boundBox(x.centre - reach, x.centre + reach);
}

void Foam::rigidGroup::insertBody(const label i, const label number,
                                  const scalarList& state,
                                  const dictionary& source)
{
    const label n = markers_.size();
    body x;
    x.X.setSize(n, start_.positions[number]);
    x.forces.setSize(n, Zero);
    x.U.setSize(n, Zero);
    x.centre = start_.positions[number];
    x.turn = turnOf(number);
    if (state.size()) restore(x, number, state, source);
    bodies_.insert(bodies_.begin() + i, x);
}

void Foam::rigidGroup::eraseBody(const label i)
{
    bodies_.erase(bodies_.begin() + i);
}

Foam::scalarList Foam::rigidGroup::state(const label i) const
{
    const body& x = bodies_[i];
    DynamicList<scalar> s;
    const auto save = [&](const vector& v) { s.append({v.x(), v.y(), v.z()}); };
    save(x.centre);
    s.append(x.turn.w());
    save(x.turn.v());
    save(x.velocity);
    save(x.angularVelocity);
    save(x.innerAngularMomentum);
    s.append(x.slip);
    s.append(x.dt);
    s.append(x.nUnsteady);
    for (const vectorField* field : {&x.forces, &x.U})
    {
        for (const vector& v : *field)
        {
            save(v);
        }
    }
    save(x.film);
    return scalarList(std::move(s));
}

Foam::point Foam::rigidGroup::centreOf(const scalarList& state,
                                       const label number,
                                       const dictionary& source) const
{
    if (state.size() < 22 || (state.size() - 22) % 6 != 0)
    {
        waitForMaster();
        FatalIOErrorInFunction(source)
            << "the saved state of body " << number << " of group " << name()
            << " has " << state.size() << " numbers where 22 and 6 for each "
            << "marker belong" << exit(FatalIOError);
    }
    return point(state[0], state[1], state[2]);
}

void Foam::rigidGroup::restore(body& x, const label number,
                               const scalarList& state,
                               const dictionary& source) const
{
    x.centre = centreOf(state, number, source);
    const scalar* at = state.cdata() + 3;
    const auto read = [&]()
    {
        at += 3;
        return vector(at[-3], at[-2], at[-1]);
    };
    x.turn.w() = *at++;
    x.turn.v() = read();
    x.velocity = read();
    x.angularVelocity = read();
    x.innerAngularMomentum = read();
    x.slip = *at++;
    x.dt = *at++;
    x.nUnsteady = label(*at++);
    x.starts = x.dt == 0;
    const label before = (state.size() - 22) / 6;
    if (before != markers_.size())
    {
        if (number == 0)
        {
            Info << "Group " << name() << ": " << markers_.size()
                 << " markers a body, before " << before
                 << ": their forces start from zero" << endl;
        }
        x.dt = -1; // no forces of a last step
        x.forces = Zero;
        x.U = Zero;
        return;
    }
    for (vectorField* field : {&x.forces, &x.U})
    {
        for (vector& v : *field)
        {
            v = read();
        }
    }
    x.film = read();
}
