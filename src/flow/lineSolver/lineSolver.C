// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lineSolver.H"

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
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

//- The ranks that share this rank's lines, in order along them: first cell and
//  rank. None where blocks that meet along the direction have not the same
//  cross-section everywhere (collective)
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
    DynamicList<label> rank, place, source;
    from.cells(
        [&](const label i, const labelVector& c)
        {
            rank.append(((c[across] + 1) * ranks - 1) / n);
            place.append(linesOf(rank.last()).index(c));
            source.append(i);
        });
    toLines_.reset(new indexExchange(rank, place, source));

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
    labelList rank(allEnds_.size()), place(rank.size()), source(rank.size());
    for (label p = 0, k = 0; p < nPieces; ++p)
    {
        for (label i = 0; i < 2 * nLines; ++i, ++k)
        {
            rank[k] = pieces[p].second;
            place[k] = 2 * nLines * mine_ + i;
            source[k] = i;
        }
    }
    exchange_.reset(new indexExchange(rank, place, source));
}

void Foam::lineSolver::factorise(const double beta)
{
    beta_ = beta;
    const label nPieces = begins_.size() - 1;
    piece_ = makePiece(mine_);
    if (!coupled_) return;

    // Unknowns: first and last of all pieces.
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

void Foam::lineSolver::sweep(double* x, const label m, const label stride,
                             const double lower, const double upper) const
{
    const label n = box_.size[dir_];
    for (label j = 0; j < n; ++j)
    {
        double* xj = x + j * stride;
        const double* xm = j ? xj - stride : xj;
        const double r = piece_.r[j], b = j ? beta_ : 0;
        const double w = (j == 0 ? lower : 0) + (j == n - 1 ? upper : 0);
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            xj[i] = (xj[i] + w + b * xm[i]) * r;
        }
    }
    for (label j = n - 2; j >= 0; --j)
    {
        double* xj = x + j * stride;
        const double* xp = xj + stride;
        const double c = piece_.c[j];
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            xj[i] += c * xp[i];
        }
    }
}

void Foam::lineSolver::beyond(const double* ends, const label size,
                              const label m, double* before,
                              double* after) const
{
    std::fill(before, before + m, 0.0);
    std::fill(after, after + m, 0.0);
    for (size_t k = 0; k < beforeFrom_.size(); ++k)
    {
        const double b = beforeFrom_[k], a = afterFrom_[k];
        const double* y = ends + k * size;
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            before[i] += b * y[i];
            after[i] += a * y[i];
        }
    }
}

void Foam::lineSolver::correct(double* x, const label m, const label stride,
                               const label line, const label begin,
                               const label end) const
{
    const label within = box_.size[dir_] - reach_;
    const double* before = before_.data() + line;
    const double* after = after_.data() + line;
    for (label j = begin; j < end; ++j)
    {
        if (j >= reach_ && j < within) j = within;
        if (j >= end) return;
        double* xj = x + (j - begin) * stride;
        const double b = piece_.before[j], a = piece_.after[j];
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            xj[i] += b * before[i] + a * after[i];
        }
    }
}

template<class Visit>
void Foam::lineSolver::parts(double* x, const lineSolver* earlier, Visit visit)
{
    const label nx = box_.size.x(), ny = box_.size.y(), nz = box_.size.z();
    const label layer = box_.stride(2);
    if (dir_)
    {
        const bool z = dir_ == 2;
        for (label k = 0; k < (z ? ny : nz); ++k)
        {
            double* first = x + k * (z ? nx : layer);
            const label stride = z ? layer : nx;
            for (label l = 0; earlier && l < box_.size[dir_]; ++l)
            {
                earlier->correctRow(first + l * stride, z ? k : l, z ? l : k);
            }
            visit(first, nx, stride, k * nx);
        }
    }
    else
    {
        // Lines along memory: some at a time, turned on their side so that the
        // sweep runs over neighbours, all of them in the cache
        const label wide = 32;
        turned_.resize(nx * wide);
        for (label line = 0; line < ny * nz;)
        {
            const label y = line % ny, z = line / ny, m = min(wide, ny - y);
            double* lines = x + y * nx + z * layer;
            for (label j = 0; earlier && j < m; ++j)
            {
                earlier->correctRow(lines + j * nx, y + j, z);
            }
            for (label i = 0; i < nx; ++i)
            {
                double* across = turned_.data() + i * wide;
                for (label j = 0; j < m; ++j)
                {
                    across[j] = lines[i + j * nx];
                }
            }
            visit(turned_.data(), m, wide, line);
            for (label j = 0; j < m; ++j)
            {
                const double* across = turned_.data() + j;
                for (label i = 0; i < nx; ++i)
                {
                    lines[i + j * nx] = across[i * wide];
                }
            }
            line += m;
        }
    }
}

void Foam::lineSolver::correctRow(double* row, const label j,
                                  const label k) const
{
    const label nx = box_.size.x();
    if (dir_ == 0) return correct(row, 1, 1, j + k * box_.size.y(), 0, nx);
    const label at = dir_ == 1 ? j : k, across = dir_ == 1 ? k : j;
    correct(row, nx, 0, across * nx, at, at + 1);
}

void Foam::lineSolver::begin(double* x, const double beta, const double lower,
                             const double upper, lineSolver* earlier)
{
    if (beta != beta_) factorise(beta);
    double* swept = x;
    if (toLines_)
    {
        if (earlier) earlier->finish(x);
        earlier = nullptr;
        swept = whole_.data();
        toLines_->forward(x, swept);
    }
    if (earlier) earlier->receive();

    const bool given = !periodic_ && !faces_;
    const label end = box_.lo[dir_] + box_.size[dir_];
    const double lo = given && box_.lo[dir_] == 0 ? 2 * beta * lower : 0;
    const double up = given && end == begins_.last() ? 2 * beta * upper : 0;
    const label last = box_.size[dir_] - 1, nLines = before_.size();
    parts(swept, earlier,
          [&](double* y, const label m, const label stride, const label line)
          {
              sweep(y, m, stride, lo, up);
              if (!coupled_) return;
              double* ends = ends_.data() + (exchange_ ? line : 0);
              std::copy_n(y, m, ends);
              std::copy_n(y + last * stride, m, ends + nLines);
              if (exchange_) return;

              // Periodic lines on one rank are their own neighbours: a part at a time
              beyond(ends, nLines, m, before_.data(), after_.data());
              correct(y, m, stride, 0, 0, last + 1);
          });
    if (exchange_) exchange_->startForward(ends_.data());
    if (toLines_) toLines_->backward(swept, x);
}

void Foam::lineSolver::receive()
{
    const label nLines = before_.size();
    exchange_->finishForward(ends_.data(), allEnds_.data());
    beyond(allEnds_.data(), nLines, nLines, before_.data(), after_.data());
}

void Foam::lineSolver::finish(double* x)
{
    receive();
    parts(x, nullptr,
          [&](double* y, const label m, const label stride, const label line)
          { correct(y, m, stride, line, 0, box_.size[dir_]); });
}
