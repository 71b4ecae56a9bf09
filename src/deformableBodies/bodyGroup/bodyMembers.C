// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyMembers.H"
#include <algorithm>

Foam::bodyMembers::bodyMembers(const word& name, const dictionary& dict,
                               const bodyScene& scene)
    : name_(name),
      coupling_(readCoupling(dict, scene.coupling)),
      removesOutside_(Foam::removesOutside(dict, scene.removesOutside))
{
}

Foam::string Foam::bodyMembers::nameOfBody(const label body) const
{
    return "body " + Foam::name(body) + " of group " + name_;
}

Foam::label Foam::bodyMembers::add(const label body, const bool atStart)
{
    const label i =
        std::lower_bound(mine_.begin(), mine_.end(), body) - mine_.begin();
    mine_.append(body);
    for (label k = mine_.size() - 1; k > i; --k)
    {
        mine_[k] = mine_[k - 1];
    }
    mine_[i] = body;
    startsAfresh_ = startsAfresh_ || atStart;
    return i;
}

void Foam::bodyMembers::remove(const label i)
{
    for (label k = i; k + 1 < mine_.size(); ++k)
    {
        mine_[k] = mine_[k + 1];
    }
    mine_.setSize(mine_.size() - 1);
}
