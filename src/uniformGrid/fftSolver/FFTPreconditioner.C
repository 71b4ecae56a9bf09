// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "FFTPreconditioner.H"

namespace Foam
{
defineTypeNameAndDebug(FFTPreconditioner, 0);
lduMatrix::preconditioner::addsymMatrixConstructorToTable<FFTPreconditioner>
    addFFTPreconditionerSym_;
lduMatrix::preconditioner::addasymMatrixConstructorToTable<FFTPreconditioner>
    addFFTPreconditionerAsym_;
} // namespace Foam
