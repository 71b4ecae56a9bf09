// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "solidForm.H"
#include "segmentDistance.H"
#include "turnTo.H"

namespace
{
using namespace Foam;

//- x.A^-1.x = 1 on the surface of an ellipsoid
symmTensor matrixOf(const solidForm& form, const vector& direction)
{
    const tensor Q(turnTo(direction));
    const vector s(cmptMultiply(form.semiAxes, form.semiAxes));
    return symm(Q & tensor(s.x(), 0, 0, 0, s.y(), 0, 0, 0, s.z()) & Q.T());
}

//- Two ellipsoids touch where the largest value over 0 < l < 1 of
//  l (1 - l) r.[(1 - l) A + l B]^-1.r is 1
bool ellipsoidsApart(const symmTensor& A, const symmTensor& B, const vector& r)
{
    const auto f = [&](const scalar l)
    { return l * (1 - l) * (r & (inv((1 - l) * A + l * B) & r)); };
    const scalar golden = 0.5 * (std::sqrt(5.0) - 1);
    scalar low = 0, high = 1, l1 = 1 - golden, l2 = golden;
    scalar f1 = f(l1), f2 = f(l2);
    for (label i = 0; i < 30; ++i)
    {
        if (max(f1, f2) >= 1) return true;
        if (f1 < f2)
        {
            low = l1;
            l1 = l2;
            f1 = f2;
            l2 = low + golden * (high - low);
            f2 = f(l2);
        }
        else
        {
            high = l2;
            l2 = l1;
            f2 = f1;
            l1 = high - golden * (high - low);
            f1 = f(l1);
        }
    }
    return false;
}
} // namespace

bool Foam::solidForm::isApart(const vector& own, const solidForm& other,
                              const vector& others, const vector& r) const
{
    if (magSqr(r) >= sqr(circumradius() + other.circumradius())) return true;
    if (isSphere() && other.isSphere()) return false;
    if (isRod() && other.isRod())
    {
        const vector u(halfLength * own), v(other.halfLength * others);
        return magSqr(connection(r - u, r + u, -v, v)) >=
               sqr(semiAxes.x() + other.semiAxes.x());
    }
    if (other.isRod()) return other.isApart(others, *this, own, -r);
    if (isRod())
    {
        // Scaled so that the ellipsoid, with semi-axes longer by the rod's radius, is a
        // unit sphere
        const tensor toAxes(turnTo(others).T());
        const auto scaled = [&](const vector& x) {
            return cmptDivide(toAxes & x,
                              other.semiAxes + semiAxes.x() * vector::one);
        };
        const vector u(halfLength * own);
        return magSqr(connection(scaled(r - u), scaled(r + u), vector::zero,
                                 vector::zero)) >= 1;
    }
    return ellipsoidsApart(matrixOf(*this, own), matrixOf(other, others), r);
}
