// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "EswaranPopeForcing.H"
#include "addToRunTimeSelectionTable.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "stateObject.H"

namespace Foam
{
namespace fv
{
defineTypeNameAndDebug(EswaranPopeForcing, 0);
addToRunTimeSelectionTable(option, EswaranPopeForcing, dictionary);
} // namespace fv
} // namespace Foam

namespace
{
using namespace Foam;

//- Modes with 1 <= |k| <= radius, k = m/L of a box of sides L, the shortest of which is 1;
//  one of each pair m, -m
std::vector<fv::lowModeForcing::mode> modesWithin(const scalar radius,
                                                  const vector& L)
{
    labelVector most;
    for (direction d = 0; d < 3; ++d)
    {
        most[d] = label(radius * L[d] * (1 + 1e-12));
    }
    std::vector<fv::lowModeForcing::mode> modes;
    for (label x = 0; x <= most.x(); ++x)
    {
        for (label y = -most.y(); y <= most.y(); ++y)
        {
            for (label z = -most.z(); z <= most.z(); ++z)
            {
                const bool first = x > 0 || y > 0 || (y == 0 && z > 0);
                const scalar k2 =
                    sqr(x / L.x()) + sqr(y / L.y()) + sqr(z / L.z());
                if (first && !(x == 0 && y < 0) && k2 >= 1 - 1e-12 &&
                    k2 <= sqr(radius) * (1 + 1e-12))
                {
                    modes.push_back({labelVector(x, y, z), {0, 0, 0}});
                }
            }
        }
    }
    return modes;
}
} // namespace

Foam::fv::EswaranPopeForcing::EswaranPopeForcing(const word& name,
                                                 const word& modelType,
                                                 const dictionary& dict,
                                                 const fvMesh& mesh)
    : lowModeForcing(name, modelType, dict, mesh,
                     {"acceleration", "timeScale", "maxWaveNumber", "seed"}),
      timeScale_(readPositive(coeffs_, "timeScale", dimTime)),
      seed_(coeffs_.getOrDefault<label>("seed", 1))
{
    const scalar acceleration =
        readPositive(coeffs_, "acceleration", dimAcceleration);
    const scalar radius = coeffs_.getOrDefault<scalar>("maxWaveNumber", 2);
    if (!(radius >= 1))
    {
        refuse(coeffs_, "maxWaveNumber", Foam::name(radius), "1 and greater");
    }
    const vector L(grid_.length() / cmptMin(grid_.length()));
    for (direction d = 0; d < 3; ++d)
    {
        const scalar cells = grid_.n()[d] / L[d];
        if (2 * radius < cells) continue;
        refuse(coeffs_, "maxWaveNumber", Foam::name(radius),
               "less than half the number of cells, which is " +
                   Foam::name(cells) + " along " + vector::componentNames[d] +
                   " in a length of the shortest side");
    }

    const std::vector<mode> modes(modesWithin(radius, L));
    setModes(modes, "maxWaveNumber");

    vector share(Zero);
    for (const mode& m : modes)
    {
        const vector k(waveVector(m.m));
        share += (vector::one - cmptMultiply(k, k) / magSqr(k)) /
                 (2 * scalar(modes.size()));
    }
    if (cmptMax(cmptMag(3 * share - vector::one)) > 0.05)
    {
        IOWarningInFunction(coeffs_)
            << "of the force in this box x, y and z have shares of " << share
            << nl << "    Take a maxWaveNumber of 2 and more, or a cube"
            << endl;
    }

    // Two of three components survive the projection: mean |f|^2 is twice
    // deviation^2 per mode
    deviation_ = acceleration / std::sqrt(2.0 * modes.size());

    b_.resize(3 * modes.size());
    start(mesh);
    file_.reset(new stateObject<IOdictionary>(
        name, "uniform", mesh, [this](Ostream& os) { writeState(os); }));
    project();
}

void Foam::fv::EswaranPopeForcing::start(const fvMesh& mesh)
{
    const auto old = stateOfTime(mesh, name());
    if (old)
    {
        scalarList numbers(1, scalar(old->get<label>("steps")));
        numbers.append(scalarField("values", *old,
                                   label(2 * b_.size()))); // checks the size
        setState(numbers);
        return;
    }
    for (size_t i = 0; i < b_.size(); ++i)
    {
        b_[i] = random(i);
    }
}

void Foam::fv::EswaranPopeForcing::writeState(Ostream& os) const
{
    const scalarList numbers(state());
    const scalarField values(SubList<scalar>(numbers, numbers.size() - 1, 1));
    os.precision(17);
    os.writeEntry("steps", steps_);
    values.writeEntry("values", os);
}

// Two normal deviates (Box & Muller) from a hash of seed, step and number (the
// finaliser of splitmix64)
Foam::fv::EswaranPopeForcing::complexNumber
Foam::fv::EswaranPopeForcing::random(const uint64_t i) const
{
    uint64_t x = uint64_t(seed_);
    const auto mix = [&](const uint64_t add)
    {
        x += 0x9e3779b97f4a7c15ull + add;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
        x ^= x >> 31;
        return (double(x >> 11) + 0.5) / 9007199254740992.0; // 2^53
    };
    mix(uint64_t(steps_));
    const double u = mix(i);
    const double v = mix(0);
    return std::polar(std::sqrt(-2 * std::log(u)),
                      constant::mathematical::twoPi * v);
}

void Foam::fv::EswaranPopeForcing::project()
{
    const complexNumber* b = b_.data();
    for (mode& m : modes())
    {
        const vector k(waveVector(m.m));
        const complexNumber along =
            (k[0] * b[0] + k[1] * b[1] + k[2] * b[2]) / magSqr(k);
        for (direction d = 0; d < 3; ++d, ++b)
        {
            m.c[d] = deviation_ * (*b - along * k[d]);
        }
    }
}

Foam::scalarList Foam::fv::EswaranPopeForcing::state() const
{
    scalarList numbers(1 + 2 * b_.size());
    numbers[0] = steps_;
    for (size_t i = 0; i < b_.size(); ++i)
    {
        numbers[1 + 2 * i] = b_[i].real();
        numbers[2 + 2 * i] = b_[i].imag();
    }
    return numbers;
}

void Foam::fv::EswaranPopeForcing::setState(const scalarList& numbers)
{
    steps_ = label(numbers[0]);
    lastTime_ = -GREAT;
    for (size_t i = 0; i < b_.size(); ++i)
    {
        b_[i] = complexNumber(numbers[1 + 2 * i], numbers[2 + 2 * i]);
    }
    project();
}

void Foam::fv::EswaranPopeForcing::advance()
{
    const Time& time = mesh_.time();
    if (lastTime_ == time.value()) return;
    lastTime_ = time.value();

    ++steps_;
    const scalar keep = std::exp(-time.deltaTValue() / timeScale_);
    const scalar fresh = std::sqrt(1 - sqr(keep));
    for (size_t i = 0; i < b_.size(); ++i)
    {
        b_[i] = keep * b_[i] + fresh * random(i);
    }
    project();
}
