// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Sums over the points of bodies at walls

#include "wallImage.H"
#include "mathematicalConstants.H"
#include "quietEigen.H"
#include "wallImageTable.H"
#include <algorithm>

namespace
{
using namespace Foam::wallTable;
using values = Eigen::Array<double, padded, 1>;

//- Linear interpolation: the entry below, and the share of the one above
struct between
{
    int i;
    double share;

    between(const double index, const int n)
        : i(std::min(std::max(int(index), 0), n - 2)),
          share(std::min(std::max(index - i, 0.0), 1.0))
    {
    }
};

//- Parts of K |R|^3
inline values interpolated(const double* table, const between& z,
                           const between& H, const between& r)
{
    values sum = values::Zero();
    for (int c = 0; c < 4; ++c)
    {
        const int a = c & 1, b = c >> 1;
        const double weight = (a ? z.share : 1 - z.share) *
                             (b ? H.share : 1 - H.share);
        const double* entry = table + entryOf(z.i + a, H.i + b, r.i);
        sum += weight * ((1 - r.share) * Eigen::Map<const values>(entry) +
                         r.share * Eigen::Map<const values>(entry + padded));
    }
    return sum;
}

//- Raise all points alike, so that none is lower than the table
void lift(std::vector<double>& heights)
{
    if (heights.empty()) return;
    const double least = *std::min_element(heights.begin(), heights.end());
    for (double& z : heights)
    {
        z += std::max(lowest - least, 0.0);
    }
}
} // namespace

Foam::wallImage::wallImage(const deltaKernel::kernelType kernel, const scalar h,
                           const scalar mu)
    : h_(h),
      mu_(mu)
{
    fill(deltaKernel(kernel));
}

Foam::scalar Foam::wallImage::tableIndex(const scalar height)
{
    return std::log(max(height, lowest) / lowest) / std::log(growth);
}

std::array<Foam::scalar, Foam::wallImage::nParts>
Foam::wallImage::parts(const scalar rho, const scalar z, const scalar H) const
{
    const scalar Z = max(z, lowest) + max(H, lowest);
    const values K =
        interpolated(table_.data(), between(tableIndex(z), nHeights),
                     between(tableIndex(H), nHeights),
                     between(rho / (rho + Z) * perRatio, nRatios)) /
        std::pow(rho * rho + Z * Z, 1.5);
    std::array<scalar, nParts> each;
    std::copy(K.data(), K.data() + nParts, each.begin());
    return each;
}

void Foam::wallImage::velocity(const nearField::pointSet& body,
                               const nearField::pointSet& image,
                               const vector& apart, const direction normal,
                               const scalar height, const bool above,
                               std::vector<vector>& u) const
{
    const label n = body.padded(), m = image.padded();
    const direction first = (normal + 1) % 3, second = (normal + 2) % 3;
    const scalar side = above ? -1 : 1;
    const scalar factor =
        1 / (8 * constant::mathematical::pi * mu_ * h_);
    std::vector<double> own(body.n), others(image.n);
    for (label i = 0; i < body.n; ++i)
    {
        own[i] = side * (height + body.fromOrigin[normal * n + i]) / h_;
    }
    for (label j = 0; j < image.n; ++j)
    {
        const double along = apart[normal] + image.fromOrigin[normal * m + j];
        others[j] = -side * (height + along) / h_;
    }
    lift(own);
    lift(others);
    std::vector<between> H;
    for (const double z : others)
    {
        H.emplace_back(tableIndex(z), nHeights);
    }
    const Eigen::Map<const Eigen::ArrayXd> Hs(others.data(), image.n);
    Eigen::ArrayXd x, y, rho, RR, ratio, scale;
    u.assign(body.n, vector(Zero));
    for (label i = 0; i < body.n; ++i)
    {
        const auto along = [&](const direction d)
        {
            const Eigen::Map<const Eigen::ArrayXd> from(
                image.fromOrigin.data() + d * m, image.n);
            return (body.fromOrigin[d * n + i] - apart[d] - from) / h_;
        };
        x = along(first);
        y = along(second);
        rho = (x.square() + y.square()).max(1e-20).sqrt(); // 1/0 stops
        ratio = rho / (rho + own[i] + Hs) * perRatio;
        RR = rho.square() + (own[i] + Hs).square();
        scale = 1 / (RR * RR.sqrt());
        rho = 1 / rho;
        const between z(tableIndex(own[i]), nHeights);
        double sum[3] = {0, 0, 0};
        for (label j = 0; j < image.n; ++j)
        {
            const values K = interpolated(table_.data(), z, H[j],
                                          between(ratio[j], nRatios)) *
                             scale[j];

            // The force is mirrored: its normal part has the other sign
            const double fx = image.F[first * m + j],
                         fy = image.F[second * m + j],
                         fn = -side * image.F[normal * m + j],
                         ex = x[j] * rho[j], ey = y[j] * rho[j],
                         fe = ex * fx + ey * fy,
                         ue = (K[EE] - K[TT]) * fe + K[EN] * fn;
            sum[0] += ex * ue + K[TT] * fx;
            sum[1] += ey * ue + K[TT] * fy;
            sum[2] += K[NN] * fn + K[NE] * fe;
        }
        u[i][first] = factor * sum[0];
        u[i][second] = factor * sum[1];
        u[i][normal] = factor * side * sum[2];
    }
}
