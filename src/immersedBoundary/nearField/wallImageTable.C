// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The table of wallImage: the answer of the mesh to waves of force along a wall, and its
// transform

#include "wallImageTable.H"
#include "mathematicalConstants.H"
#include "wallImage.H"

// g++ 12 sees uninitialised values in its own AVX-512 intrinsics
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/LU>

namespace
{
using namespace Foam;
using namespace Foam::wallTable;

const double pi = constant::mathematical::pi;

//- Responses to a wave of force of wave number k, times 8 pi mu, by height of marker and
//  force: along k of a force along k, across, along the normal; along k of a normal one and
//  the other way (the latter two with - i and i)
enum response
{
    ALONG,
    ACROSS,
    NORMAL,
    ALONG_OF_NORMAL,
    NORMAL_OF_ALONG,
    nResponses
};
using responses = std::array<Eigen::MatrixXd, nResponses>;

scalar heightAt(const int i)
{
    return lowest * std::pow(growth, i);
}

//- Height of a kernel, raised and above the wall
double raisedHeight(const int i, const double raised)
{
    return max(heightAt(i) + raised, 0.05);
}

//- Transform of the kernel
double kernelTransform(const deltaKernel& kernel, const double k)
{
    const int n = 400;
    const double step = kernel.reach() / n;
    double sum = 0;
    for (int i = 0; i < n; ++i)
    {
        const double r = (i + 0.5) * step;
        sum += 2 * step * kernel.phi(r) * std::cos(k * r);
    }
    return sum;
}

//- Discrete Stokes equations between walls n cells apart for a wave vector (kx kz) along
//  them: velocities along it and normal, and across, of forces there
struct column
{
    const label n;
    Eigen::MatrixXd inPlane, across;

    column(const label cells, const double kx, const double kz)
        : n(cells)
    {
        const double square =
            4 * (sqr(std::sin(kx / 2)) + sqr(std::sin(kz / 2)));
        const label size = 3 * n - 1, v = n, p = 2 * n - 1;
        Eigen::MatrixXd A(Eigen::MatrixXd::Zero(size, size));
        for (label j = 0; j < n; ++j)
        {
            const bool atWall = j == 0 || j == n - 1;
            A(j, j) = 2 + atWall + square;
            if (j) A(j, j - 1) = A(j - 1, j) = -1;
            A(p + j, j) = std::sqrt(square);
            if (j < n - 1) A(p + j, v + j) = 1;
            if (j) A(p + j, v + j - 1) = -1;
        }
        across = A.topLeftCorner(n, n).inverse();
        for (label j = 0; j < n - 1; ++j)
        {
            A(v + j, v + j) = 2 + square;
            if (j) A(v + j, v + j - 1) = A(v + j - 1, v + j) = -1;
        }
        A.topRightCorner(p, n) = -A.bottomLeftCorner(n, p).transpose();
        inPlane = A.inverse().topLeftCorner(p, p);
    }

    //- Weights of kernels at all heights, raised; rows: faces of a component
    Eigen::MatrixXd weights(const deltaKernel& kernel, const double raised,
                            const bool normal) const
    {
        Eigen::MatrixXd w(Eigen::MatrixXd::Zero(n - normal, nHeights));
        for (int i = 0; i < nHeights; ++i)
        {
            const double x = raisedHeight(i, raised);
            if (x > n - 3) continue;
            const kernelStencil s(
                kernel.stencil(x, normal ? 0 : 0.5, normal, n - 1));
            for (label q = 0; q < s.size; ++q)
            {
                w(s.index[q] - normal, i) = s.weight[q];
            }
        }
        return w;
    }

    void add(const deltaKernel& kernel, const double raised,
             const double factor, responses& to) const
    {
        const Eigen::MatrixXd t(weights(kernel, raised, false)),
            w(weights(kernel, raised, true));
        const label m = n - 1;
        to[ALONG] +=
            factor * t.transpose() * inPlane.topLeftCorner(n, n) * t;
        to[ACROSS] += factor * t.transpose() * across * t;
        to[NORMAL] +=
            factor * w.transpose() * inPlane.bottomRightCorner(m, m) * w;
        to[ALONG_OF_NORMAL] +=
            factor * t.transpose() * inPlane.topRightCorner(n, m) * w;
        to[NORMAL_OF_ALONG] +=
            factor * w.transpose() * inPlane.bottomLeftCorner(m, n) * t;
    }
};

//- Blake's image at raised heights, and what the mesh adds to it to order h^2; c: half the
//  second moment of the kernel
void longWaves(const double k, const double raised, const double c,
               responses& R, responses& more)
{
    for (int r = 0; r < nResponses; ++r)
    {
        R[r].resize(nHeights, nHeights);
        more[r].resize(nHeights, nHeights);
    }
    for (int i = 0; i < nHeights; ++i)
    {
        for (int j = 0; j < nHeights; ++j)
        {
            const double z = k * raisedHeight(i, raised),
                         H = k * raisedHeight(j, raised), Z = z + H,
                         wave = 2 * pi * std::exp(-Z), C = 4 * c,
                         square = 7 / 96.0 * sqr(Z),
                         products = z * H * (21 / 16.0 - 7 / 48.0 * Z);
            const auto set = [&](const response r, const double exact,
                                 const double error)
            {
                R[r](i, j) = wave / k * exact;
                more[r](i, j) = wave * k * error;
            };
            set(ALONG, Z - 1 - 2 * z * H,
                11 / 32.0 - C + (C - 79 / 96.0) * Z + square + products);
            set(ACROSS, -2, 3 / 16.0 - 7 / 48.0 * Z);
            set(NORMAL, -1 - Z - 2 * z * H,
                C - 5 / 32.0 + (C + 17 / 96.0) * Z - square + products);
            const double even = (C - 0.25) * Z - 0.25 + products,
                         odd = (z - H) * (7 / 96.0 * Z - 0.5);
            set(ALONG_OF_NORMAL, H - z - 2 * z * H, even - odd);
            set(NORMAL_OF_ALONG, z - H - 2 * z * H, even + odd);
        }
    }
}

//- Answer of the wall of the mesh less Blake's image, averaged over directions and
//  positions in a cell
responses surplus(const deltaKernel& kernel, const double k, const double c)
{
    responses exact, more;
    longWaves(k, 0, c, exact, more);
    if (k < 0.25) return more;
    responses R;
    for (Eigen::MatrixXd& m : R)
    {
        m = Eigen::MatrixXd::Zero(nHeights, nHeights);
    }
    const int nAngles = 2, nPlaces = 4;
    const label away = std::ceil(6 / k) + 2;
    const label top = min(heightAt(nHeights - 1), 8 / k) + 4;
    for (int a = 0; a < nAngles; ++a)
    {
        const double angle = (a + 0.5) / nAngles * pi / 4,
                     kx = k * std::cos(angle), kz = k * std::sin(angle);
        const column mesh(top + 2 * away, kx, kz);
        const double factor =
            8 * pi / (nAngles * nPlaces) *
            sqr(kernelTransform(kernel, kx) * kernelTransform(kernel, kz));
        for (int i = 0; i < nPlaces; ++i)
        {
            const double raised = 0.5 * ((i + 0.5) / nPlaces - 0.5);
            mesh.add(kernel, raised, factor, R);
            mesh.add(kernel, raised + away, -factor, R);
            longWaves(k, raised, c, exact, more);
            for (int r = 0; r < nResponses; ++r)
            {
                R[r] -= exact[r] / (nAngles * nPlaces);
            }
        }
    }
    return R;
}
} // namespace

void Foam::wallImage::fill(const deltaKernel& kernel)
{
    const auto entry = [](const int i, const int j, const int r)
    { return padded * ((i * nHeights + j) * nRatios + r); };
    std::vector<double> sum(padded * nHeights * nHeights * nRatios, 0);

    // Half the second moment of the kernel, by its transform
    const double little = 0.01;
    const double c = (1 - kernelTransform(kernel, little)) / sqr(little);

    // Midpoints of intervals that grow with k
    const int nWaves = 128;
    const double last = 2 * pi, bend = 0.05,
                 end = std::log(1 + last / bend);
    for (int w = 0; w < nWaves; ++w)
    {
        const double x = (w + 0.5) / nWaves * end,
                     k = bend * (std::exp(x) - 1),
                     dk = (k + bend) * end / nWaves;
        const responses R(surplus(kernel, k, c));
        for (int i = 0; i < nHeights; ++i)
        {
            for (int j = 0; j < nHeights; ++j)
            {
                const double Z = heightAt(i) + heightAt(j);
                if (k * Z > 16) continue;
                for (int r = 0; r < nRatios; ++r)
                {
                    const double q = r / perRatio, kr = k * Z * q / (1 - q),
                                 J0 = ::j0(kr), J1 = ::j1(kr),
                                 over = kr > 1e-6 ? J1 / kr : 0.5,
                                 wave = k * dk / (2 * pi),
                                 along = R[ALONG](i, j),
                                 across = R[ACROSS](i, j);
                    double* K = &sum[entry(i, j, r)];
                    K[EE] += wave * (along * (J0 - over) + across * over);
                    K[TT] += wave * (along * over + across * (J0 - over));
                    K[NN] += wave * R[NORMAL](i, j) * J0;
                    K[EN] += wave * R[ALONG_OF_NORMAL](i, j) * J1;
                    K[NE] -= wave * R[NORMAL_OF_ALONG](i, j) * J1;
                }
            }
        }
    }

    table_.assign(sum.size(), 0);
    for (int i = 0; i < nHeights; ++i)
    {
        for (int j = 0; j < nHeights; ++j)
        {
            const double Z = heightAt(i) + heightAt(j);
            for (int r = 0; r < nRatios; ++r)
            {
                const double q = r / perRatio, rho = Z * q / (1 - q),
                             scale = std::pow(sqr(rho) + sqr(Z), 1.5);
                for (int p = 0; p < nParts; ++p)
                {
                    const int at = entry(i, j, r) + p;
                    table_[at] = -scale * sum[at];
                }
            }
        }
    }
}
