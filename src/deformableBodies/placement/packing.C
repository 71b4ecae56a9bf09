// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "packing.H"
#include "cpuTime.H"
#include "segmentDistance.H"

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

bool isSphere(const solidForm& form)
{
    return !form.isRod() && cmptMax(form.semiAxes) == cmptMin(form.semiAxes);
}

//- The largest value over 0 < l < 1 of l (1 - l) r.[(1 - l) A + l B]^-1.r is 1
//  where two ellipsoids touch
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

//- Are two solids apart, the first moved by r from the second's place?
bool areApart(const solidForm& a, const vector& directionA, const solidForm& b,
              const vector& directionB, const vector& r)
{
    if (magSqr(r) >= sqr(a.circumradius() + b.circumradius())) return true;
    if (isSphere(a) && isSphere(b)) return false;
    if (a.isRod() && b.isRod())
    {
        const vector u(a.halfLength * directionA), v(b.halfLength * directionB);
        return magSqr(connection(r - u, r + u, -v, v)) >=
               sqr(a.semiAxes.x() + b.semiAxes.x());
    }
    if (b.isRod()) return areApart(b, directionB, a, directionA, -r);
    if (a.isRod())
    {
        // Where the ellipsoid of semi-axes longer by the rod's radius is a sphere
        const tensor toAxes(turnTo(directionB).T());
        const auto there = [&](const vector& x) {
            return cmptDivide(toAxes & x,
                              b.semiAxes + a.semiAxes.x() * vector::one);
        };
        const vector u(a.halfLength * directionA);
        return magSqr(connection(there(r - u), there(r + u), vector::zero,
                                 vector::zero)) >= 1;
    }
    return ellipsoidsApart(matrixOf(a, directionA), matrixOf(b, directionB), r);
}
} // namespace

Foam::solidForm Foam::packing::formOf(const solid& a, const label i) const
{
    const scalar size = i < first_ ? 1 : size_;
    return {size * a.form.semiAxes + 0.5 * size_ * gap_ * vector::one,
            size * a.form.halfLength};
}

void Foam::packing::sort(const label n, const scalar circumradius,
                         const scalar gap)
{
    scalar largest = circumradius;
    for (const solid& a : solids_)
    {
        largest = max(largest, a.form.circumradius());
    }
    bins_.reset(new pointBins(grid_, 2 * largest + gap, n));
    inBin_.assign(bins_->count(), {});
    for (size_t i = 0; i < solids_.size(); ++i)
    {
        inBin_[bins_->numberOf(solids_[i].centre)].push_back(i);
    }
}

void Foam::packing::move(const label i, const solid& to)
{
    auto& from = inBin_[bins_->numberOf(solids_[i].centre)];
    from.erase(std::find(from.begin(), from.end(), i));
    solids_[i] = to;
    inBin_[bins_->numberOf(to.centre)].push_back(i);
}

bool Foam::packing::isFree(const solid& a, const label i) const
{
    const solidForm form(formOf(a, i));
    const vector L(grid_.length());
    const tensor Q(turnTo(a.direction));
    for (direction d = 0; d < 3; ++d)
    {
        if (grid_.periodic(d)) continue;
        const scalar extent =
            form.halfLength * mag(a.direction[d]) + 0.5 * size_ * gap_ +
            (form.isRod()
                 ? form.semiAxes.x()
                 : mag(cmptMultiply(form.semiAxes,
                                    vector(Q(d, 0), Q(d, 1), Q(d, 2)))));
        const scalar above = a.centre[d] - grid_.origin()[d];
        if (above < extent || L[d] - above < extent) return false;
    }

    // All images of another that may reach it
    const auto freeOf = [&](const label j)
    {
        const solid& b = j == i ? a : solids_[j];
        const solidForm other(formOf(b, j));
        const scalar reach = form.circumradius() + other.circumradius();
        const vector r(nearestImage(grid_, a.centre, b.centre));
        label most[3];
        for (direction d = 0; d < 3; ++d)
        {
            most[d] = grid_.periodic(d) ? label((reach + mag(r[d])) / L[d]) : 0;
        }
        for (label k = -most[2]; k <= most[2]; ++k)
        {
            for (label l = -most[1]; l <= most[1]; ++l)
            {
                for (label m = -most[0]; m <= most[0]; ++m)
                {
                    if (j == i && k == 0 && l == 0 && m == 0) continue;
                    if (!areApart(form, a.direction, other, b.direction,
                                  r + vector(m * L[0], l * L[1], k * L[2])))
                    {
                        return false;
                    }
                }
            }
        }
        return true;
    };
    if (!freeOf(i)) return false;
    bool all = true;
    bins_->eachNext(bins_->numberOf(a.centre),
                    [&](const label bin)
                    {
                        for (const label j : inBin_[bin])
                        {
                            if (!all) return;
                            if (j != i) all = freeOf(j);
                        }
                    });
    return all;
}

Foam::solid Foam::packing::draw(const solidForm& form,
                                const std::function<vector()>& direction,
                                Random& random) const
{
    return {form,
            grid_.origin() +
                cmptMultiply(random.sample01<vector>(), grid_.length()),
            direction()};
}

bool Foam::packing::insert(const label n, const solidForm& form,
                           const std::function<vector()>& direction,
                           Random& random)
{
    const label attempts = 2000;
    while (label(solids_.size()) < first_ + n)
    {
        const label i = solids_.size();
        solid a(draw(form, direction, random));
        for (label k = 0; !isFree(a, i); ++k)
        {
            if (k == attempts) return false;
            a = draw(form, direction, random);
        }
        solids_.push_back(a);
        inBin_[bins_->numberOf(a.centre)].push_back(i);
    }
    return true;
}

Foam::solid Foam::packing::nudged(const solid& a, const scalar distance,
                                  const scalar angle, Random& random) const
{
    const auto about = [&]
    { return vector(2 * random.sample01<vector>() - vector::one); };
    solid b(a);
    b.centre = intoBox(grid_, a.centre + distance * about());
    b.direction += angle * about();
    b.direction /= mag(b.direction);
    return b;
}

Foam::scalar Foam::packing::shake(const scalar distance, const scalar angle,
                                  Random& random)
{
    const label n = solids_.size();
    label moved = 0;
    for (label i = first_; i < n; ++i)
    {
        const solid a(nudged(solids_[i], distance, angle, random));
        if (!isFree(a, i)) continue;
        move(i, a);
        ++moved;
    }
    return scalar(moved) / (n - first_);
}

bool Foam::packing::grow(const scalar factor, const scalar distance,
                         const scalar angle, Random& random)
{
    const label attempts = 50, n = solids_.size();
    const scalar before = size_;
    const std::vector<solid> places(solids_);
    size_ = min(scalar(1), factor * size_);
    for (label i = first_; i < n; ++i)
    {
        solid a(solids_[i]);
        label k = 0;
        for (; k < attempts && !isFree(a, i); ++k)
        {
            a = nudged(solids_[i], distance, angle, random);
        }
        if (k == attempts)
        {
            size_ = before;
            for (label j = first_; j < i; ++j)
            {
                move(j, places[j]);
            }
            return false;
        }
        if (k) move(i, a);
    }
    return true;
}

Foam::scalar Foam::packing::fill(const label n, const solidForm& form,
                                 const scalar gap, const bool turn,
                                 const std::function<vector()>& direction,
                                 Random& random, const word& name)
{
    first_ = solids_.size();
    gap_ = gap;
    size_ = 1;
    sort(first_ + n, form.circumradius(), gap);

    // Said where it takes long
    const cpuTime clock;
    scalar said = 0;
    const auto progress = [&](const string& what)
    {
        if (clock.elapsedCpuTime() < said + 5) return;
        said = clock.elapsedCpuTime();
        Info << "Placing the bodies of group " << name << ": " << what.c_str()
             << endl;
    };
    while (!insert(n, form, direction, random))
    {
        progress(Foam::name(solids_.size() - first_) + " of " + Foam::name(n) +
                 " at size " + Foam::name(size_));
        solids_.resize(first_);
        sort(first_ + n, form.circumradius(), gap);
        size_ *= 0.9;
        if (size_ < 0.2) return 0;
    }

    scalar distance = 0.3 * cmptMin(form.semiAxes), growth = 0.02;
    scalar before = size_;
    const label patience = 500;
    for (label sweep = 1; size_ < 1; ++sweep)
    {
        const scalar angle = turn ? distance / form.circumradius() : 0;
        const scalar moved = shake(distance, angle, random);
        const bool grows = grow(1 + growth, distance, angle, random);
        growth = grows ? min(scalar(0.05), 1.5 * growth)
                       : max(scalar(1e-5), 0.5 * growth);
        distance *= moved > 0.4 ? 1.1 : 0.9;
        distance = min(distance, form.circumradius());
        progress("all have grown to " + Foam::name(size_) + " of their size");
        if (sweep % patience) continue;
        if (size_ < 1.001 * before) break;
        before = size_;
    }
    return size_;
}
