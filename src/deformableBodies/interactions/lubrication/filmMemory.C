// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filmMemory.H"

Foam::filmMemory::key Foam::filmMemory::lowerFirst(const key& which)
{
    if (which[2] < 0 || which[0] < which[2]) return which;
    return {which[2], which[3], which[0], which[1]};
}

void Foam::filmMemory::append(const contact& c, DynamicList<scalar>& numbers)
{
    for (const label x : c.which)
    {
        numbers.append(x);
    }
    numbers.append(c.force);
    numbers.append(c.k);
}

size_t Foam::filmMemory::slotOf(const key& which) const
{
    size_t i = 0;
    for (const label x : which)
    {
        i = i * 1000003 + size_t(x);
    }
    i ^= i >> 17;
    const size_t mask = slots_.size() - 1;
    for (i &= mask; slots_[i].which[0] >= 0 && slots_[i].which != which;)
    {
        i = (i + 1) & mask;
    }
    return i;
}

const Foam::filmMemory::contact* Foam::filmMemory::find(const key& which) const
{
    if (slots_.empty()) return nullptr;
    const contact& found = slots_[slotOf(which)];
    return found.which[0] < 0 ? nullptr : &found;
}

void Foam::filmMemory::set(const UList<scalar>& contacts)
{
    size_t size = 4;
    while (3 * size < size_t(contacts.size()))
        size *= 2;
    slots_.assign(size, {{{-1, -1, -1, -1}}, 0, 0});
    for (label n = 0; n < contacts.size(); n += 6)
    {
        const scalar* x = &contacts[n];
        const key which(
            lowerFirst({label(x[0]), label(x[1]), label(x[2]), label(x[3])}));
        slots_[slotOf(which)] = {which, x[4], x[5]};
    }
}

Foam::scalarList Foam::filmMemory::contacts() const
{
    DynamicList<scalar> all(6 * slots_.size());
    for (const contact& c : slots_)
    {
        if (c.which[0] >= 0) append(c, all);
    }
    return scalarList(std::move(all));
}
