// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "closeWarnings.H"
#include "directForcing.H"
#include "dictionaryChecks.H"
#include "Time.H"

Foam::closeWarnings::closeWarnings(const Time& time, const uniformGrid& grid,
                                   PtrList<bodyGroup>& groups,
                                   markerSet& markers,
                                   const bodyInteractions* interactions,
                                   const neighbourField* between)
    : time_(time),
      groups_(groups),
      markers_(markers),
      grid_(grid),
      numbers_(groups),
      imageNamed_(groups.size(), false),
      named_(groups.size() * (groups.size() + 1) / 2, false),
      limit_(named_.size(), 1.5)
{
    forAll(groups_, g)
    {
        for (label h = 0; h <= g; ++h)
        {
            // No warning of pairs without a force through the fluid, and of pairs that
            // interact
            named_[pairOf(g, h)] =
                !groups_[g].twoWay() || !groups_[h].twoWay() ||
                (g == h && groups_[g].nBodies() < 2) ||
                (interactions && interactions->actBetween(g, h));
            if (between && between->actBetween(g, h))
            {
                limit_[pairOf(g, h)] = 0.75;
            }
        }
    }
}

Foam::label Foam::closeWarnings::pairOf(const label g, const label h) const
{
    const label a = max(g, h), b = min(g, h);
    return a * (a + 1) / 2 + b;
}

Foam::List<Foam::closeWarnings::encounter> Foam::closeWarnings::closest()
{
    label n = 0;
    for (const bodyGroup& group : groups_)
    {
        n += group.nMarkers();
    }
    vectorField X(n);
    labelList body(n);
    label first = 0;
    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        if (group.mine().empty() || group.nMarkers() == 0) continue;
        const label each = group.nMarkers() / group.mine().size();
        group.placeMarkers(X.data() + first, 0);
        forAll(group.mine(), i)
        {
            std::fill_n(body.data() + first + i * each, each, group.mine()[i]);
        }

        // Markers beside the line of a fibre get -1
        if (group.forcing() != forcingType::none)
        {
            refCast<const directForcing>(group).lines(body.data() + first);
        }
        for (label k = first; k < first + group.nMarkers(); ++k)
        {
            if (!group.twoWay()) body[k] = -1;
            if (body[k] >= 0) body[k] = numbers_.number(g, body[k]);
        }
        first += group.nMarkers();
    }
    markers_.setPositions(X);

    List<encounter> closest(named_.size());
    const auto visit =
        [&](const label a, const label b, const point& x, const scalar distance)
    {
        const label pair = pairOf(numbers_.group(a), numbers_.group(b));
        encounter& e = closest[pair];
        if (named_[pair] || distance >= min(e.distance, limit_[pair])) return;
        e.distance = distance;
        e.a = a;
        e.b = b;
        e.position = x;
    };
    markers_.closeLines(X, body, visit);
    return closest;
}

Foam::string Foam::closeWarnings::describe(const encounter& e) const
{
    const auto nameOf = [&](const label number) {
        return groups_[numbers_.group(number)].nameOfBody(
            numbers_.body(number));
    };
    OStringStream os;
    os.precision(6);
    os << nameOf(e.a).c_str() << " and " << nameOf(e.b).c_str() << " are "
       << e.distance << " cells apart at " << e.position;
    return os.str();
}

void Foam::closeWarnings::warnOfImages()
{
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (imageNamed_[g] || !group.twoWay() ||
            group.forcing() == forcingType::ofLines)
            continue;
        const scalar limit = limit_[pairOf(g, g)];
        string reaches;
        forAll(group.mine(), i)
        {
            const vector free(grid_.length() - group.bounds(i, true).span());
            for (direction d = 0; d < 3; ++d)
            {
                if (!grid_.periodic(d) || free[d] > limit * grid_.h()[d])
                    continue;
                reaches = group.nameOfBody(group.mine()[i]) +
                          " reaches its own image in " +
                          vector::componentNames[d];
            }
        }
        imageNamed_[g] = returnReduce(!reaches.empty(), orOp<bool>());
        if (!imageNamed_[g]) continue;
        reaches = firstOf(reaches);
        WarningInFunction
            << reaches.c_str() << ", at time " << time_.timeName() << nl
            << "    No contact keeps a body from its own image: use a longer "
            << "box (said once for this group)" << endl;
    }
}

void Foam::closeWarnings::look()
{
    if (lastStep_ == time_.timeIndex()) return;
    lastStep_ = time_.timeIndex();
    if (steps_++ % 50) return;
    warnOfImages();
    if (!named_.found(false)) return;

    // Encounters are rare: most calls end with one reduction
    const List<encounter> closest(this->closest());
    bool any = false;
    for (const encounter& e : closest)
    {
        any = any || e.distance < GREAT;
    }
    if (!returnReduce(any, orOp<bool>())) return;
    forAll(closest, pair)
    {
        const encounter& e = closest[pair];
        const scalar least = returnReduce(e.distance, minOp<scalar>());
        if (least == GREAT) continue;
        named_[pair] = true;
        const string sentence(
            firstOf(e.distance == least ? describe(e) : string()));
        WarningInFunction
            << sentence.c_str() << ", at time " << time_.timeName() << nl
            << "    Below " << limit_[pair]
            << " cells the fluid between bodies is not resolved, and nothing "
               "keeps them apart (said once for these "
            << "groups)" << endl;
    }
}
