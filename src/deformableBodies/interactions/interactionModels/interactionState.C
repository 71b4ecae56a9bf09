// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "interactionState.H"
#include "Pair.H"
#include <iomanip>
#include <map>
#include <sstream>

namespace
{
using namespace Foam;

//- In place of a group's name; no group may have a colon in its name
const word wall("wall:");
} // namespace

void Foam::interactionState::writePoint(std::ostream& os, const scalar* x,
                                        const bodyNumbers& numbers)
{
    const label number = label(x[0]), point = label(x[1]);
    if (number < 0)
    {
        os << wall << " 0 " << point << ' ';
        return;
    }
    os << numbers.name(numbers.group(number)) << ' ' << numbers.body(number)
       << ' ' << point << ' ';
}

Foam::string Foam::interactionState::write(const interactionModels& models,
                                           const bodyNumbers& numbers)
{
    std::ostringstream os;
    os << std::setprecision(17) << "    strengths\n    {\n";
    for (const contactForce& force : models.forces())
    {
        const scalarList defaults(force.defaults());
        if (defaults.empty()) continue;
        os << "        " << force.type() << " (";
        for (const scalar x : defaults)
        {
            os << ' ' << x;
        }
        os << " );\n";
    }
    os << "    }\n";
    for (const contactResistance& resistance : models.resistances())
    {
        List<scalarList> ofRanks(Pstream::nProcs());
        ofRanks[Pstream::myProcNo()] = resistance.memory();
        Pstream::gatherList(ofRanks);

        // Several ranks may remember one contact
        std::map<std::vector<scalar>, Pair<scalar>> sorted;
        for (const scalarList& all : ofRanks)
        {
            for (label n = 0; n < all.size(); n += 6)
            {
                const scalar* x = &all[n];
                sorted.insert(
                    {std::vector<scalar>(x, x + 4), Pair<scalar>(x[4], x[5])});
            }
        }
        os << "    " << resistance.type() << "\n    (\n";
        for (const auto& contact : sorted)
        {
            os << "        ";
            writePoint(os, contact.first.data(), numbers);
            writePoint(os, contact.first.data() + 2, numbers);
            os << contact.second.first() << ' ' << contact.second.second()
               << '\n';
        }
        os << "    );\n";
    }
    return os.str();
}

void Foam::interactionState::readStrengths(const dictionary& strengths,
                                           interactionModels& models,
                                           effectTable& effects)
{
    for (contactForce& force : models.forces())
    {
        if (!strengths.found(force.type())) continue;
        const scalarList defaults(strengths.get<scalarList>(force.type()));
        if (!force.raiseDefaults(defaults)) continue;
        effects.declare(force.type(), true,
                        "as at the start of the run, strength " +
                            Foam::name(defaults[0]));
    }
}

Foam::scalarList Foam::interactionState::readMemory(Istream& is,
                                                    const boolList& initial,
                                                    const bodyNumbers& numbers)
{
    DynamicList<scalar> all;

    // Append body and point of one side; false if there is no such body
    const auto readPoint = [&]()
    {
        const word name(is);
        const label body = readLabel(is), point = readLabel(is);
        const label g = numbers.find(name);
        const bool known = g >= 0 && !initial[g] && body < numbers.nBodies(g);
        all.append(known ? numbers.number(g, body) : -1);
        all.append(point);
        return known || name == wall;
    };
    is.readBegin("list");
    for (token t(is); t.isWord(); is.read(t))
    {
        is.putBack(t);
        const label before = all.size();
        const bool first = readPoint(), second = readPoint();
        const scalar force = readScalar(is);
        all.append(force);
        all.append(readScalar(is));
        if (!first || !second) all.resize(before);
    }
    return scalarList(std::move(all));
}

void Foam::interactionState::read(const dictionary& saved,
                                  const boolList& initial,
                                  const bodyNumbers& numbers,
                                  interactionModels& models,
                                  effectTable& effects)
{
    // A flow that has developed would make other defaults
    if (!initial.found(true))
    {
        readStrengths(saved.subOrEmptyDict("strengths"), models, effects);
    }
    const PtrList<contactResistance>& resistances = models.resistances();
    List<scalarList> memories(resistances.size());
    forAll(resistances, m)
    {
        const word& name = resistances[m].type();
        if (!saved.found(name)) continue;
        memories[m] = readMemory(saved.lookup(name), initial, numbers);
    }
    models.remember(memories);
}
