// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "energySpectrum.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "functionTimes.H"
#include "fvOptions.H"
#include "lastStep.H"
#include "lowModeForcing.H"
#include "resultFile.H"
#include "sumOverRanks.H"

namespace Foam
{
namespace functionObjects
{
defineTypeNameAndDebug(energySpectrum, 0);
addToRunTimeSelectionTable(functionObject, energySpectrum, dictionary);
} // namespace functionObjects
} // namespace Foam

namespace
{
using namespace Foam;

//- Modes of one direction with n cells of size h [m]
struct modesOfLine
{
    //- Squares of the wave number, and of that of the second difference [1/m^2]
    scalarField k2, modified2;

    //- Weight of the square of a mode in the mean, with its conjugate if not all are there
    scalarField weight;

    modesOfLine(const label n, const scalar h, const bool all = false)
        : k2(n),
          modified2(n),
          weight(n)
    {
        for (label i = 0; i < n; ++i)
        {
            const scalar m = min(i, n - i);
            const scalar angle = constant::mathematical::pi * m / n;
            k2[i] = sqr(2 * angle / h);
            modified2[i] = sqr(2 * Foam::sin(angle) / h);
            weight[i] = (all || m == 0 || 2 * m == n ? 1.0 : 2.0) / n;
        }
    }
};
} // namespace

Foam::functionObjects::energySpectrum::energySpectrum(const word& name,
                                                      const Time& time,
                                                      const dictionary& dict)
    : fvMeshFunctionObject(name, time, dict),
      writeFile(mesh_, name),
      grid_(uniformGrid::New(mesh_))
{
    read(dict);
    if (Pstream::master())
    {
        table_ = newResultFile(time, fileName(mesh_.dbDir()) / name,
                               "turbulence.dat");
        table_().precision(10);
        table_()
            << "# time kineticEnergy dissipation rms taylorLength ReLambda "
            << "integralLength kolmogorovLength turnoverTime skewness "
            << "forcingPower\n# [s] [m^2/s^2] [m^2/s^3] [m/s] [m] [1] [m] [m] "
            << "[s] [1] [m^2/s^3]" << endl;
    }
}

bool Foam::functionObjects::energySpectrum::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    writeFile::read(dict);
    checkFunctionEntries(dict, {"phi", "nu"});
    grid_.requirePeriodic(dict, typeName);
    phiName_ = dict.getOrDefault<word>("phi", "phi");
    const IOdictionary transport(
        IOobject("transportProperties", mesh_.time().constant(), mesh_,
                 IOobject::READ_IF_PRESENT, IOobject::NO_WRITE, false));
    nu_ = readPositive(dict.found("nu") ? dict : transport, "nu", dimViscosity);
    transform_.reset(new planeTransform(grid_, sidesOf(grid_), grid_.index()));
    dk_ = constant::mathematical::twoPi / cmptMax(grid_.length());
    return true;
}

void Foam::functionObjects::energySpectrum::velocity(staggeredField& u) const
{
    grid_.toStaggered(lookupObject<surfaceScalarField>(phiName_), u);
}

Foam::scalar Foam::functionObjects::energySpectrum::forcingPower() const
{
    // The phases of the forcing are known to the run only
    if (postProcess) return std::nan("");
    const auto* options = mesh_.cfindObject<fv::options>(fv::options::typeName);
    if (!options) return 0;
    staggeredField f(grid_.box()), u(grid_.box());
    bool forced = false;
    for (const fv::option& o :
         static_cast<const PtrList<fv::option>&>(*options))
    {
        const auto* forcing = isA<fv::lowModeForcing>(o);
        if (!forcing || !const_cast<fv::option&>(o).isActive()) continue;
        forcing->addPresent(f);
        forced = true;
    }
    if (!forced) return 0;
    velocity(u);
    const scalar half = 0.5 * lastStep::subStep(time_);
    scalar power = 0;
    for (direction d = 0; d < 3; ++d)
    {
        for (const label k : grid_.index())
        {
            power += f[d][k] * (u[d][k] - half * f[d][k]);
        }
    }
    reduce(power, sumOp<scalar>());
    return power / scalar(mesh_.globalData().nTotalCells());
}

void Foam::functionObjects::energySpectrum::sumShells()
{
    staggeredField u(grid_.box());
    velocity(u);

    planeTransform& t = *transform_;
    const planeTransform::rows rows(t.dealtTo(Pstream::myProcNo()));
    const vector& h = grid_.h();
    const scalar nAll = scalar(t.nFast) * t.nSlow * t.nThird;
    const modesOfLine fast(t.nFast, h[t.fast], true), slow(t.nSlow, h[t.slow]),
        third(t.nThird, h[t.third]);

    const vector largest(1 / h.x(), 1 / h.y(), 1 / h.z());
    energy_.setSize(
        label(constant::mathematical::pi * mag(largest) / dk_ + 0.5) + 1);
    energy_ = 0;
    for (direction d = 0; d < 3; ++d)
    {
        along_[d].setSize(grid_.n()[d] / 2 + 1);
        along_[d] = Zero;
    }
    const auto add = [&](const direction d, const label mode,
                         const direction component, const scalar e)
    { along_[d][min(mode, grid_.n()[d] - mode)][component] += e; };
    scalar total = 0, gradient2 = 0;
    for (direction d = 0; d < 3; ++d)
    {
        t.forward(u[d].cdata());
        t.transformThird();
        for (label k = 0; k < t.nThird; ++k)
        {
            const double* row = t.thirdMode(k);
            for (label j = rows.first; j < rows.first + rows.n; ++j)
            {
                const scalar w = 0.5 * third.weight[k] * slow.weight[j] / nAll;
                for (label i = 0; i < t.nFast; ++i)
                {
                    const scalar e = w * fast.weight[i] *
                                     (sqr(row[2 * i]) + sqr(row[2 * i + 1]));
                    const scalar k2 = third.k2[k] + slow.k2[j] + fast.k2[i];
                    total += e;
                    energy_[label(Foam::sqrt(k2) / dk_ + 0.5)] += e;
                    gradient2 += 2 * e *
                                 (third.modified2[k] + slow.modified2[j] +
                                  fast.modified2[i]);
                    add(t.fast, i, d, e);
                    add(t.slow, j, d, e);
                    add(t.third, k, d, e);
                }
                row += t.rowLength;
            }
        }
    }
    sumOverRanks(energy_);
    for (direction d = 0; d < 3; ++d)
    {
        sumOverRanks(along_[d]);
    }
    gradient2_ = returnReduce(gradient2, sumOp<scalar>());
    // Energy of the mean flow is left out
    total_ = returnReduce(total, sumOp<scalar>()) - energy_[0];
}

Foam::scalar Foam::functionObjects::energySpectrum::skewness() const
{
    const auto& phi = lookupObject<surfaceScalarField>(phiName_);
    // du/dx, dv/dy, dw/dz of each cell, times its volume
    vectorField gradient(mesh_.nCells(), Zero);
    const auto component = [](const vector& area)
    {
        return direction(mag(area.x()) > 0.5 * mag(area)   ? 0
                         : mag(area.y()) > 0.5 * mag(area) ? 1
                                                           : 2);
    };
    forAll(mesh_.owner(), face)
    {
        const direction d = component(mesh_.Sf()[face]);
        gradient[mesh_.owner()[face]][d] += phi[face];
        gradient[mesh_.neighbour()[face]][d] -= phi[face];
    }
    forAll(phi.boundaryField(), patch)
    {
        const fvsPatchScalarField& flux = phi.boundaryField()[patch];
        forAll(flux, i)
        {
            const direction d = component(mesh_.Sf().boundaryField()[patch][i]);
            gradient[mesh_.boundary()[patch].faceCells()[i]][d] += flux[i];
        }
    }
    scalar sum2 = 0, sum3 = 0;
    for (const vector& g : gradient)
    {
        for (direction d = 0; d < 3; ++d)
        {
            sum2 += sqr(g[d]);
            sum3 += pow3(g[d]);
        }
    }
    reduce(sum2, sumOp<scalar>());
    reduce(sum3, sumOp<scalar>());
    const scalar n = 3 * scalar(mesh_.globalData().nTotalCells());
    return sum3 / n / (Foam::pow(sum2 / n, 1.5) + VSMALL);
}

bool Foam::functionObjects::energySpectrum::execute()
{
    lastIndex_ = time_.timeIndex();
    sumShells();
    const scalar skewed = skewness(), power = forcingPower();
    if (!Pstream::master()) return true;

    const scalar dissipation = nu_ * gradient2_;
    const scalar rms = Foam::sqrt(2 * total_ / 3);
    scalar inverseK = 0;
    for (label s = 1; s < energy_.size(); ++s)
    {
        inverseK += energy_[s] / (s * dk_);
    }
    const scalar lambda = rms * Foam::sqrt(15 * nu_ / (dissipation + VSMALL));
    const scalar integral =
        0.75 * constant::mathematical::pi * inverseK / (total_ + VSMALL);
    table_() << time_.value() << tab << total_ << tab << dissipation << tab
             << rms << tab << lambda << tab << rms * lambda / nu_ << tab
             << integral << tab
             << Foam::pow025(pow3(nu_) / (dissipation + VSMALL)) << tab
             << integral / (rms + VSMALL) << tab << skewed << tab << power
             << endl;
    return true;
}

Foam::FixedList<Foam::scalar, 2>
Foam::functionObjects::energySpectrum::structureFunctions(const scalar r) const
{
    scalar longitudinal = 0, transverse = 0;
    for (direction d = 0; d < 3; ++d)
    {
        forAll(along_[d], m)
        {
            const scalar apart = 1 - Foam::cos(constant::mathematical::twoPi *
                                               m * r / grid_.length()[d]);
            const vector& e = along_[d][m];
            longitudinal += 4 * apart * e[d] / 3;
            transverse += 4 * apart * (cmptSum(e) - e[d]) / 6;
        }
    }
    return {longitudinal, transverse};
}

bool Foam::functionObjects::energySpectrum::write()
{
    if (lastIndex_ != time_.timeIndex()) execute();
    if (!Pstream::master()) return true;

    const fileName dir(baseFileDir() / name() / time_.timeName());
    mkDir(dir);
    OFstream os(dir / "spectrum.dat");
    os << "# k E" << nl << "# [1/m] [m^3/s^2]" << endl;
    label last = energy_.size() - 1;
    while (last > 1 && energy_[last] == 0)
        --last;
    for (label s = 1; s <= last; ++s)
    {
        os << s * dk_ << ' ' << energy_[s] / dk_ << endl;
    }

    OFstream increments(dir / "structureFunctions.dat");
    increments << "# r longitudinal transverse" << nl
               << "# [m] [m^2/s^2] [m^2/s^2]" << endl;
    const scalar h = cmptMin(grid_.h());
    for (label i = 1; 2 * i * h <= cmptMin(grid_.length()) * (1 + SMALL); ++i)
    {
        const FixedList<scalar, 2> S(structureFunctions(i * h));
        increments << i * h << ' ' << S[0] << ' ' << S[1] << endl;
    }
    return true;
}
