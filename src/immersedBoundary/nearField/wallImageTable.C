// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The table of wallImage: velocities that waves of force along a wall cause on the mesh and by
// Blake's image, and their transform

#include "wallImageTable.H"
#include "mathematicalConstants.H"
#include "wallImage.H"
#include "quietEigen.H"
#include <Eigen/LU>

namespace
{
using namespace Foam;
using namespace Foam::wallTable;

const double pi = constant::mathematical::pi;

//- Velocities due to a wave of force of wave number k, times 8 pi mu, by height of marker and
//  of force. ALONG: along k by a force along k; ACROSS and NORMAL: the same across k and along
//  the normal. ALONG_OF_NORMAL: - i times that along k by a normal force; NORMAL_OF_ALONG: i
//  times the normal one by a force along k
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

//- Flow reflected by the wall on the mesh minus that of Blake's image, averaged over
//  directions and positions in a cell
responses meshLessBlake(const deltaKernel& kernel, const double k,
                        const double c)
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

//- Add a wave of wave number k, which stands for dk, to the parts of K
void addWave(const responses& R, const double k, const double dk,
             std::vector<double>& sum)
{
    for (int i = 0; i < nHeights; ++i)
    {
        for (int j = 0; j < nHeights; ++j)
        {
            // The wave decays as exp(-kZ)
            const double Z = heightAt(i) + heightAt(j);
            if (k * Z > 16) continue;
            for (int r = 0; r < nRatios; ++r)
            {
                const double q = r / perRatio, kr = k * Z * q / (1 - q),
                             J0 = ::j0(kr), J1 = ::j1(kr),
                             over = kr > 1e-6 ? J1 / kr : 0.5,
                             wave = k * dk / (2 * pi), along = R[ALONG](i, j),
                             across = R[ACROSS](i, j);
                double* K = &sum[entryOf(i, j, r)];
                K[wallImage::EE] +=
                    wave * (along * (J0 - over) + across * over);
                K[wallImage::TT] +=
                    wave * (along * over + across * (J0 - over));
                K[wallImage::NN] += wave * R[NORMAL](i, j) * J0;
                K[wallImage::EN] += wave * R[ALONG_OF_NORMAL](i, j) * J1;
                K[wallImage::NE] -= wave * R[NORMAL_OF_ALONG](i, j) * J1;
            }
        }
    }
}

//- Parts of K |R|^3 of (Blake - mesh), by sums over waves of the parts of K of (mesh - Blake)
std::vector<double> scaledByDistance(const std::vector<double>& sum)
{
    std::vector<double> table(sum.size(), 0);
    for (int i = 0; i < nHeights; ++i)
    {
        for (int j = 0; j < nHeights; ++j)
        {
            const double Z = heightAt(i) + heightAt(j);
            for (int r = 0; r < nRatios; ++r)
            {
                const double q = r / perRatio, rho = Z * q / (1 - q),
                             scale = std::pow(sqr(rho) + sqr(Z), 1.5);
                for (int p = 0; p < wallImage::nParts; ++p)
                {
                    const int at = entryOf(i, j, r) + p;
                    table[at] = -scale * sum[at];
                }
            }
        }
    }
    return table;
}
} // namespace

void Foam::wallImage::fill(const deltaKernel& kernel)
{
    std::vector<double> sum(padded * nHeights * nHeights * nRatios, 0);

    // Half the second moment of the kernel, by its transform
    const double smallWave = 0.01;
    const double c = (1 - kernelTransform(kernel, smallWave)) / sqr(smallWave);

    // Midpoints of intervals that grow with k from linearUpTo on
    const int nWaves = 128;
    const double largestWave = 2 * pi, linearUpTo = 0.05,
                 end = std::log(1 + largestWave / linearUpTo);
    for (int w = 0; w < nWaves; ++w)
    {
        const double x = (w + 0.5) / nWaves * end,
                     k = linearUpTo * (std::exp(x) - 1),
                     dk = (k + linearUpTo) * end / nWaves;
        addWave(meshLessBlake(kernel, k, c), k, dk, sum);
    }
    table_ = scaledByDistance(sum);
}
