// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "pairDistribution.H"
#include "mathematicalConstants.H"
#include "periodicBox.H"

Foam::pairDistribution::pairDistribution(const uniformGrid& grid,
                                         const scalar reach, const label bins,
                                         const direction f, const direction g)
    : grid_(grid),
      reach_(reach),
      nBins_(bins),
      f_(f),
      g_(g),
      radial_(4 * bins, Zero),
      map_(4 * bins * bins, Zero)
{
}

void Foam::pairDistribution::add(const UList<point>& centres, const scalar dt)
{
    const label n = centres.size();
    const vector L(grid_.length());
    expected_ += dt * n * (n - 1.0) / grid_.volume();
    for (label i = 0; i < n; ++i)
    {
        for (label j = i + 1; j < n; ++j)
        {
            const vector r(nearestImage(grid_, centres[i], centres[j]));
            scalar share = 1;
            for (direction d = 0; d < 3; ++d)
            {
                if (!grid_.periodic(d)) share *= 1 - mag(r[d]) / L[d];
            }
            if (share <= 0) continue;
            add(r, dt / share);
            add(-r, dt / share);
        }
    }
}

void Foam::pairDistribution::add(const vector& r, const scalar weight)
{
    const scalar distance = mag(r);
    if (distance < reach_)
    {
        scalar* bin = &radial_[4 * label(distance / reach_ * nBins_)];
        bin[0] += weight;
        for (direction d = 0; d < 3; ++d)
        {
            if (mag(r[d]) > 0.8 * distance) bin[1 + d] += weight;
        }
    }
    const label n = 2 * nBins_;
    const scalar i = (r[f_] / reach_ + 1) * nBins_,
                 j = (r[g_] / reach_ + 1) * nBins_;
    if (mag(r[3 - f_ - g_]) < 0.1 * reach_ && i >= 0 && j >= 0 && i < n &&
        j < n)
    {
        map_[label(j) * n + label(i)] += weight;
    }
}

void Foam::pairDistribution::write(Ostream& radial, Ostream& map) const
{
    const scalar width = reach_ / nBins_;
    radial << "# r g gX gY gZ" << nl << "# [m] [1] [1] [1] [1]" << nl;
    for (label k = 0; k < nBins_; ++k)
    {
        const scalar shell = 4 * constant::mathematical::pi / 3 * pow3(width) *
                             (pow3(k + scalar(1)) - pow3(scalar(k)));
        radial << (k + 0.5) * width;
        for (direction c = 0; c < 4; ++c)
        {
            // A double cone of that angle is a fifth of all directions
            const scalar volume = c == 0 ? shell : 0.2 * shell;
            radial << ' '
                   << radial_[4 * k + c] / max(expected_ * volume, VSMALL);
        }
        radial << nl;
    }
    map << "# r" << vector::componentNames[f_] << " r"
        << vector::componentNames[g_] << " g" << nl << "# [m] [m] [1]" << nl;
    const label n = 2 * nBins_;
    const scalar volume = sqr(width) * 0.2 * reach_;
    forAll(map_, k)
    {
        map << (k % n + 0.5 - nBins_) * width << ' '
            << (k / n + 0.5 - nBins_) * width << ' '
            << map_[k] / max(expected_ * volume, VSMALL) << nl;
    }
}

Foam::scalarList Foam::pairDistribution::state() const
{
    scalarList all(1 + radial_.size() + map_.size());
    all[0] = expected_;
    std::copy(radial_.begin(), radial_.end(), all.begin() + 1);
    std::copy(map_.begin(), map_.end(), all.begin() + 1 + radial_.size());
    return all;
}

void Foam::pairDistribution::restore(const UList<scalar>& state)
{
    if (state.size() != 1 + radial_.size() + map_.size()) return;
    expected_ = state[0];
    std::copy_n(state.begin() + 1, radial_.size(), radial_.begin());
    std::copy_n(state.begin() + 1 + radial_.size(), map_.size(), map_.begin());
}
