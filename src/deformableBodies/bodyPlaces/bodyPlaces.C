// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyPlaces.H"
#include "dictionaryChecks.H"
#include "directForcing.H"
#include "processorPolyPatch.H"
#include "Time.H"
#include "wallPolyPatch.H"

Foam::bodyPlaces::bodyPlaces(const fvMesh& mesh, PtrList<bodyGroup>& groups,
                             markerSet& markers,
                             const bodyInteractions* interactions)
    : time_(mesh.time()),
      grid_(uniformGrid::New(mesh)),
      groups_(groups),
      markers_(markers),
      firstBody_(groups.size() + 1, label(0)),
      pairNamed_(groups.size() * (groups.size() + 1) / 2, false),
      wallNamed_(groups.size(), false),
      nearWall_(groups.size(), false)
{
    isWall_ = FixedList<bool, 2>(false);
    // Not periodic: patches of the box, and those of walls inside it
    string inside;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.coupled()) continue;
        bool isInside = false;
        FixedList<FixedList<bool, 2>, 3> at(FixedList<bool, 2>(false));
        forAll(patch, i)
        {
            const label facei = patch.start() + i;
            const direction d = grid_.faceDirection(facei);
            const scalar x =
                (mesh.faceCentres()[facei][d] - grid_.origin()[d]) /
                grid_.h()[d];
            if (x > 0.5 && x < grid_.n()[d] - 0.5)
                isInside = true;
            else
                at[d][x > 0.5] = true;
        }
        for (direction d = 0; d < 3; ++d)
        {
            for (label s = 0; s < 2; ++s)
            {
                if (!returnReduce(at[d][s], orOp<bool>())) continue;
                string& names = sides_[d][s];
                names += (names.empty() ? "" : ", ") + patch.name();
                isWall_[d][s] = isWall_[d][s] || isA<wallPolyPatch>(patch);
            }
        }
        if (returnReduce(isInside, orOp<bool>()))
        {
            inside += (inside.empty() ? "" : ", ") + patch.name();
        }
    }
    if (!inside.empty())
    {
        WarningInFunction
            << "walls inside the box (" << inside.c_str()
            << "): bodies move and "
            << "act across them as if they were not there; keep bodies away"
            << endl;
    }

    for (direction d = 0; d < 3; ++d)
    {
        anySides_ = anySides_ || !grid_.periodic(d);
    }
    forAll(groups_, g)
    {
        firstBody_[g + 1] = firstBody_[g] + groups_[g].nBodies();
        anyForcing_ =
            anyForcing_ || groups_[g].forcing() == forcingType::ofLines;
        for (label h = 0; h <= g; ++h)
        {
            // Others share no force through the fluid
            pairNamed_[pairOf(g, h)] =
                !groups_[g].twoWay() || !groups_[h].twoWay() ||
                (g == h && groups_[g].nBodies() < 2) ||
                (interactions && interactions->actBetween(g, h));
        }
    }
}

Foam::label Foam::bodyPlaces::pairOf(const label g, const label h) const
{
    const label a = max(g, h), b = min(g, h);
    return a * (a + 1) / 2 + b;
}

Foam::string Foam::bodyPlaces::through(const boundBox& bounds,
                                       const scalar cells, bool* isWall) const
{
    for (direction d = 0; d < 3; ++d)
    {
        if (grid_.periodic(d)) continue;
        const scalar lo = grid_.origin()[d], hi = lo + grid_.length()[d];
        const scalar beyond[2] = {lo - bounds.min()[d], bounds.max()[d] - hi};
        for (label s = 0; s < 2; ++s)
        {
            if (beyond[s] <= cells * grid_.h()[d]) continue; // NaN is outside
            if (isWall) *isWall = isWall_[d][s];
            OStringStream os;
            os.precision(6);
            os << "patch " << sides_[d][s].c_str() << ": it extends to "
               << vector::componentNames[d] << " = "
               << (s ? bounds.max()[d] : bounds.min()[d])
               << ", and the box from " << lo << " to " << hi;
            return os.str();
        }
    }
    return "";
}

Foam::string Foam::bodyPlaces::divergence(const bodyGroup& group,
                                          const label i) const
{
    const boundBox bounds(group.bounds(i, true));
    for (direction d = 0; d < 3; ++d)
    {
        const scalar length = bounds.span()[d];
        if (grid_.periodic(d) || length <= grid_.length()[d]) continue;
        return "it is " + Foam::name(length) + " m long in " +
               vector::componentNames[d];
    }
    scalar cells = 0;
    for (const vector& v : group.points(i).velocities)
    {
        cells = max(cells, time_.deltaTValue() *
                               cmptMax(cmptDivide(cmptMag(v), grid_.h())));
    }
    return cells <= 3 ? ""
                      : "it moves by " + Foam::name(cells) + " cells in a step";
}

Foam::bodyPlaces::fate Foam::bodyPlaces::look(string& trouble)
{
    fate worst = INSIDE;
    if (anySides_)
    {
        worst = removeOutside(trouble);
        if (anyForcing_) warnOfWalls();
    }
    if (steps_++ % 50 == 0 && pairNamed_.found(false)) warnOfClose();
    return worst;
}

// Nuclei go with their capsules, and capsules with their nuclei
Foam::string Foam::bodyPlaces::removeOrphans()
{
    string removed;
    forAll(groups_, g)
    {
        const label host = groups_[g].host();
        if (host < 0) continue;
        boolList there[2];
        for (const label i : {0, 1})
        {
            const bodyGroup& group = groups_[i ? host : g];
            there[i].setSize(group.nBodies(), false);
            for (const label body : group.mine())
            {
                there[i][body] = true;
            }
            Pstream::listCombineGather(there[i], orEqOp<bool>());
            Pstream::listCombineScatter(there[i]);
        }
        for (const label one : {g, host})
        {
            bodyGroup& group = groups_[one];
            forAllReverse(group.mine(), i)
            {
                const label body = group.mine()[i];
                if (there[0][body] && there[1][body]) continue;
                removed += "Removed at time " + time_.timeName() + ": " +
                           group.nameOfBody(group.mine()[i]) + " with its " +
                           (one == g ? "capsule" : "nucleus") + "\n";
                group.release(i);
            }
        }
    }
    return removed;
}

Foam::bodyPlaces::fate Foam::bodyPlaces::removeOutside(string& trouble)
{
    string removed;
    fate worst = INSIDE;
    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        nearWall_[g] = false;
        forAllReverse(group.mine(), i)
        {
            const boundBox bounds(group.bounds(i, false));
            if (through(bounds, -0.5).empty()) continue;
            nearWall_[g] = true;

            // Not for the round-off of what is held at a wall
            if (through(bounds, 1e-6).empty()) continue;
            bool isWall = false;
            const string where(through(group.bounds(i, true), 1e-6, &isWall));
            if (where.empty()) continue;
            const string diverged(divergence(group, i));
            const fate now = !diverged.empty() ? DIVERGED
                             : isWall          ? PRESSED
                                               : LEFT;
            const string what(group.nameOfBody(group.mine()[i]) + " reaches through " + where +
                              (diverged.empty() ? "" : "; " + diverged));
            if (group.removesOutside() && now != DIVERGED)
            {
                removed +=
                    "Removed at time " + time_.timeName() + ": " + what + "\n";
                group.release(i);
            }
            else if (now > worst)
            {
                worst = now;
                trouble = what;
            }
        }
    }
    if (returnReduce(!removed.empty(), orOp<bool>()))
    {
        removed += removeOrphans();
        List<string> all(Pstream::nProcs());
        all[Pstream::myProcNo()] = removed;
        Pstream::gatherList(all);
        for (const string& lines : all)
        {
            Info << lines.c_str();
        }
    }
    return worst;
}

void Foam::bodyPlaces::warnOfWalls()
{
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (wallNamed_[g] || group.forcing() != forcingType::ofLines) continue;
        string near;
        for (label i = 0; nearWall_[g] && i < group.mine().size(); ++i)
        {
            const string where(through(refCast<const directForcing>(group).forcedBounds(i), -0.5));
            if (where.empty()) continue;
            near = group.nameOfBody(group.mine()[i]) + " is closer than half a cell to " + where;
            break;
        }
        wallNamed_[g] = returnReduce(!near.empty(), orOp<bool>());
        if (!wallNamed_[g]) continue;
        near = firstOf(near);
        WarningInFunction
            << near.c_str() << ", at time " << time_.timeName() << nl
            << "    The force of a fibre is spread over 1.5 cells to either "
            << "side, and the wall cuts this off: drag and slip are wrong "
            << "there. Keep fibres a cell from walls, or use smaller cells"
            << endl;
    }
}

void Foam::bodyPlaces::warnOfClose()
{
    label n = 0;
    forAll(groups_, g)
    {
        n += groups_[g].nMarkers();
    }
    vectorField X(n);
    labelList body(n);
    label at = 0;
    forAll(groups_, g)
    {
        bodyGroup& group = groups_[g];
        if (group.mine().empty() || group.nMarkers() == 0) continue;
        const label each = group.nMarkers() / group.mine().size();
        group.markers(X.data() + at, 0);
        forAll(group.mine(), i)
        {
            std::fill_n(body.data() + at + i * each, each, group.mine()[i]);
        }
        // Markers of a fibre count along its line only
        if (group.forcing() != forcingType::none)
        {
            refCast<const directForcing>(group).lines(body.data() + at);
        }
        for (label k = at; k < at + group.nMarkers(); ++k)
        {
            if (!group.twoWay()) body[k] = -1;
            if (body[k] >= 0) body[k] += firstBody_[g];
        }
        at += group.nMarkers();
    }
    markers_.place(X);

    const auto groupOf = [&](const label b)
    {
        label g = 0;
        while (b >= firstBody_[g + 1])
            ++g;
        return g;
    };
    struct encounter
    {
        scalar distance = GREAT;
        label a = -1, b = -1;
        point at = Zero;
    };
    List<encounter> closest(pairNamed_.size());
    markers_.closeLines(X, body,
                        [&](const label a, const label b, const point& at,
                            const scalar distance)
                        {
                            const label pair = pairOf(groupOf(a), groupOf(b));
                            if (pairNamed_[pair] ||
                                distance >= closest[pair].distance)
                                return;
                            closest[pair].distance = distance;
                            closest[pair].a = a;
                            closest[pair].b = b;
                            closest[pair].at = at;
                        });

    // Any is rare, and said once
    scalarList distances(closest.size());
    forAll(closest, pair)
    {
        distances[pair] = closest[pair].distance;
    }
    if (!returnReduce(!distances.empty() && min(distances) < GREAT,
                      orOp<bool>()))
    {
        return;
    }
    forAll(closest, pair)
    {
        const encounter& e = closest[pair];
        const scalar least = returnReduce(e.distance, minOp<scalar>());
        if (least == GREAT) continue;
        pairNamed_[pair] = true;
        string sentence;
        if (e.distance == least)
        {
            const label g = groupOf(e.a), h = groupOf(e.b);
            OStringStream os;
            os.precision(6);
            os << groups_[g].nameOfBody(e.a - firstBody_[g]).c_str() << " and "
               << groups_[h].nameOfBody(e.b - firstBody_[h]).c_str() << " are "
               << e.distance << " cells apart at " << e.at;
            sentence = os.str();
        }
        sentence = firstOf(sentence);
        WarningInFunction
            << sentence.c_str() << ", at time " << time_.timeName() << nl
            << "    Below 1.5 cells the fluid between bodies is not "
            << "resolved, and nothing keeps them apart (said once for these "
            << "groups)" << endl;
    }
}
