// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "interactionState.H"
#include "IStringStream.H"
#include "unitTest.H"

using namespace Foam;

namespace
{
const uniformGrid& grid()
{
    return uniformGrid::New(test::mesh());
}

struct group
{
    word name_;
    label n;
    const word& name() const { return name_; }
    label nBodies() const { return n; }
};

//- Groups of three, two and four bodies: numbers 0 to 2, 3 and 4, 5 to 8
bodyNumbers threeGroups()
{
    return bodyNumbers(std::vector<group>{{"a", 3}, {"b", 2}, {"c", 4}});
}

//- Collision and lubrication of fibres in a fluid of some viscosity, which makes the
//  default strength
struct scene
{
    effectTable effects;
    interactionModels models;

    explicit scene(const scalar mu)
        : effects(test::mesh().time()),
          models(dict(),
                 interactionScene{grid(),
                                  mu,
                                  0.01,
                                  0,
                                  0.3 * cmptMax(grid().h()),
                                  0.3 * cmptMax(grid().h()),
                                  {}},
                 effects)
    {
    }

    static dictionary dict()
    {
        IStringStream is("lubrication {} collision {}");
        return dictionary(is);
    }
};

dictionary dictOf(const string& text)
{
    IStringStream is(text);
    return dictionary(is);
}

//- Contacts in an order of their own
scalarList sorted(const scalarList& contacts)
{
    std::vector<std::vector<scalar>> all;
    for (label n = 0; n < contacts.size(); n += 6)
    {
        all.emplace_back(&contacts[n], &contacts[n] + 6);
    }
    std::sort(all.begin(), all.end());
    DynamicList<scalar> numbers;
    for (const auto& one : all)
    {
        for (const scalar x : one)
        {
            numbers.append(x);
        }
    }
    return scalarList(std::move(numbers));
}

//- Within a, of a and a wall, of a and b, of c
const scalarList contacts({0,    3,       2,    7,    1 / 3.0, 1e-17, 1, 2,
                           -1,   5,       -0.1, 3e20, 2,       0,     4, 1,
                           M_PI, 7 / 9.0, 5,    1,    8,       2,     1, 2});
} // namespace

// To the last digit
TEST(InteractionState, readsWhatItWrote)
{
    const bodyNumbers numbers(threeGroups());
    scene saved(2), restarted(1 / 3.0);
    saved.models.remember({contacts});
    const dictionary state(
        dictOf(interactionState::write(saved.models, numbers)));
    const scalarList before(restarted.models.forces()[0].defaults());
    interactionState::read(state, boolList(3, false), numbers, restarted.models,
                           restarted.effects);
    EXPECT_EQ(sorted(restarted.models.memory()[0]), sorted(contacts));
    EXPECT_NE(saved.models.forces()[0].defaults(), before);
    EXPECT_EQ(restarted.models.forces()[0].defaults(),
              saved.models.forces()[0].defaults());

    // Loads that have grown make a larger strength
    scene grown(4);
    const scalarList larger(grown.models.forces()[0].defaults());
    interactionState::read(state, boolList(3, false), numbers, grown.models,
                           grown.effects);
    EXPECT_EQ(grown.models.forces()[0].defaults(), larger);
}

// Contacts of a group that starts afresh, or of bodies and groups that are not there,
// are forgotten; strengths of a scene that has changed are not taken
TEST(InteractionState, forgetsWhatIsNotThere)
{
    const bodyNumbers numbers(threeGroups());
    scene saved(1 / 3.0);
    saved.models.remember({contacts});
    const dictionary state(
        dictOf(interactionState::write(saved.models, numbers)));
    {
        scene restarted(2);
        const scalarList before(restarted.models.forces()[0].defaults());
        interactionState::read(state, boolList({false, true, false}), numbers,
                               restarted.models, restarted.effects);
        EXPECT_EQ(restarted.models.memory()[0].size(), 3 * 6);
        EXPECT_EQ(restarted.models.forces()[0].defaults(), before);
    }
    {
        // Group c alone, with a body less
        scene restarted(2);
        const bodyNumbers fewer(std::vector<group>{{"c", 3}});
        interactionState::read(state, boolList(1, false), fewer,
                               restarted.models, restarted.effects);
        EXPECT_TRUE(restarted.models.memory()[0].empty());
    }
    {
        // Groups in another order: numbers follow the names
        scene restarted(2);
        const bodyNumbers turned(
            std::vector<group>{{"c", 4}, {"b", 2}, {"a", 3}});
        interactionState::read(state, boolList(3, false), turned,
                               restarted.models, restarted.effects);
        EXPECT_EQ(sorted(restarted.models.memory()[0]),
                  sorted({6, 3, 8, 7, 1 / 3.0, 1e-17,   7, 2, -1, 5, -0.1, 3e20,
                          5, 1, 8, 0, M_PI,    7 / 9.0, 0, 1, 3,  2, 1,    2}));
    }
}
