// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Sums over the grid points of the markers in the block of this rank

#include "markerLoops.H"

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
            s = kernel_.stencil(w.position[d][marker], i < 3 ? 0 : 0.5, least,
                                n - 1);
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
