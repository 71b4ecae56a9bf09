// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Columns, lines and means of the bulk stress

#include "bulkStress.H"
#include "resultFile.H"

namespace
{
Foam::fileName folderOf(const Foam::fvMesh& mesh)
{
    return Foam::fileName(mesh.dbDir()) / "bulkStress";
}
} // namespace

Foam::wordList Foam::bulkStress::fluidColumns()
{
    return {"relativeViscosity",
            "N1",
            "N2",
            "particleStress",
            "reynoldsStress",
            "wallStress",
            "unsteady",
            "residual",
            "wallLower",
            "wallUpper",
            "contactPressure"};
}

// Parts are between the stresses and what checks them
Foam::wordList Foam::bulkStress::columns() const
{
    const wordList fluid(fluidColumns());
    wordList all(SubList<word>(fluid, 6));
    all.append(parts_);
    all.append(SubList<word>(fluid, 5, 6));
    return all;
}

Foam::wordList Foam::bulkStress::partColumns() const
{
    DynamicList<word> all;
    for (const word& part : parts_)
    {
        for (const word force : {"X", "Y", "Z"})
        {
            for (const word distance : {"X", "Y", "Z"})
            {
                all.append(part + force + distance);
            }
        }
    }
    return wordList(std::move(all));
}

void Foam::bulkStress::append(autoPtr<OFstream>& file, const word& name,
                              const wordList& columns,
                              const UList<scalar>& values) const
{
    if (!Pstream::master()) return;
    if (!file.valid())
    {
        file = newResultFile(system_.mesh.time(), folderOf(system_.mesh), name);
        file() << "# time";
        for (const word& column : columns)
        {
            file() << ' ' << column;
        }
        file() << nl << "# [s]";
        forAll(columns, i)
        {
            file() << " [1]";
        }
        file() << endl;
        file().precision(10);
    }
    file() << lastTime_;
    for (const scalar x : values)
    {
        file() << ' ' << x;
    }
    file() << endl;
}

void Foam::bulkStress::writeState(Ostream& os) const
{
    OStringStream text;
    text.precision(17);
    text << "lastTime " << lastTime_ << token::END_STATEMENT << nl
         << "largestRate " << largestRate_ << token::END_STATEMENT << nl
         << "rate " << rate_ << token::END_STATEMENT << nl << "directions ("
         << label(flowDirection_) << ' ' << label(gradient_) << ')'
         << token::END_STATEMENT << nl;
    writeNumbers(text, "sums", means_.state());
    os.writeEntry("columns", columns());
    os << text.str().c_str();
}

Foam::label Foam::bulkStress::firstBlock() const
{
    if (startAverage_ > -GREAT) return means_.firstFrom(startAverage_);
    const label settled =
        means_.nBlocks() ? means_.firstFrom(means_.start(0) + settling_) : 0;
    return max(settled, means_.afterTransient(0));
}

void Foam::bulkStress::writeAverages()
{
    const label first = firstBlock();
    if (first >= means_.nBlocks())
    {
        Info << "Bulk stress: "
             << (startAverage_ > -GREAT ? "startAverage is not reached"
                                        : "the transient is not over")
             << ", no averages yet" << nl;
        return;
    }
    if (!Pstream::master()) return;
    const wordList names(columns());
    if (!averages_.valid())
    {
        averages_ = newResultFile(system_.mesh.time(), folderOf(system_.mesh),
                                  "averages.dat");
        averages_() << "# time from";
        for (const word& name : names)
        {
            averages_() << ' ' << name << ' ' << name << "Error";
        }
        averages_() << nl << "# [s] [s]";
        forAll(names, i)
        {
            averages_() << " [1] [1]";
        }
        averages_() << endl;
        averages_().precision(10);
    }
    averages_() << lastTime_ << ' ' << means_.start(first);
    forAll(names, i)
    {
        const blockMeans::mean m(means_.of(i, first));
        averages_() << ' ' << m.value << ' ' << m.error;
    }
    averages_() << endl;

    const blockMeans::mean viscosity(means_.of(0, first));
    Info << "Bulk stress from " << means_.start(first)
         << " s on: relative viscosity " << viscosity.value;
    if (viscosity.error >= 0) Info << " +- " << viscosity.error;
    Info << ", N1 " << means_.of(1, first).value << ", N2 "
         << means_.of(2, first).value << nl;
}
