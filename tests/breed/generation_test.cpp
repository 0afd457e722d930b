#include "breed/generation.h"

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "breed/breed_fixture.h"
#include "breed/first_generation.h"
#include "derivation/encode.h"

namespace espalier {
namespace {

using test::BreedFixture;
using ::testing::HasSubstr;

std::vector<Member> first_screen(BreedFixture& on, const BreedSettings& settings = {}) {
  return first_generation(on.problem, settings, {}, 1).members;
}

void rate(Member& member, double rating) {
  member.rated = true;
  member.rating = rating;
}

BreedSettings classic() {
  BreedSettings settings;
  settings.method = BreedMethod::classic;
  settings.population = 20;
  return settings;
}

TEST(Generation, BothMethodsGiveTheSameBytesTwiceAndOthersForAnotherDraw) {
  for (const BreedSettings& settings : {classic(), BreedSettings()}) {
    BreedFixture on("gentree.esp"), threads("gentree.esp", 3);
    std::vector<Member> parents = first_screen(on, settings);
    rate(parents[2], 1), rate(parents[5], 3), rate(parents[6], -1);
    const NextGeneration next = next_generation(on.problem, settings, parents, 1, 100);
    EXPECT_EQ(next.members, next_generation(threads.problem, settings, parents, 1, 100).members);
    ASSERT_EQ(next.members.size(), settings.population);
    for (std::size_t i = 0; i < next.members.size(); ++i) EXPECT_EQ(next.members[i].id, 100 + i);
    on.problem.draw = 1;
    EXPECT_NE(next.members, next_generation(on.problem, settings, parents, 1, 100).members);
    on.problem.draw = 0;
    EXPECT_NE(next.members, next_generation(on.problem, settings, parents, 2, 100).members);
  }
}

TEST(Generation, CopiesKeepTheirRatingAndNothingElseIsRated) {
  for (const BreedSettings& settings : {classic(), BreedSettings()}) {
    BreedFixture on("gentree.esp");
    std::vector<Member> parents = first_screen(on, settings);
    for (std::size_t i = 0; i < parents.size(); ++i) rate(parents[i], static_cast<double>(i % 5));
    const NextGeneration next = next_generation(on.problem, settings, parents, 1, 100);
    std::size_t copies = 0;
    for (const Member& member : next.members) {
      EXPECT_EQ(member.rated, member.origin == Origin::kept);
      if (member.origin != Origin::kept) continue;
      ++copies;
      ASSERT_EQ(member.parents.size(), 1u);
      const Member& parent = parents[member.parents[0] - 1];
      EXPECT_EQ(member.derivation, parent.derivation);
      EXPECT_EQ(member.rating, parent.rating);
    }
    EXPECT_GE(copies, settings.method == BreedMethod::free ? settings.keep : 1u);
  }
}

TEST(Generation, TheBestIsNeverLost) {
  for (const BreedSettings& settings : {classic(), BreedSettings()}) {
    BreedFixture on("gentree.esp");
    std::vector<Member> members = first_screen(on, settings);
    const Derivation best = members[3].derivation;
    rate(members[3], 9);
    for (std::uint32_t number = 1; number <= 10; ++number) {
      for (Member& member : members) {
        if (!member.rated) rate(member, number % 3);
      }
      members = next_generation(on.problem, settings, members, number, 100 * number).members;
      EXPECT_TRUE(std::any_of(members.begin(), members.end(), [&](const Member& m) { return m.derivation == best; }));
    }
  }
}

TEST(Generation, ChildrenComeFromThoseWhoAreLiked) {
  BreedFixture on("spaceship.esp");
  std::vector<Member> parents = first_screen(on);
  rate(parents[1], 2), rate(parents[4], 1), rate(parents[7], -2);
  const NextGeneration next = next_generation(on.problem, {}, parents, 1, 100);
  for (const Member& member : next.members) {
    for (const MemberId parent : member.parents) EXPECT_TRUE(parent == 2 || parent == 5) << parent;
    EXPECT_EQ(find_fault(on.graph(), member.derivation), "");
    EXPECT_TRUE(member.origin == Origin::kept || on.appraise(member.derivation).viable);
  }
}

TEST(Generation, DislikedOnesHaveNoChildrenWhereNobodyIsLiked) {
  BreedFixture on("gentree.esp");
  std::vector<Member> parents = first_screen(on);
  for (std::size_t i = 0; i < 6; ++i) rate(parents[i], -1);
  std::set<MemberId> seen;
  for (std::uint32_t number = 1; number < 8; ++number) {
    for (const Member& member : next_generation(on.problem, {}, parents, number, 100).members) {
      seen.insert(member.parents.begin(), member.parents.end());
      EXPECT_NE(member.origin, Origin::kept);
    }
  }
  EXPECT_THAT(seen, ::testing::ElementsAre(7, 8, 9, 10, 11, 12));
}

TEST(Generation, WithoutRatingsEverybodyHasChildrenAlike) {
  BreedFixture on("gentree.esp");
  BreedSettings settings = classic();
  settings.use_ratings = false;
  settings.genesis.elitism = false;
  std::vector<Member> parents = first_screen(on, settings);
  rate(parents[0], 100);
  std::set<MemberId> seen;
  for (const Member& member : next_generation(on.problem, settings, parents, 1, 100).members) seen.insert(member.parents[0]);
  EXPECT_GE(seen.size(), 19u) << "each is selected once; a child that was not viable may have been replaced by its parent";
}

TEST(Generation, AClassicChildThatIsAParentToTheBitIsACopyOfIt) {
  BreedFixture on("gentree.esp");
  BreedSettings settings = classic();
  settings.genesis.crossover = 1;
  settings.genesis.mutation = 0;
  std::vector<Member> parents = first_screen(on, settings);
  parents.resize(2);
  parents[1].derivation = parents[0].derivation;
  parents[1].derivation.draws[4] ^= 0x80000000;  // all that they differ in
  rate(parents[0], 1), rate(parents[1], 2);
  int crossed = 0;
  for (std::uint32_t number = 1; number < 20; ++number) {
    for (const Member& member : next_generation(on.problem, settings, parents, number, 100).members) {
      const Member& of = parents[member.derivation == parents[0].derivation ? 0 : 1];
      if (member.derivation != of.derivation) {
        ++crossed;  // the points lie within the gene
        continue;
      }
      EXPECT_EQ(member.origin, Origin::kept);
      EXPECT_EQ(member.parents, std::vector<MemberId>{of.id});
      EXPECT_EQ(member.rating, of.rating);
    }
  }
  EXPECT_LT(crossed, 100);
}

TEST(Generation, TheScalingWindowRemembersTheGenerationsBefore) {
  BreedFixture on("gentree.esp");
  BreedSettings settings = classic();
  settings.genesis.crossover = settings.genesis.mutation = 0;
  settings.genesis.elitism = false;
  std::vector<Member> parents = first_screen(on, settings);
  for (std::size_t i = 0; i < parents.size(); ++i) rate(parents[i], i < 10 ? 1 : 2);
  const auto of_the_worse = [&](std::uint32_t window, const std::vector<double>& before) {
    settings.genesis.window = window;
    std::size_t count = 0;
    for (const Member& member : next_generation(on.problem, settings, parents, 1, 100, before).members) {
      count += member.rating == 1;
    }
    return count;
  };
  EXPECT_EQ(of_the_worse(5, {}), 0u) << "they are the worst, and that is 0";
  EXPECT_EQ(of_the_worse(0, {-100}), 0u);
  EXPECT_EQ(of_the_worse(1, {1, -100}), 0u) << "beyond the window";
  EXPECT_NEAR(static_cast<double>(of_the_worse(2, {1, -100})), 10, 1) << "both are far above it";
  EXPECT_NEAR(static_cast<double>(of_the_worse(1, {0})), 20.0 / 3, 1);
}

TEST(Generation, ClassicWantsAGenomeOfStartDraws) {
  BreedFixture on("spaceship.esp");
  const std::vector<Member> parents = first_screen(on);
  try {
    next_generation(on.problem, classic(), parents, 1, 100);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("has the slot"));
  }
}

TEST(Generation, HeldDrawsStayInEveryChild) {
  for (const BreedSettings& settings : {classic(), BreedSettings()}) {
    BreedFixture on("gentree.esp");
    on.problem.held.draws = {{{}, 0}, {{}, 7}};
    std::vector<Member> parents = first_screen(on, settings);
    rate(parents[0], 2), rate(parents[1], 1);
    std::map<MemberId, const Member*> by_id;
    for (const Member& parent : parents) by_id[parent.id] = &parent;
    for (const Member& member : next_generation(on.problem, settings, parents, 1, 100).members) {
      const Derivation& first = by_id.at(member.parents.at(0))->derivation;
      EXPECT_EQ(member.derivation.draws[0], first.draws[0]);
      EXPECT_EQ(member.derivation.draws[7], first.draws[7]);
    }
  }
}

TEST(Generation, HandEditsAreInheritedWhole) {
  BreedFixture on("gentree.esp");
  const BreedSettings settings = classic();
  std::vector<Member> parents = first_screen(on, settings);
  const std::uint32_t by_hand = 0x12345678;  // between the numbers of an 8-bit gene
  for (Member& parent : parents) parent.derivation.draws[8] = by_hand;
  for (const Member& member : next_generation(on.problem, settings, parents, 1, 100).members) {
    EXPECT_EQ(member.derivation.draws[8], by_hand);
  }
}

TEST(Generation, TellsWhereNothingIsViable) {
  BreedFixture on("gentree.esp");
  std::vector<Member> parents = first_screen(on);
  BreedFixture strict("gentree.esp", 1, [](ModelAppraiser::Settings& s) { s.viability.limits[Measure::triangles].max = 1; });
  const NextGeneration next = next_generation(strict.problem, {}, parents, 1, 100);
  EXPECT_EQ(next.members.size(), 12u);
  EXPECT_EQ(next.refused, next.tried);
  EXPECT_LE(next.tried, 12 * kMostTries);
  EXPECT_THAT(next.note, HasSubstr("12 places have copies of parents"));
  const FirstGeneration first = first_generation(strict.problem, {}, {}, 1);
  EXPECT_TRUE(first.members.empty());
  EXPECT_THAT(first.note, HasSubstr("only 0 different viable models were found among 480 drawn"));
}

TEST(Generation, RefusesBadSettingsAndNoParents) {
  BreedFixture on("gentree.esp");
  const auto error_of = [&](const BreedSettings& settings, const std::vector<Member>& parents) -> std::string {
    try {
      next_generation(on.problem, settings, parents, 1, 100);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(error_of({}, {}), HasSubstr("a generation needs parents"));
  BreedSettings few;
  few.population = 8;
  EXPECT_THAT(error_of(few, first_screen(on)), HasSubstr("population must be between 9 and 20, got 8"));
  BreedSettings strong;
  strong.strength = 1.1;
  EXPECT_THAT(error_of(strong, first_screen(on)), HasSubstr("strength must be between 0 and 1, got 1.1"));
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

TEST(FirstGeneration, FoundersComeFirst) {
  BreedFixture on("gentree.esp");
  const std::vector<Member> some = first_screen(on);
  const FirstGeneration first = first_generation(on.problem, {}, {some[4].derivation, some[2].derivation}, 1);
  ASSERT_EQ(first.members.size(), 12u);
  EXPECT_EQ(first.members[0].derivation, some[4].derivation);
  EXPECT_EQ(first.members[1].derivation, some[2].derivation);
}

TEST(FarthestPoints, SpreadMoreThanThoseThatComeFirst) {
  RandomStream random({1, Purpose::test, 0, 0, 0});
  std::vector<std::vector<double>> points(60);
  for (auto& point : points) point = {random.next_unit(), 100 * random.next_unit(), 7};
  const auto least = [&](const std::vector<std::size_t>& which) {
    double least_distance = 1e9;
    for (const std::size_t a : which) {
      for (const std::size_t b : which) {
        const std::vector<double> x = {points[a][0], points[a][1] / 100}, y = {points[b][0], points[b][1] / 100};
        if (a != b) least_distance = std::min(least_distance, feature_distance(x, y));
      }
    }
    return least_distance;
  };
  std::vector<std::size_t> first(9);
  for (std::size_t i = 0; i < 9; ++i) first[i] = i;
  EXPECT_GT(least(farthest_points(points, 9)), 1.5 * least(first));
  EXPECT_EQ(farthest_points(points, 100).size(), 60u);
  EXPECT_TRUE(farthest_points({}, 3).empty());
}

}  // namespace
}  // namespace espalier
