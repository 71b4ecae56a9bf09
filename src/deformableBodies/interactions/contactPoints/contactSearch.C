// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "contactSearch.H"

void Foam::contactSearch::search(const UList<vector>& X,
                                 const UList<interactingPoint>& own,
                                 const labelUList& body,
                                 const UList<scalar>& along, const scalar apart)
{
    pairs_.search(SubList<vector>(X, body.size()), body, along, apart);
    const label nHere = pairs_.here().size();
    if (!Pstream::parRun())
    {
        points_.shallowCopy(SubList<interactingPoint>(own, nHere));
        return;
    }
    const scalarField numbers(
        pairs_.handOut(reinterpret_cast<const scalar*>(own.cdata()),
                       sizeof(interactingPoint) / sizeof(scalar)));
    copies_.setSize(nHere);
    std::copy(numbers.begin(), numbers.end(),
              reinterpret_cast<scalar*>(copies_.data()));
    points_.shallowCopy(copies_);
}
