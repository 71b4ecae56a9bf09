// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "closePairs.H"
#include "pointBins.H"
#include <algorithm>
#include <cmath>

namespace
{
using namespace Foam;

//- Eight values that lie next to each other anywhere in memory, and whether something
//  holds of each (0 or -1): one vector for the compiler (GCC and Clang), of AVX or of
//  two halves
typedef float eight __attribute__((vector_size(32), aligned(4), may_alias));
typedef int eightFlags __attribute__((vector_size(32)));
static_assert(closePairs::nParts == 8, "parts of a cluster fill a vector");

inline const eight& eightAt(const float* values)
{
    return *reinterpret_cast<const eight*>(values);
}

//- Bit k: does number k of eight hold?
inline unsigned bitsOf(const eightFlags& flags)
{
    typedef long long fourPairs __attribute__((vector_size(32)));
    const eightFlags bit = {1, 2, 4, 8, 16, 32, 64, 128};
    const fourPairs p = reinterpret_cast<fourPairs>(flags & bit);
    const long long all = (p[0] | p[1]) | (p[2] | p[3]);
    return unsigned(all | all >> 32);
}

//- Of each value the distance to its nearest image. Adding this number rounds to
//  integers
inline eight nearest(const eight& x, const float length, const float perLength)
{
    const float rounds = 12582912;
    return x - length * ((x * perLength + rounds) - rounds);
}
} // namespace

// Comparisons in loops of their own, without branches: followed up one by one they took
// half as long again
template<class Visit>
void Foam::closePairs::eachNear(const std::vector<cluster>& clusters,
                                std::vector<comparison>& twos, Visit visit)
{
    const auto away = [](const cluster& p, const cluster& q, const direction d)
    { return float(p.centre[d] - q.centre[d]); };

    // Are eight places, by their components, within range?
    const auto within = [this](const eight& x, const eight& y, const eight& z,
                               const eight& range)
    {
        const eight a = nearest(x, length_[0], perLength_[0]),
                    b = nearest(y, length_[1], perLength_[1]),
                    c = nearest(z, length_[2], perLength_[2]);
        return bitsOf(a * a + b * b + c * c < range * range);
    };
    const auto eachPart = [](const comparison& c, const auto& use)
    {
        for (unsigned bits = c.near; bits; bits &= bits - 1)
        {
            use(label(__builtin_ctz(bits)));
        }
    };

    for (comparison& c : twos)
    {
        const cluster &p = clusters[c.first], &q = clusters[c.second];
        c.near = p.present & within(eightAt(p.x[0]) + away(p, q, 0),
                                    eightAt(p.x[1]) + away(p, q, 1),
                                    eightAt(p.x[2]) + away(p, q, 2),
                                    eightAt(p.r) + (reach_ + q.radius));
    }
    ofParts_.clear();
    for (const comparison& c : twos)
    {
        eachPart(c,
                 [&](const label i) {
                     ofParts_.push_back({c.first, c.second, i, 0});
                 });
    }
    for (comparison& c : ofParts_)
    {
        const cluster &p = clusters[c.first], &q = clusters[c.second];
        const label i = c.part;
        c.near =
            q.present & within((p.x[0][i] + away(p, q, 0)) - eightAt(q.x[0]),
                               (p.x[1][i] + away(p, q, 1)) - eightAt(q.x[1]),
                               (p.x[2][i] + away(p, q, 2)) - eightAt(q.x[2]),
                               eightAt(q.r) + (reach_ + p.r[i]));
    }
    for (const comparison& c : ofParts_)
    {
        eachPart(c,
                 [&](const label j) {
                     visit(c, clusters[c.first].first + c.part,
                           clusters[c.second].first + j);
                 });
    }
}

// Clusters are compared in single precision, what is then near also in double
Foam::closePairs::closePairs(const uniformGrid& grid, const scalar range)
    : grid_(grid),
      range_(range),
      neighbours_(grid),
      copies_(neighbours_),
      reach_(range + 1e-6 * mag(grid.length()))
{
    for (direction d = 0; d < 3; ++d)
    {
        length_[d] = grid.length()[d];
        perLength_[d] = grid.periodic(d) ? 1 / length_[d] : 0;
    }
}

Foam::closePairs::cluster::cluster(const label start, const label n,
                                   const label number, const bool folds,
                                   const bool isHeld,
                                   const UList<vector>& points,
                                   const vector* places, const float* radii)
    : first(start),
      size(n),
      body(number),
      present((1u << n) - 1),
      mayFold(folds),
      held(isHeld),
      nPoints(points.size())
{
    vector lo(points[0]), hi(points[0]);
    for (const vector& X : points)
    {
        lo = min(lo, X);
        hi = max(hi, X);
    }
    centre = 0.5 * (lo + hi);
    scalar furthestSqr = 0;
    for (const vector& X : points)
    {
        furthestSqr = max(furthestSqr, magSqr(X - centre));
    }
    radius = std::sqrt(furthestSqr);
    for (label k = 0; k < nParts; ++k)
    {
        const label i = min(k, n - 1);
        for (direction d = 0; d < 3; ++d)
        {
            x[d][k] = places[i][d] - centre[d];
        }
        r[k] = radii ? radii[i] : 0;
    }
}

void Foam::closePairs::makePatches(const UList<vector>& X,
                                   const labelUList& body,
                                   const UList<scalar>& along)
{
    X_.shallowCopy(X);
    body_ = body;
    along_ = along;
    patches_.clear();
    for (label k = 0, n; k < X.size(); k += n)
    {
        n = 1;
        while (n < nParts && k + n < X.size() && body[k + n] == body[k])
            ++n;
        patches_.emplace_back(k, n, body[k], along_.size() && along_[k] >= 0,
                              true, SubList<vector>(X, n, k), &X[k]);
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
        patches_.emplace_back(first, n, body[first], along[first] >= 0,
                              copies_.holds(i), SubList<vector>(X, n, first),
                              &X[first]);
    }
    withCopies_ = X;
    X_.shallowCopy(withCopies_);
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
        largest_ = max(largest_, scalar(p.radius));
    }
    if (Pstream::parRun()) exchangePatches();
    patchOf_.setSize(X_.size());
    provincePairs_.clear();
    for (size_t i = 0; i < patches_.size(); ++i)
    {
        const cluster& p = patches_[i];
        std::fill_n(patchOf_.begin() + p.first, p.size, label(i));
    }
    gather(patches_, regions_);
    gather(regions_, provinces_);

    // In the order of their bins
    const label n = provinces_.size();
    scalar reach = range_;
    for (const cluster& p : provinces_)
    {
        reach = max(reach, range_ + 2 * p.radius);
    }
    const pointBins bins(grid_, reach, n);
    labelList bin(n), begin(bins.count() + 1, Zero), sorted(n);
    for (label i = 0; i < n; ++i)
    {
        bin[i] = bins.numberOf(provinces_[i].centre);
        ++begin[bin[i] + 1];
    }
    for (label b = 0; b < bins.count(); ++b)
    {
        begin[b + 1] += begin[b];
    }
    labelList next(begin);
    for (label i = 0; i < n; ++i)
    {
        sorted[next[bin[i]]++] = i;
    }

    // Each with those in its bin and next to it, each two once
    for (label i = 0; i < n; ++i)
    {
        const cluster& p = provinces_[i];
        const auto compareWith = [&](const label other)
        {
            if (other < bin[i]) return;
            for (label s = begin[other]; s < begin[other + 1]; ++s)
            {
                const cluster& q = provinces_[sorted[s]];
                if ((other == bin[i] && sorted[s] < i) ||
                    (q.body == p.body && !p.mayFold) ||
                    (q.body < 0 && p.body < 0))
                {
                    continue;
                }
                if (magSqr(nearestImage(grid_, p.centre, q.centre)) <
                    sqr(reach_ + p.radius + q.radius))
                {
                    provincePairs_.push_back({i, sorted[s], 0, 0});
                }
            }
        };
        bins.eachNext(bin[i], compareWith);
    }

    // Each two once also within one
    regionPairs_.clear();
    eachNear(provinces_, provincePairs_,
             [&](const comparison& c, const label a, const label b)
             {
                 if (c.first != c.second || b >= a)
                     regionPairs_.push_back({a, b, 0, 0});
             });
    patchPairs_.clear();
    eachNear(regions_, regionPairs_,
             [&](const comparison& c, const label a, const label b)
             {
                 if (c.first == c.second && b <= a) return;
                 if (patches_[a].held)
                     patchPairs_.push_back({a, b, 0, 0});
                 else if (patches_[b].held)
                     patchPairs_.push_back({b, a, 0, 0});
             });
    pairs_.clear();
    eachNear(patches_, patchPairs_,
             [&](const comparison& c, const label a, const label b)
             {
                 const cluster& q = patches_[c.second];
                 const vector r(nearestImage(grid_, X_[a], X_[b]));
                 if (magSqr(r) >= sqr(range_) ||
                     (q.body == patches_[c.first].body &&
                      mag(along_[a] - along_[b]) <= apart))
                 {
                     return;
                 }
                 pairs_.push_back({a, b, q.held, r});
             });
}

void Foam::closePairs::gather(const std::vector<cluster>& parts,
                              std::vector<cluster>& wholes) const
{
    wholes.clear();
    label point = 0;
    for (size_t i = 0; i < parts.size();)
    {
        const cluster& p = parts[i];
        vector centres[nParts];
        float radii[nParts];
        label n = 0, points = 0;
        for (;
             n < nParts && i + n < parts.size() && parts[i + n].body == p.body;
             ++n)
        {
            const cluster& part = parts[i + n];
            centres[n] = part.centre;
            radii[n] = part.radius;
            points += part.nPoints;
        }
        wholes.emplace_back(label(i), n, p.body, p.mayFold, true,
                            SubList<vector>(X_, points, point), centres, radii);
        i += n;
        point += points;
    }
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

Foam::vectorField Foam::closePairs::handOut(const UList<vector>& own) const
{
    const scalarField all(
        handOut(reinterpret_cast<const scalar*>(own.cdata()), 3));
    vectorField here(all.size() / 3);
    std::copy(all.begin(), all.end(), reinterpret_cast<scalar*>(here.data()));
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

void Foam::closePairs::addUp(UList<vector>& here, UList<vector>& own) const
{
    addUp(
        UList<scalar>(reinterpret_cast<scalar*>(here.data()), 3 * here.size()),
        3, reinterpret_cast<scalar*>(own.data()));
}
