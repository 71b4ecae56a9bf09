// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bulkStress.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "functionTimes.H"
#include "lastStep.H"
#include "mathematicalConstants.H"

Foam::string Foam::bulkStress::obstacle(const bodySystem& system,
                                        const shearSides& sides)
{
    if (!system.twoWay()) return "no bodies act on the fluid";
    for (const bodyGroup& group : system.groups)
    {
        if (group.twoWay() || !system.interactions ||
            !interactionScene::takesPart(group))
            continue;
        return "the fluid does not feel contacts of group " + group.name();
    }
    if (!system.nu->isUniform())
    {
        return "the stress of the fluid is not that of one viscosity";
    }
    if (sides.rate == 0 && sides.steady)
    {
        return "no sides of the box move against each other";
    }
    if (sides.oblique > 1e-6)
        return "the sides do not move along an edge of the box";
    for (direction d = 0; d < 3; ++d)
    {
        if (d != sides.gradient && !system.grid.periodic(d))
        {
            return "the box is not periodic along the sides that move";
        }
    }
    return string::null;
}

std::unique_ptr<Foam::bulkStress>
Foam::bulkStress::New(const dictionary& dict, const bodySystem& system,
                      const flow& flow, const bool implicit)
{
    std::unique_ptr<bulkStress> none;
    const bool given = dict.found("bulkStress");
    if (system.empty() || (system.withoutFluid && !given)) return none;
    const string why(system.withoutFluid
                         ? string("there is no fluid")
                         : obstacle(system, shearSides::of(system.mesh)));
    const bool isDict = dict.isDict("bulkStress");
    if (given && !isDict && !Switch(dict.get<word>("bulkStress"), true).valid())
    {
        refuse(dict, "bulkStress", valueOf(*dict.findEntry("bulkStress")),
               "on, off or a dictionary");
    }
    const bool wanted =
        isDict || !given || Switch(dict.get<word>("bulkStress"));
    if (wanted && given && !why.empty())
    {
        refuse(dict, "bulkStress", valueOf(*dict.findEntry("bulkStress")),
               "off, or none at all, as " + why);
    }
    const bool made = wanted && why.empty();
    system.effects.declare("bulkStress", made,
                           made      ? "postProcessing/bulkStress"
                           : !wanted ? string("bulkStress off")
                                     : why);
    if (!made) return none;
    return std::unique_ptr<bulkStress>(
        new bulkStress(isDict ? dict.subDict("bulkStress") : dictionary(),
                       system, flow, implicit));
}

Foam::bulkStress::bulkStress(const dictionary& dict, const bodySystem& system,
                             const flow& flow, const bool implicit)
    : system_(system),
      flow_(flow),
      bodies_(system),
      parts_(bodies_.names(fluidColumns())),
      implicit_(implicit),
      interval_(dict.getOrDefault<label>("interval", 10)),
      startAverage_(dict.getOrDefault<scalar>("startAverage", -GREAT)),
      lastTime_(system.mesh.time().startTime().value()),
      means_(columns().size()),
      state_("bulkStress", "uniform", system.mesh,
             [this](Ostream& os)
             {
                 // In other solvers functions execute after the fields are written
                 if (!system_.solverBalances) addLine();
                 writeState(os);
             })
{
    checkEntries(dict);
    const shearSides sides(shearSides::of(system.mesh));
    const auto saved = stateOfTime(system.mesh, "bulkStress");
    const auto otherSides = [&]()
    {
        rate_ = saved->getOrDefault<scalar>("rate", 0);
        const labelList turned(saved->getOrDefault<labelList>(
            "directions", {sides.flow, sides.gradient}));

        // Boundary values are written with writePrecision digits
        return sides.steady && rate_ != 0 &&
               (mag(sides.rate - rate_) > 1e-4 * mag(rate_) ||
                turned != labelList({sides.flow, sides.gradient}));
    };
    if (saved && otherSides())
    {
        Info << "Bulk stress: means start afresh, as the sides do not move as "
             << "in the state" << nl;
    }
    else if (saved && (system.startsAfresh() ||
                       saved->get<wordList>("columns") != columns()))
    {
        Info << "Bulk stress: means start afresh, as the bodies or their "
             << "effects are not those of the state" << nl;
    }
    else if (saved)
    {
        means_.restore(saved->get<scalarList>("sums"));
        lastTime_ = saved->get<scalar>("lastTime");
        largestRate_ = saved->getOrDefault<scalar>("largestRate", 0);
        const labelList directions(
            saved->getOrDefault<labelList>("directions", labelList()));
        if (directions.size() == 2)
        {
            flowDirection_ = directions[0];
            gradient_ = directions[1];
        }
        else
        {
            largestRate_ = 0;
        }
    }
    isShear(sides);
    const scalar H = system.grid.length()[sides.gradient];
    settling_ = sqr(0.5 * H / constant::mathematical::pi) / system.nu->value();
    Info << "Bulk stress: the flow takes " << Foam::name(settling_)
         << " s to settle, H^2/(4 pi^2 nu)"
         << (startAverage_ > -GREAT ? "" : "; means begin after that") << nl
         << endl;
}

void Foam::bulkStress::checkEntries(const dictionary& dict) const
{
    const wordList own({"interval", "startAverage"});
    if (system_.solverBalances)
        Foam::checkEntries(dict, own);
    else
        checkFunctionEntries(dict, own);
    if (interval_ < 1)
    {
        refuse(dict, "interval", Foam::name(interval_), "1 and more");
    }
    const scalar end = system_.mesh.time().endTime().value();
    if (startAverage_ >= end)
    {
        refuse(dict, "startAverage", Foam::name(startAverage_),
               "times before endTime, " + Foam::name(end));
    }
}

Foam::bulkStress::fluidStress
Foam::bulkStress::measure(const shearSides& sides) const
{
    const uniformGrid& grid = system_.grid;
    const direction f = sides.flow, g = sides.gradient, v = 3 - f - g;
    const scalar h = grid.h()[g], rho = system_.rho,
                 mu = rho * system_.nu->value();
    const layerMeans means(flow_(f, g));
    const label n = means.u.size();
    fluidStress s{2 * mu / h * (means.u[0][f] - sides.lower[f]),
                  2 * mu / h * (sides.upper[f] - means.u[n - 1][f]), Zero,
                  -rho * average(means.product), 0};
    for (label j = 0; j < n; ++j)
    {
        const vector& u = means.u[j];
        const vector fluctuation(means.squares[j] - cmptMultiply(u, u));
        s.normal -=
            rho / n * vector(fluctuation[f], fluctuation[g], fluctuation[v]);
        s.moment += rho / n * (j + 0.5 - 0.5 * n) * h * u[f];
    }
    return s;
}

bool Foam::bulkStress::isShear(const shearSides& sides)
{
    if (sides.oblique > 1e-6) return false;
    if (largestRate_ == 0 && sides.rate != 0)
    {
        flowDirection_ = sides.flow;
        gradient_ = sides.gradient;
    }
    largestRate_ = max(largestRate_, mag(sides.rate));
    return sides.flow == flowDirection_ && sides.gradient == gradient_ &&
           mag(sides.rate) > 0.01 * largestRate_;
}

void Foam::bulkStress::begin()
{
    const label step = stepIndex(system_.mesh.time());
    if (!due(step) || begun_ == step) return;
    const auto timing(system_.effects.time("bulkStress"));
    const shearSides sides(shearSides::of(system_.mesh));
    if (!isShear(sides))
    {
        // Sides that rest: the next line does not stand for this time
        lastTime_ = system_.mesh.time().value();
        return;
    }
    begun_ = step;
    beginTime_ =
        system_.mesh.time().value() - system_.mesh.time().deltaTValue();
    before_ = lastLine_ == step - 1 ? after_ : measure(sides);
}

void Foam::bulkStress::addLine()
{
    const Time& time = system_.mesh.time();
    const label step = stepIndex(time);
    if (begun_ == step && lastLine_ != step)
    {
        const auto timing(system_.effects.time("bulkStress"));
        const shearSides sides(shearSides::of(system_.mesh));
        if (!isShear(sides)) return;
        lastLine_ = step;
        rate_ = sides.rate;
        after_ = measure(sides);
        const tensorField parts(bodies_.parts());
        const scalarList values(line(sides, parts));
        means_.add(time.value(), time.value() - lastTime_, values);
        lastTime_ = time.value();
        append(file_, "bulkStress.dat", columns(), values);
        const tensorField relative(
            parts / (system_.rho * system_.nu->value() * mag(sides.rate)));
        append(partsFile_, "parts.dat", partColumns(),
               UList<scalar>(const_cast<scalar*>(relative.cdata()->cdata()),
                             9 * relative.size()));
    }
}

void Foam::bulkStress::end()
{
    addLine();
    const Time& time = system_.mesh.time();
    if (lastLine_ != lastAverages_ && (time.writeTime() || isLastStep(time)))
    {
        lastAverages_ = lastLine_;
        writeAverages();
    }
}

Foam::scalarList Foam::bulkStress::line(const shearSides& sides,
                                        const tensorField& parts) const
{
    const direction f = sides.flow, g = sides.gradient, v = 3 - f - g;
    const scalar unit = system_.rho * system_.nu->value() * sides.rate;
    const scalar dt = system_.mesh.time().value() - beginTime_;
    const scalar last = implicit_ ? 1 : 0.5, first = 1 - last;
    const auto mean = [&](const scalar fluidStress::*term)
    { return (first * before_.*term + last * after_.*term) / unit; };

    tensor all(Zero);
    scalar contactPressure = 0;
    forAll(parts, i)
    {
        all += parts[i];
        if (parts_[i] == "contacts") contactPressure = -tr(parts[i]) / 3;
    }
    const vector normal((first * before_.normal + last * after_.normal +
                         vector(all(f, f), all(g, g), all(v, v))) /
                        mag(unit));
    const scalar lower = mean(&fluidStress::lower),
                 upper = mean(&fluidStress::upper),
                 wall = 0.5 * (lower + upper);
    const scalar bodies = all(f, g) / unit,
                 reynolds = mean(&fluidStress::shear);
    const scalar unsteady = (after_.moment - before_.moment) / dt / unit;

    DynamicList<scalar> values;
    for (const scalar x : {1 + bodies + reynolds, normal[0] - normal[1],
                           normal[1] - normal[2], bodies, reynolds, wall})
    {
        values.append(x);
    }
    for (const tensor& part : parts)
    {
        values.append(part(f, g) / unit);
    }
    for (const scalar x : {unsteady, wall - 1 - bodies - reynolds - unsteady,
                           lower, upper, contactPressure / mag(unit)})
    {
        values.append(x);
    }
    return scalarList(std::move(values));
}
