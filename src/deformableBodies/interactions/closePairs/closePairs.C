// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "closePairs.H"
#include "periodicBox.H"
#include "pointBins.H"
#include <algorithm>

Foam::closePairs::closePairs(const uniformGrid& grid, const scalar range)
    : grid_(grid),
      range_(range),
      copies_(grid),
      compare_(grid, range)
{
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
    // Position and distance along the body of each point, body
    const label nNumbers = 4 * nParts + 1;
    vectorField centres(patches_.size());
    labelList sizes(patches_.size());
    scalarField numbers(nNumbers * patches_.size(), Zero);
    forAll(centres, i)
    {
        const pointCluster& p = patches_[i];
        centres[i] = p.centre;
        sizes[i] = p.size;
        scalar* to = &numbers[nNumbers * i];
        to[nNumbers - 1] = p.body;
        for (label k = p.first; k < p.first + p.size; ++k)
        {
            to = std::copy_n(X_[k].cdata(), 3, to);
            *to++ = along_.size() ? along_[k] : -1;
        }
    }
    reduce(largest_, maxOp<scalar>());
    const scalarField here(
        copies_.route(centres, sizes, numbers, nNumbers,
                      grid_.layersWithin(range_ + 2 * largest_)));

    patches_.clear();
    DynamicList<vector> X(nParts * copies_.nPatches());
    DynamicList<label> body(X.capacity());
    DynamicList<scalar> along(X.capacity());
    for (label i = 0; i < copies_.nPatches(); ++i)
    {
        const scalar* from = &here[nNumbers * i];
        const label first = X.size(), n = copies_.size(i);
        const label number = label(from[nNumbers - 1]);
        for (label k = 0; k < n; ++k, from += 4)
        {
            X.append(vector(from[0], from[1], from[2]));
            along.append(from[3]);
            body.append(number);
        }
        patches_.emplace_back(first, n, number, along[first] >= 0,
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
    for (const pointCluster& p : patches_)
    {
        largest_ = max(largest_, scalar(p.radius));
    }
    if (Pstream::parRun())
        exchangePatches();
    else
        copies_.placeAlone(X.size());
    patchOf_.setSize(X_.size());
    for (size_t i = 0; i < patches_.size(); ++i)
    {
        const pointCluster& p = patches_[i];
        std::fill_n(patchOf_.begin() + p.first, p.size, label(i));
    }
    pointCluster::gather(patches_, X_, regions_);
    pointCluster::gather(regions_, X_, provinces_);
    findProvincePairs();
    findPairs(apart);
}

void Foam::closePairs::findProvincePairs()
{
    // Provinces in the order of their bins
    const label n = provinces_.size();
    scalar reach = range_;
    for (const pointCluster& p : provinces_)
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

    // Each province with those in its bin and next to it, each pair once
    provincePairs_.clear();
    for (label i = 0; i < n; ++i)
    {
        const pointCluster& p = provinces_[i];
        const auto compareWith = [&](const label other)
        {
            if (other < bin[i]) return;
            for (label s = begin[other]; s < begin[other + 1]; ++s)
            {
                const pointCluster& q = provinces_[sorted[s]];
                if ((other == bin[i] && sorted[s] < i) ||
                    (q.body == p.body && !p.mayFold) ||
                    (q.body < 0 && p.body < 0))
                {
                    continue;
                }
                if (magSqr(nearestImage(grid_, p.centre, q.centre)) <
                    sqr(compare_.reach() + p.radius + q.radius))
                {
                    provincePairs_.push_back({i, sorted[s], 0, 0});
                }
            }
        };
        bins.eachNext(bin[i], compareWith);
    }
}

void Foam::closePairs::findPairs(const scalar apart)
{
    // Parts of one cluster are compared with each other, each pair once
    regionPairs_.clear();
    compare_.eachNear(provinces_, provincePairs_,
                      [&](const comparison& c, const label a, const label b)
                      {
                          if (c.first != c.second || b >= a)
                              regionPairs_.push_back({a, b, 0, 0});
                      });
    patchPairs_.clear();
    compare_.eachNear(regions_, regionPairs_,
                      [&](const comparison& c, const label a, const label b)
                      {
                          if (c.first == c.second && b <= a) return;
                          if (patches_[a].held)
                              patchPairs_.push_back({a, b, 0, 0});
                          else if (patches_[b].held)
                              patchPairs_.push_back({b, a, 0, 0});
                      });
    pairs_.clear();
    compare_.eachNear(patches_, patchPairs_,
                      [&](const comparison& c, const label a, const label b)
                      {
                          const pointCluster& q = patches_[c.second];
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

Foam::vectorField Foam::closePairs::handOut(const UList<vector>& own) const
{
    const scalarField all(
        handOut(reinterpret_cast<const scalar*>(own.cdata()), 3));
    vectorField here(all.size() / 3);
    std::copy(all.begin(), all.end(), reinterpret_cast<scalar*>(here.data()));
    return here;
}

void Foam::closePairs::addUp(UList<vector>& here, UList<vector>& own) const
{
    addUp(
        UList<scalar>(reinterpret_cast<scalar*>(here.data()), 3 * here.size()),
        3, reinterpret_cast<scalar*>(own.data()));
}
