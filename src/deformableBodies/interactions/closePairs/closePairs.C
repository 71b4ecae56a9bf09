// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "closePairs.H"
#include "pointBins.H"
#include <algorithm>

namespace
{
using namespace Foam;

//- Layers of cells that a distance reaches over
label layersOf(const uniformGrid& grid, const scalar distance)
{
    return label(std::ceil(distance / cmptMin(grid.h()))) + 1;
}
} // namespace

Foam::closePairs::closePairs(const uniformGrid& grid, const scalar range)
    : grid_(grid),
      range_(range),
      neighbours_(grid),
      points_(neighbours_, layersOf(grid, range))
{
}

void Foam::closePairs::search(const UList<vector>& X, const labelUList& body,
                              const UList<scalar>& along, const scalar apart)
{
    points_.place(X);
    scalarField own(2 * body.size());
    forAll(body, k)
    {
        own[2 * k] = body[k];
        own[2 * k + 1] = along.size() ? along[k] : -1;
    }
    const scalarField all(points_.handOut(own.cdata(), 2));
    body_.setSize(all.size() / 2);
    along_.setSize(body_.size());
    forAll(body_, k)
    {
        body_[k] = label(all[2 * k]);
        along_[k] = all[2 * k + 1];
    }
    const auto apartEnough = [&](const label a, const label b)
    {
        return body_[a] != body_[b] ||
               (along_[a] >= 0 && mag(along_[a] - along_[b]) > apart);
    };
    pairs_.clear();

    // Points sorted by their bins, in their order within a bin
    const vectorField& x = here();
    const pointBins bins(grid_, range_, x.size());
    labelList binOf(x.size()), binBegin(bins.count() + 1, Zero);
    forAll(x, k)
    {
        binOf[k] = bins.numberOf(x[k]);
        ++binBegin[binOf[k] + 1];
    }
    for (label b = 0; b < bins.count(); ++b)
    {
        binBegin[b + 1] += binBegin[b];
    }
    labelList sorted(x.size()), binEnd(binBegin);
    forAll(x, k)
    {
        sorted[binEnd[binOf[k]]++] = k;
    }
    std::vector<double> coordinate[3];
    for (direction d = 0; d < 3; ++d)
    {
        coordinate[d].resize(x.size());
        forAll(sorted, p)
        {
            coordinate[d][p] = x[sorted[p]][d];
        }
    }

    // The body of each bin's points if all are of one, whose parts do not meet
    labelList onlyBody(bins.count(), -1);
    for (label b = 0; b < bins.count(); ++b)
    {
        if (binBegin[b] == binEnd[b]) continue;
        const label first = body_[sorted[binBegin[b]]];
        if (std::all_of(sorted.cbegin() + binBegin[b],
                        sorted.cbegin() + binEnd[b],
                        [&](const label k)
                        { return body_[k] == first && along_[k] < 0; }))
        {
            onlyBody[b] = first;
        }
    }

    // Those in bins next to a bin, each two bins once, side by side for vectors: ranges
    // of the sorted points, points, places, squares of the distances from one
    std::vector<labelPair> ranges;
    std::vector<label> others;
    std::vector<double> around[3], square;
    const vector length(grid_.length());
    vector perLength(Zero); // no images where it is 0
    for (direction d = 0; d < 3; ++d)
    {
        if (grid_.periodic(d)) perLength[d] = 1 / length[d];
    }
    // How many are within range?
    const auto findSquares = [&](const vector& from)
    {
        const label n = others.size();
        const scalar limit = sqr(range_);
        label within = 0;
        square.resize(n);
        double* sum = square.data();
        const double *bx = around[0].data(), *by = around[1].data(),
                     *bz = around[2].data();
        const vector a(from), L(length), perL(perLength);
        const auto image = [](const double r, const double l, const double perl)
        { return r - l * std::rint(r * perl); };
#pragma GCC ivdep
        for (label q = 0; q < n; ++q)
        {
            const double x = image(a.x() - bx[q], L.x(), perL.x());
            const double y = image(a.y() - by[q], L.y(), perL.y());
            const double z = image(a.z() - bz[q], L.z(), perL.z());
            sum[q] = x * x + y * y + z * z;
            within += sum[q] < limit;
        }
        return within;
    };
    for (label bin = 0; bin < bins.count(); ++bin)
    {
        if (binBegin[bin] == binEnd[bin]) continue;
        ranges.clear();
        const auto collect = [&](const label other)
        {
            if (other < bin || binBegin[other] == binEnd[other] ||
                (onlyBody[bin] >= 0 && onlyBody[bin] == onlyBody[other]))
            {
                return;
            }
            if (ranges.size() && ranges.back().second() == binBegin[other])
                ranges.back().second() = binEnd[other];
            else
                ranges.push_back({binBegin[other], binEnd[other]});
        };
        bins.eachNext(bin, collect);
        others.clear();
        for (auto& values : around)
        {
            values.clear();
        }
        for (const labelPair& r : ranges)
        {
            others.insert(others.end(), sorted.cbegin() + r.first(),
                          sorted.cbegin() + r.second());
            for (direction d = 0; d < 3; ++d)
            {
                around[d].insert(around[d].end(),
                                 coordinate[d].begin() + r.first(),
                                 coordinate[d].begin() + r.second());
            }
        }
        for (label p = binBegin[bin]; p < binEnd[bin] && others.size(); ++p)
        {
            const label a = sorted[p];
            if (!findSquares(x[a])) continue;
            const bool held = points_.holds(a);
            for (size_t q = 0; q < others.size(); ++q)
            {
                if (!(square[q] < sqr(range_))) continue;
                const label b = others[q];
                const bool again = binOf[b] == bin && b <= a;
                if (again || !apartEnough(a, b)) continue;
                const bool otherHeld = points_.holds(b);
                const vector r(nearestImage(grid_, x[a], x[b]));
                if (held)
                    pairs_.push_back({a, b, otherHeld, r});
                else if (otherHeld)
                    pairs_.push_back({b, a, false, -r});
            }
        }
    }
}
