#pragma once
// The screen of a taste model: a hidden pool of candidates is bred and ordered by what a person will probably say of
// them, and the person sees the best, one that is different, and one of which the model is unsure.

#include <cstdint>
#include <string>
#include <vector>

#include "breed/generation.h"
#include "breed/taste.h"

namespace espalier {

struct ScreenSettings {
  std::uint32_t pool = 160;  // hidden candidates, 100..2000
  std::uint32_t rounds = 2;  // the pool is bred in so many parts, each from the most promising of the one before; 1..10
  double daring = 1;         // how many standard deviations above what it forecasts a candidate is hoped to be, 0..5
  double spacing = 0.5;      // of shown ones, as a share of the pool's mean distance: nearer ones are passed over, 0..1

  bool operator==(const ScreenSettings&) const = default;
};

/// Throws Error stating rule and value.
void validate(const ScreenSettings& settings);

enum class ShownAs : std::uint8_t { kept, best, different, uncertain };
std::string_view name_of(ShownAs shown);

struct Screen {
  NextGeneration generation;
  // One for each member:
  std::vector<ShownAs> shown_as;
  std::vector<Forecast> forecasts;
  std::vector<std::string> reasons;  // Taste::reasons; "" where there are none
};

/// The next generation as next_generation makes it freely, but chosen from the pool. Targets' scores and what is not
/// viable count as there. Pure.
Screen next_screen(const BreedProblem& problem, const BreedSettings& settings, const ScreenSettings& screen,
                   const std::vector<Member>& parents, const Taste& taste, std::uint32_t number, MemberId first_id);

/// How unlike each other these are: the mean distance of their features over that of `reference` (what the grammar
/// grows at random, at least two), clamped to 0..1. 1 where there are fewer than two.
double diversity(const std::vector<std::vector<double>>& features, const std::vector<std::vector<double>>& reference);

}  // namespace espalier
