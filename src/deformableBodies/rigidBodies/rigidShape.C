// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "rigidShape.H"
#include "dictionaryChecks.H"
#include "mathematicalConstants.H"
#include <cmath>
#include <vector>

namespace
{
using namespace Foam;

const scalar pi = constant::mathematical::pi;

//- Directions of n points that share the area of an ellipsoid
class spiral
{
    const vector s_;

    //- Area of the ellipsoid per area of the unit sphere in the direction e
    scalar density(const vector& e) const
    {
        return cmptProduct(s_) * mag(cmptDivide(e, s_));
    }

    static vector direction(const scalar z, const scalar azimuth)
    {
        const scalar r = std::sqrt(max(1 - z * z, scalar(0)));
        return vector(r * std::cos(azimuth), r * std::sin(azimuth), z);
    }

    //- Where the integral of f over [a, b] reaches a part of the whole, for parts
    //  in any order: its values at the ends of intervals
    class cumulative
    {
        const scalar a_, step_;
        std::vector<scalar> sums_{0};

    public:
        template<class Function>
        cumulative(const scalar a, const scalar b, const label n, Function f)
            : a_(a),
              step_((b - a) / n)
        {
            for (label i = 0; i < n; ++i)
            {
                sums_.push_back(sums_.back() +
                                step_ * f(a + (i + 0.5) * step_));
            }
        }

        scalar total() const { return sums_.back(); }

        scalar at(const scalar part) const
        {
            const scalar wanted = part * total();
            const label i =
                min(label(std::upper_bound(sums_.begin(), sums_.end(), wanted) -
                          sums_.begin()),
                    label(sums_.size()) - 1);
            return a_ + step_ * (i - 1 +
                                 (wanted - sums_[i - 1]) /
                                     (sums_[i] - sums_[i - 1]));
        }
    };

    cumulative ring(const scalar z) const
    {
        return cumulative(0, 2 * pi, 64,
                          [&](const scalar p)
                          { return density(direction(z, p)); });
    }

    cumulative rings() const
    {
        return cumulative(-1, 1, 1000,
                          [&](const scalar z) { return ring(z).total(); });
    }

public:
    explicit spiral(const vector& semiAxes)
        : s_(semiAxes)
    {
    }

    scalar area() const { return rings().total(); }

    vectorField points(const label n) const
    {
        const scalar golden = 0.5 * (std::sqrt(5.0) - 1);
        const cumulative all(rings());
        vectorField e(n);
        for (label k = 0; k < n / 2; ++k)
        {
            const scalar z = all.at((k + 0.5) / n), turns = golden * k;
            e[k] = direction(z, ring(z).at(turns - std::floor(turns)));
            e[n - 1 - k] = -e[k];
        }
        return e;
    }
};
} // namespace

Foam::rigidShape::rigidShape(const dictionary& dict)
{
    requireEntry(dict, "type");
    const word type(dict.get<word>("type"));
    if (type == "sphere")
    {
        checkEntries(dict, {"type", "radius"});
        semiAxes_ = readPositive(dict, "radius", dimLength) * vector::one;
    }
    else if (type == "ellipsoid")
    {
        checkEntries(dict, {"type", "semiAxes", "axis"});
        semiAxes_ = dict.get<vector>("semiAxes");
        if (!(cmptMin(semiAxes_) > 0))
        {
            refuse(dict, "semiAxes", Foam::name(cmptMin(semiAxes_)),
                   "three numbers greater than 0");
        }
        axis_ = dict.getOrDefault<vector>("axis", axis_);
        if (!(mag(axis_) > 0)) refuse(dict, "axis", "(0 0 0)", "a direction");
        axis_ /= mag(axis_);
    }
    else
    {
        refuse(dict, "type", type, "(sphere ellipsoid)");
    }
    area_ = spiral(semiAxes_).area();
}

Foam::scalar Foam::rigidShape::volume() const
{
    return 4 * pi / 3 * cmptProduct(semiAxes_);
}

Foam::scalar Foam::rigidShape::radius() const
{
    return std::cbrt(cmptProduct(semiAxes_));
}

Foam::vector Foam::rigidShape::inertia() const
{
    const vector s(cmptMultiply(semiAxes_, semiAxes_));
    return 0.2 * vector(s.y() + s.z(), s.z() + s.x(), s.x() + s.y());
}

void Foam::rigidShape::points(const label n, const scalar inset, vectorField& X,
                              vectorField& dS) const
{
    const vector inner(semiAxes_ - inset * vector::one);
    const vectorField e(spiral(inner).points(n));
    X = cmptMultiply(e, inner);

    // Normals of the surface itself, then what is left of the sum
    dS = cmptDivide(e, semiAxes_);
    dS *= area() / n / mag(dS);
    tensor sum(Zero);
    forAll(dS, k)
    {
        sum += dS[k] * vector(cmptMultiply(e[k], semiAxes_));
    }
    dS = (volume() * inv(sum)) & dS;
}
