// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "indexExchange.H"
#include "DynamicList.H"
#include "PstreamBuffers.H"

int64_t Foam::indexExchange::messages = 0;
int64_t Foam::indexExchange::bytes = 0;

namespace
{
//- Exchanges that are under way, and the requests that there were before them
Foam::label underWay = 0, before = 0;

//- Values with a stride to values with a stride
inline void copy(const double* from, const Foam::label sf, double* to,
                 const Foam::label st, const Foam::label n)
{
    if (sf == 1 && st == 1)
    {
        std::copy_n(from, n, to);
        return;
    }
    for (Foam::label i = 0; i < n; ++i)
    {
        to[i * st] = from[i * sf];
    }
}
} // namespace

// Longest stretches along which both lists have a constant stride
template<class Visit>
void Foam::indexExchange::divide(const labelUList& a, const labelUList& b,
                                 Visit visit)
{
    for (label begin = 0; begin < a.size();)
    {
        label end = begin + 1;
        label sa = 1, sb = 1;
        if (end < a.size())
        {
            sa = a[end] - a[begin];
            sb = b[end] - b[begin];
        }
        while (end < a.size() && a[end] - a[end - 1] == sa &&
               b[end] - b[end - 1] == sb)
        {
            ++end;
        }
        visit(run{a[begin], sa, end - begin}, run{b[begin], sb, end - begin});
        begin = end;
    }
}

Foam::List<Foam::indexExchange::run>
Foam::indexExchange::runs(const labelUList& targets)
{
    DynamicList<run> all;
    divide(targets, targets, [&](const run& r, const run&) { all.append(r); });
    return List<run>(std::move(all));
}

void Foam::indexExchange::keep(const labelUList& sources,
                               const labelUList& targets)
{
    DynamicList<run> from, to;
    divide(sources, targets,
           [&](const run& s, const run& t)
           {
               from.append(s);
               to.append(t);
           });
    ownSource_.transfer(from);
    ownTarget_.transfer(to);
}

Foam::indexExchange::indexExchange(const labelUList& rank,
                                   const labelUList& target,
                                   const labelUList& source)
{
    const label me = Pstream::myProcNo();
    labelList count(Pstream::nProcs(), Zero);
    forAll(rank, i)
    {
        ++count[rank[i]];
    }
    List<labelList> sources(Pstream::nProcs()), targets(Pstream::nProcs());
    forAll(count, proci)
    {
        sources[proci].setSize(count[proci]);
        targets[proci].setSize(count[proci]);
    }
    count = 0;
    forAll(rank, i)
    {
        const label k = count[rank[i]]++;
        sources[rank[i]][k] = source.size() ? source[i] : i;
        targets[rank[i]][k] = target[i];
    }

    keep(sources[me], targets[me]);
    if (!Pstream::parRun()) return;

    PstreamBuffers buffers(Pstream::commsTypes::nonBlocking);
    forAll(targets, proci)
    {
        if (proci != me && targets[proci].size())
        {
            UOPstream os(proci, buffers);
            os << targets[proci];
        }
    }
    labelList sizes;
    buffers.finishedSends(sizes);
    forAll(sizes, proci)
    {
        labelList theirs;
        if (proci != me && sizes[proci])
        {
            UIPstream is(proci, buffers);
            is >> theirs;
        }
        const labelList& ours = sources[proci];
        if (proci == me || (theirs.empty() && ours.empty())) continue;

        routes_.append(route{proci, ours.size(), theirs.size(), runs(ours),
                             runs(theirs), scalarField(), scalarField()});
    }
}

void Foam::indexExchange::start(const bool forward, const label n,
                                const scalar* const* src) const
{
    if (underWay++ == 0) before = Pstream::nRequests();
    firstRequest_ = Pstream::nRequests();
    for (const route& r : routes_)
    {
        const label size = n * (forward ? r.there : r.here);
        if (r.in.size() < size) r.in.setSize(size);
        if (size)
        {
            UIPstream::read(Pstream::commsTypes::nonBlocking, r.rank,
                            reinterpret_cast<char*>(r.in.data()),
                            size * sizeof(scalar));
        }
    }
    for (const route& r : routes_)
    {
        const label size = n * (forward ? r.here : r.there);
        if (r.out.size() < size) r.out.setSize(size);
        scalar* buf = r.out.data();
        for (label k = 0; k < n; ++k)
        {
            for (const run& s : forward ? r.source : r.target)
            {
                copy(src[k] + s.start, s.stride, buf, 1, s.length);
                buf += s.length;
            }
        }
        if (size)
        {
            UOPstream::write(Pstream::commsTypes::nonBlocking, r.rank,
                             reinterpret_cast<const char*>(r.out.cdata()),
                             size * sizeof(scalar));
            count(size * sizeof(scalar));
        }
    }
    endRequest_ = Pstream::nRequests();
}

void Foam::indexExchange::finish(const bool forward, const label n,
                                 const scalar* const* src,
                                 scalar* const* dst) const
{
    const List<run>& from = forward ? ownSource_ : ownTarget_;
    const List<run>& to = forward ? ownTarget_ : ownSource_;
    for (label k = 0; k < n; ++k)
    {
        forAll(from, i)
        {
            copy(src[k] + from[i].start, from[i].stride, dst[k] + to[i].start,
                 to[i].stride, from[i].length);
        }
    }

    // While another exchange is under way the list of requests stays
    if (--underWay == 0)
    {
        Pstream::waitRequests(before);
    }
    else
    {
        for (label i = firstRequest_; i < endRequest_; ++i)
        {
            while (!Pstream::finishedRequest(i))
            {
            }
        }
    }
    for (const route& r : routes_)
    {
        const scalar* buf = r.in.cdata();
        for (label k = 0; k < n; ++k)
        {
            for (const run& t : forward ? r.target : r.source)
            {
                copy(buf, 1, dst[k] + t.start, t.stride, t.length);
                buf += t.length;
            }
        }
    }
}
