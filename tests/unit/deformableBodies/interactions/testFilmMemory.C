// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "filmMemory.H"
#include "unitTest.H"
#include <map>

using namespace Foam;

TEST(FilmMemory, lowerBodyFirst)
{
    typedef filmMemory::key key;
    EXPECT_EQ(filmMemory::lowerFirst(key{{2, 5, 1, 7}}), (key{{1, 7, 2, 5}}));
    EXPECT_EQ(filmMemory::lowerFirst(key{{1, 7, 2, 5}}), (key{{1, 7, 2, 5}}));

    // A wall stays second
    EXPECT_EQ(filmMemory::lowerFirst(key{{2, 5, -1, 3}}), (key{{2, 5, -1, 3}}));
}

// Thousands of contacts, some of them given twice and either way round
TEST(FilmMemory, findsWhatWasSet)
{
    Random random(5);
    std::map<filmMemory::key, std::pair<scalar, scalar>> all;
    DynamicList<scalar> numbers;
    const auto draw = [&](const label n)
    { return label(n * random.sample01<scalar>()); };
    for (label i = 0; i < 5000; ++i)
    {
        const bool wall = i % 7 == 0;
        const filmMemory::key key{
            {draw(40), draw(30), wall ? -1 : 40 + draw(40), draw(6)}};
        if (all.count(key)) continue;
        const scalar F = random.sample01<scalar>() - 0.5, k = i + 1;
        all[key] = {F, k};
        filmMemory::append({key, F, k}, numbers);
        if (i % 3) continue;
        filmMemory::append(
            {wall ? key : filmMemory::key{{key[2], key[3], key[0], key[1]}}, F,
             k},
            numbers);
    }
    filmMemory memory;
    EXPECT_EQ(memory.find(filmMemory::key{{0, 0, 1, 0}}), nullptr);
    memory.set(numbers);
    for (const auto& one : all)
    {
        const filmMemory::contact* found = memory.find(one.first);
        ASSERT_NE(found, nullptr);
        EXPECT_EQ(found->force, one.second.first);
        EXPECT_EQ(found->k, one.second.second);
    }
    EXPECT_EQ(memory.find(filmMemory::key{{0, 0, 100, 0}}), nullptr);

    // Each contact once, and the same again from these numbers
    const scalarList contacts(memory.contacts());
    EXPECT_EQ(contacts.size(), label(6 * all.size()));
    filmMemory again;
    again.set(contacts);
    EXPECT_EQ(again.contacts().size(), contacts.size());
    for (const auto& one : all)
    {
        EXPECT_EQ(again.find(one.first)->force, one.second.first);
    }

    // Set forgets what was there before
    memory.set(scalarList());
    EXPECT_EQ(memory.find(all.begin()->first), nullptr);
    EXPECT_TRUE(memory.contacts().empty());
}
