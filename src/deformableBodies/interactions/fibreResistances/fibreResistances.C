// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "fibreResistances.H"

Foam::fibreMotions
Foam::fibreResistances::motionsHere(const lineMotions& own) const
{
    const closePairs& pairs = search_.pairs();
    const UList<vector>& x = pairs.here();
    const scalarField numbers(pairs.handOut(own.number.cdata(), 1));
    fibreMotions motions{
        labelList(x.size()),          pairs.handOut(own.element),
        pairs.handOut(own.velocity),  pairs.handOut(own.turn),
        scalarField(x.size(), GREAT), vectorField(x.size(), Zero)};
    forAll(x, k)
    {
        // Walls do not act beside a held end: see contactPoints::addLine
        const bool rooted = numbers[k] < 0;
        motions.numbers[k] = label(rooted ? -1 - numbers[k] : numbers[k]);
        if (search_.points()[k].radius > 0 && !rooted)
        {
            motions.toWalls[k] = walls_.distance(x[k], motions.inward[k]);
        }
    }
    return motions;
}

Foam::scalarField Foam::fibreResistances::implicit(const contactPoints& points,
                                                   const scalarField& along,
                                                   const UList<scalar>& mobility,
                                                   const scalarField& k)
{
    scalarField loss(k);
    forAll(mobility, b)
    {
        const contactPoints::range& body = points.ofBody(b);
        scalar all = 0, turning = 0;
        for (label m = body.first; m < body.end(); ++m)
        {
            all += k[m];
            turning += k[m] * along[m];
        }
        for (label m = body.first; m < body.end(); ++m)
        {
            loss[m] = mobility[b] * (all + 12 * along[m] * turning);
        }
    }
    return loss;
}

Foam::scalar Foam::fibreResistances::add(const lineMotions& own,
                                         const UList<scalar>& mobility,
                                         contactPoints& points) const
{
    const closePairs& pairs = search_.pairs();
    const fibreMotions motions(motionsHere(own));
    const label nHere = pairs.here().size(), n = points.size();
    scalarField k(nHere, Zero), ownK(n, Zero);
    for (contactResistance& model : models_)
    {
        const auto timing(effects_.time(model.type()));
        model.findResistances(pairs, search_.points(), motions, k);
    }
    pairs.addUp(k, 1, ownK.data());
    const scalarField loss(
        pairs.handOut(implicit(points, own.along, mobility, ownK).cdata(), 1));

    armedForces here{vectorField(nHere, Zero), vectorField(nHere, Zero), Zero};
    for (contactResistance& model : models_)
    {
        const auto timing(effects_.time(model.type()));
        model.resist(pairs, motions, loss, here);
    }
    vectorField F(n, Zero), arms(n, Zero);
    pairs.addUp(here.F, F);
    pairs.addUp(here.arms, arms);
    points.forces().F += F;
    points.forces().arms += arms;
    points.forces().moment = here.moment;
    return sum(F & own.velocity) + sum(arms & own.turn);
}
