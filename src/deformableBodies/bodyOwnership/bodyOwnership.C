// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyOwnership.H"

void Foam::bodyOwnership::distribute(bodyGroup& group,
                                     const List<scalarList>& states,
                                     const dictionary& source) const
{
    for (label body = 0; body < group.nBodies(); ++body)
    {
        const scalarList state(states.size() ? states[body] : scalarList());
        if (states.size() && state.empty()) continue; // it has been removed
        const point centre(states.size() ? group.centreOf(state, body, source)
                                         : group.initialCentre(body));
        if (group.host() < 0
                ? neighbours_.holderOfAll(centre) == Pstream::myProcNo()
                : group.hasHostOf(body))
        {
            group.insert(body, state, source);
        }
    }
}

void Foam::bodyOwnership::migrate(PtrList<bodyGroup>& groups)
{
    if (!Pstream::parRun()) return;

    DynamicList<point> centres;
    forAll(groups, g)
    {
        forAll(groups[g].mine(), i)
        {
            centres.append(groups[g].owningPlace(i));
        }
    }
    neighbours_.cover(centres, 0);
    // Of each body that leaves: group, number, size of its state, its state
    List<DynamicList<scalar>> leaving(neighbours_.ranks().size());
    label nLeaving = 0;
    label k = centres.size();
    forAllReverse(groups, g)
    {
        forAllReverse(groups[g].mine(), i)
        {
            const label holder = neighbours_.holder(centres[--k]);
            if (holder == neighbours_.me() || holder < 0) continue;
            const label body = groups[g].mine()[i];
            const scalarList state(groups[g].release(i));
            leaving[holder].append(scalar(g));
            leaving[holder].append(scalar(body));
            leaving[holder].append(scalar(state.size()));
            leaving[holder].append(state);
            ++nLeaving;
        }
    }
    reduce(nLeaving, sumOp<label>());
    if (nLeaving == 0) return;
    handedOver_ += nLeaving;

    List<scalarField> out(leaving.size()), in;
    forAll(out, r)
    {
        out[r] = scalarField(leaving[r]);
    }
    neighbours_.exchange(out, in);
    for (const scalarField& from : in)
    {
        for (label at = 0; at < from.size();)
        {
            const label g = label(from[at]), body = label(from[at + 1]),
                        size = label(from[at + 2]);
            groups[g].insert(body,
                             scalarList(SubList<scalar>(from, size, at + 3)),
                             dictionary::null);
            at += 3 + size;
        }
    }
}
