// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyStress.H"
#include "lastStep.H"
#include "sumOverRanks.H"
#include "Time.H"

namespace
{
using namespace Foam;

//- visit(group) of the groups whose forces the fluid feels
template<class Visit>
void actingGroups(const bodySystem& system, Visit visit)
{
    forAll(system.groups, g)
    {
        if (system.groups[g].twoWay()) visit(g);
    }
}
} // namespace

Foam::scalar Foam::bodyStress::excessViscosity(const label g) const
{
    return system_.contrast ? system_.excessViscosity(g) : 0;
}

bool Foam::bodyStress::hasFilms() const
{
    return system_.films ||
           (system_.interactions && system_.interactions->resists());
}

Foam::wordList Foam::bodyStress::names(wordList taken) const
{
    DynamicList<word> all;
    taken.append(wordList({"contacts", "wallContacts", "films", "netForces"}));
    actingGroups(system_,
                 [&](const label g)
                 {
                     const bodyGroup& group = system_.groups[g];
                     word name(group.name());
                     while (taken.found(name) || all.found(name))
                     {
                         name += "Group";
                     }
                     all.append(name);
                     if (group.report().nCoupleMarkers())
                     {
                         all.append(name + "Couple");
                     }
                     if (excessViscosity(g) != 0) all.append(name + "Viscosity");
                 });
    if (system_.interactions)
    {
        all.append("contacts");
        all.append("wallContacts");
    }
    if (hasFilms()) all.append("films");
    all.append("netForces");
    return wordList(std::move(all));
}

void Foam::bodyStress::addForces(const label g, tensor& own, tensor& couple,
                                 tensor& net) const
{
    const bodyGroup& group = system_.groups[g];
    const Time& time = system_.mesh.time();
    const uniformGrid& grid = system_.grid;
    vectorField X(group.nMarkers()), F(group.nMarkers());
    group.loads(X.data(), F.data(),
                time.value() - 0.5 * lastStep::subStep(time));
    const point middle(grid.origin() + 0.5 * grid.length());
    const label n = group.mine().size(), each = n ? X.size() / n : 0,
                nForces = each - group.report().nCoupleMarkers();
    for (label i = 0; i < n; ++i)
    {
        const point centre(group.centre(i));
        vector sum(Zero);
        for (label k = i * each; k < (i + 1) * each; ++k)
        {
            sum += F[k];
            (k - i * each < nForces ? own : couple) += F[k] * (X[k] - centre);
        }
        if (system_.interactions)
        {
            sum -= system_.interactions->forceOn(g, group.mine()[i]);
        }
        if (system_.films) sum -= system_.films->forceOn(g, i);
        vector arm(centre - middle);
        for (direction d = 0; d < 3; ++d)
        {
            if (grid.periodic(d)) arm[d] = 0;
        }
        net += sum * arm;
    }
}

Foam::tensor Foam::bodyStress::viscousMoment(const label g) const
{
    const bodyGroup& group = system_.groups[g];
    tensor moment(Zero);
    forAll(group.mine(), i)
    {
        // Velocities and areas in the middle of the step
        const bodyPoints p(group.points(i));
        moment += sum(p.velocities * p.areas);
    }
    return moment + moment.T();
}

Foam::tensorField Foam::bodyStress::parts() const
{
    const scalar perVolume = 1 / system_.grid.volume();
    DynamicList<tensor> all;
    tensor net(Zero);
    actingGroups(system_,
                 [&](const label g)
                 {
                     tensor own(Zero), couple(Zero);
                     addForces(g, own, couple, net);
                     all.append(-perVolume * own);
                     if (system_.groups[g].report().nCoupleMarkers())
                     {
                         all.append(-perVolume * couple);
                     }
                     if (excessViscosity(g) != 0)
                     {
                         all.append(perVolume * excessViscosity(g) * system_.rho *
                                    system_.nu->value() * viscousMoment(g));
                     }
                 });
    if (system_.interactions)
    {
        all.append(-perVolume * system_.interactions->contactMoment());
        all.append(-perVolume * system_.interactions->wallMoment());
    }
    if (hasFilms())
    {
        tensor films(Zero);
        if (system_.interactions) films += system_.interactions->filmMoment();
        if (system_.films) films += system_.films->moment();
        all.append(-perVolume * films);
    }
    all.append(-perVolume * net);
    tensorField sums(std::move(all));
    sumOverRanks(sums);
    return sums;
}
