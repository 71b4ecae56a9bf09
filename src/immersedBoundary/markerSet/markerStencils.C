// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The points that markers reach in the block of this rank, and sums over them

#include "markerSet.H"

namespace
{
//- Four values that lie next to each other anywhere in memory: one vector for the
//  compiler (GCC and Clang), of AVX or of two halves
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

//- Of a marker at faces in the three directions, then at centres in them: four points
//  that follow each other
struct Foam::markerSet::markerWeights
{
    scalar lowest[6]; //!< first points, counted through the box
    scalar weight[6][4];
};

Foam::markerSet::markerWeights Foam::markerSet::weightsAt(const vector& x) const
{
    scalar position[6];
    for (direction d = 0; d < 3; ++d)
    {
        scalar at = (x[d] - grid_.origin()[d]) / grid_.h()[d];
        if (grid_.periodic(d) && (at < 0 || at >= grid_.n()[d]))
        {
            at -= grid_.n()[d] * std::floor(at / grid_.n()[d]);
        }
        position[d] = at;
        position[d + 3] = at - 0.5;
    }
    markerWeights w;
    kernel_.weights<6>(position, w.lowest, w.weight);
    return w;
}

// All points of a marker in the block of this rank, as they stand in memory?
bool Foam::markerSet::makeWhole(const markerWeights& w, label* first,
                                scalar* weights) const
{
    for (int i = 0; i < 6; ++i)
    {
        const direction d = i % 3;
        const label lo = grid_.box().lo[d];

        // The faces of walls have their velocity from a boundary condition
        const label least = i < 3 && lo == 0 && !grid_.periodic(d) ? 1 : lo;
        const label last =
            lo + grid_.box().size[d] - (d == 0 ? 4 : kernel_.nPoints());
        if (!(w.lowest[i] >= least && w.lowest[i] <= last)) return false;
        first[i] = label(w.lowest[i]) - lo;
        std::copy_n(w.weight[i], 4, weights + 4 * i);
    }
    return true;
}

void Foam::markerSet::makeCut(const vector& x, const markerWeights& w,
                              cutMarker& c) const
{
    const label nPoints = kernel_.nPoints();
    for (int i = 0; i < 6; ++i)
    {
        const direction d = i % 3;
        const label n = grid_.n()[d], lowest = label(w.lowest[i]);
        const label least = i < 3 ? 1 : 0;
        kernelStencil s;
        if (grid_.periodic(d) || (lowest >= least && lowest + nPoints <= n))
        {
            s.size = nPoints;
            for (label k = 0; k < nPoints; ++k)
            {
                s.at[k] = (lowest + k + n) % n;
                s.weight[k] = w.weight[i][k];
            }
        }
        else
        {
            const scalar at = (x[d] - grid_.origin()[d]) / grid_.h()[d];
            kernel_.stencil(at, i < 3 ? 0 : 0.5, least, n - 1, n, false, s);
        }
        for (label k = 0; k < 4; ++k)
        {
            // Points of this rank only, counted within its block
            const label at = k < s.size ? s.at[k] - grid_.box().lo[d] : -1;
            const bool here = at >= 0 && at < grid_.box().size[d];
            c.at[i][k] = here ? at : 0;
            c.weight[i][k] = here ? s.weight[k] : 0;
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
    const label each = 24;
    whole_.clear();
    cut_.clear();
    wholeFirst_.resize(6 * X().size() + 6);
    wholeWeights_.resize(each * X().size() + each);
    if (X().empty()) return;

    for (const label k : alongMemory())
    {
        const markerWeights w(weightsAt(X()[k]));
        if (makeWhole(w, &wholeFirst_[6 * whole_.size()],
                      &wholeWeights_[each * whole_.size()]))
        {
            whole_.push_back(k);
        }
        else
        {
            cut_.emplace_back();
            cut_.back().marker = k;
            makeCut(X()[k], w, cut_.back());
        }
    }
}

// ---- sums over the points of this rank

// visit(marker, component, field, first point in the field's memory, weights along
// x, y and z) for some whole markers. Rows are fetched some markers ahead, as they
// lie all over memory
template<int n, class Places, class Visit>
void Foam::markerSet::eachWhole(const List<Places>& fields, const label begin,
                                const label end, Visit visit) const
{
    const label nWhole = whole_.size(), ahead = 6;
    const label* first = wholeFirst_.data() + 6 * begin;
    const auto firstPoint =
        [](const label* f, const direction d, const Places& v)
    {
        return f[d == 0 ? 0 : 3] + v.row * f[d == 1 ? 1 : 4] +
               v.layer * f[d == 2 ? 2 : 5];
    };
    for (label k = begin; k < end; ++k, first += 6)
    {
        if (k + ahead < nWhole)
        {
            for (const Places& v : fields)
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
                            __builtin_prefetch(p + 3 + z * v.layer + y * v.row);
                        }
                    }
                }
            }
        }
        const scalar* w = &wholeWeights_[24 * k];
        for (direction d = 0; d < 3; ++d)
        {
            const scalar* wx = w + 4 * (d == 0 ? 0 : 3);
            const scalar* wy = w + 4 * (d == 1 ? 1 : 4);
            const scalar* wz = w + 4 * (d == 2 ? 2 : 5);
            for (const Places& v : fields)
            {
                visit(whole_[k], d, v, firstPoint(first, d, v), wx, wy, wz);
            }
        }
    }
}

// visit(marker, component, field, its four points in a row, their weights, first
// point in the field's memory of the row, weight of the row) for all cut markers
template<class Places, class Visit>
void Foam::markerSet::eachCutRow(const List<Places>& fields, Visit visit) const
{
    const label n = kernel_.nPoints(), nCut = cut_.size(), ahead = 3;
    for (label i = 0; i < nCut; ++i)
    {
        const cutMarker& c = cut_[i];
        const cutMarker& next = cut_[min(i + ahead, nCut - 1)];
        for (direction d = 0; d < 3; ++d)
        {
            const int x = d == 0 ? 0 : 3, y = d == 1 ? 1 : 4,
                      z = d == 2 ? 2 : 5;
            for (const Places& v : fields)
            {
                for (label k = 0; k < n; ++k)
                {
                    for (label j = 0; j < n; ++j)
                    {
                        const scalar* coming = v.first[d] +
                                               v.row * next.at[y][j] +
                                               v.layer * next.at[z][k];
                        __builtin_prefetch(coming + next.at[x][0]);
                        __builtin_prefetch(coming + next.at[x][n - 1]);
                        const scalar ofRow = c.weight[y][j] * c.weight[z][k];
                        if (ofRow == 0) continue;
                        visit(c.marker, d, v, c.at[x], c.weight[x],
                              v.row * c.at[y][j] + v.layer * c.at[z][k], ofRow);
                    }
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
    eachWhole<n>(
        u, begin, end,
        [&](const label marker, const direction d, const staggeredView& v,
            const label first, const scalar* wx, const scalar* wy,
            const scalar* wz)
        {
            const scalar* p = v.first[d] + first;
            fourValues sum = {};
            for (int z = 0; z < n; ++z)
            {
                for (int y = 0; y < n; ++y)
                {
                    sum += wy[y] * wz[z] * fourAt(p + z * v.layer + y * v.row);
                }
            }
            sum *= fourAt(wx);
            U[marker][d] += v.factor * (sum[0] + sum[1] + sum[2] + sum[3]);
        });
}

void Foam::markerSet::gatherCut(const List<staggeredView>& u,
                                UList<vector>& U) const
{
    eachCutRow(u,
               [&](const label marker, const direction d,
                   const staggeredView& v, const label* at,
                   const scalar* weight, const label row, const scalar ofRow)
               {
                   const scalar* p = v.first[d] + row;
                   scalar sum = 0;
                   for (int k = 0; k < 4; ++k)
                   {
                       sum += weight[k] * p[at[k]];
                   }
                   U[marker][d] += v.factor * ofRow * sum;
               });
}

template<int n>
void Foam::markerSet::scatterWhole(const UList<vector>& F,
                                   const List<staggeredTarget>& f,
                                   const label begin, const label end) const
{
    eachWhole<n>(f, begin, end,
                 [&](const label marker, const direction d,
                     const staggeredTarget& f, const label first,
                     const scalar* wx, const scalar* wy, const scalar* wz)
                 {
                     scalar* p = f.first[d] + first;
                     const fourValues value =
                         f.factor * F[marker][d] * fourAt(wx);
                     for (int z = 0; z < n; ++z)
                     {
                         for (int y = 0; y < n; ++y)
                         {
                             fourAt(p + z * f.layer + y * f.row) +=
                                 wy[y] * wz[z] * value;
                         }
                     }
                 });
}

void Foam::markerSet::scatterCut(const UList<vector>& F,
                                 const List<staggeredTarget>& f) const
{
    eachCutRow(f,
               [&](const label marker, const direction d,
                   const staggeredTarget& f, const label* at,
                   const scalar* weight, const label row, const scalar ofRow)
               {
                   scalar* p = f.first[d] + row;
                   const scalar value = f.factor * ofRow * F[marker][d];
                   for (int k = 0; k < 4; ++k)
                   {
                       p[at[k]] += value * weight[k];
                   }
               });
}

// Markers of a layer of cells reach two layers down and up: values at a layer are
// complete when the forces of the third layer above have been added
template<int n>
void Foam::markerSet::sweep(const UList<vector>& F,
                            const List<staggeredTarget>& f,
                            const List<staggeredView>& u,
                            UList<vector>& U) const
{
    const auto layerOf = [&](const label k)
    { return grid_.cellAt(X()[whole_[k]].z(), 2); };
    const label all = whole_.size();
    label scattered = f.empty() ? all : 0, gathered = u.empty() ? all : 0;
    while (scattered < all)
    {
        const label layer = layerOf(scattered), begin = scattered;
        while (scattered < all && layerOf(scattered) == layer)
            ++scattered;
        scatterWhole<n>(F, f, begin, scattered);
        const label first = gathered;
        while (gathered < scattered && layerOf(gathered) < layer - 3)
            ++gathered;
        gatherWhole<n>(u, first, gathered, U);
    }
    gatherWhole<n>(u, gathered, all, U);
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
    scatterCut(F, perVolume);
    if (kernel_.nPoints() == 3)
        sweep<3>(F, perVolume, u, U);
    else
        sweep<4>(F, perVolume, u, U);
    gatherCut(u, U);
}
