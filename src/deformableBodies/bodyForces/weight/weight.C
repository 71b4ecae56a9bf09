// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "weight.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

namespace Foam
{
defineTypeNameAndDebug(weight, 0);
addToRunTimeSelectionTable(bodyForce, weight, dictionary);
} // namespace Foam

Foam::weight::weight(const dictionary& dict, const bodyPoints&)
    : bodyForce(dict.get<word>("group")),
      excess_(dict.get<vector>("excess"))
{
    checkEntries(dict, {"type", "group", "excess"});
}

void Foam::weight::add(const bodyPoints& body, const scalar,
                       vectorField& F) const
{
    if (body.volume > 0)
    {
        F += body.volume / F.size() * excess_;
        return;
    }
    if (!body.isSurface())
    {
        F += body.crossSection * body.lengths * excess_;
        return;
    }
    const vector centre(average(body.positions));
    F += (excess_ & (body.positions - centre)) * body.areas;
}
