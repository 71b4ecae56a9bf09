// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bending.H"
#include "dictionaryChecks.H"
#include "gridValues.H"
#include <cmath>

namespace
{
using namespace Foam;

//- Geometry of one point. Index 0 is theta, 1 is phi
struct pointGeometry
{
    vector x[2], n;
    vector H[2][2];
    double J, up[2][2]; // area per solid angle; contravariant metric
    double b[2][2];     // covariant curvature
    double mixed[2][2]; // b_a^b
};

//- Symmetric part of a tensor
void symmetric(const double full[2][2], double sym[2][2])
{
    sym[0][0] = full[0][0];
    sym[1][1] = full[1][1];
    sym[0][1] = sym[1][0] = 0.5 * (full[0][1] + full[1][0]);
}

//- Bending moments M^ab = -E_B sym((b_c^a - B_c^a) a^cb). B: mixed reference curvature
void moments(const pointGeometry& g, const double modulus, const double* B,
             double M[2][2])
{
    double full[2][2];
    for (int a = 0; a < 2; ++a)
    {
        for (int b = 0; b < 2; ++b)
        {
            full[a][b] = 0;
            for (int c = 0; c < 2; ++c)
            {
                full[a][b] -=
                    modulus * (g.mixed[c][a] - B[2 * c + a]) * g.up[c][b];
            }
        }
    }
    symmetric(full, M);
}

//- sym(M^am b_m^b) of moments M
void momentsTimesCurvature(const pointGeometry& g, const double M[2][2],
                           double N[2][2])
{
    double full[2][2];
    for (int a = 0; a < 2; ++a)
    {
        for (int b = 0; b < 2; ++b)
        {
            full[a][b] = M[a][0] * g.mixed[0][b] + M[a][1] * g.mixed[1][b];
        }
    }
    symmetric(full, N);
}
} // namespace

void Foam::bending::derivatives::fill(const sphericalHarmonics& grid,
                                      const double* coeffs)
{
    for (std::vector<double>* v : {&t, &p, &tt, &tp, &pp})
    {
        v->resize(3 * grid.nPoints());
    }
    grid.gradient(coeffs, t.data(), p.data());
    grid.hessian(coeffs, tt.data(), tp.data(), pp.data());
}

// Call point(k, geometry) for all points of the grid
template<class Point>
void Foam::bending::each(const sphericalHarmonics& grid, const derivatives& d,
                         Point point)
{
    pointGeometry g;
    for (label k = 0; k < grid.nPoints(); ++k)
    {
        g.x[0] = vectorAt(d.t, k);
        g.x[1] = vectorAt(d.p, k);
        g.H[0][0] = vectorAt(d.tt, k);
        g.H[0][1] = g.H[1][0] = vectorAt(d.tp, k);
        g.H[1][1] = vectorAt(d.pp, k);
        const vector area(g.x[0] ^ g.x[1]);
        g.J = mag(area);
        g.n = area / g.J;
        const double r = 1 / (g.J * g.J);
        g.up[0][0] = r * (g.x[1] & g.x[1]);
        g.up[1][1] = r * (g.x[0] & g.x[0]);
        g.up[0][1] = g.up[1][0] = -r * (g.x[0] & g.x[1]);
        for (int a = 0; a < 2; ++a)
        {
            for (int b = 0; b < 2; ++b)
            {
                g.b[a][b] = g.n & g.H[a][b];
            }
        }
        for (int a = 0; a < 2; ++a)
        {
            for (int b = 0; b < 2; ++b)
            {
                g.mixed[a][b] = g.b[a][0] * g.up[0][b] + g.b[a][1] * g.up[1][b];
            }
        }
        point(k, g);
    }
}

Foam::bending::bending(const dictionary& dict,
                       const sphericalHarmonics& harmonics, const scalar radius,
                       const std::vector<double>& initial)
    : harmonics_(harmonics),
      modulus_(readPositive(dict, "modulus", dimForce * dimLength)),
      reference_(4 * harmonics.nPoints(), 0)
{
    checkEntries(dict, {"modulus", "reference"});
    const label n = harmonics_.nPoints();
    const token first(dict.found("reference")
                          ? token(dict.lookup("reference")[0])
                          : token(word("sphere")));
    scalar curvature = 0;
    if (first.isNumber())
    {
        curvature = first.number();
    }
    else if (first.isWord() && first.wordToken() == "sphere")
    {
        curvature = 1 / radius;
    }
    else if (first.isWord() && first.wordToken() == "initial")
    {
        d_.fill(harmonics_, initial.data());
        each(harmonics_, d_,
             [&](const label k, const pointGeometry& g)
             {
                 for (int i = 0; i < 4; ++i)
                 {
                     reference_[4 * k + i] = g.mixed[i / 2][i % 2];
                 }
             });
        return;
    }
    else if (!(first.isWord() && first.wordToken() == "none"))
    {
        refuse(dict, "reference", first.isWord() ? first.wordToken() : "?",
               "none, sphere, initial, or a curvature");
    }
    for (label k = 0; k < n; ++k)
    {
        reference_[4 * k] = reference_[4 * k + 3] = -curvature;
    }
}

void Foam::bending::addLoad(const double* coeffs, double* q) const
{
    const label n = harmonics_.nPoints();
    d_.fill(harmonics_, coeffs);
    each(harmonics_, d_,
         [&](const label k, const pointGeometry& g)
         {
             double M[2][2], N[2][2];
             moments(g, modulus_, &reference_[4 * k], M);
             momentsTimesCurvature(g, M, N);

             // Factors of dx_a and H_ab(dx) in dW
             const double w = g.J * harmonics_.weight(k);
             vector first[2];
             for (int a = 0; a < 2; ++a)
             {
                 double s = 0; // M^bc S^a_bc
                 for (int d = 0; d < 2; ++d)
                 {
                     s += g.up[a][d] * (g.x[d] & (M[0][0] * g.H[0][0] +
                                                  2 * M[0][1] * g.H[0][1] +
                                                  M[1][1] * g.H[1][1]));
                 }
                 first[a] = w * (N[a][0] * g.x[0] + N[a][1] * g.x[1] + s * g.n);
             }
             for (direction c = 0; c < 3; ++c)
             {
                 d_.t[c * n + k] = first[0][c];
                 d_.p[c * n + k] = first[1][c];
                 d_.tt[c * n + k] = -w * M[0][0] * g.n[c];
                 d_.tp[c * n + k] = -2 * w * M[0][1] * g.n[c];
                 d_.pp[c * n + k] = -w * M[1][1] * g.n[c];
             }
         });

    std::vector<double> tension(3 * harmonics_.nCoeffs());
    harmonics_.gradientAdjoint(d_.t.data(), d_.p.data(), tension.data());
    harmonics_.addHessianAdjoint(d_.tt.data(), d_.tp.data(), d_.pp.data(),
                                 tension.data());
    for (size_t i = 0; i < tension.size(); ++i)
    {
        q[i] += tension[i];
    }
}

Foam::scalar Foam::bending::energy(const double* coeffs) const
{
    double sum = 0;
    d_.fill(harmonics_, coeffs);
    each(harmonics_, d_,
         [&](const label k, const pointGeometry& g)
         {
             double d[4], square = 0;
             for (int i = 0; i < 4; ++i)
             {
                 d[i] = g.mixed[i / 2][i % 2] - reference_[4 * k + i];
             }
             square = d[0] * d[0] + 2 * d[1] * d[2] + d[3] * d[3];
             sum += 0.5 * modulus_ * g.J * harmonics_.weight(k) * square;
         });
    return sum;
}

void Foam::bending::curvature(const sphericalHarmonics& grid,
                              const double* coeffs, double* c)
{
    derivatives d;
    d.fill(grid, coeffs);
    each(grid, d,
         [&](const label k, const pointGeometry& g)
         { c[k] = -g.mixed[0][0] - g.mixed[1][1]; });
}
