// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "boxChecks.H"
#include "dictionaryChecks.H"
#include "directForcing.H"
#include "processorPolyPatch.H"
#include "startChecks.H"
#include "Time.H"

Foam::boxChecks::boxChecks(const fvMesh& mesh, PtrList<bodyGroup>& groups,
                           markerSet& markers,
                           const bodyInteractions* interactions,
                           const neighbourField* between)
    : time_(mesh.time()),
      grid_(uniformGrid::New(mesh)),
      groups_(groups),
      sides_(boxSides(grid_)),
      close_(time_, grid_, groups, markers, interactions, between),
      wallNamed_(groups.size(), false),
      nearWall_(groups.size(), false)
{
    for (direction d = 0; d < 3; ++d)
    {
        anySides_ = anySides_ || !grid_.periodic(d);
    }
    forAll(groups_, g)
    {
        anyLines_ =
            anyLines_ || groups_[g].forcing() == forcingType::ofLines;
    }
}

Foam::string Foam::boxChecks::through(const boundBox& bounds,
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
            if (isWall) *isWall = sides_[d][s].wall;
            OStringStream os;
            os.precision(6);
            os << "patch " << sides_[d][s].patches.c_str() << ": it extends to "
               << vector::componentNames[d] << " = "
               << (s ? bounds.max()[d] : bounds.min()[d])
               << ", and the box from " << lo << " to " << hi;
            return os.str();
        }
    }
    return "";
}

Foam::string Foam::boxChecks::divergence(const bodyGroup& group,
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

void Foam::boxChecks::checkStart(const dictionary& dict) const
{
    requireWalls(grid_);
    startChecks(grid_, groups_).check(dict);
}

Foam::boxChecks::fate Foam::boxChecks::look(string& trouble)
{
    fate worst = INSIDE;
    if (anySides_)
    {
        worst = removeOutside(trouble);
        if (anyLines_) warnOfWalls();
    }
    return worst;
}

// Nuclei are removed with their capsules, and capsules with their nuclei
Foam::string Foam::boxChecks::removeOrphans()
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

Foam::boxChecks::fate Foam::boxChecks::removeOutside(string& trouble)
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

            // Beyond the round-off of a body that is held at a wall
            if (through(bounds, 1e-6).empty()) continue;
            bool isWall = false;
            const string where(through(group.bounds(i, true), 1e-6, &isWall));
            if (where.empty()) continue;
            const string diverged(divergence(group, i));
            const fate now = !diverged.empty() ? DIVERGED
                             : isWall          ? PRESSED
                                               : LEFT;
            const string what(group.nameOfBody(group.mine()[i]) +
                              " reaches through " + where +
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

void Foam::boxChecks::warnOfWalls()
{
    forAll(groups_, g)
    {
        const bodyGroup& group = groups_[g];
        if (wallNamed_[g] || group.forcing() != forcingType::ofLines) continue;
        string near;
        for (label i = 0; nearWall_[g] && i < group.mine().size(); ++i)
        {
            const string where(through(
                refCast<const directForcing>(group).forcedBounds(i), -0.5));
            if (where.empty()) continue;
            near = group.nameOfBody(group.mine()[i]) +
                   " is closer than half a cell to " + where;
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
