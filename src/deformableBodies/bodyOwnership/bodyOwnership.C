// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyOwnership.H"

void Foam::bodyOwnership::distribute(PtrList<bodyGroup>& groups, const label g,
                                     const List<scalarList>& states,
                                     const dictionary& source) const
{
    bodyGroup& group = groups[g];
    for (label body = 0; body < group.nBodies(); ++body)
    {
        const scalarList state(states.size() ? states[body] : scalarList());
        if (states.size() && state.empty()) continue; // removed body
        const point centre(states.size() ? group.centreOf(state, body, source)
                                         : group.initialCentre(body));
        if (group.host() < 0
                ? neighbours_.holderOfAll(centre) == Pstream::myProcNo()
                : groups[group.host()].mine().found(body))
        {
            group.insert(body, state, source);
        }
    }
}

Foam::List<Foam::labelList>
Foam::bodyOwnership::nBodies(const PtrList<bodyGroup>& groups) const
{
    const label me = neighbours_.me(), nRanks = neighbours_.ranks().size();
    List<scalarField> n(nRanks, scalarField(groups.size()));
    forAll(groups, g)
    {
        n[me][g] = groups[g].mine().size();
    }
    blockNeighbours::values out, in;
    forAll(n, r)
    {
        out.emplace_back(n[me].data(), n[me].size());
        in.emplace_back(n[r].data(), n[r].size());
    }
    neighbours_.exchange(out, in);

    List<labelList> byGroup(groups.size(), labelList(nRanks));
    forAll(byGroup, g)
    {
        forAll(n, r)
        {
            byGroup[g][r] = label(n[r][g]);
        }
    }
    return byGroup;
}

Foam::labelList Foam::bodyOwnership::shares(const UList<labelVector>& cells,
                                            labelList n) const
{
    const label me = neighbours_.me();
    labelList to(cells.size(), me);
    const auto give = [&](const label i, const label r)
    {
        to[i] = r;
        --n[me];
        ++n[r];
    };
    bool most = true;
    forAll(n, r)
    {
        most = most && (n[r] < n[me] || (n[r] == n[me] && me <= r));
    }
    forAll(to, i)
    {
        const label holder = neighbours_.holder(cells[i]);
        if (holder != me && holder >= 0 &&
            (n[holder] < n[me] || neighbours_.away(cells[i]) > strayLayers_))
        {
            give(i, holder);
        }
    }
    if (!most || min(n) > n[me] - 2) return to;

    label body = -1, fewest = me;
    forAll(to, i)
    {
        if (to[i] != me) continue;
        neighbours_.each(neighbours_.near(strayLayers_), cells[i],
                         [&](const label r)
                         {
                             if (n[r] >= n[fewest]) return;
                             fewest = r;
                             body = i;
                         });
    }
    if (body >= 0 && n[fewest] <= n[me] - 2) give(body, fewest);
    return to;
}

Foam::List<Foam::labelList>
Foam::bodyOwnership::newOwners(const PtrList<bodyGroup>& groups) const
{
    DynamicList<point> centres;
    forAll(groups, g)
    {
        if (groups[g].host() >= 0) continue;
        forAll(groups[g].mine(), i)
        {
            centres.append(groups[g].centre(i));
        }
    }
    const List<labelVector> cells(neighbours_.cover(centres, 0));
    const List<labelList> n(nBodies(groups));
    List<labelList> to(groups.size());
    label first = 0;
    forAll(groups, g)
    {
        const label host = groups[g].host(), size = groups[g].mine().size();
        if (host >= 0)
        {
            to[g] = to[host];
            continue;
        }
        to[g] = shares(SubList<labelVector>(cells, size, first), n[g]);
        first += size;
    }
    return to;
}

// Message of each body: group, number, size of its state, state
Foam::label Foam::bodyOwnership::release(PtrList<bodyGroup>& groups,
                                         const List<labelList>& to,
                                         List<scalarField>& out) const
{
    List<DynamicList<scalar>> leaving(neighbours_.ranks().size());
    label nLeaving = 0;
    forAll(groups, g)
    {
        forAllReverse(to[g], i)
        {
            const label r = to[g][i];
            if (r == neighbours_.me()) continue;
            const label body = groups[g].mine()[i];
            const scalarList state(groups[g].release(i));
            leaving[r].append(scalar(g));
            leaving[r].append(scalar(body));
            leaving[r].append(scalar(state.size()));
            leaving[r].append(state);
            ++nLeaving;
        }
    }
    out.setSize(leaving.size());
    forAll(out, r)
    {
        out[r] = scalarField(leaving[r]);
    }
    return nLeaving;
}

void Foam::bodyOwnership::insert(PtrList<bodyGroup>& groups,
                                 const scalarField& bodies)
{
    for (label at = 0; at < bodies.size();)
    {
        const label g = label(bodies[at]), body = label(bodies[at + 1]),
                    size = label(bodies[at + 2]);
        groups[g].insert(body,
                         scalarList(SubList<scalar>(bodies, size, at + 3)),
                         dictionary::null);
        at += 3 + size;
    }
}

void Foam::bodyOwnership::migrate(PtrList<bodyGroup>& groups)
{
    if (!Pstream::parRun()) return;

    List<scalarField> out, in;
    const label nLeaving =
        returnReduce(release(groups, newOwners(groups), out), sumOp<label>());
    if (nLeaving == 0) return;
    handedOver_ += nLeaving;

    neighbours_.exchange(out, in);
    for (const scalarField& bodies : in)
    {
        insert(groups, bodies);
    }
}
