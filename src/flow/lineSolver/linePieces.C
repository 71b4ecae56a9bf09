// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Pieces of the lines: ranks that share them, their matrices and the inverse that couples
// them

#include "lineSolver.H"
#include "quietEigen.H"
#include <Eigen/Dense>

Foam::lineSolver::piece Foam::lineSolver::makePiece(const label p) const
{
    const label begin = begins_[p], end = begins_[p + 1], n = begins_.last();
    const label m = end - begin;
    const double beta = beta_;
    std::vector<double> r(m), c(m), before(m, 0), after(m, 0);
    for (label j = 0; j < m; ++j)
    {
        double diag = 1 + 2 * beta;
        if (!periodic_ && !faces_)
        {
            if (begin + j == 0) diag += beta;
            if (begin + j == n - 1) diag += beta;
        }
        r[j] = 1 / (diag - (j ? beta * c[j - 1] : 0));
        c[j] = beta * r[j];

        // A value on a wall is zero
        if (!periodic_ && faces_ && begin + j == 0) r[j] = c[j] = 0;
    }

    // Nothing is beyond a wall
    if (periodic_ || begin > 0) before[0] = beta;
    if (periodic_ || end < n) after[m - 1] = beta;
    for (std::vector<double>* x : {&before, &after})
    {
        for (label j = 0; j < m; ++j)
        {
            (*x)[j] = ((*x)[j] + (j ? beta * (*x)[j - 1] : 0)) * r[j];
        }
        for (label j = m - 2; j >= 0; --j)
        {
            (*x)[j] += c[j] * (*x)[j + 1];
        }
    }
    return {r, c, before, after};
}

namespace
{
using namespace Foam;

//- First cell and rank of the pieces of this rank's lines, in order along them. None
//  unless the blocks that meet along the direction have the same cross-section
//  everywhere (collective)
std::vector<std::pair<label, label>> sharing(const uniformGrid& grid,
                                             const direction dir)
{
    const direction a = dir == 0 ? 1 : 0, b = 3 - dir - a;
    const cellBox& mine = grid.box();
    const List<cellBox> boxes(grid.allBoxes());
    std::vector<std::pair<label, label>> all;
    label held = 0;
    forAll(boxes, proci)
    {
        const cellBox& x = boxes[proci];
        if (x.lo[a] == mine.lo[a] && x.size[a] == mine.size[a] &&
            x.lo[b] == mine.lo[b] && x.size[b] == mine.size[b])
        {
            all.push_back({x.lo[dir], proci});
            held += x.size[dir];
        }
    }
    std::sort(all.begin(), all.end());
    if (!returnReduce(held == grid.n()[dir], andOp<bool>())) all.clear();
    return all;
}
} // namespace

// Layers of lines are dealt to the ranks in order; a rank may get none
Foam::cellBox Foam::lineSolver::deal(const uniformGrid& grid,
                                     const direction dir)
{
    const direction across = dir == 2 ? 1 : 2;
    const int64_t n = grid.n()[across], ranks = Pstream::nProcs();
    const auto linesOf = [&](const label rank)
    {
        cellBox lines;
        lines.size = grid.n();
        lines.lo[across] = n * rank / ranks;
        lines.size[across] = n * (rank + 1) / ranks - lines.lo[across];
        return lines;
    };

    const cellBox& from = grid.box();
    DynamicList<label> rank, target, source;
    from.cells(
        [&](const label i, const labelVector& c)
        {
            rank.append(((c[across] + 1) * ranks - 1) / n);
            target.append(linesOf(rank.last()).index(c));
            source.append(i);
        });
    toLines_.reset(new indexExchange(rank, target, source));

    const cellBox mine(linesOf(Pstream::myProcNo()));
    whole_.resize(mine.nPlaces());
    return mine;
}

Foam::lineSolver::lineSolver(const uniformGrid& grid, const direction dir,
                             const bool faces)
    : dir_(dir),
      periodic_(grid.periodic(dir)),
      faces_(faces)
{
    auto pieces(sharing(grid, dir));
    box_ = pieces.empty() ? deal(grid, dir) : grid.box();
    if (toLines_) pieces.push_back({0, Pstream::myProcNo()});
    const label nPieces = pieces.size();
    for (label p = 0; p < nPieces; ++p)
    {
        begins_.append(pieces[p].first);
        if (pieces[p].second == Pstream::myProcNo()) mine_ = p;
    }
    begins_.append(grid.n()[dir]);
    coupled_ = periodic_ || nPieces > 1;
    const label nLines = box_.count() / box_.size[dir];
    ends_.resize(2 * nLines);
    before_.resize(nLines);
    after_.resize(nLines);
    if (returnReduce(nPieces, maxOp<label>()) == 1) return;

    allEnds_.resize(2 * nLines * nPieces);
    labelList rank(allEnds_.size()), target(rank.size()), source(rank.size());
    for (label p = 0, k = 0; p < nPieces; ++p)
    {
        for (label i = 0; i < 2 * nLines; ++i, ++k)
        {
            rank[k] = pieces[p].second;
            target[k] = 2 * nLines * mine_ + i;
            source[k] = i;
        }
    }
    exchange_.reset(new indexExchange(rank, target, source));
}

void Foam::lineSolver::factorise(const double beta)
{
    beta_ = beta;
    const label nPieces = begins_.size() - 1;
    piece_ = makePiece(mine_);
    if (!coupled_) return;

    // Unknowns: first and last value of all pieces
    //     first_p = y_0 + before_0 last_{p-1} + after_0 first_{p+1}, last alike
    Eigen::MatrixXd A(Eigen::MatrixXd::Identity(2 * nPieces, 2 * nPieces));
    const auto previous = [&](const label p)
    { return 2 * ((p + nPieces - 1) % nPieces) + 1; };
    const auto next = [&](const label p) { return 2 * ((p + 1) % nPieces); };
    for (label p = 0; p < nPieces; ++p)
    {
        const piece q(makePiece(p));
        A(2 * p, previous(p)) -= q.before.front();
        A(2 * p, next(p)) -= q.after.front();
        A(2 * p + 1, previous(p)) -= q.before.back();
        A(2 * p + 1, next(p)) -= q.after.back();
    }
    const Eigen::MatrixXd inverse(A.inverse());
    beforeFrom_.resize(2 * nPieces);
    afterFrom_.resize(2 * nPieces);
    for (label k = 0; k < 2 * nPieces; ++k)
    {
        beforeFrom_[k] = inverse(previous(mine_), k);
        afterFrom_[k] = inverse(next(mine_), k);
    }

    const label m = box_.size[dir_];
    reach_ = 1;
    while (reach_ < m && (piece_.before[reach_] > 1e-18 ||
                          piece_.after[m - 1 - reach_] > 1e-18))
    {
        ++reach_;
    }
}
