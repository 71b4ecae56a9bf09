// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "closePairs.H"
#include <algorithm>

namespace
{
using namespace Foam;

//- Layers of cells that a distance reaches over
label layersOf(const uniformGrid& grid, const scalar distance)
{
    return label(std::ceil(distance / cmptMin(grid.h()))) + 1;
}

//- Numbers of bins along each direction, and the bin of a point
class binning
{
    const uniformGrid& grid_;
    label n_[3];

    label wrapped(const label i, const direction d) const
    {
        return (i % n_[d] + n_[d]) % n_[d];
    }

public:
    binning(const uniformGrid& grid, const scalar distance)
        : grid_(grid)
    {
        for (direction d = 0; d < 3; ++d)
        {
            n_[d] = max(label(1), label(grid.length()[d] / distance));
        }
    }

    label along(const vector& x, const direction d) const
    {
        const label i = label(
            std::floor((x[d] - grid_.origin()[d]) / grid_.length()[d] * n_[d]));
        return grid_.periodic(d) ? wrapped(i, d)
                                 : min(max(i, label(0)), n_[d] - 1);
    }

    //- One number for a bin; those of neighbours in x follow each other
    label number(const label i, const label j, const label k) const
    {
        return i + n_[0] * (j + n_[1] * k);
    }

    label count() const { return n_[0] * n_[1] * n_[2]; }

    //- The bins along a direction next to bin i, each once
    label next(const label i, const direction d, label* bins) const
    {
        label found = 0;
        for (label b = i - 1; b <= i + 1; ++b)
        {
            if (!grid_.periodic(d) && (b < 0 || b >= n_[d])) continue;
            const label w = wrapped(b, d);
            if (std::find(bins, bins + found, w) == bins + found)
            {
                bins[found++] = w;
            }
        }
        return found;
    }
};
} // namespace

Foam::closePairs::closePairs(const uniformGrid& grid, const scalar range)
    : grid_(grid),
      range_(range),
      neighbours_(grid),
      points_(neighbours_, layersOf(grid, range))
{
}

void Foam::closePairs::search(const UList<vector>& X, const labelUList& body)
{
    points_.place(X);
    scalarField own(body.size());
    std::copy(body.begin(), body.end(), own.begin());
    const scalarField all(points_.handOut(own.cdata(), 1));
    body_.setSize(all.size());
    std::copy(all.begin(), all.end(), body_.begin());
    pairs_.clear();

    // Points sorted by their bins, those of a bin side by side; of each bin which
    // they are, and the body if all are of one
    struct located
    {
        label bin, point, body;
        bool held;
        vector x;
    };
    const vectorField& x = here();
    const binning bins(grid_, range_);
    std::vector<located> sorted(x.size());
    forAll(x, k)
    {
        sorted[k] = {bins.number(bins.along(x[k], 0), bins.along(x[k], 1),
                                 bins.along(x[k], 2)),
                     k, body_[k], points_.holds(k), x[k]};
    }
    std::sort(sorted.begin(), sorted.end(),
              [](const located& a, const located& b)
              { return a.bin != b.bin ? a.bin < b.bin : a.point < b.point; });
    struct content
    {
        label bin, first, last, onlyBody;
    };
    std::vector<content> contents;
    for (size_t at = 0; at < sorted.size(); ++at)
    {
        const located& p = sorted[at];
        if (contents.empty() || contents.back().bin != p.bin)
        {
            contents.push_back({p.bin, label(at), 0, p.body});
        }
        content& c = contents.back();
        c.last = label(at) + 1;
        if (c.onlyBody != p.body) c.onlyBody = -1;
    }

    labelList contentOf(bins.count(), -1);
    for (size_t c = 0; c < contents.size(); ++c)
    {
        contentOf[contents[c].bin] = label(c);
    }

    const auto pairsOf = [&](const content& c, const content& other)
    {
        if (c.onlyBody >= 0 && c.onlyBody == other.onlyBody) return;
        for (label p = c.first; p < c.last; ++p)
        {
            const located& a = sorted[p];
            if (!a.held) continue;
            for (label q = other.first; q < other.last; ++q)
            {
                // Once where both are held
                const located& b = sorted[q];
                if (a.body == b.body || (b.held && b.point < a.point)) continue;
                const vector r(nearestImage(grid_, a.x, b.x));
                if (magSqr(r) < sqr(range_))
                {
                    pairs_.push_back({a.point, b.point, b.held, r});
                }
            }
        }
    };
    for (const content& c : contents)
    {
        const vector& inside = sorted[c.first].x;
        label near[3][3], nNear[3];
        for (direction d = 0; d < 3; ++d)
        {
            nNear[d] = bins.next(bins.along(inside, d), d, near[d]);
        }
        for (label k = 0; k < nNear[2]; ++k)
        {
            for (label j = 0; j < nNear[1]; ++j)
            {
                for (label i = 0; i < nNear[0]; ++i)
                {
                    const label other = contentOf[bins.number(
                        near[0][i], near[1][j], near[2][k])];
                    if (other >= 0) pairsOf(c, contents[other]);
                }
            }
        }
    }
}
