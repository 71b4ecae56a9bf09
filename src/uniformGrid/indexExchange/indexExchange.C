// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "indexExchange.H"
#include "PstreamBuffers.H"

Foam::indexExchange::indexExchange(const labelUList& rank,
                                   const labelUList& place)
    : source_(Pstream::nProcs()),
      target_(Pstream::nProcs()),
      sent_(Pstream::nProcs()),
      received_(Pstream::nProcs())
{
    labelList count(Pstream::nProcs(), Zero);
    forAll(rank, i)
    {
        ++count[rank[i]];
    }
    List<labelList> places(Pstream::nProcs());
    forAll(source_, proci)
    {
        source_[proci].setSize(count[proci]);
        places[proci].setSize(count[proci]);
    }
    count = 0;
    forAll(rank, i)
    {
        const label k = count[rank[i]]++;
        source_[rank[i]][k] = i;
        places[rank[i]][k] = place[i];
    }

    PstreamBuffers buffers(Pstream::commsTypes::nonBlocking);
    forAll(places, proci)
    {
        if (proci == Pstream::myProcNo())
        {
            target_[proci] = places[proci];
        }
        else if (places[proci].size())
        {
            UOPstream os(proci, buffers);
            os << places[proci];
        }
    }
    labelList bytes;
    buffers.finishedSends(bytes);
    forAll(bytes, proci)
    {
        if (bytes[proci] && proci != Pstream::myProcNo())
        {
            UIPstream is(proci, buffers);
            is >> target_[proci];
        }
    }

    forAll(source_, proci)
    {
        if (proci != Pstream::myProcNo())
        {
            const label n = max(source_[proci].size(), target_[proci].size());
            sent_[proci].setSize(n);
            received_[proci].setSize(n);
        }
    }
}

void Foam::indexExchange::transfer(const List<labelList>& from,
                                   const List<labelList>& to, const scalar* src,
                                   scalar* dst) const
{
    const label me = Pstream::myProcNo();
    const label pending = Pstream::nRequests();

    forAll(to, proci)
    {
        if (proci != me && to[proci].size())
        {
            UIPstream::read(Pstream::commsTypes::nonBlocking, proci,
                            reinterpret_cast<char*>(received_[proci].data()),
                            to[proci].size() * sizeof(scalar));
        }
    }
    forAll(from, proci)
    {
        if (proci != me && from[proci].size())
        {
            scalar* buf = sent_[proci].data();
            for (const label i : from[proci])
            {
                *buf++ = src[i];
            }
            UOPstream::write(
                Pstream::commsTypes::nonBlocking, proci,
                reinterpret_cast<const char*>(sent_[proci].cdata()),
                from[proci].size() * sizeof(scalar));
        }
    }

    const label* __restrict__ f = from[me].cdata();
    const label* __restrict__ t = to[me].cdata();
    const label n = from[me].size();
    for (label k = 0; k < n; ++k)
    {
        dst[t[k]] = src[f[k]];
    }

    Pstream::waitRequests(pending);
    forAll(to, proci)
    {
        if (proci != me)
        {
            const scalar* buf = received_[proci].cdata();
            for (const label i : to[proci])
            {
                dst[i] = *buf++;
            }
        }
    }
}
