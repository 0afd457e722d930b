#include "breed/generation.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "breed/first_generation.h"
#include "breed/breed_fixture.h"
#include "derivation/encode.h"

namespace espalier {
namespace {

using test::BreedFixture;
using ::testing::HasSubstr;

std::vector<Member> first_screen(BreedFixture& on, const BreedSettings& settings = {}) {
  return first_generation(on.problem, settings, {}, 1).members;
}

void like(std::vector<Member>& members, std::size_t place, double rating) {
  members[place].rated = true;
  members[place].rating = rating;
}

TEST(FirstGeneration, IsViableDistinctAndTheSameForAnyNumberOfThreads) {
  for (const char* name : {"gentree.esp", "gentree-natural.esp", "plant.esp", "spaceship.esp"}) {
    BreedFixture one(name, 1), three(name, 3);
    const FirstGeneration first = first_generation(one.problem, {}, {}, 7);
    EXPECT_EQ(first.members, first_generation(three.problem, {}, {}, 7).members) << name;
    ASSERT_EQ(first.members.size(), 12u) << name << first.note;
    std::set<std::uint64_t> distinct;
    for (std::size_t i = 0; i < first.members.size(); ++i) {
      EXPECT_EQ(first.members[i].id, 7 + i);
      EXPECT_EQ(find_fault(one.graph(), first.members[i].derivation), "") << name;
      EXPECT_TRUE(one.appraise(first.members[i].derivation).viable) << name;
      distinct.insert(hash(first.members[i].derivation));
    }
    EXPECT_EQ(distinct.size(), 12u) << name;
  }
}

TEST(Generation, BothMethodsGiveTheSameBytesTwiceAndOthersForAnotherDraw) {
  for (const BreedMethod method : {BreedMethod::classic, BreedMethod::free}) {
    BreedFixture on("gentree.esp");
    BreedSettings settings;
    settings.method = method;
    std::vector<Member> parents = first_screen(on, settings);
    like(parents, 2, 1), like(parents, 5, 3), like(parents, 6, -1);
    const NextGeneration next = next_generation(on.problem, settings, parents, 1, 100);
    EXPECT_EQ(next.members, next_generation(on.problem, settings, parents, 1, 100).members);
    ASSERT_EQ(next.members.size(), settings.population);
    on.problem.draw = 1;
    EXPECT_NE(next.members, next_generation(on.problem, settings, parents, 1, 100).members);
  }
}

}  // namespace
}  // namespace espalier
