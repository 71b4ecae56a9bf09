// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "packing.H"
#include "cpuTime.H"
#include <algorithm>

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
                    const vector image(m * L[0], l * L[1], k * L[2]);
                    if (!form.isApart(a.direction, other, b.direction,
                                      r + image))
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

    // Progress is printed every five seconds
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
