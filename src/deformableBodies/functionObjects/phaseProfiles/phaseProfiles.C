// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "phaseProfiles.H"
#include "addToRunTimeSelectionTable.H"
#include "boxSides.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "functionTimes.H"
#include "fluidViscosity.H"
#include "layerVolumes.H"

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(phaseProfiles, 0);
addToRunTimeSelectionTable(functionObject, phaseProfiles, dictionary);
} // namespace functionObjects
} // namespace Foam

namespace
{
using namespace Foam;

//- Across the sides that shear the flow, else the first direction with walls, else the first
//  with sides
direction acrossSides(const uniformGrid& grid, const shearSides& shear)
{
    if (shear.rate != 0) return shear.gradient;
    const auto sides = boxSides(grid);
    for (direction d = 0; d < 3; ++d)
    {
        if (sides[d][0].wall || sides[d][1].wall) return d;
    }
    return !grid.periodic(0)                       ? 0
           : grid.periodic(1) && !grid.periodic(2) ? 2
                                                   : 1;
}
} // namespace

Foam::functionObjects::phaseProfiles::phaseProfiles(const word& name,
                                                    const Time& time,
                                                    const dictionary& dict)
    : sampledBodies(name, time, dict, typeName),
      grid_(uniformGrid::New(mesh_))
{
    checkFunctionEntries(dict, {"across", "flow"});
    if (bodies_.empty())
    {
        const IOdictionary transport(
            IOobject("transportProperties", mesh_.time().constant(), mesh_,
                     IOobject::MUST_READ, IOobject::NO_WRITE, false));
        const fluidViscosity nu(mesh_, transport, dictionary::null);
        nu_ = nu.value();
        withStress_ = nu.isUniform();
        perRho_ = !transport.found("rho");
        if (!perRho_) rho_ = readPositive(transport, "rho", dimDensity);
    }
    else
    {
        withStress_ =
            bodies_.system().nu->isUniform() && !bodies_.system().contrast;
    }
    if (!withStress_)
    {
        Info << "functionObject " << name << ": no stress.dat, as the stress "
             << "of the fluid is not that of one viscosity" << nl;
    }
    const shearSides sides(shearSides::of(mesh_));
    g_ = readDirection(dict, "across", acrossSides(grid_, sides));
    f_ = readDirection(dict, "flow",
                       sides.rate != 0 && sides.gradient == g_ ? sides.flow
                       : g_ == 0                               ? 1
                                                               : 0);
    if (f_ == g_)
    {
        refuse(dict, "flow", dict.getOrDefault<word>("flow", "x"),
               "a direction other than across");
    }
    const label n = grid_.n()[g_], groups = bodies_.system().groups.size();
    u_.setSize(n, Zero);
    squares_.setSize(n, Zero);
    for (scalarField* stress : {&viscous_, &reynolds_, &ofBodies_})
    {
        stress->setSize(n + 1, Zero);
    }
    volume_.setSize(groups, scalarField(n, Zero));
    momentum_.setSize(groups, vectorField(n, Zero));
    readState();
    keepState();
}

Foam::direction Foam::functionObjects::phaseProfiles::readDirection(
    const dictionary& dict, const word& name, const direction otherwise) const
{
    const wordList axes({"x", "y", "z"});
    return axes.find(readWord(dict, name, axes, axes[otherwise]));
}

std::vector<Foam::UList<Foam::scalar>>
Foam::functionObjects::phaseProfiles::sums() const
{
    std::vector<UList<scalar>> all;
    const auto append = [&](const auto& field)
    {
        using value = typename std::decay<decltype(field[0])>::type;
        scalar* first =
            reinterpret_cast<scalar*>(const_cast<value*>(field.cdata()));
        all.emplace_back(first,
                         field.size() * label(sizeof(value) / sizeof(scalar)));
    };
    append(u_);
    append(squares_);
    append(viscous_);
    append(reynolds_);
    append(ofBodies_);
    forAll(volume_, g)
    {
        append(volume_[g]);
        append(momentum_[g]);
    }
    return all;
}

void Foam::functionObjects::phaseProfiles::writeState(Ostream& os) const
{
    os << "directions (" << label(f_) << ' ' << label(g_) << ");" << nl
       << "groups " << bodies_.system().groupNames() << ';' << nl << "weight "
       << weight_ << ';' << nl;
    DynamicList<scalar> all;
    for (const UList<scalar>& numbers : sums())
    {
        all.append(numbers);
    }
    writeNumbers(os, "sums", all);
}

void Foam::functionObjects::phaseProfiles::readState()
{
    const auto saved = savedState();
    if (!saved) return;
    const labelList directions({label(f_), label(g_)});
    const wordList groups(bodies_.system().groupNames());
    const scalarList numbers(saved->get<scalarList>("sums"));
    label n = 0, k = 0;
    for (const UList<scalar>& to : sums())
    {
        n += to.size();
    }
    const char* differ =
        saved->getOrDefault<labelList>("directions", labelList()) != directions
            ? "directions"
        : saved->getOrDefault<wordList>("groups", groups) != groups ? "groups"
        : n != numbers.size()                                       ? "layers"
                                                                    : nullptr;
    if (differ)
    {
        Info << "functionObject " << name() << " starts afresh: its " << differ
             << " are not those of the state" << nl;
        return;
    }
    for (UList<scalar> to : sums())
    {
        for (scalar& x : to)
        {
            x = numbers[k++];
        }
    }
    weight_ = saved->get<scalar>("weight");
    last_ = saved->get<scalar>("last");
}

bool Foam::functionObjects::phaseProfiles::execute()
{
    const scalar dt = elapsed();
    if (dt == 0) return true;
    weight_ += dt;
    const label n = grid_.n()[g_];
    const bool none = bodies_.empty();
    const scalar h = grid_.h()[g_],
                 rho = none ? rho_ : bodies_.statistics().rho(),
                 mu = none ? rho_ * nu_ : bodies_.statistics().mu();
    const layerMeans means(bodies_.statistics().layers(f_, g_));
    u_ += dt * means.u;
    squares_ += dt * means.squares;
    const scalarField force(none ? scalarField(n, Zero)
                                 : bodies_.statistics().forces(f_, g_));
    const scalar layer = grid_.volume() / n;
    const bool walls = !grid_.periodic(g_);
    const sideVelocities sides(mesh_.lookupObject<volVectorField>("U"), grid_,
                               g_);
    scalar bodies = 0;
    for (label j = 0; j <= n; ++j)
    {
        const scalar below = j > 0   ? means.u[j - 1][f_]
                             : walls ? sides.lower[f_]
                                     : means.u[n - 1][f_];
        const scalar above = j < n   ? means.u[j][f_]
                             : walls ? sides.upper[f_]
                                     : means.u[0][f_];
        const bool side = walls && (j == 0 || j == n);
        viscous_[j] += dt * mu * (above - below) / (side ? 0.5 * h : h);
        if (!side) reynolds_[j] -= dt * rho * means.product[j % n];
        ofBodies_[j] += dt * bodies;
        if (j < n) bodies += force[j] * h / layer;
    }
    forAll(bodies_.system().groups, g)
    {
        scalarField volume;
        vectorField momentum;
        layerVolumes(bodies_.system().groups[g], grid_, g_, volume, momentum);
        volume_[g] += dt * volume / layer;
        momentum_[g] += dt * momentum / layer;
    }
    return !isLast() || write();
}

bool Foam::functionObjects::phaseProfiles::write()
{
    if (postProcess || !Pstream::master() || weight_ == 0) return true;
    const fileName dir(folder());
    writeProfiles(OFstream(dir / "profiles.dat")());
    if (withStress_) writeStress(OFstream(dir / "stress.dat")());
    return true;
}

void Foam::functionObjects::phaseProfiles::writeFreeLayers(Ostream& os) const
{
    scalarField all(u_.size(), Zero);
    forAll(volume_, g)
    {
        if (bodies_.system().groups[g].host() < 0) all += volume_[g];
    }
    const scalar half = 0.5 * average(all);
    const auto thickness = [&](const bool upper)
    {
        const label n = all.size();
        const auto at = [&](const label j)
        { return all[upper ? n - 1 - j : j]; };
        label j = 0;
        while (j < n && at(j) < half)
            ++j;
        if (j == 0 || j == n) return j * grid_.h()[g_];
        return (j - 0.5 + (half - at(j - 1)) / (at(j) - at(j - 1))) *
               grid_.h()[g_];
    };
    os << "# free layers: " << thickness(false) << " and " << thickness(true)
       << " m" << nl;
}

void Foam::functionObjects::phaseProfiles::writeProfiles(Ostream& os) const
{
    os.precision(10);
    os << "# " << vector::componentNames[g_]
       << " velocityX velocityY velocityZ rmsX rmsY rmsZ";
    for (const bodyGroup& group : bodies_.system().groups)
    {
        os << ' ' << group.name() << ' ' << group.name() << "VelocityX "
           << group.name() << "VelocityY " << group.name() << "VelocityZ";
    }
    os << nl << "# [m] [m/s] [m/s] [m/s] [m/s] [m/s] [m/s]";
    forAll(volume_, g)
        os << " [1] [m/s] [m/s] [m/s]";
    os << nl;
    if (!bodies_.empty()) writeFreeLayers(os);
    forAll(u_, j)
    {
        const vector u(u_[j] / weight_), squares(squares_[j] / weight_);
        os << grid_.origin()[g_] + (j + 0.5) * grid_.h()[g_];
        os << ' ' << u.x() << ' ' << u.y() << ' ' << u.z();
        for (direction d = 0; d < 3; ++d)
        {
            os << ' ' << Foam::sqrt(max(squares[d] - sqr(u[d]), scalar(0)));
        }
        forAll(volume_, g)
        {
            const vector v(momentum_[g][j] / max(volume_[g][j], VSMALL));
            os << ' ' << volume_[g][j] / weight_ << ' ' << v.x() << ' ' << v.y()
               << ' ' << v.z();
        }
        os << nl;
    }
}

void Foam::functionObjects::phaseProfiles::writeStress(Ostream& os) const
{
    os.precision(10);
    const char* unit = perRho_ ? " [m^2/s^2]" : " [Pa]";
    os << "# " << vector::componentNames[g_] << " viscous reynolds bodies sum"
       << nl << "# [m]" << unit << unit << unit << unit << nl;
    forAll(viscous_, j)
    {
        const scalar viscous = viscous_[j] / weight_,
                     reynolds = reynolds_[j] / weight_,
                     bodies = ofBodies_[j] / weight_;
        os << grid_.origin()[g_] + j * grid_.h()[g_] << ' ' << viscous << ' '
           << reynolds << ' ' << bodies << ' ' << viscous + reynolds + bodies
           << nl;
    }
}
