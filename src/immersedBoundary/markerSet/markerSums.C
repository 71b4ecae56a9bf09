// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Grid points of markers in the block of this rank, and sums over them

#include "markerSet.H"

namespace
{
//- Four consecutive values at any address, as one vector of the compiler (GCC and Clang)
typedef double fourValues
    __attribute__((vector_size(32), aligned(8), may_alias));

inline const fourValues& fourAt(const double* p)
{
    return *reinterpret_cast<const fourValues*>(p);
}
inline fourValues& fourAt(double* p)
{
    return *reinterpret_cast<fourValues*>(p);
}
} // namespace

//- Weights of up to n consecutive markers of sorted_, for six sets of grid points: faces in
//  the three directions, then cell centres in the three directions. For each marker its
//  position [cells], the index of the first of four points in the box, and four weights.
//  Computed where they are used, as loading them from memory takes longer
struct Foam::markerSet::weightBatch
{
    static constexpr label n = 128;

    // Alignment decides where the compiler's vector loops begin, and so the last bit of the
    // weights: fixed, so that results can be repeated
    alignas(64) scalar position[6][n];
    alignas(64) scalar lowest[6][n];
    alignas(64) scalar weight[4][6][n];

    weightBatch(const markerSet& markers, const label begin, const label size)
    {
        const label all = (size + 7) / 8 * 8; // whole vectors on any machine
        for (direction d = 0; d < 3; ++d)
        {
            for (label k = 0; k < all; ++k)
            {
                const scalar x =
                    markers.positions_[begin + min(k, size - 1)][d];
                position[d][k] = x;
                position[d + 3][k] = x - 0.5;
            }
        }
        for (int i = 0; i < 6; ++i)
        {
            scalar* const w[4] = {weight[0][i], weight[1][i], weight[2][i],
                                  weight[3][i]};
            markers.kernel_.weights(all, position[i], lowest[i], w);
        }
    }

    //- Shift the four points of clipped markers into the block. Weights stay with their
    //  points; the weights of points outside are dropped
    void clip(const markerSet& markers, const label size)
    {
        for (int i = 0; i < 6; ++i)
        {
            const direction d = i % 3;
            const label first = markers.grid_.box().lo[d],
                        last = first + markers.grid_.box().size[d] -
                               markers.rowSize(d);
            for (label k = 0; k < size; ++k)
            {
                const label index = label(lowest[i][k]),
                            shifted = max(first, min(index, last));
                if (shifted == index) continue;
                const scalar w[4] = {weight[0][i][k], weight[1][i][k],
                                     weight[2][i][k], weight[3][i][k]};
                for (label j = 0; j < 4; ++j)
                {
                    const label from = j + shifted - index;
                    weight[j][i][k] = from >= 0 && from < 4 ? w[from] : 0;
                }
                lowest[i][k] = shifted;
            }
        }
    }
};

//- Grid points of a cut marker: four indices within the block and their weights for each of
//  the six sets; weight 0 for a point that is not in the block
struct Foam::markerSet::cutMarker
{
    label index[6][4];
    scalar weight[6][4];
};

//- Rows of a cut marker for one component: four points along x, their weights, true if the
//  points are consecutive; offsets and weights of the rows
struct Foam::markerSet::cutRows
{
    const label* x;
    const scalar* weightX;
    bool inLine;
    int count;
    std::ptrdiff_t offset[17];
    scalar weight[17];
};

void Foam::markerSet::cut(const weightBatch& w, const label marker,
                          cutMarker& c) const
{
    const label nPoints = kernel_.nPoints();
    for (int i = 0; i < 6; ++i)
    {
        const direction d = i % 3;
        const label n = grid_.n()[d], lowest = label(w.lowest[i][marker]);
        const label least = i < 3 ? 1 : 0;
        kernelStencil s;
        if (grid_.periodic(d) || (lowest >= least && lowest + nPoints <= n))
        {
            s.size = nPoints;
            for (label k = 0; k < nPoints; ++k)
            {
                const label index = lowest + k;
                s.index[k] = (index % n + n) % n;
                s.weight[k] = w.weight[k][i][marker];
            }
        }
        else
        {
            kernel_.stencil(w.position[d][marker], i < 3 ? 0 : 0.5, least,
                            n - 1, n, false, s);
        }
        for (label k = 0; k < 4; ++k)
        {
            // Indices relative to the block of this rank. A point without weight is put
            // after the one before, so that the row can be loaded as one vector
            const bool exists = k < s.size;
            const label index = exists   ? s.index[k] - grid_.box().lo[d]
                                : k == 0 ? 0
                                         : c.index[i][k - 1] + 1;
            const bool inBlock = index >= 0 && index < grid_.box().size[d];
            c.index[i][k] = inBlock ? index : 0;
            c.weight[i][k] = inBlock && exists ? s.weight[k] : 0;
        }
    }
}

// ---- sums over the grid points of this rank

// Call visit(marker, component, first point, strides to the next row and layer, factor of
// the field, weights along x, y and z) for whole or clipped markers. Both ends of each row
// are prefetched eight markers ahead, as the rows are scattered in memory
template<int n, class Fields, class Visit>
void Foam::markerSet::eachWhole(const List<Fields>& fields, const label begin,
                                const label end, Visit visit) const
{
    if (fields.empty()) return;
    const label ahead = 3 * 8, most = weightBatch::n;
    for (label b = begin; b < end; b += most)
    {
        const label size = min(most, end - b);
        weightBatch w(*this, b, size);
        if (begin >= nWhole_) w.clip(*this, size);
        for (const Fields& v : fields)
        {
            const std::ptrdiff_t row = v.row, layer = v.layer;
            const labelVector& lo = grid_.box().lo;
            typename std::decay<decltype(v.first[0])>::type first[3 * most];
            for (direction d = 0; d < 3; ++d)
            {
                const scalar *x = w.lowest[d == 0 ? 0 : 3],
                             *y = w.lowest[d == 1 ? 1 : 4],
                             *z = w.lowest[d == 2 ? 2 : 5];
                for (label k = 0; k < size; ++k)
                {
                    first[3 * k + d] = v.first[d] + label(x[k]) - lo.x() +
                                       row * (label(y[k]) - lo.y()) +
                                       layer * (label(z[k]) - lo.z());
                }
            }

            // Inlined by force: the compiler removes calls that only prefetch
            const auto fetch = [&](const label m) __attribute__((always_inline))
            {
                if (m >= 3 * size) return;
                const scalar* p = first[m];
                for (int j = 0; j < n; ++j, p += layer)
                {
                    for (int i = 0; i < n; ++i)
                    {
                        __builtin_prefetch(p + i * row);
                        __builtin_prefetch(p + i * row + 3);
                    }
                }
            };
            for (label m = 0; m < ahead; ++m)
            {
                fetch(m);
            }
            for (label k = 0; k < size; ++k)
            {
#pragma GCC unroll 3
                for (direction d = 0; d < 3; ++d)
                {
                    const int x = d == 0 ? 0 : 3, y = d == 1 ? 1 : 4,
                              z = d == 2 ? 2 : 5;
                    const label m = 3 * k + d;
                    fetch(m + ahead);
                    const fourValues wx = {w.weight[0][x][k], w.weight[1][x][k],
                                           w.weight[2][x][k],
                                           w.weight[3][x][k]};
                    scalar wy[n], wz[n];
                    for (int j = 0; j < n; ++j)
                    {
                        wy[j] = w.weight[j][y][k];
                        wz[j] = w.weight[j][z][k];
                    }
                    visit(sorted_[b + k], d, first[m], row, layer, v.factor, wx,
                          wy, wz);
                }
            }
        }
    }
}

// Call visit(marker, component, first point of the field, rows, factor of the field) for all
// cut markers
template<int n, class Fields, class Visit>
void Foam::markerSet::eachCut(const List<Fields>& fields, Visit visit) const
{
    if (fields.empty()) return;
    const label all = label(sorted_.size());
    for (label b = nWhole_ + nClipped_; b < all; b += weightBatch::n)
    {
        const label size = min(weightBatch::n, all - b);
        const weightBatch w(*this, b, size);
        for (label i = 0; i < size; ++i)
        {
            cutMarker c;
            cut(w, i, c);
            for (direction d = 0; d < 3; ++d)
            {
                const int x = d == 0 ? 0 : 3, y = d == 1 ? 1 : 4,
                          z = d == 2 ? 2 : 5;
                cutRows rows;
                rows.x = c.index[x];
                rows.weightX = c.weight[x];
                rows.inLine = c.index[x][3] == c.index[x][0] + 3;
                for (const Fields& v : fields)
                {
                    const std::ptrdiff_t row = v.row, layer = v.layer;
                    rows.count = 0;
                    for (int j = 0; j < n * n; ++j)
                    {
                        const int k = j / n, l = j % n;
                        rows.offset[rows.count] =
                            row * c.index[y][l] + layer * c.index[z][k];
                        rows.weight[rows.count] =
                            c.weight[y][l] * c.weight[z][k];
                        rows.count += rows.weight[rows.count] != 0;
                    }
                    visit(sorted_[b + i], d, v.first[d], rows, v.factor);
                }
            }
        }
    }
}

template<int n>
void Foam::markerSet::gatherWhole(const List<staggeredView>& u,
                                  const label begin, const label end,
                                  UList<vector>& U) const
{
    eachWhole<n>(u, begin, end,
                 [&](const label marker, const direction d, const scalar* p,
                     const std::ptrdiff_t row, const std::ptrdiff_t layer,
                     const scalar factor, const fourValues& wx,
                     const scalar* wy, const scalar* wz)
                 {
                     fourValues sum = {};
                     for (int z = 0; z < n; ++z, p += layer)
                     {
                         fourValues ofLayer = wy[0] * fourAt(p);
                         for (int y = 1; y < n; ++y)
                         {
                             ofLayer += wy[y] * fourAt(p + y * row);
                         }
                         sum += wz[z] * ofLayer;
                     }
                     sum *= wx;
                     U[marker][d] +=
                         factor * (sum[0] + sum[1] + sum[2] + sum[3]);
                 });
}

template<int n>
void Foam::markerSet::gatherCut(const List<staggeredView>& u,
                                UList<vector>& U) const
{
    eachCut<n>(u,
               [&](const label marker, const direction d, const scalar* first,
                   const cutRows& rows, const scalar factor)
               {
                   fourValues sum = {};
                   for (int j = 0; j < rows.count; ++j)
                   {
                       const scalar* p = first + rows.offset[j];
                       const label* x = rows.x;
                       sum += rows.weight[j] *
                              (rows.inLine ? fourAt(p + x[0])
                                           : fourValues{p[x[0]], p[x[1]],
                                                        p[x[2]], p[x[3]]});
                   }
                   sum *= fourAt(rows.weightX);
                   U[marker][d] += factor * (sum[0] + sum[1] + sum[2] + sum[3]);
               });
}

template<int n>
void Foam::markerSet::scatterWhole(const UList<vector>& F,
                                   const List<staggeredTarget>& f,
                                   const label begin, const label end) const
{
    eachWhole<n>(f, begin, end,
                 [&](const label marker, const direction d, scalar* p,
                     const std::ptrdiff_t row, const std::ptrdiff_t layer,
                     const scalar factor, const fourValues& wx,
                     const scalar* wy, const scalar* wz)
                 {
                     const fourValues value = factor * F[marker][d] * wx;
                     for (int z = 0; z < n; ++z, p += layer)
                     {
                         const fourValues ofLayer = wz[z] * value;
                         for (int y = 0; y < n; ++y)
                         {
                             fourAt(p + y * row) += wy[y] * ofLayer;
                         }
                     }
                 });
}

template<int n>
void Foam::markerSet::scatterCut(const UList<vector>& F,
                                 const List<staggeredTarget>& f) const
{
    eachCut<n>(f,
               [&](const label marker, const direction d, scalar* first,
                   const cutRows& rows, const scalar factor)
               {
                   const fourValues value =
                       factor * F[marker][d] * fourAt(rows.weightX);
                   for (int j = 0; j < rows.count; ++j)
                   {
                       scalar* p = first + rows.offset[j];
                       const fourValues values = rows.weight[j] * value;
                       if (rows.inLine)
                       {
                           fourAt(p + rows.x[0]) += values;
                           continue;
                       }
                       for (int k = 0; k < 4; ++k)
                       {
                           p[rows.x[k]] += values[k];
                       }
                   }
               });
}

// A sweep begins where the pass before it ended, as these cells may still be cached. The
// explicit terms of the flow go from low to high layers; so interpolation goes from high to
// low, and spreading alone, which follows it, from low to high.
//
// Markers reach two layers of cells down and up. Markers of every other layer of bunches
// share no point, so values are taken one layer of bunches behind the forces. Clipped and
// cut markers are not sorted: their forces come first, their values last
template<int n>
void Foam::markerSet::sweepAll(const UList<vector>& F,
                               const List<staggeredTarget>& f,
                               const List<staggeredView>& u,
                               UList<vector>& U) const
{
    static_assert(bunch_ >= 4, "forces come after values");
    const auto layerOf = [&](const label k)
    { return layerOfBunches(positions_[k]); };
    const label all = nWhole_ + nClipped_;
    scatterCut<n>(F, f);
    scatterWhole<n>(F, f, nWhole_, all);
    if (u.empty())
    {
        scatterWhole<n>(F, f, 0, nWhole_);
        return;
    }
    label gathered = nWhole_;
    for (label end = nWhole_, begin = end; end > 0; end = begin)
    {
        while (begin > 0 && layerOf(begin - 1) == layerOf(end - 1))
            --begin;
        scatterWhole<n>(F, f, begin, end);
        gatherWhole<n>(u, end, gathered, U);
        gathered = end;
    }
    gatherWhole<n>(u, 0, gathered, U);
    gatherWhole<n>(u, nWhole_, all, U);
    gatherCut<n>(u, U);
}

void Foam::markerSet::sweep(const UList<vector>& F,
                            const List<staggeredTarget>& f,
                            const List<staggeredView>& u,
                            UList<vector>& U) const
{
    List<staggeredTarget> perVolume(f);
    for (staggeredTarget& field : perVolume)
    {
        field.factor /= grid_.cellVolume();
    }
    U = vector(Zero);
    if (kernel_.nPoints() == 3)
        sweepAll<3>(F, perVolume, u, U);
    else
        sweepAll<4>(F, perVolume, u, U);
}
