// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Between the fields of OpenFOAM and those of a block: state, U, p and phi

#include "staggeredFlow.H"
#include "caseFiles.H"
#include "lastStep.H"
#include "writtenObject.H"

Foam::word Foam::staggeredFlow::historyName(const bool isExplicit)
{
    return isExplicit ? "staggeredExplicit" : "staggeredConvection";
}

void Foam::staggeredFlow::readState()
{
    const auto scheme = stateOfTime(mesh_, "timeScheme");
    const word before(scheme ? scheme->getOrDefault<word>("timeScheme", "AB2")
                             : "AB2");
    if ((timeScheme_ == "auto" ? before : timeScheme_) == "RK3") takeRK3();
    for (const bool isExplicit : {false, true})
    {
        IOobject io(historyName(isExplicit), mesh_.time().timeName(), mesh_,
                    IOobject::MUST_READ, IOobject::NO_WRITE, false);
        if (RK3_ || !io.typeHeaderOk<volVectorField>(true)) continue;

        const volVectorField field(io, mesh_);
        forAll(grid_.index(), celli)
        {
            for (direction d = 0; d < 3; ++d)
            {
                last_[d][grid_.index()[celli]] = field[celli][d];
            }
        }
        explicit_ = isExplicit;
        hasLast_ = true;
    }
    if (!RK3_ && !hasLast_ && mesh_.time().value() > 0)
    {
        WarningInFunction << "no history of timeScheme AB2 in time "
                          << mesh_.time().timeName() << ", file "
                          << historyName(false)
                          << ": the first step is one of explicit Euler"
                          << endl;
    }
    const auto writeLast = [this](Ostream& os)
    {
        const auto made = volVectorField::New(
            "last", mesh_, dimensionedVector(dimAcceleration, Zero));
        volVectorField& field = made.ref();
        forAll(field, celli)
        {
            for (direction d = 0; d < 3; ++d)
            {
                field[celli][d] = last_[d][grid_.index()[celli]];
            }
        }
        field.correctBoundaryConditions();
        field.writeData(os);
    };
    if (!RK3_)
    {
        history_.reset(new writtenObject<volVectorField>(historyName(explicit_),
                                                         "", mesh_, writeLast));
    }

    // The step that the last terms belong to: Time forgets it where deltaT is
    // fixed
    lastDt_ = lastStep::read(mesh_.time());
    if (!(lastDt_ > 0)) lastDt_ = mesh_.time().deltaTValue();

    grid_.toStaggered(phi_, force_);
    setVelocity(force_);
    force_.clear();
    block_.set(p_, pressure_.data());
}

// What p has more than pressure_
Foam::scalar Foam::staggeredFlow::levelOfPressure() const
{
    if (!hasReference_) return 0;
    const scalar here =
        referenceCell_ < 0 ? 0 : pressure_[block_.placeOf(referenceCell_)];
    return referenceValue_ - returnReduce(here, sumOp<scalar>());
}

void Foam::staggeredFlow::fill()
{
    const auto timing(effects_.time("fields"));
    Info << "Largest divergence, relative to max|u|/h: " << divergence()
         << endl;

    velocity(force_);
    grid_.toFlux(force_, phi_);
    force_.clear();

    forAll(U_, celli)
    {
        const label q = block_.placeOf(celli);
        for (direction d = 0; d < 3; ++d)
        {
            U_[celli][d] = 0.5 * (u_[d][q] + u_[d][q + block_.stride(d)]);
        }
        p_[celli] = pressure_[q];
    }
    if (hasReference_) p_.primitiveFieldRef() += levelOfPressure();
    U_.correctBoundaryConditions();
    p_.correctBoundaryConditions();
    filled_ = true;
}

void Foam::staggeredFlow::takeOver()
{
    if (!filled_) return;
    const auto timing(effects_.time("fields"));

    // What is theirs less what is ours, of phi as a velocity
    vectorField U(U_.size());
    grid_.toStaggered(phi_, force_);
    const scalar level = levelOfPressure();
    vector change(Zero), size(Zero);
    forAll(grid_.index(), celli)
    {
        const label n = grid_.index()[celli], q = block_.placeOf(celli);
        for (direction d = 0; d < 3; ++d)
        {
            const scalar u = u_[d][q];
            U[celli][d] =
                U_[celli][d] - 0.5 * (u + u_[d][q + block_.stride(d)]);
            change.x() = max(change.x(), mag(U[celli][d]));
            change.y() = max(change.y(), mag(force_[d][n] - u));
            size.x() = max(size.x(), mag(u));
        }
        const scalar p = pressure_[q] + level;
        change.z() = max(change.z(), mag(p_[celli] - p));
        size.z() = max(size.z(), mag(p));
    }
    size.y() = size.x();
    reduce(change, maxOp<vector>());
    reduce(size, maxOp<vector>());
    const auto changed = [&](const direction which)
    { return change[which] > 1e-10 * size[which]; };

    if (!tookOver_ && (changed(0) || changed(1) || changed(2)))
    {
        Info << "Between two steps" << (changed(0) ? " U" : "")
             << (changed(1) ? " phi" : "") << (changed(2) ? " p" : "")
             << " changed (by a functionObject?): staggered takes that over"
             << endl;
        tookOver_ = true;
    }
    if (changed(1) || changed(0))
    {
        if (!changed(1))
        {
            velocity(force_);
            addCells(U, 1);
        }
        setVelocity(force_);
    }
    force_.clear();
    if (!changed(2)) return;
    const scalarField p(p_.primitiveField() - level);
    block_.set(p, pressure_.data());
}
