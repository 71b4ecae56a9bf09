// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "patchCopies.H"
#include <algorithm>

Foam::scalarField Foam::patchCopies::route(const UList<vector>& centres,
                                           const labelUList& ownSizes,
                                           const scalarField& numbers,
                                           const label n, const label margin)
{
    // The size goes along as the last number
    const label full = n + 1;
    ownSizes_ = ownSizes;
    scalarField own(full * ownSizes.size());
    forAll(ownSizes, i)
    {
        std::copy_n(numbers.begin() + n * i, n, own.begin() + full * i);
        own[full * i + n] = ownSizes[i];
    }
    copies_.route(centres, margin);
    const scalarField all(copies_.handOut(own.cdata(), full));
    sizes_.setSize(copies_.here().size());
    nHere_ = 0;
    scalarField here(n * sizes_.size());
    forAll(sizes_, i)
    {
        std::copy_n(all.begin() + full * i, n, here.begin() + n * i);
        sizes_[i] = label(all[full * i + n]);
        nHere_ += sizes_[i];
    }
    return here;
}

Foam::scalarField Foam::patchCopies::handOut(const scalar* own,
                                             const label n) const
{
    if (!Pstream::parRun())
    {
        return scalarField(UList<scalar>(const_cast<scalar*>(own), n * nHere_));
    }
    const label full = nParts * n;
    scalarField numbers(full * ownSizes_.size(), Zero);
    forAll(ownSizes_, i)
    {
        const label size = n * ownSizes_[i];
        std::copy(own, own + size, &numbers[full * i]);
        own += size;
    }
    const scalarField all(copies_.handOut(numbers.cdata(), full));
    scalarField here(n * nHere_);
    scalar* to = here.data();
    forAll(sizes_, i)
    {
        to = std::copy_n(all.cdata() + full * i, n * sizes_[i], to);
    }
    return here;
}

void Foam::patchCopies::addUp(const UList<scalar>& here, const label n,
                              scalar* own) const
{
    if (!Pstream::parRun())
    {
        forAll(here, k)
        {
            own[k] += here[k];
        }
        return;
    }
    const label full = nParts * n;
    scalarField all(full * sizes_.size(), Zero),
        numbers(full * ownSizes_.size(), Zero);
    const scalar* from = here.cdata();
    forAll(sizes_, i)
    {
        const label size = n * sizes_[i];
        std::copy_n(from, size, all.data() + full * i);
        from += size;
    }
    copies_.addUp(all, full, numbers.data());
    forAll(ownSizes_, i)
    {
        for (label k = 0; k < n * ownSizes_[i]; ++k)
        {
            *own++ += numbers[full * i + k];
        }
    }
}
