// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The points that markers reach in the block of this rank, and sums over them

#include "markerSet.H"

// All points of a marker in the block of this rank, as they stand in memory?
bool Foam::markerSet::makeWhole(const vector& x, label* first,
                                scalar* weights) const
{
    const label n = kernel_.nPoints();
    for (label kind = 0; kind < 2; ++kind)
    {
        for (direction d = 0; d < 3; ++d, weights += n, ++first)
        {
            const label lo = grid_.box().lo[d];
            scalar at = (x[d] - grid_.origin()[d]) / grid_.h()[d];
            if (grid_.periodic(d) && (at < 0 || at >= grid_.n()[d]))
            {
                at -= grid_.n()[d] * std::floor(at / grid_.n()[d]);
            }
            // The faces of walls have their velocity from a boundary condition
            const label lowest = kernel_.weights(at - 0.5 * kind, weights);
            const label least =
                kind == 0 && lo == 0 && !grid_.periodic(d) ? 1 : lo;
            *first = lowest - lo;
            if (!(lowest >= least && lowest <= lo + grid_.box().size[d] - n))
            {
                return false;
            }
        }
    }
    return true;
}

void Foam::markerSet::makeCut(const vector& x, stencils& s) const
{
    for (direction d = 0; d < 3; ++d)
    {
        const label n = grid_.n()[d];
        const bool periodic = grid_.periodic(d);
        const scalar at = (x[d] - grid_.origin()[d]) / grid_.h()[d];
        kernel_.stencil(at, 0, 1, n - 1, n, periodic, s.at[0][d]);
        kernel_.stencil(at, 0.5, 0, n - 1, n, periodic, s.at[1][d]);

        // Points of this rank only, counted within its block
        for (label kind = 0; kind < 2; ++kind)
        {
            kernelStencil& all = s.at[kind][d];
            label kept = 0;
            for (label k = 0; k < all.size; ++k)
            {
                const label i = all.at[k] - grid_.box().lo[d];
                if (i >= 0 && i < grid_.box().size[d])
                {
                    all.at[kept] = i;
                    all.weight[kept] = all.weight[k];
                    ++kept;
                }
            }
            all.size = kept;
        }
    }
}

// From low to high z, within that from low to high y by some rows, within that
// as in the list, where neighbours are neighbours in space: what one marker has
// fetched others find in the cache
Foam::labelList Foam::markerSet::alongMemory() const
{
    const label rows = 8;
    const cellBox& box = grid_.box();
    const label perLayer = box.size.y() / rows + 1;
    const auto bucket = [&](const vector& x)
    {
        const label j = grid_.cellAt(x.y(), 1) - box.lo.y();
        const label k = grid_.cellAt(x.z(), 2) - box.lo.z();
        return min(max(j, label(0)), box.size.y() - 1) / rows +
               perLayer * min(max(k, label(0)), box.size.z() - 1);
    };
    labelList start(perLayer * box.size.z() + 1, Zero), in(X().size());
    forAll(X(), k)
    {
        in[k] = bucket(X()[k]);
        ++start[in[k] + 1];
    }
    for (label b = 1; b < start.size(); ++b)
    {
        start[b] += start[b - 1];
    }
    labelList order(X().size());
    forAll(X(), k)
    {
        order[start[in[k]]++] = k;
    }
    return order;
}

void Foam::markerSet::makeStencils()
{
    const label each = 6 * kernel_.nPoints();
    whole_.clear();
    cut_.clear();
    wholeFirst_.resize(6 * X().size() + 6);
    wholeWeights_.resize(each * X().size() + each);
    if (X().empty()) return;

    for (const label k : alongMemory())
    {
        if (makeWhole(X()[k], &wholeFirst_[6 * whole_.size()],
                      &wholeWeights_[each * whole_.size()]))
        {
            whole_.push_back(k);
        }
        else
        {
            cut_.emplace_back();
            cut_.back().marker = k;
            makeCut(X()[k], cut_.back());
        }
    }
}

// ---- sums over the points of this rank

// visit(marker, component, its row of weights along x, first point in the
// field's memory of each row, weight of each row) for all whole markers. Rows
// are fetched some markers ahead, as they lie all over memory
template<int n, class Visit>
void Foam::markerSet::eachWhole(const List<staggeredView>& fields,
                                Visit visit) const
{
    const label nWhole = whole_.size(), ahead = 4;
    const label* first = wholeFirst_.data();
    const auto firstPoint =
        [](const label* f, const direction d, const staggeredView& v)
    {
        return f[d == 0 ? 0 : 3] + v.row * f[d == 1 ? 1 : 4] +
               v.layer * f[d == 2 ? 2 : 5];
    };
    for (label k = 0; k < nWhole; ++k, first += 6)
    {
        if (k + ahead < nWhole)
        {
            for (const staggeredView& v : fields)
            {
                for (direction d = 0; d < 3; ++d)
                {
                    const scalar* p =
                        v.first[d] + firstPoint(first + 6 * ahead, d, v);
                    for (int z = 0; z < n; ++z)
                    {
                        for (int y = 0; y < n; ++y)
                        {
                            __builtin_prefetch(p + z * v.layer + y * v.row);
                        }
                    }
                }
            }
        }
        const scalar* w = &wholeWeights_[6 * n * k];
        for (direction d = 0; d < 3; ++d)
        {
            const scalar* wx = w + n * (d == 0 ? 0 : 3);
            const scalar* wy = w + n * (d == 1 ? 1 : 4);
            const scalar* wz = w + n * (d == 2 ? 2 : 5);
            for (const staggeredView& v : fields)
            {
                visit(whole_[k], d, v, firstPoint(first, d, v), wx, wy, wz);
            }
        }
    }
}

template<class Visit>
void Foam::markerSet::eachCutRow(const stencils& s, const direction d,
                                 const staggeredView& v, Visit visit)
{
    const kernelStencil& sy = s.at[d != 1][1];
    const kernelStencil& sz = s.at[d != 2][2];
    for (label k = 0; k < sz.size; ++k)
    {
        for (label j = 0; j < sy.size; ++j)
        {
            visit(v.row * sy.at[j] + v.layer * sz.at[k],
                  sy.weight[j] * sz.weight[k]);
        }
    }
}

template<int n>
void Foam::markerSet::gatherWhole(const List<staggeredView>& u,
                                  UList<vector>& U) const
{
    eachWhole<n>(u,
                 [&](const label marker, const direction d,
                     const staggeredView& v, const label first,
                     const scalar* wx, const scalar* wy, const scalar* wz)
                 {
                     const scalar* p = v.first[d] + first;
                     scalar sum = 0;
                     for (int z = 0; z < n; ++z)
                     {
                         for (int y = 0; y < n; ++y)
                         {
                             const scalar* row = p + z * v.layer + y * v.row;
                             scalar part = 0;
                             for (int x = 0; x < n; ++x)
                             {
                                 part += wx[x] * row[x];
                             }
                             sum += wy[y] * wz[z] * part;
                         }
                     }
                     U[marker][d] += v.factor * sum;
                 });
}

void Foam::markerSet::gather(const List<staggeredView>& u,
                             UList<vector>& U) const
{
    U = vector(Zero);
    if (kernel_.nPoints() == 3)
        gatherWhole<3>(u, U);
    else
        gatherWhole<4>(u, U);

    for (const stencils& s : cut_)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const kernelStencil& sx = s.at[d != 0][0];
            for (const staggeredView& v : u)
            {
                scalar sum = 0;
                eachCutRow(s, d, v,
                           [&](const label row, const scalar weight)
                           {
                               const scalar* values = v.first[d] + row;
                               for (label i = 0; i < sx.size; ++i)
                               {
                                   sum +=
                                       weight * sx.weight[i] * values[sx.at[i]];
                               }
                           });
                U[s.marker][d] += v.factor * sum;
            }
        }
    }
}

template<int n>
void Foam::markerSet::scatterWhole(const UList<vector>& F,
                                   const staggeredView& perVolume,
                                   staggeredField& f) const
{
    eachWhole<n>({perVolume},
                 [&](const label marker, const direction d,
                     const staggeredView& v, const label first,
                     const scalar* wx, const scalar* wy, const scalar* wz)
                 {
                     scalar* p = f[d].data() + first;
                     const scalar value = v.factor * F[marker][d];
                     for (int z = 0; z < n; ++z)
                     {
                         for (int y = 0; y < n; ++y)
                         {
                             scalar* row = p + z * v.layer + y * v.row;
                             const scalar weight = value * wy[y] * wz[z];
                             for (int x = 0; x < n; ++x)
                             {
                                 row[x] += weight * wx[x];
                             }
                         }
                     }
                 });
}

void Foam::markerSet::scatter(const UList<vector>& F, staggeredField& f) const
{
    const staggeredView perVolume(f, 1 / grid_.cellVolume());
    if (kernel_.nPoints() == 3)
        scatterWhole<3>(F, perVolume, f);
    else
        scatterWhole<4>(F, perVolume, f);

    for (const stencils& s : cut_)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const kernelStencil& sx = s.at[d != 0][0];
            const scalar value = perVolume.factor * F[s.marker][d];
            eachCutRow(s, d, perVolume,
                       [&](const label row, const scalar weight)
                       {
                           scalar* values = f[d].data() + row;
                           for (label i = 0; i < sx.size; ++i)
                           {
                               values[sx.at[i]] +=
                                   value * weight * sx.weight[i];
                           }
                       });
        }
    }
}
