// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lowModeForcing.H"
#include "dictionaryChecks.H"
#include "fvMatrices.H"

namespace Foam
{
namespace fv
{
defineTypeNameAndDebug(lowModeForcing, 0);
} // namespace fv
} // namespace Foam

Foam::fv::lowModeForcing::lowModeForcing(const word& name,
                                         const word& modelType,
                                         const dictionary& dict,
                                         const fvMesh& mesh,
                                         const wordList& entries)
    : option(name, modelType, dict, mesh),
      extent_(labelVector::zero),
      grid_(uniformGrid::New(mesh))
{
    wordList allowed({"type", "active", "libs", "U"});
    allowed.append(entries);
    checkEntries(coeffs_, allowed);
    fieldNames_.setSize(1, coeffs_.getOrDefault<word>("U", "U"));
    applied_.setSize(1, false);
    grid_.requirePeriodic(dict_, modelType);
}

Foam::vector Foam::fv::lowModeForcing::waveVector(const labelVector& m) const
{
    const vector L(grid_.length());
    return constant::mathematical::twoPi *
           vector(m.x() / L.x(), m.y() / L.y(), m.z() / L.z());
}

void Foam::fv::lowModeForcing::setModes(const std::vector<mode>& modes,
                                        const word& entry)
{
    modes_ = modes;
    for (const mode& m : modes_)
    {
        extent_ = max(extent_, cmptMag(m.m));
    }
    for (direction d = 0; d < 3; ++d)
    {
        if (2 * extent_[d] >= grid_.n()[d])
        {
            refuse(coeffs_, entry, Foam::name(extent_[d]),
                   "less than half the number of cells, which is " +
                       Foam::name(grid_.n()[d]) + " in direction " +
                       vector::componentNames[d]);
        }
    }
}

void Foam::fv::lowModeForcing::add(const direction d, const vector& offset,
                                   scalar* f) const
{
    const cellBox& box = grid_.box();
    const vector k1(waveVector(labelVector::one));
    const auto phase = [&](const direction e, const label m, const label i)
    {
        return std::polar(1.0,
                          m * k1[e] *
                              (grid_.origin()[e] +
                               (box.lo[e] + i + offset[e]) * grid_.h()[e]));
    };

    // In two partial sums: first over m_z for a plane, then over m_y and m_x,
    // for which rows of exp(i k_x x) are kept
    const label nx = box.size.x();
    const labelVector& M = extent_;
    const label mx = 2 * M.x() + 1, my = 2 * M.y() + 1;
    std::vector<double> cosX(mx * nx), sinX(mx * nx);
    for (label m = 0; m < mx; ++m)
    {
        for (label i = 0; i < nx; ++i)
        {
            const complexNumber e(phase(0, m - M.x(), i));
            cosX[m * nx + i] = e.real();
            sinX[m * nx + i] = e.imag();
        }
    }

    std::vector<complexNumber> plane(mx * my), row(mx);
    for (label k = 0; k < box.size.z(); ++k)
    {
        std::fill(plane.begin(), plane.end(), 0.0);
        for (const mode& m : modes_)
        {
            plane[(m.m.x() + M.x()) + mx * (m.m.y() + M.y())] +=
                m.c[d] * phase(2, m.m.z(), k);
        }
        for (label j = 0; j < box.size.y(); ++j)
        {
            std::fill(row.begin(), row.end(), 0.0);
            for (label l = 0; l < my; ++l)
            {
                const complexNumber e(phase(1, l - M.y(), j));
                for (label m = 0; m < mx; ++m)
                {
                    row[m] += plane[m + mx * l] * e;
                }
            }
            double* __restrict__ out =
                f + j * box.stride(1) + k * box.stride(2);
            for (label m = 0; m < mx; ++m)
            {
                const double a = row[m].real(), b = row[m].imag();
                const double* __restrict__ c = cosX.data() + m * nx;
                const double* __restrict__ s = sinX.data() + m * nx;
                for (label i = 0; i < nx; ++i)
                {
                    out[i] += a * c[i] - b * s[i];
                }
            }
        }
    }
}

void Foam::fv::lowModeForcing::addTo(staggeredField& f)
{
    advance();
    addPresent(f);
}

void Foam::fv::lowModeForcing::addPresent(staggeredField& f) const
{
    for (direction d = 0; d < 3; ++d)
    {
        vector offset(0.5, 0.5, 0.5);
        offset[d] = 0;
        add(d, offset, f[d].data());
    }
}

void Foam::fv::lowModeForcing::addSup(fvMatrix<vector>& eqn, const label)
{
    advance();
    staggeredField f(grid_.box());
    vectorField& source = eqn.source();
    for (direction d = 0; d < 3; ++d)
    {
        add(d, vector(0.5, 0.5, 0.5), f[d].data());
        forAll(source, celli)
        {
            source[celli][d] -= grid_.cellVolume() * f[d][grid_.index()[celli]];
        }
    }
}
