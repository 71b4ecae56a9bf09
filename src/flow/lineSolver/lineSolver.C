// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lineSolver.H"

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
                               const label line) const
{
    const label end = box_.size[dir_], within = end - reach_;
    const double* before = before_.data() + line;
    const double* after = after_.data() + line;
    for (label j = 0; j < end; ++j)
    {
        if (j >= reach_ && j < within) j = within;
        double* xj = x + j * stride;
        const double b = piece_.before[j], a = piece_.after[j];
#pragma GCC ivdep
        for (label i = 0; i < m; ++i)
        {
            xj[i] += b * before[i] + a * after[i];
        }
    }
}

template<class Visit>
void Foam::lineSolver::parts(double* x, Visit visit)
{
    const label nx = box_.size.x(), ny = box_.size.y(), nz = box_.size.z();
    const label layer = box_.stride(2);
    if (dir_)
    {
        const bool z = dir_ == 2;
        for (label k = 0; k < (z ? ny : nz); ++k)
        {
            visit(x + k * (z ? nx : layer), nx, z ? layer : nx, k * nx);
        }
        return;
    }

    // Lines along memory: some at a time, turned on their side so that the sweep runs
    // over neighbours, all of them in the cache
    const label wide = 32;
    turned_.resize(nx * wide);
    for (label line = 0; line < ny * nz;)
    {
        const label y = line % ny, z = line / ny, m = min(wide, ny - y);
        double* lines = x + y * nx + z * layer;
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

void Foam::lineSolver::begin(double* x, const double beta, const double lower,
                             const double upper)
{
    if (beta != beta_) factorise(beta);
    double* swept = x;
    if (toLines_)
    {
        swept = whole_.data();
        toLines_->forward(x, swept);
    }

    const bool given = !periodic_ && !faces_;
    const label end = box_.lo[dir_] + box_.size[dir_];
    const double lo = given && box_.lo[dir_] == 0 ? 2 * beta * lower : 0;
    const double up = given && end == begins_.last() ? 2 * beta * upper : 0;
    const label last = box_.size[dir_] - 1, nLines = before_.size();
    parts(swept,
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
              correct(y, m, stride, 0);
          });
    if (exchange_) exchange_->startForward(ends_.data());
    if (toLines_) toLines_->backward(swept, x);
}

void Foam::lineSolver::finish(double* x)
{
    if (!exchange_) return;
    const label nLines = before_.size();
    exchange_->finishForward(ends_.data(), allEnds_.data());
    beyond(allEnds_.data(), nLines, nLines, before_.data(), after_.data());
    if (dir_)
    {
        parts(x,
              [&](double* y, const label m, const label stride, const label line)
              { correct(y, m, stride, line); });
        return;
    }

    // Lines along memory need not be turned: only points near their ends change
    const label ny = box_.size.y();
    for (label line = 0; line < nLines; ++line)
    {
        correct(x + (line % ny) * box_.stride(1) + line / ny * box_.stride(2), 1,
                1, line);
    }
}
