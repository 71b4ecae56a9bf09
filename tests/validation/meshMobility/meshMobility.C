// This file is part of deformableBodies. License: GPL-3.0-or-later.

// The mobility G_h between two markers, measured: forces at random places are
// spread to a periodic mesh, the staggered discrete Stokes equations solved by
// Fourier transforms, and the velocity interpolated at markers around,
//
//     G_h = 1/(8 pi mu h) [A(q) I + B(q) r r/r^2],  q = |r|/h.
//
// The periodic images go away with those of a Stokeslet whose transform is
// multiplied by (1 + x + 4/3 x^3) e^(-x), x = (k d)^2/4: it is summed over the
// same wave vectors and, without images, known in closed form.

#include "capsuleNearField.H"
#include "markerSet.H"
#include "mathematicalConstants.H"
#include "nearField.H"
#include "testShapes.H"
#include <array>
#include <complex>
#include <Eigen/Eigenvalues>
#include <fftw3.h>
#include <fstream>
#include <map>

using namespace Foam;

namespace
{
const double pi = constant::mathematical::pi;
using complexField = std::vector<std::complex<double>>;

//- A and B of the regularised Stokeslet, lengths in h
struct regularised
{
    static constexpr double d = 5;

    static void AB(const double r, double& A, double& B)
    {
        const double q = std::max(r / d, 0.02), qq = q * q;
        const double E = std::exp(-qq) / std::sqrt(pi), F = std::erf(q);
        const double P = (F * (1 - 0.5 / qq) + E / q) / q -
                         0.5 * (2 * E / q - F / qq) / q +
                         4 / 3.0 * (2.5 - qq) * E;
        const double L =
            2 * F / q + 2 * E +
            4 / 3.0 * ((2.5 - 8 * qq + 2 * qq * qq) + 2 * (2.5 - qq)) * E;
        A = (L - P) / d;
        B = r > 0 ? (3 * P - L) / d : 0;
    }

    //- 8 pi times the sum over the wave vectors of a box of n cells
    static tensor periodic(const vector& r, const label n)
    {
        const double step = 2 * pi / n;
        const label most = label(2 / step);
        symmTensor sum(Zero);
        for (label i = -most; i <= most; ++i)
        {
            for (label j = -most; j <= most; ++j)
            {
                for (label k = 0; k <= most; ++k)
                {
                    const vector K(step * vector(i, j, k));
                    const double KK = magSqr(K);
                    if (KK == 0 || KK > 4) continue;
                    const double x = 0.25 * d * d * KK;
                    const double wave = (k ? 2 : 1) * std::cos(K & r) *
                                        (1 + x + 4 / 3.0 * x * x * x) *
                                        std::exp(-x) / KK;
                    sum += wave * (symmTensor(I) - sqr(K) / KK);
                }
            }
        }
        return tensor(8 * pi / pow3(scalar(n)) * sum);
    }
};

//- Replace f by the velocity of the discrete Stokes flow, mu = h = 1
void solve(staggeredField& f, const label n)
{
    const label size = n * n * n;
    const auto inTransform = [n](const labelVector& c)
    { return c.x() + n * (c.y() + n * c.z()); };
    std::array<complexField, 3> F;
    for (direction d = 0; d < 3; ++d)
    {
        F[d].resize(size);
        fftw_complex* data = reinterpret_cast<fftw_complex*>(F[d].data());
        f.box().cells([&](const label i, const labelVector& c)
                      { F[d][inTransform(c)] = f[d][i]; });
        fftw_plan plan =
            fftw_plan_dft_3d(n, n, n, data, data, FFTW_FORWARD, FFTW_ESTIMATE);
        fftw_execute(plan);
        fftw_destroy_plan(plan);
    }
    for (label q = 0; q < size; ++q)
    {
        // Symbol of the divergence at centres; - its conjugate is the one of gradients
        std::complex<double> D[3], force(0);
        double kk = 0;
        const label at[3] = {q % n, q / n % n, q / (n * n)};
        for (direction d = 0; d < 3; ++d)
        {
            D[d] = std::polar(1.0, 2 * pi * at[d] / n) - 1.0;
            kk += std::norm(D[d]);
            force += D[d] * F[d][q];
        }
        for (direction d = 0; d < 3; ++d)
        {
            F[d][q] = kk == 0 ? 0
                              : (F[d][q] - std::conj(D[d]) * force / kk) /
                                    (kk * size);
        }
    }
    for (direction d = 0; d < 3; ++d)
    {
        fftw_complex* data = reinterpret_cast<fftw_complex*>(F[d].data());
        fftw_plan plan =
            fftw_plan_dft_3d(n, n, n, data, data, FFTW_BACKWARD, FFTW_ESTIMATE);
        fftw_execute(plan);
        fftw_destroy_plan(plan);
        f.box().cells([&](const label i, const labelVector& c)
                      { f[d][i] = F[d][inTransform(c)].real(); });
    }
}
} // namespace

// On a periodic cube of cells of size 1
TEST(MeshMobility, DISABLED_table)
{
    const uniformGrid& grid = uniformGrid::New(test::mesh());
    const label n = grid.n().x();
    ASSERT_EQ(grid.n(), labelVector(n, n, n));
    ASSERT_NEAR(grid.h().x(), 1, 1e-12);
    const label nForces = 100, nDirections = 60;
    scalarList distances;
    for (label i = 0; i < 70; ++i)
    {
        distances.append(0.05 * i);
    }
    for (const scalar q : {3.5, 4.0, 5.0, 6.0, 8.0, 10.0})
    {
        distances.append(q);
    }

    Random random(1);
    const auto anywhere = [&]()
    { return random.sample01<vector>() - 0.5 * vector::one; };
    vectorField r;
    tensorField images; // part of the regularised Stokeslet
    for (const scalar q : distances)
    {
        for (label i = 0; i < nDirections; ++i)
        {
            const vector e(anywhere());
            r.append(q / mag(e) * e);
            double A, B;
            regularised::AB(q, A, B);
            images.append(
                regularised::periodic(r.last(), n) -
                tensor(A * I + (q > 0 ? B / sqr(q) : 0) * sqr(r.last())));
        }
    }

    std::printf("kernel,q,A,B,scatter\n");
    blockNeighbours neighbours(grid);
    scalarField sum; // first kernel: G_h and near field
    for (const auto kernel : {deltaKernel::Roma3, deltaKernel::Peskin4})
    {
        markerSet markers(grid, deltaKernel(kernel), neighbours);
        scalarField A(distances.size(), Zero), B(A), AA(A);
        for (label force = 0; force < nForces; ++force)
        {
            const point X(grid.origin() + 0.5 * grid.length() + anywhere());
            tensorField G(r.size());
            for (direction d = 0; d < 3; ++d)
            {
                vector F(Zero);
                F[d] = 8 * pi;
                staggeredField f(grid.box());
                markers.setPositions(vectorField(1, X));
                markers.spread(vectorField(1, F), f);
                solve(f, n);
                vectorField u;
                markers.setPositions(vectorField(X + r));
                markers.interpolate({staggeredView(f)}, u);
                forAll(u, i)
                {
                    for (direction e = 0; e < 3; ++e)
                    {
                        G[i](e, d) = u[i][e];
                    }
                }
            }
            G -= images;
            forAll(distances, i)
            {
                for (label j = 0; j < nDirections; ++j)
                {
                    const tensor& g = G[nDirections * i + j];
                    const vector& x = r[nDirections * i + j];
                    const scalar q = distances[i], trace = tr(g);
                    const scalar along =
                        q > 0 ? (x & (g & x)) / sqr(q) : trace / 3;
                    A[i] += 0.5 * (trace - along);
                    AA[i] += sqr(0.5 * (trace - along));
                    B[i] += 0.5 * (3 * along - trace);
                }
            }
        }
        const scalar all = nForces * nDirections;
        const nearField near(kernel, 1, 1, 1);
        scalarField whole(distances.size());
        scalar far = 0;
        forAll(distances, i)
        {
            A[i] /= all;
            B[i] /= all;
            const scalar q = distances[i];
            std::printf("%s,%.2f,%.5f,%.5f,%.4f\n",
                        deltaKernel::names[kernel].c_str(), q, A[i], B[i],
                        std::sqrt(max(AA[i] / all - sqr(A[i]), scalar(0))));

            // A and B of the class are those of a Stokeslet of order d^7 less
            // G_h; from 5 d on that is the Stokeslet
            const nearField::mobility m(near.exact(q));
            whole[i] = m.A + A[i];
            if (q < 5) continue;
            far = max(far, max(mag(whole[i] - 1 / q),
                               mag(m.C * sqr(q) + B[i] - 1 / q)));
        }
        test::expectBelow(deltaKernel::names[kernel] +
                              ": A and B far away against the Stokeslet",
                          far, 2e-3);
        if (sum.empty()) sum = whole;
        test::expectBelow(deltaKernel::names[kernel] +
                              ": G_h and what is added, against that of Roma3",
                          max(mag(whole - sum)), 4e-3);
    }
}

// The velocity of a surface by G_h and the near field as a matrix over coefficients
// of load and velocity: its eigenvalues must not be negative, or waves of the load
// would grow. G_h comes from table.csv in the case
TEST(MeshMobility, DISABLED_positive)
{
    std::map<std::string, std::vector<std::array<double, 3>>> tables;
    std::ifstream file("table.csv");
    for (std::string line; std::getline(file, line);)
    {
        char kernel[20];
        std::array<double, 3> row;
        if (std::sscanf(line.c_str(), "%19[^,],%lf,%lf,%lf", kernel, &row[0],
                        &row[1], &row[2]) == 4)
        {
            tables[kernel].push_back(row);
        }
    }
    ASSERT_EQ(tables.size(), 2u);

    const int N = 8;
    const double cells = 4; // a/h
    const sphericalHarmonics grid(N, 24);
    const int n = grid.nPoints(), nCoeffs = 3 * grid.nCoeffs();
    const std::pair<const char*, test::numbers> shapes[] = {
        {"sphere", test::sphere(N)},
        {"D = 0.6",
         test::shape(N, [](const vector& e)
                     { return vector(2 * e.x(), 0.5 * e.y(), e.z()); })},
        {"rough", test::roughShape(N)}};
    for (const auto kernel : {deltaKernel::Roma3, deltaKernel::Peskin4})
    {
        const auto& table = tables[deltaKernel::names[kernel]];
        const auto G = [&](const double q, double& A, double& B)
        {
            if (q >= 10)
            {
                A = B = 1 / q;
                return;
            }
            size_t i = 1;
            while (table[i][0] < q)
                ++i;
            const auto &a = table[i - 1], &b = table[i];
            const double x = (q - a[0]) / (b[0] - a[0]);
            // Far away the rows are wide apart: what is linear is q A
            const double qa = a[0] < 3.5 ? 1 : a[0], qb = a[0] < 3.5 ? 1 : b[0];
            const double scale = a[0] < 3.5 ? 1 : 1 / q;
            A = scale * ((1 - x) * qa * a[1] + x * qb * b[1]);
            B = scale * ((1 - x) * qa * a[2] + x * qb * b[2]);
        };
        for (const auto& s : shapes)
        {
            const test::numbers& x = s.second;
            test::numbers X(3 * n), f(3 * n), c(nCoeffs);
            grid.values(x.data(), X.data());

            // Between points; then between coefficients, from both sides
            Eigen::MatrixXd between(3 * n, 3 * n);
            for (int i = 0; i < n; ++i)
            {
                for (int j = 0; j < n; ++j)
                {
                    const vector r(cells * (vector(test::at(X, n, i)) -
                                            test::at(X, n, j)));
                    double A, B;
                    G(mag(r), A, B);
                    B /= max(magSqr(r), 1e-12);
                    for (int d = 0; d < 3; ++d)
                    {
                        for (int e = 0; e < 3; ++e)
                        {
                            between(d * n + i, e * n + j) =
                                grid.weight(i) * grid.weight(j) * cells *
                                ((d == e ? A : 0) + B * r[d] * r[e]) / (8 * pi);
                        }
                    }
                }
            }
            Eigen::MatrixXd half(nCoeffs, 3 * n), mesh(nCoeffs, nCoeffs);
            for (int k = 0; k < 3 * n; ++k)
            {
                const Eigen::VectorXd column(between.col(k));
                grid.valuesAdjoint(column.data(), half.col(k).data());
            }
            for (int k = 0; k < nCoeffs; ++k)
            {
                const Eigen::VectorXd row(half.row(k).transpose());
                grid.valuesAdjoint(row.data(), mesh.col(k).data());
            }
            const capsuleNearField near(N, kernel, 1 / cells, 1, 1);
            Eigen::MatrixXd both(mesh);
            for (int k = 0; k < nCoeffs; ++k)
            {
                std::fill(c.begin(), c.end(), 0);
                c[k] = 1;
                near.add(x.data(), c.data(), both.col(k).data());
            }
            const auto eigenvalues = [](const Eigen::MatrixXd& m)
            {
                return Eigen::VectorXd(
                    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                        0.5 * (m + m.transpose()), Eigen::EigenvaluesOnly)
                        .eigenvalues());
            };
            const Eigen::VectorXd without(eigenvalues(mesh));
            const Eigen::VectorXd with(eigenvalues(both));
            const std::string what(deltaKernel::names[kernel] + ", " + s.first);
            std::printf("    %s: smallest and largest eigenvalue without %.2e "
                        "%.3f, with %.2e %.3f\n",
                        what.c_str(), without[0], without[nCoeffs - 1], with[0],
                        with[nCoeffs - 1]);
            test::expectBelow(what + ": most negative over the largest",
                              -with[0] / with[nCoeffs - 1], 0);
        }
    }
}
