// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "sceneNumbers.H"
#include "caseFiles.H"
#include "dictionaryChecks.H"
#include "gaussGrad.H"
#include "shearSides.H"
#include "StringStream.H"
#include "volFields.H"
#include <iomanip>
#include <sstream>

namespace
{
using namespace Foam;

//- Begin a line of the table
std::string beginLine(const std::string& name)
{
    std::ostringstream os;
    os << "    " << std::left << std::setw(18) << name;
    return os.str();
}

//- Number with four digits
string digits(const scalar x)
{
    OStringStream os;
    os.precision(4);
    os << x;
    return os.str();
}

string sizes(const vector& v)
{
    return digits(v.x()) + " x " + digits(v.y()) + " x " + digits(v.z());
}

//- Line of the box: size, sides, cells
void printBox(const uniformGrid& grid)
{
    string closed;
    for (direction d = 0; d < 3; ++d)
    {
        if (!grid.periodic(d))
            closed += string(" ") + vector::componentNames[d];
    }
    const vector h(grid.h());
    const labelVector& n = grid.n();
    Info << beginLine("box").c_str() << sizes(grid.length()).c_str() << " m, "
         << (closed.empty() ? "periodic" : "sides in" + closed).c_str() << "; "
         << n.x() << " x " << n.y() << " x " << n.z() << " cells, h "
         << (cmptMax(h) < cmptMin(h) * (1 + 1e-6) ? digits(h.x()) : sizes(h))
                .c_str()
         << " m" << nl;
}

//- Lines of the fluid and of the flow
void printFlow(const scalar rho, const fluidViscosity& nu,
               const flowScales& flow)
{
    Info << beginLine("fluid").c_str() << "rho " << digits(rho).c_str()
         << " kg/m^3, mu " << digits(rho * nu.value()).c_str() << " Pa s, nu "
         << digits(nu.value()).c_str() << " m^2/s"
         << (nu.source().empty() ? "" : " (" + nu.source() + ")").c_str() << nl
         << beginLine("flow").c_str();
    if (flow.speed > 0)
        Info << "up to " << digits(flow.speed).c_str() << " m/s";
    else
        Info << "at rest: no Re, no Ca";
    if (flow.rate > 0)
        Info << ", rate " << digits(flow.rate).c_str() << " 1/s ("
             << flow.from.c_str() << ')';
    Info << nl;
}

//- Distance of the closest opposite sides that are no cyclic ones [m]; GREAT: there are none
scalar gapOfSides(const uniformGrid& grid)
{
    scalar least = GREAT;
    for (direction d = 0; d < 3; ++d)
    {
        if (!grid.periodic(d)) least = min(least, grid.length()[d]);
    }
    return least;
}

//- Mean velocity that a uniform force per mass, of vectorSemiImplicitSource, drives between
//  sides of that distance: of a parabola, at most that of turbulence, some 18 friction
//  velocities; 0: there is no such force [m/s]
scalar drivenMean(const fvMesh& mesh, const scalar width)
{
    const auto* transport = mesh.findObject<dictionary>("transportProperties");
    scalar force = 0;
    for (const dictionary& coeffs :
         optionsOfType(mesh, "vectorSemiImplicitSource"))
    {
        // Later releases know other forms, too
        const dictionary& rates = coeffs.subOrEmptyDict("injectionRateSuSp");
        const entry* rate = rates.findEntry("U");
        if (coeffs.getOrDefault<word>("volumeMode", "") != "specific" ||
            !rate || !rate->isStream())
            continue;
        force = max(force, mag(Tuple2<vector, scalar>(rate->stream()).first()));
    }
    if (!transport || !transport->found("nu") || force == 0) return 0;
    const scalar nu = readPositive(*transport, "nu", dimViscosity);
    return min(force * sqr(width) / (12 * nu),
               18 * std::sqrt(0.5 * force * width));
}

//- Largest rate of strain of U, in cells at the sides of the box and in others [1/s]
//  (collective)
void largestRates(const volVectorField& U, scalar& atSides, scalar& inside)
{
    const tmp<volTensorField> gradU(fv::gaussGrad<vector>::gradf(
        linearInterpolate(U), "gradientAtStart"));
    scalarField rate(std::sqrt(2.0) * mag(symm(gradU().primitiveField())));
    atSides = 0;
    for (const fvPatchVectorField& side : U.boundaryField())
    {
        if (side.patch().coupled()) continue;
        for (const label cell : side.patch().faceCells())
        {
            atSides = max(atSides, rate[cell]);
            rate[cell] = 0;
        }
    }
    inside = gMax(rate);
    reduce(atSides, maxOp<scalar>());
}
} // namespace

Foam::flowScales Foam::scalesAtStart(const fvMesh& mesh)
{
    flowScales s;
    if (!mesh.foundObject<volVectorField>("U")) return s;
    const auto& U = mesh.lookupObject<volVectorField>("U");
    const uniformGrid& grid = uniformGrid::New(mesh);

    s.speed = gMax(mag(U.primitiveField()));
    for (const fvPatchVectorField& side : U.boundaryField())
    {
        if (side.patch().coupled()) continue;
        for (const vector& v : side)
        {
            s.speed = max(s.speed, mag(v));
        }
    }
    const shearSides sides(shearSides::of(mesh));
    s.rate = mag(sides.rate);
    s.from = string("sides ") + vector::componentNames[sides.gradient] +
             " against each other";
    reduce(s.speed, maxOp<scalar>());
    if (s.rate <= SMALL * s.speed / cmptMin(grid.h())) s.rate = 0;
    if (s.rate > 0 && sides.steady)
    {
        s.plane = FixedList<direction, 2>({sides.flow, sides.gradient});
    }
    if (s.rate > 0) return s;

    const scalar width = gapOfSides(grid);
    if (s.speed > 0)
    {
        scalar atSides = 0, inside = 0;
        largestRates(U, atSides, inside);
        s.rate = max(atSides, inside);
        s.from = "largest in the field U";
        if (s.rate <= 1e-9 * s.speed / cmptMax(grid.length())) s.rate = 0;
        if (inside < 0.1 * atSides)
        {
            s.rate = 6 * s.speed / width;
            s.from = "parabola between the sides, as U jumps there";
        }
    }
    else if (width < GREAT)
    {
        scalar mean = 0;
        for (const dictionary& coeffs :
             optionsOfType(mesh, "meanVelocityForce"))
        {
            mean = max(mean, mag(coeffs.getOrDefault<vector>("Ubar", Zero)));
        }
        if (mean > 0) s.from = "parabola of Ubar of meanVelocityForce";
        if (mean == 0)
        {
            mean = drivenMean(mesh, width);
            s.from = "parabola of vectorSemiImplicitSource";
        }
        s.speed = 1.5 * mean;
        s.rate = 6 * mean / width;
    }
    return s;
}

void Foam::printSceneNumbers(const bodySystem& system)
{
    Info << nl << "Scene in numbers" << nl;
    printBox(system.grid);
    if (!system.withoutFluid) printFlow(system.rho, *system.nu, system.flow);
    for (const bodyGroup& group : system.groups)
    {
        Info << beginLine(group.name()).c_str()
             << group.report().describe().c_str() << nl;
    }
    Info << endl;
}
