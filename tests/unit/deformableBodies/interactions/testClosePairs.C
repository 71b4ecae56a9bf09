// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "collision.H"
#include "dictionary.H"
#include "IStringStream.H"
#include "mathematicalConstants.H"
#include "periodicBox.H"
#include "repulsion.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

//- Points of several bodies, the same on all ranks: clouds of half a cell about random
//  centres, also beyond periodic sides; or chains with steps of about 0.4 cells, every
//  second one of which may fold
struct clouds
{
    vectorField X;
    labelList body;
    scalarField along;

    explicit clouds(const label nBodies, const label nPoints = 30,
                    const bool chains = false)
    {
        Random random(3);
        DynamicList<vector> x;
        DynamicList<label> b;
        DynamicList<scalar> l;
        for (label i = 0; i < nBodies; ++i)
        {
            vector centre(random.sample01<vector>());
            for (direction d = 0; d < 3; ++d)
            {
                const scalar s =
                    grid().periodic(d) ? 2 * centre[d] - 0.5 : centre[d];
                centre[d] = grid().origin()[d] + s * grid().length()[d];
            }
            for (label k = 0; k < nPoints; ++k)
            {
                const vector off(random.sample01<vector>() - 0.5 * vector::one);
                vector p(centre + cmptMultiply(2 * off, grid().h()));
                if (chains) p = centre + 0.4 * (p - centre);
                for (direction d = 0; d < 3; ++d)
                {
                    const scalar lo = grid().origin()[d];
                    if (grid().periodic(d)) continue;
                    p[d] = min(max(p[d], lo), lo + grid().length()[d]);
                }
                if (chains) centre = p;
                x.append(p);
                b.append(i);
                l.append(chains && i % 2 ? 0.4 * k * cmptMin(grid().h()) : -1);
            }
        }
        X = x;
        body = b;
        along = l;
    }

    //- Bodies of this rank: every so many, wherever they are
    labelList mine() const
    {
        DynamicList<label> own;
        forAll(X, k)
        {
            if (body[k] % Pstream::nProcs() == Pstream::myProcNo())
            {
                own.append(k);
            }
        }
        return labelList(std::move(own));
    }
};
} // namespace

namespace
{
//- Close pairs equal those of a search over all points. Bodies of even number make no pairs
//  with each other if so configured; parts of one body make pairs if they are more than four
//  cells apart along it
void isAsByAllPairs(const clouds& all, const bool evenOnesDoNot)
{
    const scalar h = cmptMin(grid().h()), range = 1.5 * h, apart = 4 * h;
    const auto number = [&](const label k)
    {
        const label b = all.body[k];
        return evenOnesDoNot && b % 2 == 0 ? -1 - b : b;
    };
    const labelList mine(all.mine());
    labelList bodies(mine.size());
    forAll(mine, k)
    {
        bodies[k] = number(mine[k]);
    }
    closePairs pairs(grid(), range);
    const vectorField X(UIndirectList<vector>(all.X, mine));
    pairs.search(X, bodies, scalarField(UIndirectList<scalar>(all.along, mine)),
                 apart);

    // A pair counts twice if this rank holds both points, once if it holds one
    label found = 0;
    scalar distances = 0;
    for (const closePairs::pair& p : pairs.pairs())
    {
        found += p.bothHeld ? 2 : 1;
        distances += (p.bothHeld ? 2 : 1) * mag(p.r);
    }
    reduce(found, sumOp<label>());
    reduce(distances, sumOp<scalar>());
    label expected = 0;
    scalar expectedDistances = 0;
    forAll(all.X, i)
    {
        for (label j = 0; j < i; ++j)
        {
            const scalar r = mag(nearestImage(grid(), all.X[i], all.X[j]));
            const bool pair = all.body[i] == all.body[j]
                                  ? all.along[i] >= 0 &&
                                        mag(all.along[i] - all.along[j]) > apart
                                  : number(i) >= 0 || number(j) >= 0;
            if (!pair || r >= range) continue;
            expected += 2;
            expectedDistances += 2 * r;
        }
    }
    EXPECT_GT(expected, 100);
    EXPECT_EQ(found, expected);
    test::expectBelow("sum of the distances of pairs",
                      mag(distances / expectedDistances - 1), 1e-12);
}
} // namespace

TEST(ClosePairs, asByAllPairs)
{
    isAsByAllPairs(clouds(25), false);
}

TEST(ClosePairs, ofLongBodiesAsByAllPairs)
{
    isAsByAllPairs(clouds(7, 150, true), false);
    isAsByAllPairs(clouds(7, 150, true), true);
}

// Eight successive points of a sphere lie within a cap of about eight times their area
TEST(ClosePairs, patchesAreCompact)
{
    DynamicList<vector> X;
    const label n = 596;
    for (label k = 0; k < n; ++k)
    {
        const scalar z = 1 - (2 * k + 1.0) / n, turn = 2.4 * k;
        X.append(vector(std::cos(turn), std::sin(turn), 0) *
                     std::sqrt(1 - sqr(z)) +
                 vector(0, 0, z));
    }
    const labelList order(patchOrder(X));
    labelList sorted(order);
    sort(sorted);
    EXPECT_EQ(sorted, identity(n));
    scalar sum = 0;
    for (label k = 0; k < n; k += closePairs::nParts)
    {
        vector middle(Zero);
        const label end = min(k + closePairs::nParts, n);
        for (label i = k; i < end; ++i)
        {
            middle += X[order[i]] / (end - k);
        }
        scalar radius = 0;
        for (label i = k; i < end; ++i)
        {
            radius = max(radius, mag(X[order[i]] - middle));
        }
        sum += radius;
    }
    const scalar ofCap = 2 * std::sqrt(scalar(closePairs::nParts) / n);
    test::expectBelow("mean radius over that of a cap of the same area",
                      sum / ((n - 1) / closePairs::nParts + 1) / ofCap, 1.4);
}

namespace
{
//- Forces of a model between clouds satisfy action = reaction
void isMutual(const contactForce& model, const scalar radius)
{
    const scalar h = cmptMin(grid().h());
    closePairs pairs(grid(), model.range(radius == 0, radius == 0));
    const clouds all(25);
    const labelList mine(all.mine());
    const vectorField X(UIndirectList<vector>(all.X, mine));
    pairs.search(X, labelList(UIndirectList<label>(all.body, mine)));
    const label n = pairs.here().size();
    const List<interactingPoint> points(n, interactingPoint{sqr(h), radius, 0});
    vectorField there(n, Zero), F(mine.size(), Zero);
    pairForces forces{there};
    model.add(pairs, points, forces);
    pairs.addUp(scalarField(UList<scalar>(
                    reinterpret_cast<scalar*>(there.data()), 3 * n)),
                3, reinterpret_cast<scalar*>(F.data()));
    vector sum(Zero), torque(Zero);
    scalar size = 0;
    forAll(F, k)
    {
        sum += F[k];
        size += mag(F[k]);
    }
    // Torque about an axis that all images share, if nothing is periodic
    const bool periodic =
        grid().periodic(0) || grid().periodic(1) || grid().periodic(2);
    forAll(F, k)
    {
        if (!periodic) torque += all.X[mine[k]] ^ F[k];
    }
    reduce(sum, sumOp<vector>());
    reduce(torque, sumOp<vector>());
    reduce(size, sumOp<scalar>());
    EXPECT_GT(size, 0);
    test::expectBelow("sum of forces over that of their sizes", mag(sum) / size,
                      1e-13);
    test::expectBelow("torque, likewise over the length of the box",
                      mag(torque) / size / mag(grid().length()), 1e-13);
}
} // namespace

TEST(ClosePairs, repulsionIsMutual)
{
    IStringStream none("");
    isMutual(repulsion(dictionary(none),
                       interactionScene{grid(), 1, 1e-9, 2, 0, 0, {}}),
             0);
}

TEST(ClosePairs, collisionIsMutual)
{
    IStringStream none("");
    const scalar radius = 0.7 * cmptMin(grid().h());
    isMutual(
        collision(dictionary(none),
                  interactionScene{grid(), 1, 0.01, 0, radius, radius, {}}),
        radius);
}

// Two long crossing lines exert the force of the law divided by the sine of their angle
TEST(ClosePairs, forceOfCrossingLines)
{
    if (Pstream::parRun()) return;
    const vector L(grid().length());
    const scalar h = cmptMax(grid().h()), radius = 0.15 * h;
    IStringStream is("range " + Foam::name(0.6 * h) + "; strength 3;");
    const dictionary dict(is);
    const collision model(
        dict, interactionScene{grid(), 1, 0.01, 0, radius, radius, {}});
    const point middle(grid().origin() + 0.5 * L);
    for (const scalar angle : {30.0, 60.0, 90.0})
    {
        const scalar a = angle / 180 * constant::mathematical::pi;
        const scalar gap = 0.3 * h, spacing = 0.02 * h;
        DynamicList<vector> X;
        DynamicList<label> body;
        for (label k = -300; k <= 300; ++k)
        {
            const scalar s = k * spacing;
            if (mag(s) > 0.4 * cmptMin(L)) continue;
            X.append(middle + vector(s, 0, 0));
            body.append(0);
            X.append(middle + vector(s * std::cos(a), s * std::sin(a),
                                     2 * radius + gap));
            body.append(1);
        }
        closePairs pairs(grid(), model.range(false, false));
        pairs.search(X, body);
        const label n = X.size();
        const List<interactingPoint> points(
            n, interactingPoint{spacing * h, radius, 0});
        vectorField F(n, Zero);
        pairForces forces{F};
        model.add(pairs, points, forces);
        vector sum(Zero);
        tensor moment(Zero);
        forAll(F, k)
        {
            if (body[k] == 1) sum += F[k];
            moment += F[k] * X[k];
        }
        EXPECT_LT(mag(moment - forces.moment), 1e-12 * mag(moment));
        test::expectBelow("force at " + std::to_string(angle) + " degrees",
                          mag(sum.z() * std::sin(a) / 3 - 1), 0.02);
        EXPECT_EQ(model.ofWall(gap, true), 0);
        EXPECT_NEAR(model.ofWall(gap, false) * sqr(h), 3, 1e-6);
    }
}

// The pressure between two planes is that of the law
TEST(ClosePairs, pressureOfPlanes)
{
    const scalar h = cmptMin(grid().h());
    for (const char* law : {"law Morse;", "law exponential;"})
    {
        IStringStream is(law);
        const repulsion model(dictionary(is),
                              interactionScene{grid(), 1, 1e-9, 2, 0, 0, {}});
        const scalar R = model.range(true, true);
        for (const scalar thickness : {0.0, 0.5 * R})
        {
            for (const scalar distance : {0.3, 0.5, 0.8})
            {
                // A point of a surface, or of a fibre of that radius, above a plane of
                // closely spaced points
                const scalar spacing = 0.02 * R;
                scalar force = 0;
                for (label i = -80; i <= 80; ++i)
                {
                    for (label j = -80; j <= 80; ++j)
                    {
                        const vector r(i * spacing, j * spacing,
                                       distance * R + thickness);
                        force += model.between(mag(r), mag(r) - thickness) *
                                 r.z() / mag(r) * sqr(spacing);
                    }
                }
                test::expectBelow(
                    std::string(law) + " at " + std::to_string(distance) +
                        " of the range, radius " + std::to_string(thickness),
                    mag(force / model.ofWall(distance * R, true) - 1), 0.03);
            }
        }
        EXPECT_NEAR(model.ofWall(0.5 * R, true) / 40, law[4] == 'M' ? 1 : 0.777,
                    1e-3);
        EXPECT_EQ(model.ofWall(R, true), 0);
        EXPECT_NEAR(R, 1.5 * cmptMax(grid().h()), 1e-12 * h);
    }
}
