// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "FFTSolver.H"
#include "boxMatrix.H"

namespace Foam
{
defineTypeNameAndDebug(FFTSolver, 0);
lduMatrix::solver::addsymMatrixConstructorToTable<FFTSolver> addFFTSym_;
lduMatrix::solver::addasymMatrixConstructorToTable<FFTSolver> addFFTAsym_;
} // namespace Foam

Foam::FFTSolver::FFTSolver(const word& fieldName, const lduMatrix& matrix,
                           const FieldField<Field, scalar>& interfaceBouCoeffs,
                           const FieldField<Field, scalar>& interfaceIntCoeffs,
                           const lduInterfaceFieldPtrsList& interfaces,
                           const dictionary& solverControls)
    : lduMatrix::solver(fieldName, matrix, interfaceBouCoeffs,
                        interfaceIntCoeffs, interfaces, solverControls)
{
}

void Foam::FFTSolver::requireConstant(const boxMatrix& box) const
{
    if (box.constant()) return;
    FatalErrorInFunction
        << "FFT cannot solve for " << fieldName_ << ": " << box.reason().c_str()
        << nl << "    Use  solver PCG; preconditioner FFT;  for a symmetric "
        << "matrix or  solver PBiCGStab; preconditioner FFT;  otherwise, "
        << "in fvSolution" << exit(FatalError);
}

void Foam::FFTSolver::requireSolved(const solverPerformance& performance,
                                    const scalar reached,
                                    const scalar roundOff) const
{
    const scalar wanted =
        max(tolerance_, relTol_ * performance.initialResidual());
    if (reached <= max(wanted, roundOff)) return;
    FatalErrorInFunction
        << "FFT has not solved for " << fieldName_ << ": residual " << reached
        << " after " << performance.nIterations() << " passes, tolerance "
        << wanted << " (round-off " << roundOff << ")" << nl
        << "    Allow more passes (maxIter) or a larger tolerance, or "
        << "use  solver PCG; preconditioner FFT;  in fvSolution"
        << exit(FatalError);
}

Foam::solverPerformance Foam::FFTSolver::solve(scalarField& psi,
                                               const scalarField& source,
                                               const direction cmpt) const
{
    solverPerformance performance(typeName, fieldName_);
    const boxMatrix box(*this);
    requireConstant(box);

    scalarField Apsi(psi.size()), residual(psi.size());
    const auto updateResidual = [&]()
    {
        matrix_.Amul(Apsi, psi, interfaceBouCoeffs_, interfaces_, cmpt);
        residual = source - Apsi;
    };

    updateResidual();
    scalarField work(psi.size());
    const scalar norm = normFactor(psi, source, Apsi, work);
    performance.initialResidual() = gSumMag(residual) / norm;
    performance.finalResidual() = performance.initialResidual();

    while (performance.nIterations() < minIter_ ||
           (performance.nIterations() < maxIter_ &&
            !performance.checkConvergence(tolerance_, relTol_)))
    {
        box.solveWithReference(work, residual);
        psi += work;
        updateResidual();
        const scalar before = performance.finalResidual();
        performance.finalResidual() = gSumMag(residual) / norm;
        ++performance.nIterations();

        // At round-off a further pass gains nothing
        if (!(performance.finalResidual() <= 0.5 * before)) break;
    }
    if (!performance.checkConvergence(tolerance_, relTol_))
    {
        // Residual that no solution removes: the mean, where the level of psi is free,
        // and round-off in the sums over neighbours
        if (box.singular()) residual -= gAverage(residual);
        const scalar reached = gSumMag(residual) / norm;
        const scalar roundOff =
            1e-14 * gSum(mag(matrix_.diag() * psi) + mag(source)) / norm;
        requireSolved(performance, reached, roundOff);
    }
    return performance;
}
