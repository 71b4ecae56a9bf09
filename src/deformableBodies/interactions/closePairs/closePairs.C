// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "closePairs.H"
#include "pointBins.H"
#include <algorithm>
#include <cmath>

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#include <Eigen/Core>

namespace
{
using namespace Foam;

using eight = Eigen::Array<double, closePairs::nParts, 1>;

//- Squares of distances by nearest images, of one or of eight
class nearestSquare
{
    vector length_, perLength_; // no images where it is 0

    static double nearest(const double x) { return std::rint(x); }
    static eight nearest(const eight& x) { return x.rint(); }

public:
    explicit nearestSquare(const uniformGrid& grid)
        : length_(grid.length()),
          perLength_(Zero)
    {
        for (direction d = 0; d < 3; ++d)
        {
            if (grid.periodic(d)) perLength_[d] = 1 / length_[d];
        }
    }

    template<class Number>
    Number operator()(Number x, Number y, Number z) const
    {
        x -= length_.x() * nearest(Number(x * perLength_.x()));
        y -= length_.y() * nearest(Number(y * perLength_.y()));
        z -= length_.z() * nearest(Number(z * perLength_.z()));
        return x * x + y * y + z * z;
    }
};

//- visit(i, j) of the parts of two clusters whose spheres are within range
template<class Cluster, class Visit>
void eachNear(const Cluster& p, const Cluster& q, const double range,
              const nearestSquare& square, Visit visit)
{
    const auto all = [](const double* values)
    { return Eigen::Map<const eight>(values); };
    // What they are too far apart by: those of p and all of q, then one and each of q
    const eight beyondAll(square(eight(all(p.x[0]) - q.centre.x()),
                                 eight(all(p.x[1]) - q.centre.y()),
                                 eight(all(p.x[2]) - q.centre.z())) -
                          (range + all(p.r) + q.radius).square());
    for (label i = 0; i < p.size; ++i)
    {
        if (!(beyondAll[i] < 0)) continue;
        const eight beyond(square(eight(p.x[0][i] - all(q.x[0])),
                                  eight(p.x[1][i] - all(q.x[1])),
                                  eight(p.x[2][i] - all(q.x[2]))) -
                           (range + p.r[i] + all(q.r)).square());
        if (!(beyond.minCoeff() < 0)) continue;
        for (label j = 0; j < q.size; ++j)
        {
            if (beyond[j] < 0) visit(i, j);
        }
    }
}

//- Order points so that their halves, of whole regions and patches, lie apart
void halve(const UList<vector>& X, label* begin, label* end)
{
    const label n = end - begin, patch = closePairs::nParts;
    if (n <= patch) return;
    vector lo(vector::uniform(GREAT)), hi(-lo);
    for (const label* k = begin; k < end; ++k)
    {
        lo = min(lo, X[*k]);
        hi = max(hi, X[*k]);
    }
    direction widest = 0;
    for (direction d = 1; d < 3; ++d)
    {
        if (hi[d] - lo[d] > hi[widest] - lo[widest]) widest = d;
    }
    const label whole = n > patch * patch ? patch * patch : patch;
    label* middle = begin + ((n - 1) / whole + 1) / 2 * whole;
    const auto before = [&](const label a, const label b)
    {
        return X[a][widest] < X[b][widest] ||
               (X[a][widest] == X[b][widest] && a < b);
    };
    std::nth_element(begin, middle, end, before);
    halve(X, begin, middle);
    halve(X, middle, end);
}
} // namespace

Foam::labelList Foam::patchOrder(const UList<vector>& X)
{
    labelList order(identity(X.size()));
    halve(X, order.begin(), order.end());
    return order;
}

Foam::closePairs::closePairs(const uniformGrid& grid, const scalar range)
    : grid_(grid),
      range_(range),
      neighbours_(grid),
      copies_(neighbours_)
{
}

Foam::closePairs::cluster::cluster(const label start, const label n,
                                   const vector* X, const label number,
                                   const bool folds, const bool isHeld)
    : first(start),
      size(n),
      body(number),
      mayFold(folds),
      held(isHeld)
{
    for (label k = 0; k < nParts; ++k)
    {
        const vector& at = X[min(k, n - 1)];
        r[k] = 0;
        for (direction d = 0; d < 3; ++d)
        {
            x[d][k] = at[d];
        }
    }
    enclose();
}

Foam::closePairs::cluster::cluster(const label start, const label n,
                                   const cluster* patches)
    : first(start),
      size(n),
      body(patches->body),
      mayFold(patches->mayFold),
      held(true)
{
    for (label k = 0; k < nParts; ++k)
    {
        const cluster& p = patches[min(k, n - 1)];
        r[k] = p.radius;
        for (direction d = 0; d < 3; ++d)
        {
            x[d][k] = p.centre[d];
        }
    }
    enclose();
}

void Foam::closePairs::cluster::enclose()
{
    for (direction d = 0; d < 3; ++d)
    {
        centre[d] = 0.5 * (*std::min_element(x[d], x[d] + nParts) +
                           *std::max_element(x[d], x[d] + nParts));
    }
    radius = 0;
    for (label k = 0; k < nParts; ++k)
    {
        const vector off(x[0][k], x[1][k], x[2][k]);
        radius = max(radius, mag(off - centre) + r[k]);
    }
}

void Foam::closePairs::makePatches(const UList<vector>& X,
                                   const labelUList& body,
                                   const UList<scalar>& along)
{
    X_ = X;
    body_ = body;
    along_ = along;
    patches_.clear();
    for (label k = 0, n; k < X.size(); k += n)
    {
        n = 1;
        while (n < nParts && k + n < X.size() && body[k + n] == body[k])
            ++n;
        patches_.emplace_back(k, n, &X[k], body[k],
                              along_.size() && along_[k] >= 0, true);
    }
}

void Foam::closePairs::exchangePatches()
{
    // Of each place and place along the body of its points, body, number of points
    const label nNumbers = 4 * nParts + 2;
    vectorField centres(patches_.size());
    scalarField numbers(nNumbers * patches_.size(), Zero);
    ownSizes_.setSize(patches_.size());
    scalar* to = numbers.data();
    forAll(centres, i)
    {
        const cluster& p = patches_[i];
        centres[i] = p.centre;
        ownSizes_[i] = p.size;
        for (label k = p.first; k < p.first + p.size; ++k)
        {
            const scalar* const x = X_[k].cdata();
            to[4 * (k - p.first) + 3] = along_.size() ? along_[k] : -1;
            std::copy(x, x + 3, to + 4 * (k - p.first));
        }
        to += nNumbers;
        to[-2] = p.body;
        to[-1] = p.size;
    }
    reduce(largest_, maxOp<scalar>());
    copies_.place(centres, grid_.layersWithin(range_ + 2 * largest_));
    const scalarField here(copies_.handOut(numbers.cdata(), nNumbers));

    patches_.clear();
    DynamicList<vector> X(nParts * copies_.here().size());
    DynamicList<label> body(X.capacity());
    DynamicList<scalar> along(X.capacity());
    forAll(copies_.here(), i)
    {
        const scalar* const from = &here[nNumbers * i];
        const label first = X.size(), n = label(from[nNumbers - 1]);
        for (label k = 0; k < n; ++k)
        {
            X.append(vector(from[4 * k], from[4 * k + 1], from[4 * k + 2]));
            along.append(from[4 * k + 3]);
            body.append(label(from[nNumbers - 2]));
        }
        patches_.emplace_back(first, n, &X[first], body[first],
                              along[first] >= 0, copies_.holds(i));
    }
    X_ = X;
    body_ = body;
    along_ = along;
}

void Foam::closePairs::search(const UList<vector>& X, const labelUList& body,
                              const UList<scalar>& along, const scalar apart)
{
    makePatches(X, body, along);
    largest_ = 0;
    for (const cluster& p : patches_)
    {
        largest_ = max(largest_, p.radius);
    }
    if (Pstream::parRun()) exchangePatches();
    patchOf_.setSize(X_.size());
    pairs_.clear();
    for (size_t i = 0; i < patches_.size(); ++i)
    {
        const cluster& p = patches_[i];
        std::fill_n(patchOf_.begin() + p.first, p.size, label(i));
    }

    regions_.clear();
    scalar reach = range_;
    for (size_t i = 0, n; i < patches_.size(); i += n)
    {
        n = 1;
        while (n < nParts && i + n < patches_.size() &&
               patches_[i + n].body == patches_[i].body)
            ++n;
        regions_.emplace_back(label(i), label(n), &patches_[i]);
        reach = max(reach, range_ + 2 * regions_.back().radius);
    }

    // Their spheres in the order of their bins
    struct sphere
    {
        vector centre;
        scalar radius;
        label body, number;
    };
    const label nRegions = regions_.size();
    const pointBins bins(grid_, reach, nRegions);
    labelList bin(nRegions), begin(bins.count() + 1, Zero);
    for (label i = 0; i < nRegions; ++i)
    {
        bin[i] = bins.numberOf(regions_[i].centre);
        ++begin[bin[i] + 1];
    }
    for (label b = 0; b < bins.count(); ++b)
    {
        begin[b + 1] += begin[b];
    }
    std::vector<sphere> sorted(nRegions);
    labelList next(begin);
    for (label i = 0; i < nRegions; ++i)
    {
        const cluster& p = regions_[i];
        sorted[next[bin[i]]++] = {p.centre, p.radius, p.body, i};
    }

    // Each with those in its bin and next to it, each two once
    const nearestSquare square(grid_);
    for (label i = 0; i < nRegions; ++i)
    {
        const cluster& p = regions_[i];
        const auto compareWith = [&](const label other)
        {
            if (other < bin[i]) return;
            for (label s = begin[other]; s < begin[other + 1]; ++s)
            {
                const sphere& q = sorted[s];
                if ((other == bin[i] && q.number < i) ||
                    (q.body == p.body && !p.mayFold) ||
                    (q.body < 0 && p.body < 0))
                {
                    continue;
                }
                const vector r(p.centre - q.centre);
                if (square(r.x(), r.y(), r.z()) <
                    sqr(range_ + p.radius + q.radius))
                {
                    compareRegions(p, regions_[q.number], apart);
                }
            }
        };
        bins.eachNext(bin[i], compareWith);
    }
}

void Foam::closePairs::compareRegions(const cluster& p, const cluster& q,
                                      const scalar apart)
{
    eachNear(p, q, range_, nearestSquare(grid_),
             [&](const label i, const label j)
             {
                 const label a = p.first + i, b = q.first + j;
                 if (&p == &q && b <= a) return;
                 if (patches_[a].held)
                     comparePatches(patches_[a], patches_[b], apart);
                 else if (patches_[b].held)
                     comparePatches(patches_[b], patches_[a], apart);
             });
}

void Foam::closePairs::comparePatches(const cluster& p, const cluster& q,
                                      const scalar apart)
{
    eachNear(
        p, q, range_, nearestSquare(grid_),
        [&](const label i, const label j)
        {
            const label a = p.first + i, b = q.first + j;
            if (p.body == q.body && mag(along_[a] - along_[b]) <= apart)
            {
                return;
            }
            pairs_.push_back({a, b, q.held, nearestImage(grid_, X_[a], X_[b])});
        });
}

Foam::scalarField Foam::closePairs::handOut(const scalar* own,
                                            const label n) const
{
    if (!Pstream::parRun())
        return scalarField(
            UList<scalar>(const_cast<scalar*>(own), n * X_.size()));
    const label full = nParts * n;
    scalarField numbers(full * ownSizes_.size(), Zero);
    forAll(ownSizes_, i)
    {
        const label size = n * ownSizes_[i];
        std::copy(own, own + size, &numbers[full * i]);
        own += size;
    }
    const scalarField all(copies_.handOut(numbers.cdata(), full));
    scalarField here(n * X_.size());
    for (size_t i = 0; i < patches_.size(); ++i)
    {
        std::copy_n(&all[full * i], n * patches_[i].size,
                    &here[n * patches_[i].first]);
    }
    return here;
}

void Foam::closePairs::addUp(const UList<scalar>& here, const label n,
                             scalar* own) const
{
    if (!Pstream::parRun())
    {
        forAll(here, k)
        {
            own[k] += here[k];
        }
        return;
    }
    const label full = nParts * n;
    scalarField all(full * patches_.size(), Zero),
        numbers(full * ownSizes_.size(), Zero);
    for (size_t i = 0; i < patches_.size(); ++i)
    {
        std::copy_n(&here[n * patches_[i].first], n * patches_[i].size,
                    &all[full * i]);
    }
    copies_.addUp(all, full, numbers.data());
    forAll(ownSizes_, i)
    {
        for (label k = 0; k < n * ownSizes_[i]; ++k)
        {
            *own++ += numbers[full * i + k];
        }
    }
}
