// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "groupStatistics.H"
#include "axialMean.H"
#include "mathematicalConstants.H"
#include "OFstream.H"
#include "periodicBox.H"
#include "stateObject.H"

Foam::groupStatistics::groupStatistics(const bodyGroup& group,
                                       const uniformGrid& grid,
                                       const settings& s)
    : group_(group),
      grid_(grid),
      settings_(s),
      columns_(columnsOf(group)),
      velocity_(columns_.find("velocityX")),
      axis_(columns_.find("axisX")),
      quantities_(namesOfQuantities()),
      angles_(anglesAmong(quantities_.size())),
      means_(2 * quantities_.size()),
      distributions_(quantities_.size(), histogram(s.bins)),
      pairs_(grid, s.maxDistance, s.bins, s.f, s.g)
{
}

Foam::wordList Foam::groupStatistics::columnsOf(const bodyGroup& group)
{
    DynamicList<word> all;
    for (const bodyColumn& c : group.report().columns())
    {
        all.append(c.name);
    }
    return wordList(std::move(all));
}

Foam::wordList Foam::groupStatistics::namesOfQuantities() const
{
    DynamicList<word> all;
    for (label c = nCentreColumns; c < columns_.size(); ++c)
        all.append(columns_[c]);
    if (axis_ >= 0)
    {
        for (const word name :
             {"axisXX", "axisXY", "axisXZ", "axisYY", "axisYZ", "axisZZ",
              "axisXXXX", "axisYYYY", "axisZZZZ", "axisXXYY"})
        {
            all.append(name);
        }
    }
    if (magSqr(settings_.referenceVelocity) > 0 && velocity_ >= 0)
    {
        all.append("velocityOverReference");
    }
    return wordList(std::move(all));
}

Foam::boolList Foam::groupStatistics::anglesAmong(const label n) const
{
    boolList angles(n, false);
    label c = 0;
    for (const bodyColumn& column : group_.report().columns())
    {
        if (c >= nCentreColumns)
            angles[c - nCentreColumns] = column.unit == "degrees";
        ++c;
    }
    return angles;
}

Foam::scalarList Foam::groupStatistics::quantities(const scalarList& row) const
{
    DynamicList<scalar> all;
    for (label c = nCentreColumns; c < columns_.size(); ++c)
    {
        all.append(row[c]);
    }
    const auto vectorAt = [&](const label c)
    { return vector(row[c], row[c + 1], row[c + 2]); };
    if (axis_ >= 0)
    {
        const vector a(vectorAt(axis_));
        const symmTensor aa(sqr(a));
        for (direction i = 0; i < 6; ++i)
        {
            all.append(aa[i]);
        }
        for (direction d = 0; d < 3; ++d)
        {
            all.append(pow4(a[d]));
        }
        all.append(sqr(a.x() * a.y()));
    }
    if (magSqr(settings_.referenceVelocity) > 0 && velocity_ >= 0)
    {
        all.append((vectorAt(velocity_) & settings_.referenceVelocity) /
                   magSqr(settings_.referenceVelocity));
    }
    return scalarList(std::move(all));
}

void Foam::groupStatistics::add(const scalar time, const scalar dt,
                                const List<scalarList>& rows)
{
    const label n = quantities_.size();
    scalarList sums(2 * n, Zero);
    DynamicList<point> centres;
    for (const scalarList& row : rows)
    {
        if (row.empty()) continue;
        centres.append(point(row[0], row[1], row[2]));
        const scalarList q(quantities(row));
        if (reference_.empty()) reference_ = q;
        forAll(q, i)
        {
            distributions_[i].add(q[i], dt);
            if (angles_[i])
            {
                const axialMean line(axialMean::of(q[i]));
                sums[i] += line.cosine;
                sums[n + i] += line.sine;
                continue;
            }
            sums[i] += q[i];
            sums[n + i] += sqr(q[i] - reference_[i]);
        }
    }
    if (centres.empty()) return;
    for (scalar& s : sums)
    {
        s /= centres.size();
    }
    means_.add(time, dt, sums);
    pairs_.add(centres, dt);
    if (velocity_ >= 0) addConcentration(rows, centres, dt);
}

void Foam::groupStatistics::addConcentration(const List<scalarList>& rows,
                                             const UList<point>& centres,
                                             const scalar dt)
{
    labelList others(centres.size(), 0);
    forAll(centres, i)
    {
        for (label j = i + 1; j < centres.size(); ++j)
        {
            if (mag(nearestImage(grid_, centres[i], centres[j])) <
                settings_.concentrationRadius)
            {
                ++others[i];
                ++others[j];
            }
        }
    }
    label i = 0;
    for (const scalarList& row : rows)
    {
        if (row.empty()) continue;
        const label n = others[i++];
        if (concentration_.size() <= n)
        {
            concentration_.setSize(n + 1, scalarList(4, scalar(0)));
        }
        concentration_[n][0] += dt;
        for (direction d = 0; d < 3; ++d)
        {
            concentration_[n][1 + d] += dt * row[velocity_ + d];
        }
    }
}

void Foam::groupStatistics::write(const fileName& stem) const
{
    const auto file = [&](const char* what)
    { return autoPtr<OFstream>(new OFstream(stem + "." + what + ".dat")); };
    writeMeans(file("means")());
    writeDistributions(file("distributions")());
    if (velocity_ >= 0) writeConcentration(file("concentration")());
    pairs_.write(file("pairs")(), file("pairMap")());
}

void Foam::groupStatistics::writeMeans(Ostream& os) const
{
    os.precision(8);
    os << "# quantity mean error deviation" << nl;
    const label n = quantities_.size();
    symmTensor aa(Zero);
    forAll(quantities_, i)
    {
        const blockMeans::mean m(means_.of(i, 0)), squares(means_.of(n + i, 0));
        os << quantities_[i] << ' ';
        if (angles_[i])
        {
            const axialMean lines{m.value, squares.value};
            const bool known = m.error >= 0 && squares.error >= 0;
            os << lines.value() << ' '
               << (known ? lines.error(m.error, squares.error) : -1) << ' '
               << lines.deviation() << nl;
            continue;
        }
        os << m.value << ' ' << m.error << ' '
           << Foam::sqrt(
                  max(squares.value - sqr(m.value - reference_[i]), scalar(0)))
           << nl;
        const label component = i - quantities_.find("axisXX");
        if (axis_ >= 0 && component >= 0 && component < 6)
        {
            aa[component] = m.value;
        }
    }
    if (axis_ >= 0)
    {
        os << "orderParameter " << 0.5 * (3 * cmptMax(eigenValues(aa)) - 1)
           << " -1 0" << nl;
    }
}

void Foam::groupStatistics::writeDistributions(Ostream& os) const
{
    os.precision(8);
    os << "# quantity from to density" << nl;
    forAll(quantities_, i)
    {
        const histogram& h = distributions_[i];
        h.visit(
            [&](const scalar from, const scalar density)
            {
                os << quantities_[i] << ' ' << from << ' ' << from + h.width()
                   << ' ' << density << nl;
            });
    }
}

void Foam::groupStatistics::writeConcentration(Ostream& os) const
{
    scalar all = 0;
    for (const scalarList& c : concentration_)
    {
        all += c[0];
    }
    const scalar volume = 4 * constant::mathematical::pi / 3 *
                          pow3(settings_.concentrationRadius);
    os.precision(8);
    os << "# others numberDensity probability velocityX velocityY velocityZ"
       << nl << "# [1] [1/m^3] [1] [m/s] [m/s] [m/s]" << nl;
    forAll(concentration_, n)
    {
        const scalarList& c = concentration_[n];
        if (c[0] == 0) continue;
        os << n << ' ' << n / volume << ' ' << c[0] / all << ' ' << c[1] / c[0]
           << ' ' << c[2] / c[0] << ' ' << c[3] / c[0] << nl;
    }
}

void Foam::groupStatistics::writeState(Ostream& os) const
{
    writeNumbers(os, "sums", means_.state());
    writeNumbers(os, "reference", reference_);
    writeNumbers(os, "pairs", pairs_.state());
    forAll(quantities_, i)
    {
        writeNumbers(os, "of." + quantities_[i], distributions_[i].state());
    }
    DynamicList<scalar> numbers;
    for (const scalarList& c : concentration_)
    {
        numbers.append(c);
    }
    writeNumbers(os, "concentration", numbers);
}

void Foam::groupStatistics::readState(const dictionary& dict)
{
    wordList needed({"sums", "reference"});
    for (const word& name : quantities_)
    {
        needed.append("of." + name);
    }
    for (const word& name : needed)
    {
        if (dict.found(name)) continue;
        Info << "Statistics begin anew: the state in " << dict.name()
             << " lacks " << name << nl;
        return;
    }
    means_.restore(dict.get<scalarList>("sums"));
    reference_ = dict.get<scalarList>("reference");
    pairs_.restore(dict.get<scalarList>("pairs"));
    forAll(quantities_, i)
    {
        distributions_[i].restore(dict.get<scalarList>("of." + quantities_[i]));
    }
    const scalarList numbers(dict.get<scalarList>("concentration"));
    concentration_.setSize(numbers.size() / 4);
    forAll(concentration_, n)
    {
        concentration_[n] = scalarList(SubList<scalar>(numbers, 4, 4 * n));
    }
}
