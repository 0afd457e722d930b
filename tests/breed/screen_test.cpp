#include "breed/screen.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "breed/breed_fixture.h"
#include "breed/first_generation.h"
#include "breed/simulated_user.h"
#include "derivation/encode.h"

namespace espalier {
namespace {

using test::BreedFixture;

/// Ratings by the height of a tree.
struct Rated {
  std::vector<Member> members;
  std::vector<Opinion> opinions;
};

Rated rated_by_height(BreedFixture& on) {
  Rated rated{first_generation(on.problem, {}, {}, 1).members, {}};
  for (Member& member : rated.members) {
    const Appraisal appraisal = on.appraise(member.derivation);
    member.rated = true;
    member.rating = appraisal.measures[Measure::height] - 4;
    rated.opinions.push_back({appraisal.features, member.rating});
  }
  return rated;
}

TEST(Screen, ShowsTheBestOneDifferentAndOneUncertain) {
  BreedFixture on("gentree-natural.esp", 2);
  const Rated rated = rated_by_height(on);
  const Taste taste(rated.opinions, {}, {});
  const ScreenSettings few = {.pool = 100};
  const Screen screen = next_screen(on.problem, {}, few, rated.members, taste, 1, 50);
  const std::vector<Member>& members = screen.generation.members;
  ASSERT_EQ(members.size(), 12u);
  ASSERT_EQ(screen.shown_as.size(), 12u);
  EXPECT_EQ(std::count(screen.shown_as.begin(), screen.shown_as.end(), ShownAs::different), 1);
  EXPECT_EQ(std::count(screen.shown_as.begin(), screen.shown_as.end(), ShownAs::uncertain), 1);
  std::set<std::uint64_t> distinct;
  double before = 0, after = 0, shown = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    EXPECT_EQ(members[i].id, 50 + i);
    EXPECT_EQ(find_fault(on.graph(), members[i].derivation), "");
    EXPECT_EQ(screen.shown_as[i] == ShownAs::kept, members[i].origin == Origin::kept);
    EXPECT_LE(members[i].parents.size(), Member::kMostParents);
    distinct.insert(hash(members[i].derivation));
    before += rated.members[i].rating / 12;
    if (screen.shown_as[i] != ShownAs::best) continue;
    after += on.appraise(members[i].derivation).measures[Measure::height] - 4;
    ++shown;
  }
  EXPECT_EQ(distinct.size(), 12u);
  EXPECT_GT(after / shown, before + 0.5) << "trees grow taller where tall ones are liked";
  EXPECT_EQ(next_screen(on.problem, {}, few, rated.members, taste, 1, 50).generation.members, members);
}

TEST(Screen, DiversityIsOfAPopulationBesideARandomOne) {
  const std::vector<std::vector<double>> wide = {{0, 0}, {1, 0}, {0, 1}, {1, 1}}, narrow = {{0, 0}, {0.1, 0}, {0, 0.1}};
  EXPECT_EQ(diversity(wide, wide), 1);
  EXPECT_LT(diversity(narrow, wide), 0.2);
  EXPECT_EQ(diversity({{1, 1}, {1, 1}}, wide), 0);
  EXPECT_EQ(diversity({{1, 1}}, wide), 1);
}

TEST(Screen, RefusesBadSettings) { EXPECT_THROW(validate(ScreenSettings{.pool = 99}), Error); }

TEST(SimulatedUser, RatesByDistanceAndNoiseIsFairOnAverage) {
  BreedFixture on("gentree.esp");
  const std::vector<Member> trees = first_generation(on.problem, {}, {}, 1).members;
  SimulatedUser sure(on.graph(), trees[0].derivation, 0, 1);
  EXPECT_EQ(sure.distance(trees[0].derivation), 0);
  EXPECT_EQ(sure.rate(trees[0].derivation), std::round(SimulatedUser::kUsual / SimulatedUser::kStep));
  SimulatedUser wavering(on.graph(), trees[0].derivation, 0.03, 1);
  double sum = 0;
  for (int i = 0; i < 4000; ++i) sum += wavering.rate(trees[1].derivation);
  const double expected = (SimulatedUser::kUsual - sure.distance(trees[1].derivation)) / SimulatedUser::kStep;
  EXPECT_NEAR(sum / 4000, expected, 4 * 1.28 * 0.03 / SimulatedUser::kStep / std::sqrt(4000));
}

TEST(GeneDistance, OfTwoRandomTreesIsAThird) {
  BreedFixture on("gentree.esp");
  BreedSettings many;
  many.population = 20;
  double sum = 0, pairs = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    RandomStream random({seed, Purpose::test, 0, 0, 0});
    Derivation a = first_generation(on.problem, {}, {}, 1).members[0].derivation, b = a;
    for (int i = 0; i < 400; ++i) {
      for (std::size_t k = 0; k < 13; ++k) a.draws[k] = random.next_u32(), b.draws[k] = random.next_u32();
      sum += gene_distance(on.graph(), a, b), ++pairs;
    }
  }
  EXPECT_NEAR(sum / pairs, (11. / 3 + 2 * 21. / 64) / 13, 0.01);  // of 8 values (n^2 - 1) / (3 n^2)
}

}  // namespace
}  // namespace espalier
