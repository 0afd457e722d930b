#include "breed/species.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/random.h"
#include "breed/breed_fixture.h"
#include "breed/newcomer.h"
#include "derivation/encode.h"

namespace espalier {
namespace {

using test::BreedFixture;
using ::testing::HasSubstr;

Derivation some_tree(BreedFixture& on) {
  for (std::uint32_t i = 0;; ++i) {
    RandomStream random({8, Purpose::test, 0, i, 0});
    const Derivation tree = draw_newcomer(on.graph(), random);
    const Appraisal appraisal = on.appraise(tree);
    if (appraisal.viable && appraisal.measures[Measure::triangles] > 500) return tree;
  }
}

TEST(Species, SiblingsAreViableDistinctWithinLimitsAndNearTheirFavourite) {
  const auto limit = [](ModelAppraiser::Settings& s) { s.viability.limits[Measure::triangles].max = 20'000; };
  BreedFixture on("gentree-natural.esp", 2, limit);
  const Derivation favourite = some_tree(on);
  SpeciesSettings settings;
  settings.count = 30;
  const Species species = find_species(on.problem, favourite, settings);
  ASSERT_EQ(species.siblings.size(), 30u) << summary(species, settings);
  EXPECT_GE(species.nearest, settings.least_distance);
  const std::vector<double> home = on.appraise(favourite).features;
  double away = 0, apart = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_EQ(find_fault(on.graph(), species.siblings[i]), "");
    EXPECT_LE(species.appraisals[i].measures[Measure::triangles], 20'000);
    away += feature_distance(home, species.appraisals[i].features);
    RandomStream random({9, Purpose::test, 0, static_cast<std::uint32_t>(i), 0});
    apart += feature_distance(home, on.appraise(draw_newcomer(on.graph(), random)).features);
  }
  EXPECT_LT(away, 0.6 * apart) << "nearer than trees of the grammar at large";
  // More of them begin with the same.
  settings.count = 40;
  const Species more = find_species(on.problem, favourite, settings);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(more.siblings[i], species.siblings[i]);
}

TEST(Species, SaysWhyThereAreNotMore) {
  BreedFixture on("gentree.esp", 1, [](ModelAppraiser::Settings& s) { s.viability.limits[Measure::triangles].max = 3; });
  SpeciesSettings settings;
  settings.count = 3;
  const Species species = find_species(on.problem, std::nullopt, settings);
  EXPECT_TRUE(species.siblings.empty());
  EXPECT_EQ(species.tried, 3 * SpeciesSettings::kTriesPerSibling);
  EXPECT_THAT(summary(species, settings), HasSubstr("0 of 3 found among 180 candidates; refused: "));
  EXPECT_THAT(summary(species, settings), HasSubstr("triangles are above max ("));
}

TEST(Species, RefusesBadSettings) {
  EXPECT_THROW(validate(SpeciesSettings{.count = 0}), Error);
  EXPECT_THROW(validate(SpeciesSettings{.strength = 2}), Error);
}

}  // namespace
}  // namespace espalier
