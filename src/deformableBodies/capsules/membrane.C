// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "membrane.H"
#include <cmath>

namespace
{
//- Covariant metric at point k of a grid of n points
struct metric
{
    double tt, tp, pp;

    metric(const double* __restrict__ t, const double* __restrict__ p,
           const int n, const int k)
        : tt(t[k] * t[k] + t[n + k] * t[n + k] + t[2 * n + k] * t[2 * n + k]),
          tp(t[k] * p[k] + t[n + k] * p[n + k] + t[2 * n + k] * p[2 * n + k]),
          pp(p[k] * p[k] + p[n + k] * p[n + k] + p[2 * n + k] * p[2 * n + k])
    {
    }
};
} // namespace

Foam::membrane::membrane(const int degree, const int nTheta,
                         const dictionary& law,
                         const std::vector<double>& stressFree)
    : harmonics_(degree, nTheta),
      model_(membraneModel::New(law))
{
    const label n = harmonics_.nPoints();
    for (std::vector<double>* v : {&xt_, &xp_, &A_})
    {
        v->resize(3 * n);
    }
    for (std::vector<double>* v : {&dA_, &I1_, &I2_, &W_, &W1_, &W2_})
    {
        v->resize(n);
    }

    harmonics_.gradient(stressFree.data(), xt_.data(), xp_.data());
    for (label k = 0; k < n; ++k)
    {
        const metric m(xt_.data(), xp_.data(), n, k);
        const double det = m.tt * m.pp - m.tp * m.tp;
        A_[k] = m.pp / det;
        A_[n + k] = -m.tp / det;
        A_[2 * n + k] = m.tt / det;
        dA_[k] = std::sqrt(det) * harmonics_.weight(k);
    }
}

void Foam::membrane::invariants(const double* coeffs) const
{
    harmonics_.gradient(coeffs, xt_.data(), xp_.data());

    const label n = harmonics_.nPoints();
    const double* __restrict__ t = xt_.data();
    const double* __restrict__ p = xp_.data();
    const double* __restrict__ A = A_.data();
    double* __restrict__ I1 = I1_.data();
    double* __restrict__ I2 = I2_.data();
    for (label k = 0; k < n; ++k)
    {
        const metric m(t, p, n, k);
        const double detInvA = A[k] * A[2 * n + k] - A[n + k] * A[n + k];
        I1[k] = A[k] * m.tt + 2 * A[n + k] * m.tp + A[2 * n + k] * m.pp - 2;
        I2[k] = (m.tt * m.pp - m.tp * m.tp) * detInvA - 1;
    }
}

Foam::scalar Foam::membrane::energy(const double* coeffs) const
{
    invariants(coeffs);
    return energyOfInvariants();
}

Foam::scalar Foam::membrane::energyOfInvariants() const
{
    const label n = harmonics_.nPoints();
    model_->evaluate(n, I1_.data(), I2_.data(), W_.data(), W1_.data(),
                     W2_.data());
    double sum = 0;
    for (label k = 0; k < n; ++k)
    {
        sum += dA_[k] * W_[k];
    }
    return sum;
}

Foam::scalar Foam::membrane::load(const double* coeffs, double* q) const
{
    const scalar total = energy(coeffs);

    // Replace x_t and x_p by V^t and V^p
    const label n = harmonics_.nPoints();
    double* __restrict__ t = xt_.data();
    double* __restrict__ p = xp_.data();
    const double* __restrict__ A = A_.data();
    const double* __restrict__ W1 = W1_.data();
    const double* __restrict__ W2 = W2_.data();
    for (label k = 0; k < n; ++k)
    {
        const metric m(t, p, n, k);
        const double detInvA = A[k] * A[2 * n + k] - A[n + k] * A[n + k];
        const double a = 2 * dA_[k] * W1[k];
        const double b = 2 * dA_[k] * W2[k] * detInvA;
        const double Ttt = a * A[k] + b * m.pp;
        const double Ttp = a * A[n + k] - b * m.tp;
        const double Tpp = a * A[2 * n + k] + b * m.tt;
        for (label c = 0; c < 3; ++c)
        {
            const double xt = t[c * n + k], xp = p[c * n + k];
            t[c * n + k] = Ttt * xt + Ttp * xp;
            p[c * n + k] = Ttp * xt + Tpp * xp;
        }
    }
    harmonics_.gradientAdjoint(xt_.data(), xp_.data(), q);
    return total;
}

// Largest eigenvalue of C^a_b = A^ac a_cb. The discriminant is computed from differences that
// vanish for isotropic stretch; I1^2/4 - det would leave the square root of round-off
Foam::membrane::extremes Foam::membrane::stretches(const double* coeffs) const
{
    invariants(coeffs);
    const label n = harmonics_.nPoints();
    double largest = 0, smallest = 1e300;
    extremes e;
    for (label k = 0; k < n; ++k)
    {
        const metric m(xt_.data(), xp_.data(), n, k);
        const double Att = A_[k], Atp = A_[n + k], App = A_[2 * n + k];
        const double half =
            0.5 * ((Att * m.tt + Atp * m.tp) - (Atp * m.tp + App * m.pp));
        const double root2 =
            half * half + (Att * m.tp + Atp * m.pp) * (Atp * m.tt + App * m.tp);
        largest = std::max(largest, 0.5 * (I1_[k] + 2) +
                                        std::sqrt(std::max(0.0, root2)));
        if (I2_[k] + 1 < smallest)
        {
            smallest = I2_[k] + 1;
            e.where = k;
        }
    }
    e.stretch = std::sqrt(largest);
    e.area = std::sqrt(smallest);
    return e;
}

Foam::membrane::extremes Foam::membrane::stretches(const double* coeffs,
                                                   scalar& energy) const
{
    const extremes e(stretches(coeffs));
    energy = energyOfInvariants();
    return e;
}

void Foam::membrane::tensions(const double* coeffs, double* T1,
                              double* T2) const
{
    energy(coeffs);

    // Principal tensions from principal stretches l: T_i = 2/(l_j/l_i) (W1 + l_j^2 W2)
    for (label k = 0; k < harmonics_.nPoints(); ++k)
    {
        const double half = 0.5 * (I1_[k] + 2), det = I2_[k] + 1;
        const double root = std::sqrt(std::max(0.0, half * half - det));
        const double s1 = half + root, s2 = std::max(half - root, 1e-300);
        const double ratio = std::sqrt(s1 / s2);
        T1[k] = 2 * ratio * (W1_[k] + s2 * W2_[k]);
        T2[k] = 2 / ratio * (W1_[k] + s1 * W2_[k]);
    }
}
