// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Sums over the points of pairs

#include "neighbourField.H"
#include "mathematicalConstants.H"

namespace
{
using namespace Foam;

//- Gaps from and to which close points fade into far ones [cells]
const scalar closeGap = 0.5, apartGap = 1.5;

//- Spacing of the points of each level [cells]
const scalar levelSpacing[] = {1.1, 2};

//- Largest degree of the harmonics that surfaces exchange
const label largestDegree = 8;

//- 1 below a, 0 above b
scalar fade(const scalar x, const scalar a, const scalar b)
{
    const scalar t = min(max((b - x) / (b - a), scalar(0)), scalar(1));
    return t * t * (3 - 2 * t);
}

void addTo(std::vector<vector>& u, const std::vector<vector>& v,
           const scalar weight)
{
    u.resize(v.size(), vector(Zero));
    for (size_t k = 0; k < v.size(); ++k)
    {
        u[k] += weight * v[k];
    }
}
} // namespace

Foam::neighbourField::neighbourField(PtrList<bodyGroup>& groups,
                                     const bodyScene& scene,
                                     const bool nucleiOnly)
    : groups_(groups),
      grid_(scene.grid),
      mu_(scene.mu),
      kernel_(scene.kernel.type()),
      numbers_(groups),
      nucleiOnly_(nucleiOnly),
      copies_(groups, numbers_, scene.grid, farGap * scene.grid.h().x()),
      spacing_(groups.size(), Zero)
{
    forAll(groups, g)
    {
        nearSurface* surface = groups[g].nearSources();
        if (!surface) continue;
        surface->join();
        spacing_[g] = surface->nearSpacing();
    }
    if (!nucleiOnly_ && grid_.periodic())
    {
        const scalar h = grid_.h().x();
        unresolved_ =
            nearField(kernel_, h, mu_, h, nearField::OTHER).unresolvedFlow();
    }
}

const Foam::nearField& Foam::neighbourField::sumFor(const scalar spacing,
                                                    const scalar mu)
{
    const scalar h = grid_.h().x(), d = max(0.5 * h, 0.48 * spacing);
    std::unique_ptr<const nearField>& sum = sums_[{d, mu}];
    if (!sum) sum.reset(new nearField(kernel_, h, mu, d, nearField::OTHER));
    return *sum;
}

const Foam::coarsePoints*
Foam::neighbourField::coarseOf(const bodyCopies::body& body, const level l)
{
    const label n = body.X.size();
    const std::array<label, 3> key{body.group, n, l};
    const auto found = coarse_.find(key);
    if (found != coarse_.end()) return found->second.get();

    const scalar pi = constant::mathematical::pi;
    const scalar cells = spacing_[body.group] / grid_.h().x() *
                         std::sqrt(n / (4 * pi)); // radius
    // With a margin, as radii are often whole numbers of cells
    const label byCells = std::ceil(1.25 * cells * (1 - 1e-6));
    const label degree =
        l == CLOSE ? largestDegree : min(largestDegree, byCells);
    const label some = max(1.6 * sqr(scalar(degree + 1)),
                           4 * pi * sqr(cells / levelSpacing[l]));
    std::unique_ptr<const coarsePoints>& points = coarse_[key];
    if (some < 0.8 * n)
    {
        points.reset(new coarsePoints(
            groups_[body.group].nearSources()->nearDirections(n), degree,
            some));
    }
    return points.get();
}

void Foam::neighbourField::add(const pair& p, const level l,
                               const scalar weight)
{
    scalar spacing = levelSpacing[l] * grid_.h().x(), mu = mu_;
    for (const label k : {p.a, p.b})
    {
        const bodyCopies::body& x = copies_.bodies()[k];
        const coarsePoints* coarse = coarseOf(x, l);
        if (!coarse) spacing = max(spacing, spacing_[x.group]);
        nearField::pointSet& points = levels_[k].points[l];
        if (points.n) continue;
        points = coarse ? nearField::pointSet(coarse->positions(x.X),
                                              coarse->forces(x.F.data()))
                        : nearField::pointSet(x.X, x.F);
    }
    const bodyCopies::body &a = copies_.bodies()[p.a],
                           &b = copies_.bodies()[p.b];
    const nearField::pointSet &ofA = levels_[p.a].points[l],
                              &ofB = levels_[p.b].points[l];
    std::vector<vector> u, v;
    const vector apart(ofB.origin + p.shift - ofA.origin);
    if (b.wall >= 0)
    {
        if (!image_)
        {
            image_.reset(new wallImage(kernel_, grid_.h().x(), mu_));
        }
        const direction d = b.wall;
        const bool above =
            b.wallAt > grid_.origin()[d] + 0.5 * grid_.length()[d];
        image_->velocity(ofA, ofB, apart, d, ofA.origin[d] - b.wallAt, above,
                         u);
        addTo(levels_[p.a].u[l], u, weight);
        return;
    }
    if (p.inside)
    {
        const label host =
            groups_[a.group].host() == b.group ? b.group : a.group;
        mu *= groups_[host].inside()->viscosityRatio();
    }
    sumFor(spacing, mu).exchange(ofA, ofB, apart, u, v);
    addTo(levels_[p.a].u[l], u, weight);
    addTo(levels_[p.b].u[l], v, weight);
}

void Foam::neighbourField::add(const pair& p)
{
    const scalar weight = p.inside ? 1 : fade(p.gap, nearGap, farGap);
    const scalar close = p.inside ? 1 : fade(p.gap, closeGap, apartGap);
    if (close > 0) add(p, CLOSE, weight * close);
    if (close < 1) add(p, FAR, weight * (1 - close));
}

std::vector<Foam::vector> Foam::neighbourField::velocities(const label k)
{
    const bodyCopies::body& body = copies_.bodies()[k];
    std::vector<vector> u(body.X.size(), vector(Zero));
    for (const level l : {CLOSE, FAR})
    {
        const std::vector<vector>& ofLevel = levels_[k].u[l];
        if (ofLevel.empty()) continue;
        const coarsePoints* coarse = coarseOf(body, l);
        if (coarse)
            coarse->add(ofLevel, u.data());
        else
            addTo(u, ofLevel, 1);
    }
    return u;
}

Foam::vector Foam::neighbourField::unresolvedMean() const
{
    vector force(Zero);
    for (const bodyCopies::body& b : copies_.bodies())
    {
        if (!b.mine) continue;
        for (const vector& F : b.F)
        {
            force += F;
        }
    }
    reduce(force, sumOp<vector>());
    return unresolved_ / grid_.volume() * force;
}

void Foam::neighbourField::update()
{
    copies_.update(!nucleiOnly_);
    levels_.assign(copies_.bodies().size(), levels());
    findPairs();
    for (const pair& p : pairs_)
    {
        add(p);
    }
    const vector mean(unresolvedMean());
    std::map<label, label> byNumber;
    for (size_t k = 0; k < copies_.bodies().size(); ++k)
    {
        const bodyCopies::body& b = copies_.bodies()[k];
        if (b.mine) byNumber[b.number] = k;
    }
    forAll(groups_, g)
    {
        nearSurface* surface = groups_[g].nearSources();
        if (!surface) continue;
        std::vector<std::vector<vector>> u;
        for (const label i : groups_[g].mine())
        {
            u.push_back(velocities(byNumber.at(numbers_.number(g, i))));
            for (vector& v : u.back())
            {
                v -= mean;
            }
        }
        surface->setExchanged(std::move(u));
    }
}
