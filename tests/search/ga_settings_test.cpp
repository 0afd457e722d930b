#include "search/ga_settings.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace espalier {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string rejection(const std::function<void(GaSettings&)>& spoil) {
  GaSettings settings;
  spoil(settings);
  try {
    validate(settings);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GaSettings, EveryPresetIsValid) {
  EXPECT_EQ(ga_presets().size(), 6u);
  for (const GaPreset& preset : ga_presets()) EXPECT_NO_THROW(validate(ga_preset(preset.name))) << preset.name;
}

TEST(GaSettings, DefaultsAreThePresetOf2017) { EXPECT_EQ(ga_preset("ga-2017"), GaSettings{}); }

TEST(GaSettings, PresetOf2017HasThePrintedRates) {
  const GaSettings s = ga_preset("ga-2017");
  EXPECT_NEAR(s.mutation * s.grow, 0.135, 1e-12);
  EXPECT_NEAR(s.mutation * s.cut, 0.135, 1e-12);
  EXPECT_NEAR(s.mutation * s.alter, 0.03, 1e-12);
  EXPECT_EQ(s.elitism * 5, s.population);
  EXPECT_EQ(s.tournament_size, 10u);
  EXPECT_EQ(s.crossover, Compatibility::edge);
}

TEST(GaSettings, CityPresetKeepsThePrintedRatios) {
  const GaSettings s = ga_preset("ga-2017-city");
  EXPECT_EQ(s.mutation, 0.4);
  EXPECT_NEAR(s.grow / s.cut, 1.25, 1e-12);
  EXPECT_NEAR(s.alter / s.cut, 1.8, 1e-12);
  EXPECT_NEAR(s.grow + s.cut + s.alter, 1, 1e-12);
}

TEST(GaSettings, PresetsOf2016DifferInThreeNumbers) {
  GaSettings s = ga_preset("ga-2016");
  EXPECT_EQ(s.population, 50u);
  EXPECT_EQ(s.elitism, 1u);
  EXPECT_EQ(s.initial_length_max, 10u);
  EXPECT_EQ(s.first, SelectionScheme::roulette);
  EXPECT_EQ(s.second, SelectionScheme::tournament);
  EXPECT_EQ(s.crossover, Compatibility::symbol);
  s.population = 200, s.elitism = 30, s.initial_length_min = s.initial_length_max = 20;
  EXPECT_EQ(ga_preset("ga-2016-final"), s);
}

TEST(GaSettings, UnknownPresetListsTheKnownOnes) {
  try {
    ga_preset("ga-2018");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("ga-2017-city"), HasSubstr("\"ga-2018\"")));
  }
}

TEST(GaSettings, RejectionsStateRuleAndValue) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(rejection([](auto&) {}), "accepted");
  EXPECT_EQ(rejection([](auto& s) { s.population = 1; }), "population must be between 2 and 1000000, got 1");
  EXPECT_EQ(rejection([](auto& s) { s.elitism = 150; }), "elitism must be between 0 and 149, got 150");
  EXPECT_EQ(rejection([](auto& s) { s.mutation = 1.5; }), "mutation must be between 0 and 1, got 1.5");
  EXPECT_THAT(rejection([=](auto& s) { s.mutation = nan; }), HasSubstr("mutation must be between 0 and 1, got nan"));
  EXPECT_THAT(rejection([](auto& s) { s.cut = -1; }), HasSubstr("cut must be between 0"));
  EXPECT_THAT(rejection([](auto& s) { s.grow = s.cut = s.alter = 0; }), HasSubstr("grow + cut + alter"));
  EXPECT_EQ(rejection([](auto& s) { s.mutation = s.grow = s.cut = s.alter = 0; }), "accepted");
  EXPECT_THAT(rejection([](auto& s) { s.tournament_size = 0; }), HasSubstr("tournament_size must be between 1"));
  EXPECT_THAT(rejection([](auto& s) { s.retries = 0; }), HasSubstr("retries must be between 1"));
  EXPECT_THAT(rejection([](auto& s) { s.replace_probability = -0.1; }), HasSubstr("got -0.1"));
  EXPECT_THAT(rejection([](auto& s) { s.genes = {10, 9}; }), HasSubstr("genes.max must be between 10"));
  EXPECT_THAT(rejection([](auto& s) { s.initial_length_min = 60; }), HasSubstr("initial_length"));
  EXPECT_THAT(rejection([](auto& s) { s.genes = {60, 90}; }),
              HasSubstr("initial_length must overlap the gene limits 60 to 90, got 50 to 50"));
}

}  // namespace
}  // namespace espalier
