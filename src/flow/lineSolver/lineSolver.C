// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "lineSolver.H"

Foam::lineSolver::lineSolver(const uniformGrid& grid, const direction dir,
                             const bool faces)
    : dir_(dir),
      n_(grid.n()[dir]),
      periodic_(grid.periodic(dir)),
      faces_(faces),
      box_(grid.box())
{
    const bool cut = box_.size[dir] != n_;
    if (!returnReduce(cut, orOp<bool>())) return;

    // The ranks that share a bundle of lines deal them among themselves; where
    // blocks are not aligned, all ranks deal all lines
    const direction a = dir == 0 ? 1 : 0, b = 3 - dir - a;
    const auto sameSection = [&](const cellBox& x, const cellBox& y)
    {
        return x.lo[a] == y.lo[a] && x.size[a] == y.size[a] &&
               x.lo[b] == y.lo[b] && x.size[b] == y.size[b];
    };
    const List<cellBox> boxes(grid.allBoxes());
    labelList sharing;
    label held = 0;
    forAll(boxes, proci)
    {
        if (sameSection(boxes[proci], box_))
        {
            sharing.append(proci);
            held += boxes[proci].size[dir];
        }
    }
    cellBox section(box_);
    if (!returnReduce(held == n_, andOp<bool>()))
    {
        sharing = identity(Pstream::nProcs());
        section.lo = labelVector::zero;
        section.size = grid.n();
    }

    const label nLines = section.size[a] * section.size[b];
    const label nRanks = sharing.size();
    const auto first = [&](const label r)
    { return label((int64_t(nLines) * r) / nRanks); };
    const label me = sharing.find(Pstream::myProcNo());
    nLines_ = first(me + 1) - first(me);

    labelList rank(box_.count()), place(box_.count());
    forAll(rank, i)
    {
        const labelVector c(box_.cell(i));
        const label line =
            c[a] - section.lo[a] + section.size[a] * (c[b] - section.lo[b]);
        label r = label((int64_t(line) * nRanks) / nLines);
        while (first(r) > line)
        {
            --r;
        }
        while (first(r + 1) <= line)
        {
            ++r;
        }
        rank[i] = sharing[r];
        place[i] = (line - first(r)) + (first(r + 1) - first(r)) * c[dir];
    }
    toLines_.reset(new indexExchange(rank, place));
    lines_.resize(nLines_ * n_);
}

void Foam::lineSolver::factorise(const double beta)
{
    beta_ = beta;
    r_.assign(n_, 0);
    c_.assign(n_, 0);
    z_.assign(n_, 0);
    const label begin = !periodic_ && faces_ ? 1 : 0;
    const label last = periodic_ ? n_ - 2 : n_ - 1;
    for (label j = begin; j <= last; ++j)
    {
        double diag = 1 + 2 * beta;
        if (!periodic_ && !faces_ && j == 0) diag += beta;
        if (!periodic_ && !faces_ && j == n_ - 1) diag += beta;
        r_[j] = 1 / (diag - (j > begin ? beta * c_[j - 1] : 0));
        c_[j] = beta * r_[j];
        const double b = (j == 0 ? 1 : 0) + (j == last ? 1 : 0);
        z_[j] = c_[j] * (b + (j > begin ? z_[j - 1] : 0));
    }
    if (periodic_)
    {
        for (label j = last - 1; j >= 0; --j)
        {
            z_[j] += c_[j] * z_[j + 1];
        }
        rLast_ = 1 / (1 + 2 * beta - beta * (z_[0] + z_[last]));
    }
}

void Foam::lineSolver::sweep(double* x, const label m, const label stride,
                             const double lower, const double upper) const
{
    const label begin = !periodic_ && faces_ ? 1 : 0;
    const label last = periodic_ ? n_ - 2 : n_ - 1;
    for (label j = begin; j <= last; ++j)
    {
        double* __restrict__ xj = x + j * stride;
        const double* __restrict__ xm = xj - stride;
        const double r = r_[j], b = beta_;
        const double w = (j == begin ? lower : 0) + (j == last ? upper : 0);
        if (j == begin)
        {
            for (label i = 0; i < m; ++i)
            {
                xj[i] = (xj[i] + w) * r;
            }
            continue;
        }
        for (label i = 0; i < m; ++i)
        {
            xj[i] = (xj[i] + w + b * xm[i]) * r;
        }
    }
    for (label j = last - 1; j >= begin; --j)
    {
        double* __restrict__ xj = x + j * stride;
        const double* __restrict__ xp = xj + stride;
        const double c = c_[j];
        for (label i = 0; i < m; ++i)
        {
            xj[i] += c * xp[i];
        }
    }
    if (periodic_)
    {
        double* __restrict__ xl = x + (n_ - 1) * stride;
        const double* __restrict__ x0 = x;
        const double* __restrict__ xm = x + last * stride;
        for (label i = 0; i < m; ++i)
        {
            xl[i] = (xl[i] + beta_ * (xm[i] + x0[i])) * rLast_;
        }
        for (label j = 0; j <= last; ++j)
        {
            double* __restrict__ xj = x + j * stride;
            const double z = z_[j];
            for (label i = 0; i < m; ++i)
            {
                xj[i] += z * xl[i];
            }
        }
    }
}

void Foam::lineSolver::solve(double* x, const double beta, const double lower,
                             const double upper)
{
    if (beta != beta_) factorise(beta);
    const bool given = !periodic_ && !faces_;
    const double lo = given ? 2 * beta * lower : 0;
    const double up = given ? 2 * beta * upper : 0;

    if (toLines_)
    {
        toLines_->forward(x, lines_.data());
        sweep(lines_.data(), nLines_, nLines_, lo, up);
        toLines_->backward(lines_.data(), x);
        return;
    }

    const label nx = box_.size.x(), ny = box_.size.y(), nz = box_.size.z();
    if (dir_ == 2)
    {
        // A row of x at a time: the sweep stays in cache
        for (label j = 0; j < ny; ++j)
        {
            sweep(x + j * nx, nx, nx * ny, lo, up);
        }
    }
    else if (dir_ == 1)
    {
        for (label k = 0; k < nz; ++k)
        {
            sweep(x + k * nx * ny, nx, nx, lo, up);
        }
    }
    else
    {
        // Lines along memory: turn a plane on its side, so that the sweep
        // runs over neighbours
        std::vector<double>& t = lines_;
        t.resize(nx * ny);
        for (label k = 0; k < nz; ++k)
        {
            double* plane = x + k * nx * ny;
            for (label j = 0; j < ny; ++j)
            {
                for (label i = 0; i < nx; ++i)
                {
                    t[i * ny + j] = plane[j * nx + i];
                }
            }
            sweep(t.data(), ny, ny, lo, up);
            for (label j = 0; j < ny; ++j)
            {
                for (label i = 0; i < nx; ++i)
                {
                    plane[j * nx + i] = t[i * ny + j];
                }
            }
        }
    }
}
