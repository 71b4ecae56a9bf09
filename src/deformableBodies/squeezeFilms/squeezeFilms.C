// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "squeezeFilms.H"
#include "mathematicalConstants.H"
#include "ofAllRanks.H"
#include "rigidGroup.H"
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <set>
#include <tuple>

namespace
{
using namespace Foam;

//- Gap above which there is no film, and below which its resistance is constant [cells]
const scalar largestGap = 2, smallestGap = 0.02;

//- Lists of numbers of all ranks, one after the other (collective)
scalarList joinedRanks(const DynamicList<scalar>& mine)
{
    scalarList together;
    for (const scalarList& one : ofAllRanks(scalarList(mine)))
    {
        together.append(one);
    }
    return together;
}

const rigidGroup* spheresOf(const bodyGroup& group)
{
    const nearSurface* surface = group.nearSources();
    return surface && surface->makesFilms()
               ? &refCast<const rigidGroup>(group)
               : nullptr;
}
} // namespace

Foam::squeezeFilms::squeezeFilms(PtrList<bodyGroup>& groups,
                                 const neighbourField& field,
                                 const bodyScene& scene)
    : groups_(groups),
      field_(field),
      mu_(scene.mu),
      h_(scene.grid.h().x()),
      effects_(scene.effects),
      numbers_(groups)
{
}

bool Foam::squeezeFilms::arePossible(const PtrList<bodyGroup>& groups,
                                     const uniformGrid& grid)
{
    label n = 0;
    for (const auto& sides : boxSides(grid))
    {
        if (sides[0].closed || sides[1].closed) n = 1;
    }
    for (const bodyGroup& group : groups)
    {
        if (spheresOf(group)) n += group.nBodies();
    }
    return n > 1;
}

Foam::string Foam::squeezeFilms::describe()
{
    return "between rigid spheres, and at walls, gaps below " +
           Foam::name(largestGap) + " cells";
}

Foam::scalar Foam::squeezeFilms::lack(const scalar gap)
{
    // Fit to what is measured in the mean over directions at radii of 3, 4 and 6 cells: 0.49 to
    // 0.58 at 0.25 cells, 0.23 to 0.30 at 0.5, 0.05 to 0.09 at 1 (doc/developer/notes.md, "Films
    // of spheres"). No film at the largest gap
    const scalar decay = 2.65, rounding = 0.015;
    const int endPower = 8;
    if (gap >= largestGap) return 0;
    return std::exp(-decay * sqr(gap) / (gap + rounding)) *
           (1 - std::pow(gap / largestGap, endPower));
}

Foam::scalar Foam::squeezeFilms::lackAtWall(const scalar gap)
{
    // Fit to what is measured at radii of 3, 4 and 6 cells: 0.66 to 0.71 at 0.25 cells, 0.41 to
    // 0.47 at 0.5, 0.01 to 0.08 at 1; at 4 cells 0.87 at 0.1 (doc/developer/notes.md, "Films
    // of spheres")
    const scalar linear = 1.36, square = 0.45, cubic = 0.85;
    if (gap >= largestGap) return 0;
    return std::exp(-gap * (linear + gap * (square + cubic * gap)));
}

Foam::scalar Foam::squeezeFilms::resistance(
    const neighbourField::closeSpheres& s) const
{
    const bool wall = s.b < 0;
    const scalar R =
        wall ? s.radiusA : s.radiusA * s.radiusB / (s.radiusA + s.radiusB);
    const scalar gap = max(s.gap / h_, smallestGap);
    return 6 * constant::mathematical::pi * mu_ * sqr(R) / (gap * h_) *
           (wall ? lackAtWall(gap) : lack(gap));
}

std::vector<Foam::squeezeFilms::film> Foam::squeezeFilms::find() const
{
    std::vector<film> films;
    for (const neighbourField::closeSpheres& s :
         field_.spheresWithin(largestGap * h_))
    {
        const scalar k = resistance(s);
        if (k > 0)
            films.push_back({s.a, s.b, s.n, k, s.gap + s.radiusA + s.radiusB});
    }
    return films;
}

void Foam::squeezeFilms::share(std::vector<film>& films,
                               std::map<label, moving>& bodies)
{
    DynamicList<scalar> own;
    for (const film& f : films)
    {
        own.append({scalar(f.a), scalar(f.b), f.n.x(), f.n.y(), f.n.z(), f.k,
                    f.apart});
    }
    const scalarList allFilms(joinedRanks(own));
    films.clear();
    for (label i = 0; i < allFilms.size(); i += 7)
    {
        const scalar* x = &allFilms[i];
        films.push_back(
            {label(x[0]), label(x[1]), vector(x[2], x[3], x[4]), x[5], x[6]});
    }
    std::sort(films.begin(), films.end(),
              [](const film& f, const film& g)
              {
                  return std::tie(f.a, f.b, f.k, f.n.x(), f.n.y()) <
                         std::tie(g.a, g.b, g.k, g.n.x(), g.n.y());
              });

    std::set<label> inFilms;
    for (const film& f : films)
    {
        inFilms.insert(f.a);
        if (f.b >= 0) inFilms.insert(f.b);
    }
    own.clear();
    for (const auto& x : bodies)
    {
        if (!inFilms.count(x.first)) continue;
        const vector& V = x.second.velocity;
        own.append({scalar(x.first), V.x(), V.y(), V.z(), x.second.mobility});
    }
    const scalarList allBodies(joinedRanks(own));
    bodies.clear();
    for (label i = 0; i < allBodies.size(); i += 5)
    {
        const scalar* x = &allBodies[i];
        bodies[label(x[0])] = {vector(x[1], x[2], x[3]), x[4]};
    }
}

std::vector<Foam::scalar>
Foam::squeezeFilms::solve(const std::vector<film>& films,
                          const std::map<label, moving>& bodies)
{
    // (1/k_p + sum_q K_pq) F_q = - n_p.(V_a - V_b), K_pq by the bodies that p and q share
    const label n = films.size();
    std::map<label, std::vector<std::pair<label, scalar>>> ofBody;
    Eigen::VectorXd right(n);
    for (label p = 0; p < n; ++p)
    {
        const film& f = films[p];
        right[p] = -(f.n & bodies.at(f.a).velocity);
        ofBody[f.a].emplace_back(p, 1);
        if (f.b < 0) continue;
        right[p] += f.n & bodies.at(f.b).velocity;
        ofBody[f.b].emplace_back(p, -1);
    }
    std::vector<Eigen::Triplet<scalar>> entries;
    for (label p = 0; p < n; ++p)
    {
        entries.emplace_back(p, p, 1 / films[p].k);
    }
    for (const auto& body : ofBody)
    {
        for (const auto& p : body.second)
        {
            for (const auto& q : body.second)
            {
                entries.emplace_back(p.first, q.first,
                                     bodies.at(body.first).mobility * p.second *
                                         q.second *
                                         (films[p.first].n & films[q.first].n));
            }
        }
    }
    Eigen::SparseMatrix<scalar> A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd F(
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<scalar>>(A).solve(right));
    return std::vector<scalar>(F.data(), F.data() + n);
}

void Foam::squeezeFilms::act(const labelUList& groups, const vector* U,
                             const scalar* density, const bodyStep& step)
{
    std::vector<film> films(find());
    moment_ = Zero;
    const bool any = returnReduce(films.size() > 0, orOp<bool>());
    std::map<label, moving> bodies;
    for (const label g : groups)
    {
        const label n = groups_[g].nMarkers();
        if (spheresOf(groups_[g]))
        {
            rigidGroup& spheres = refCast<rigidGroup>(groups_[g]);
            std::vector<rigidStep::answer> freeMotions;
            if (any) freeMotions = spheres.freeMotions(U, density, step);
            forAll(spheres.mine(), i)
            {
                spheres.setFilm(i, Zero);
                if (!any) continue;
                bodies[numbers_.number(g, spheres.mine()[i])] = {
                    freeMotions[i].velocity, freeMotions[i].mobility};
            }
        }
        U += n;
        density += n;
    }
    if (!any) return;
    const auto timing(effects_.time("squeezeFilms"));
    share(films, bodies);
    const std::vector<scalar> F(solve(films, bodies));
    for (size_t p = 0; p < films.size(); ++p)
    {
        const film& f = films[p];
        bodies[f.a].force += F[p] * f.n;
        if (f.b >= 0) bodies[f.b].force -= F[p] * f.n;
        if (Pstream::master()) moment_ += f.apart * F[p] * f.n * f.n;
    }
    for (const label g : groups)
    {
        if (!spheresOf(groups_[g])) continue;
        rigidGroup& spheres = refCast<rigidGroup>(groups_[g]);
        forAll(spheres.mine(), i)
        {
            spheres.setFilm(
                i, bodies[numbers_.number(g, spheres.mine()[i])].force);
        }
    }
}

Foam::vector Foam::squeezeFilms::forceOn(const label group,
                                         const label i) const
{
    const rigidGroup* spheres = spheresOf(groups_[group]);
    return spheres ? spheres->film(i) : vector(Zero);
}
