// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "immersedBoundary.H"
#include "indexExchange.H"
#include "PstreamBuffers.H"
#include <algorithm>
#include <utility>
#include <vector>

Foam::immersedBoundary::immersedBoundary(const uniformGrid& grid,
                                         const deltaKernel& kernel)
    : grid_(grid),
      kernel_(kernel),
      boxes_(grid.allBoxes())
{
}

void Foam::immersedBoundary::locate(const vector& X, marker& m) const
{
    m.whole = kernel_.nPoints();
    for (direction d = 0; d < 3; ++d)
    {
        const label n = grid_.n()[d];
        const bool periodic = grid_.periodic(d);
        const scalar x = (X[d] - grid_.origin()[d]) / grid_.h()[d];

        // The faces of walls have their velocity from a boundary condition
        kernel_.stencil(x, 0, 1, n - 1, n, periodic, m.face[d]);
        kernel_.stencil(x, 0.5, 0, n - 1, n, periodic, m.centre[d]);

        // Points of this rank only, numbered within its box: all of them where no
        // other rank has any of this direction
        for (kernelStencil* s : {&m.face[d], &m.centre[d]})
        {
            label kept = grid_.box().size[d] == n ? s->size : 0;
            for (label k = kept; k < s->size; ++k)
            {
                const label i = s->at[k] - grid_.box().lo[d];
                if (i >= 0 && i < grid_.box().size[d])
                {
                    s->at[kept] = i;
                    s->weight[kept] = s->weight[k];
                    ++kept;
                }
            }
            s->size = kept;
            if (kept != m.whole) m.whole = 0;
        }
    }
}

bool Foam::immersedBoundary::reaches(const boundBox& bounds,
                                     const cellBox& box) const
{
    for (direction d = 0; d < 3; ++d)
    {
        const scalar h = grid_.h()[d], margin = kernel_.reach() + 1;
        const scalar lo = (bounds.min()[d] - grid_.origin()[d]) / h - margin;
        const scalar hi = (bounds.max()[d] - grid_.origin()[d]) / h + margin;
        const label n = grid_.n()[d];

        // Some image of the box between lo and hi?
        bool hit = false;
        const label first =
            grid_.periodic(d) ? label(std::floor((lo - n) / n)) : 0;
        const label last = grid_.periodic(d) ? label(std::ceil(hi / n)) : 0;
        for (label image = first; image <= last && !hit; ++image)
        {
            const scalar begin = box.lo[d] + image * n;
            hit = begin <= hi && begin + box.size[d] >= lo;
        }
        if (!hit) return false;
    }
    return box.count() > 0;
}

Foam::List<Foam::labelList>
Foam::immersedBoundary::route(const vectorField& X) const
{
    // Neighbours in the list are neighbours in space: decide for the group
    // first, so that far ranks cost nothing per marker
    const label group = 64;
    List<DynamicList<label>> to(Pstream::nProcs());
    for (label begin = 0; begin < X.size(); begin += group)
    {
        const label size = min(group, X.size() - begin);
        const boundBox bounds(SubField<vector>(X, size, begin), false);
        forAll(boxes_, proci)
        {
            if (!reaches(bounds, boxes_[proci])) continue;
            for (label k = begin; k < begin + size; ++k)
            {
                if (reaches(boundBox(X[k], X[k]), boxes_[proci]))
                {
                    to[proci].append(k);
                }
            }
        }
    }
    List<labelList> lists(Pstream::nProcs());
    forAll(lists, proci)
    {
        lists[proci].transfer(to[proci]);
    }
    return lists;
}

// visit(first value of a row along x, weight of the row) for the points of
// component d around a marker
template<class Number, class Visit>
void Foam::immersedBoundary::rows(const marker& m, const Number n,
                                  const direction d, const staggeredView& at,
                                  Visit visit)
{
    const kernelStencil& sy = d == 1 ? m.face[1] : m.centre[1];
    const kernelStencil& sz = d == 2 ? m.face[2] : m.centre[2];
    for (label k = 0; k < count(sz, n); ++k)
    {
        for (label j = 0; j < count(sy, n); ++j)
        {
            visit(at.row * sy.at[j] + at.layer * sz.at[k],
                  sy.weight[j] * sz.weight[k]);
        }
    }
}

// In bunches of neighbours in the list, from low z to high: what one bunch has
// fetched others find in the cache. Rows are fetched ahead of the sums, as they lie
// all over memory
template<class Visit>
void Foam::immersedBoundary::eachMarker(const vectorField& X,
                                        const List<staggeredView>& fields,
                                        Visit visit) const
{
    constexpr label size = 4;
    std::vector<std::pair<scalar, label>> bunches;
    for (label first = 0; first < X.size(); first += size)
    {
        bunches.emplace_back(X[first].z(), first);
    }
    std::sort(bunches.begin(), bunches.end());

    marker m[size];
    for (const auto& bunch : bunches)
    {
        const label first = bunch.second, n = min(size, X.size() - first);
        for (label k = 0; k < n; ++k)
        {
            locate(X[first + k], m[k]);
            for (const staggeredView& field : fields)
            {
                for (direction d = 0; d < 3; ++d)
                {
                    const scalar* values = field.first[d] + m[k].x(d).at[0];
                    rows(m[k], cut(), d, field,
                         [&](const label row, scalar)
                         { __builtin_prefetch(values + row); });
                }
            }
        }
        for (label k = 0; k < n; ++k)
        {
            if (m[k].whole == 3)
                visit(first + k, m[k], std::integral_constant<label, 3>());
            else if (m[k].whole == 4)
                visit(first + k, m[k], std::integral_constant<label, 4>());
            else
                visit(first + k, m[k], cut());
        }
    }
}

void Foam::immersedBoundary::gather(const vectorField& X,
                                    const List<staggeredView>& u,
                                    vectorField& U) const
{
    const auto visit = [&](const label markeri, const marker& m, const auto n)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const kernelStencil& sx = m.x(d);
            U[markeri][d] = 0;
            for (const staggeredView& v : u)
            {
                const scalar* values = v.first[d];
                scalar sum = 0;
                rows(m, n, d, v,
                     [&](const label row, const scalar weight)
                     {
                         scalar part = 0;
                         for (label i = 0; i < count(sx, n); ++i)
                         {
                             part += sx.weight[i] * values[row + sx.at[i]];
                         }
                         sum += weight * part;
                     });
                U[markeri][d] += v.factor * sum;
            }
        }
    };
    eachMarker(X, u, visit);
}

void Foam::immersedBoundary::scatter(const vectorField& X, const vectorField& F,
                                     staggeredField& f) const
{
    const scalar perVolume = 1 / grid_.cellVolume();
    const auto visit = [&](const label markeri, const marker& m, const auto n)
    {
        for (direction d = 0; d < 3; ++d)
        {
            const kernelStencil& sx = m.x(d);
            const scalar density = F[markeri][d] * perVolume;
            scalar* values = f[d].data();
            rows(m, n, d, f,
                 [&](const label row, const scalar weight)
                 {
                     for (label i = 0; i < count(sx, n); ++i)
                     {
                         values[row + sx.at[i]] +=
                             density * weight * sx.weight[i];
                     }
                 });
        }
    };
    eachMarker(X, {f}, visit);
}

void Foam::immersedBoundary::interpolate(const vectorField& X,
                                         const List<staggeredView>& u,
                                         vectorField& U) const
{
    U.setSize(X.size());
    if (!Pstream::parRun())
    {
        gather(X, u, U);
        return;
    }

    const List<labelList> to(route(X));
    PstreamBuffers ask(Pstream::commsTypes::nonBlocking);
    forAll(to, proci)
    {
        if (to[proci].size())
        {
            UOPstream os(proci, ask);
            os << vectorField(X, to[proci]);
            indexExchange::count(to[proci].size() * sizeof(vector));
        }
    }
    labelList bytes;
    ask.finishedSends(bytes);

    PstreamBuffers answer(Pstream::commsTypes::nonBlocking);
    forAll(bytes, proci)
    {
        if (bytes[proci])
        {
            UIPstream is(proci, ask);
            const vectorField theirX(is);
            vectorField theirU(theirX.size());
            gather(theirX, u, theirU);
            UOPstream os(proci, answer);
            os << theirU;
            indexExchange::count(theirU.size() * sizeof(vector));
        }
    }
    answer.finishedSends();

    // Partial sums in the order of the ranks: reproducible
    U = Zero;
    forAll(to, proci)
    {
        if (to[proci].size())
        {
            UIPstream is(proci, answer);
            const vectorField part(is);
            forAll(part, k)
            {
                U[to[proci][k]] += part[k];
            }
        }
    }
}

void Foam::immersedBoundary::spread(const vectorField& X, const vectorField& F,
                                    staggeredField& f) const
{
    if (!Pstream::parRun())
    {
        scatter(X, F, f);
        return;
    }

    const List<labelList> to(route(X));
    PstreamBuffers buffers(Pstream::commsTypes::nonBlocking);
    forAll(to, proci)
    {
        if (to[proci].size())
        {
            UOPstream os(proci, buffers);
            os << vectorField(X, to[proci]) << vectorField(F, to[proci]);
            indexExchange::count(2 * to[proci].size() * sizeof(vector));
        }
    }
    labelList bytes;
    buffers.finishedSends(bytes);
    forAll(bytes, proci)
    {
        if (bytes[proci])
        {
            UIPstream is(proci, buffers);
            const vectorField theirX(is), theirF(is);
            scatter(theirX, theirF, f);
        }
    }
}
