// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Between the fields of OpenFOAM and those of a block: state, U, p and phi

#include "staggeredFlow.H"
#include "lastStep.H"

// last_ as an OpenFOAM field, made only when it is written
struct Foam::staggeredFlow::history : public regIOobject
{
    const staggeredFlow& flow_;

    explicit history(const staggeredFlow& flow)
        : regIOobject(IOobject(historyName(flow.explicit_),
                               flow.mesh_.time().timeName(), flow.mesh_,
                               IOobject::NO_READ, IOobject::AUTO_WRITE)),
          flow_(flow)
    {
    }

    virtual const word& type() const { return volVectorField::typeName; }

    virtual bool writeData(Ostream& os) const
    {
        volVectorField field(
            IOobject("last", time().timeName(), flow_.mesh_, IOobject::NO_READ,
                     IOobject::NO_WRITE, false),
            flow_.mesh_, dimensionedVector(dimAcceleration, Zero));
        const labelList& index = flow_.grid_.index();
        forAll(index, celli)
        {
            for (direction d = 0; d < 3; ++d)
            {
                field[celli][d] = flow_.last_[d][index[celli]];
            }
        }
        field.correctBoundaryConditions();
        return field.writeData(os);
    }
};

Foam::word Foam::staggeredFlow::historyName(const bool isExplicit)
{
    return isExplicit ? "staggeredExplicit" : "staggeredConvection";
}

void Foam::staggeredFlow::readState()
{
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
    if (!RK3_) history_.reset(new history(*this));

    // The step that the last terms belong to: Time forgets it where deltaT is
    // fixed
    lastDt_ = lastStep::read(mesh_.time());
    if (!(lastDt_ > 0)) lastDt_ = mesh_.time().deltaTValue();

    staggeredField& u = force_;
    grid_.toStaggered(phi_, u);
    forAll(grid_.index(), celli)
    {
        const label q = block_.placeOf(celli);
        for (direction d = 0; d < 3; ++d)
        {
            u_[d][q] = u[d][grid_.index()[celli]];
        }
        pressure_[q] = p_[celli];
    }
    block_.update(pressure_.data());
    force_.clear();
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
    scalarField p(p_.size());
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
        p[celli] = p_[celli] - (pressure_[q] + level);
        change.z() = max(change.z(), mag(p[celli]));
        size.z() = max(size.z(), mag(pressure_[q] + level));
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
        rates_.clear();
        if (!changed(1))
        {
            velocity(force_);
            addCells(U, 1);
        }
        block_.rows(
            [&](const label q, const label n)
            {
                for (direction d = 0; d < 3; ++d)
                {
                    std::copy_n(force_[d].cdata() + n, box_.size.x(),
                                u_[d].data() + q);
                }
            });
        stopOnWalls();
        updateVelocity();
    }
    force_.clear();
    if (changed(2))
    {
        forAll(p, celli)
        {
            pressure_[block_.placeOf(celli)] += p[celli];
        }
        block_.update(pressure_.data());
    }
}
