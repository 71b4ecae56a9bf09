// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filamentLoad.H"
#include "dictionaryChecks.H"

Foam::filamentLoad::filamentLoad(const dictionary& dict)
    : at_(dict.getOrDefault<word>("at", "last"))
{
    checkEntries(dict, {"type", "group", "force", "at"});
    const word type(dict.get<word>("type"));
    if (type == "deadLoad")
    {
        dead_ = Function1<vector>::New("force", dict);
    }
    else if (type == "followerLoad")
    {
        follower_ = Function1<scalar>::New("force", dict);
    }
    else
    {
        refuse(dict, "type", type, "(deadLoad followerLoad) for filaments");
    }
    if (!wordList({"first", "last", "all"}).found(at_))
    {
        refuse(dict, "at", at_, "(first last all)");
    }
}

void Foam::filamentLoad::add(const vectorField& X, const scalar ds,
                             const scalar time, vectorField& force) const
{
    const label N = X.size() - 1;
    const vector dead(dead_.valid() ? dead_->value(time) : vector(Zero));
    const scalar follower = follower_.valid() ? follower_->value(time) : 0;
    forAll(X, i)
    {
        // An end stands for half a segment
        scalar perLength = 0;
        if (at_ == "all") perLength = 1 / (N * ds);
        if (at_ == (i == 0 ? "first" : i == N ? "last" : ""))
        {
            perLength = 2 / ds;
        }
        if (perLength == 0) continue;

        const vector t(X[min(i + 1, N)] - X[max(i - 1, label(0))]);
        force[i] += perLength * (dead + follower / mag(t) * t);
    }
}
