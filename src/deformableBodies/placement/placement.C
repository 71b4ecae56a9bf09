// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "placement.H"
#include "dictionaryChecks.H"
#include "unitConversion.H"

namespace
{
using namespace Foam;

//- Entry orientation
struct orientation
{
    enum kindType
    {
        RANDOM,
        ALIGNED,
        NORMAL
    };
    kindType kind = RANDOM;
    vector mean = vector(1, 0, 0);
    scalar deviation = 0;

    explicit orientation(const dictionary& dict)
    {
        if (!dict.found("orientation")) return;
        const auto refuseIt = [&]()
        {
            refuse(
                dict, "orientation", valueOf(*dict.findEntry("orientation")),
                "random, aligned (1 0 0), normal (1 0 0) 10: a direction and "
                "a standard deviation up to 45 degrees");
        };
        const tokenList& given = dict.lookup("orientation");
        const Enum<kindType> kinds(
            {{RANDOM, "random"}, {ALIGNED, "aligned"}, {NORMAL, "normal"}});
        const label size[3] = {1, 6, 7};
        if (given.empty() || !given[0].isWord() ||
            !kinds.found(given[0].wordToken()))
        {
            refuseIt();
        }
        kind = kinds[given[0].wordToken()];
        if (given.size() != size[kind]) refuseIt();
        if (kind == RANDOM) return;
        for (direction d = 0; d < 3; ++d)
        {
            if (!given[2 + d].isNumber()) refuseIt();
            mean[d] = given[2 + d].number();
        }
        if (!(mag(mean) > 0)) refuseIt();
        mean /= mag(mean);
        if (kind == ALIGNED) return;
        if (!given[6].isNumber() || !(given[6].number() > 0) ||
            given[6].number() > 45)
        {
            refuseIt();
        }
        deviation = degToRad(given[6].number());
    }

    vector draw(Random& random) const
    {
        if (kind == ALIGNED) return mean;
        vector away;
        for (direction d = 0; d < 3; ++d)
        {
            away[d] = random.GaussNormal<scalar>();
        }
        if (kind == RANDOM) return away / mag(away);
        away -= (away & mean) * mean;
        const scalar angle = deviation * mag(away);
        return std::cos(angle) * mean + std::sin(angle) * away / mag(away);
    }
};

//- FatalIOError naming the entry placement
void refusePlacement(const dictionary& group, const string& allowed)
{
    refuse(group, "placement", valueOf(*group.findEntry("placement")), allowed);
}

//- Entry placement; FatalIOError if its entries do not go together
const dictionary& readPlacement(const dictionary& group)
{
    const dictionary& dict =
        readDict(group, "placement", "type random; number 200;");
    checkEntries(dict, {"type", "number", "volumeFraction", "nL3", "seed",
                        "minimumGap", "orientation"});
    for (const word entry : {"positions", "directions"})
    {
        if (group.found(entry))
        {
            refuse(
                group, entry, valueOf(*group.findEntry(entry)),
                "either that or placement {...}, which says where the bodies "
                "are");
        }
    }
    requireEntry(dict, "type");
    const word type(dict.get<word>("type"));
    if (type != "random") refuse(dict, "type", type, "(random)");
    if (label(dict.found("number")) + dict.found("volumeFraction") +
            dict.found("nL3") !=
        1)
    {
        refusePlacement(group,
                        "a number of bodies, a volumeFraction, or nL3 of "
                        "filaments: one of them");
    }
    return dict;
}

//- Number of bodies of that volume [m^3] and form from the entries number, volumeFraction
//  or nL3. At most one body to each cell, so that no units give an endless number
label numberOf(const dictionary& dict, const scalar volume,
               const solidForm& form, const uniformGrid& grid)
{
    const scalar box = cmptProduct(grid.length());
    const scalar most = min(box / volume, box / grid.cellVolume());
    if (dict.found("number"))
    {
        const label number = dict.get<label>("number");
        if (number < 1 || number > most)
        {
            refuse(dict, "number", Foam::name(number),
                   "1 to " + Foam::name(label(most)) +
                       ", which are as large as the box, or one to each cell");
        }
        return number;
    }
    if (dict.found("nL3") && !form.isRod())
    {
        refuse(dict, "nL3", valueOf(*dict.findEntry("nL3")),
               "volumeFraction or number: nL3 is for filaments");
    }
    const word entry(dict.found("nL3") ? "nL3" : "volumeFraction");
    const scalar given = readPositive(dict, entry, dimless);
    if (entry == "volumeFraction" && given >= 1)
    {
        refuse(dict, entry, Foam::name(given), "below 1");
    }
    const scalar n =
        given * box / (entry == "nL3" ? pow3(2 * form.halfLength) : volume);
    if (n < 0.5 || n > most)
    {
        refuse(dict, entry,
               Foam::name(given) + ", which are " + Foam::name(n) + " bodies",
               "one body to " + Foam::name(most) + ", one to each cell");
    }
    return label(n + 0.5);
}

//- Entry minimumGap: distance between the solids [m], by default half a cell
scalar readGap(const dictionary& dict, const uniformGrid& grid)
{
    if (!dict.found("minimumGap")) return 0.5 * cmptMin(grid.h());
    const scalar gap = readNumber(dict, "minimumGap", dimLength);
    if (!(gap >= 0))
    {
        refuse(dict, "minimumGap", Foam::name(gap), "0 and greater");
    }
    return gap;
}

//- FatalIOError: bodies of that volume fraction were placed at a fraction size of their
//  size only, or not at all (0)
void refuseCrowd(const dictionary& dict, const scalar fraction,
                 const scalar gap, const scalar size)
{
    const word entry(dict.found("number") ? "number"
                     : dict.found("nL3")  ? "nL3"
                                          : "volumeFraction");
    refuse(dict, entry, valueOf(*dict.findEntry(entry)),
           size == 0
               ? string("as much as there is room for: not even bodies of a "
                        "fifth of the size were placed")
               : "as much as there is room for: all bodies were placed at " +
                     Foam::name(size) +
                     " of their size, a volume fraction of " +
                     Foam::name(pow3(size) * fraction) + " instead of " +
                     Foam::name(fraction) +
                     (gap > 0 ? ". A minimumGap below " + Foam::name(gap) +
                                    " leaves more"
                              : ""));
}
} // namespace

Foam::placement::placement(const dictionary& group, const word& name,
                           const solidForm& form, const scalar volume,
                           const uniformGrid& grid, packing& all)
{
    const dictionary& dict = readPlacement(group);
    if (2 * form.circumradius() > cmptMax(grid.length()))
    {
        refusePlacement(group, "bodies shorter than the box: these are " +
                                   Foam::name(2 * form.circumradius()) +
                                   " long");
    }
    const label number = numberOf(dict, volume, form, grid);
    const scalar fraction = number * volume / cmptProduct(grid.length());
    const scalar gap = readGap(dict, grid);
    const orientation orient(dict);
    Random random(dict.getOrDefault<label>("seed", 1));
    const scalar size = all.fill(
        number, form, gap, orient.kind == orientation::RANDOM,
        [&]() { return orient.draw(random); }, random, name);
    if (size < 1) refuseCrowd(dict, fraction, gap, size);

    centres_.setSize(number);
    directions_.setSize(number);
    for (label i = 0; i < number; ++i)
    {
        const solid& a = all.solids()[all.solids().size() - number + i];
        centres_[i] = a.centre;
        directions_[i] = a.direction;
    }
    // Processors of other ranks may round otherwise
    Pstream::scatter(centres_);
    Pstream::scatter(directions_);
    Info << "Placed " << number << " bodies of group " << name
         << " at random, volume fraction " << Foam::name(fraction) << endl;
}
