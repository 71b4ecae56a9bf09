// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Sums over the points of pairs

#include "neighbourField.H"
#include "mathematicalConstants.H"

namespace
{
using namespace Foam;

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

//- Add to some of n values
void addTo(std::vector<vector>& u, const std::vector<vector>& v,
           const scalar weight, const std::vector<label>& which, const label n)
{
    u.resize(n, vector(Zero));
    for (size_t k = 0; k < v.size(); ++k)
    {
        u[which[k]] += weight * v[k];
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
        l == FINE ? largestDegree : min(largestDegree, byCells);
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

const Foam::nearField::pointSet& Foam::neighbourField::pointsOf(const label k,
                                                                const level l)
{
    nearField::pointSet& points = levels_[k].points[l];
    if (points.n) return points;
    const bodyCopies::body& body = copies_.bodies()[k];
    const coarsePoints* coarse = coarseOf(body, l);
    points = coarse ? nearField::pointSet(coarse->positions(body.X),
                                          coarse->forces(body.F.data()))
                    : nearField::pointSet(body.X, body.F);
    return points;
}

Foam::scalar Foam::neighbourField::spacingOf(const pair& p, const level l)
{
    scalar spacing = levelSpacing[l] * grid_.h().x();
    for (const label k : {p.a, p.b})
    {
        const bodyCopies::body& body = copies_.bodies()[k];
        if (!coarseOf(body, l)) spacing = max(spacing, spacing_[body.group]);
    }
    return spacing;
}

const Foam::nearField& Foam::neighbourField::sumOf(const pair& p, const level l)
{
    const scalar h = grid_.h().x(), smooth = 0.68 * spacingOf(p, COARSE);
    const scalar d =
        l == COARSE ? smooth : max(0.5 * h, 0.48 * spacingOf(p, FINE));
    scalar mu = mu_;
    if (p.inside)
    {
        const label a = copies_.bodies()[p.a].group,
                    b = copies_.bodies()[p.b].group;
        const label host = groups_[a].host() == b ? b : a;
        mu *= groups_[host].inside()->viscosityRatio();
    }
    std::unique_ptr<const nearField>& sum = sums_[{scalar(l), d, mu}];
    if (!sum)
    {
        sum.reset(l == COARSE
                      ? new nearField(kernel_, h, mu, d, nearField::OTHER)
                      : new nearField(h, mu, d, smooth));
    }
    return *sum;
}

void Foam::neighbourField::addCoarse(const pair& p, const scalar weight)
{
    const nearField::pointSet &a = pointsOf(p.a, COARSE),
                              &b = pointsOf(p.b, COARSE);
    std::vector<vector> u, v;
    sumOf(p, COARSE).exchange(a, b, b.origin + p.shift - a.origin, u, v);
    addTo(levels_[p.a].u[COARSE], u, weight);
    addTo(levels_[p.b].u[COARSE], v, weight);
}

void Foam::neighbourField::addFine(const pair& p, const scalar range,
                                   const scalar weight)
{
    const scalar depth = range - p.gap * grid_.h().x();
    if (depth < 0) return;
    const nearField::pointSet &a = pointsOf(p.a, FINE),
                              &b = pointsOf(p.b, FINE);
    const std::vector<label> ofA(a.foremost(p.e, depth)),
        ofB(b.foremost(-p.e, depth));
    std::vector<vector> u, v;
    sumOf(p, FINE).exchange(nearField::pointSet(a, ofA),
                            nearField::pointSet(b, ofB),
                            b.origin + p.shift - a.origin, u, v);
    addTo(levels_[p.a].u[FINE], u, weight, ofA, a.n);
    addTo(levels_[p.b].u[FINE], v, weight, ofB, b.n);
}

void Foam::neighbourField::addAtWall(const pair& p, const scalar weight)
{
    if (!image_)
    {
        image_.reset(new wallImage(kernel_, grid_.h().x(), mu_));
    }
    const bodyCopies::body& mirrored = copies_.bodies()[p.b];
    const nearField::pointSet &a = pointsOf(p.a, COARSE),
                              &b = pointsOf(p.b, COARSE);
    const direction d = mirrored.wall;
    const bool above =
        mirrored.wallAt > grid_.origin()[d] + 0.5 * grid_.length()[d];
    std::vector<vector> u;
    image_->velocity(a, b, b.origin + p.shift - a.origin, d,
                     a.origin[d] - mirrored.wallAt, above, u);
    addTo(levels_[p.a].u[COARSE], u, weight);
}

void Foam::neighbourField::add(const pair& p)
{
    const scalar weight = p.inside ? 1 : fade(p.gap, nearGap, farGap);
    if (copies_.bodies()[p.b].wall >= 0)
    {
        addAtWall(p, weight);
        return;
    }
    addCoarse(p, weight);
    addFine(p, 3 * sumOf(p, COARSE).d(), weight);
}

std::vector<Foam::vector> Foam::neighbourField::velocities(const label k)
{
    const bodyCopies::body& body = copies_.bodies()[k];
    std::vector<vector> u(body.X.size(), vector(Zero));
    for (const level l : {FINE, COARSE})
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
