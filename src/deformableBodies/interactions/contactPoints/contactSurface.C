// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactSurface.H"
#include "ListOps.H"
#include "patchOrder.H"
#include "quietEigen.H"
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace
{
using namespace Foam;

//- Pairs of markers of which one is among the six nearest of the other, by directions.
//  Distances are rounded: on symmetric shapes many are equal, and numbers decide
std::set<std::pair<label, label>> neighbours(const vectorField& X)
{
    const label n = X.size(), most = min(label(6), n - 1);
    const vectorField e(X / mag(X));
    const scalarField z(e.component(vector::Z));
    const labelList byHeight(sortedOrder(z));
    const scalar round = 1e9;
    std::set<std::pair<label, label>> pairs;
    std::vector<std::pair<scalar, label>> others;
    forAll(byHeight, place)
    {
        // Among markers at about this height, unless farther ones may be nearer
        const label i = byHeight[place];
        scalar reach = 8 / std::sqrt(scalar(n));
        bool found = false;
        for (; !found; reach *= 2)
        {
            others.clear();
            const auto look = [&](const label at)
            {
                const label j = byHeight[at];
                if (mag(z[j] - z[i]) > reach) return false;
                others.push_back({std::round(round * magSqr(e[j] - e[i])), j});
                return true;
            };
            for (label at = place + 1; at < n && look(at);)
                ++at;
            for (label at = place - 1; at >= 0 && look(at);)
                --at;
            if (label(others.size()) < most) continue;
            std::partial_sort(others.begin(), others.begin() + most,
                              others.end());
            found = most == 0 ||
                    others[most - 1].first < round * sqr(reach) - 1 ||
                    reach > 2;
        }
        for (label k = 0; k < most; ++k)
        {
            pairs.insert(std::minmax(i, label(others[k].second)));
        }
    }
    return pairs;
}

//- Weights of values at the directions e that give the height of the surface above the middle
//  of the chord from the first to the second: exact for polynomials of degree two in the
//  tangential plane, and of least norm. Empty: these directions do not determine them
Eigen::VectorXd heightWeights(const UList<vector>& e)
{
    if (e.size() < 6) return Eigen::VectorXd();
    const vector ahead(e[1] - e[0]), aside(e[0] ^ e[1]);
    Eigen::MatrixXd monomials(6, e.size());
    forAll(e, k)
    {
        const scalar u = (e[k] & ahead) / mag(ahead),
                     v = (e[k] & aside) / mag(aside);
        monomials.col(k) << 1, u, v, u * u, u * v, v * v;
    }
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> all(
        monomials);
    if (all.rank() < 6) return Eigen::VectorXd();
    const Eigen::VectorXd chord(0.5 * (monomials.col(0) + monomials.col(1)));
    return all.solve(Eigen::VectorXd::Unit(6, 0) - chord);
}
} // namespace

Foam::contactSurface::contactSurface(const vectorField& X,
                                     const scalarField& areas,
                                     const scalar range)
    : nMarkers_(X.size()),
      areas_(areas),
      shares_(areas.size(), Zero),
      atRest_(sum(areas) < X.size() * sqr(0.5 * range) ? 0 : 1)
{
    DynamicList<connection> all;
    DynamicList<vector> middles;
    List<std::set<label>> beside(X.size());
    for (const auto& pair : neighbours(X))
    {
        const label i = pair.first, j = pair.second;
        const scalar apart = mag(X[j] - X[i]) / (1 << atRest_);
        all.append(connection{i, j, max(0.5 * range, 1.6 * apart), 0, 0});
        middles.append(X[i] + X[j]);
        ++shares_[i];
        ++shares_[j];
        beside[i].insert(j);
        beside[j].insert(i);
    }

    // In an order that keeps patches small
    connections_ = List<connection>(all, patchOrder(vectorField(middles)));
    for (connection& on : connections_)
    {
        setHeight(X, on, beside[on.first], beside[on.second]);
    }

    shares_ = 1 / max(shares_, scalar(1));
    areas_ /= max(stretches(X.cdata()), VSMALL);
}

void Foam::contactSurface::setHeight(const vectorField& X, connection& on,
                                     std::set<label> about,
                                     const std::set<label>& ofSecond)
{
    about.insert(ofSecond.begin(), ofSecond.end());
    about.erase(on.first);
    about.erase(on.second);
    DynamicList<label> markers(labelList({on.first, on.second}));
    for (const label k : about)
    {
        if ((X[k] & (X[on.first] + X[on.second])) > 0) markers.append(k);
    }
    DynamicList<vector> e;
    for (const label k : markers)
    {
        e.append(X[k] / mag(X[k]));
    }
    const Eigen::VectorXd weights(heightWeights(e));
    on.firstHeight = heights_.size();
    for (label k = 0; k < weights.size(); ++k)
    {
        heights_.append({markers[k], weights[k]});
    }
    on.endHeight = heights_.size();
}

Foam::scalarField Foam::contactSurface::stretches(const vector* X) const
{
    symmTensorField M(nMarkers_, Zero);
    for (const connection& on : connections_)
    {
        const symmTensor ll(sqr(X[on.second] - X[on.first]));
        M[on.first] += ll;
        M[on.second] += ll;
    }
    scalarField roots(nMarkers_);
    forAll(roots, i)
    {
        roots[i] = Foam::sqrt(max(invariantII(M[i]), scalar(0)));
    }
    return roots;
}

void Foam::contactSurface::addPoints(
    const vector* X, label* halved, DynamicList<interactingPoint>& points) const
{
    const label markers = points.size();
    const scalarField areas(areas_ * stretches(X));
    const scalarField shares(areas * shares_);
    for (const scalar area : areas)
    {
        points.append(interactingPoint{area, 0, 0});
    }
    forAll(connections_, k)
    {
        const connection& on = connections_[k];
        interactingPoint &i = points[markers + on.first],
                         &j = points[markers + on.second];
        const scalar length = mag(X[on.second] - X[on.first]);
        scalar apart = length / (1 << atRest_), fine = 1;
        for (halved[k] = atRest_; apart > on.apart && halved[k] < 8;
             ++halved[k])
        {
            fine = min(4 * (apart / on.apart - 1), scalar(1));
            apart *= 0.5;
        }
        i.spacing = max(i.spacing, apart);
        j.spacing = max(j.spacing, apart);
        if (halved[k] == 0) continue;

        // Every second point is one of the coarser division. Markers have three connections
        // each: points of equal areas have 3 n/(1 + 3 n) of it
        const label n = (1 << halved[k]) - 1, coarse = n / 2;
        const scalar area = shares[on.first] + shares[on.second];
        const scalar ofAll = 3 * fine / (1 + 3 * n),
                     ofCoarse = 3 * (1 - fine) / (1 + 3 * coarse),
                     ofMarkers = n * ofAll + coarse * ofCoarse;
        i.size -= ofMarkers * shares[on.first];
        j.size -= ofMarkers * shares[on.second];
        for (label m = 1; m <= n; ++m)
        {
            points.append(interactingPoint{
                (ofAll + (m % 2 ? 0 : ofCoarse)) * area, 0, apart});
        }
    }
}

void Foam::contactSurface::setBetween(const label* halved, vector* values) const
{
    vector* between = values + nMarkers_;
    forAll(connections_, k)
    {
        const connection& on = connections_[k];
        const vector &x = values[on.first], &y = values[on.second];
        if (halved[k] == 0) continue;
        const scalar n = 1 << halved[k];
        vector height(Zero);
        for (label w = on.firstHeight; w < on.endHeight; ++w)
        {
            height += heights_[w].value * values[heights_[w].marker];
        }
        for (label m = 1; m < n; ++m)
        {
            const scalar s = m / n;
            *between++ = x + s * (y - x) + 4 * s * (1 - s) * height;
        }
    }
}

void Foam::contactSurface::addTo(const label* halved, const vector* forces,
                                 vectorField& F) const
{
    for (label i = 0; i < nMarkers_; ++i)
    {
        F[i] += forces[i];
    }
    const vector* between = forces + nMarkers_;
    forAll(connections_, k)
    {
        const connection& on = connections_[k];
        if (halved[k] == 0) continue;
        const scalar n = 1 << halved[k];
        vector onHeight(Zero);
        for (label m = 1; m < n; ++m)
        {
            const scalar s = m / n;
            const vector force(*between++);
            F[on.first] += (1 - s) * force;
            F[on.second] += s * force;
            onHeight += 4 * s * (1 - s) * force;
        }
        for (label w = on.firstHeight; w < on.endHeight; ++w)
        {
            F[heights_[w].marker] += heights_[w].value * onHeight;
        }
    }
}
