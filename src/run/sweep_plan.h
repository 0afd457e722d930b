#pragma once
// What a sweep tries: settings with the values that each shall have, and the combinations of them.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/contest_plan.h"

namespace espalier {

inline constexpr std::size_t kMostSweepSearches = 1000;

struct VariedSetting {
  std::string key;                  // dotted
  std::vector<std::string> values;  // as written: TOML, or a text without quotes
};

/// "search.population=10,50,200", each. Throws Error for a key that is there twice, one that no search depends on, an
/// empty list, or the same value twice.
std::vector<VariedSetting> parse_varied(const std::vector<std::string>& texts);

/// Index of a value per setting; the last setting varies fastest. All, or `random` of them, drawn by the seed. Throws
/// Error where there are more than kMostSweepSearches.
std::vector<std::vector<std::size_t>> plan_combinations(const std::vector<VariedSetting>& varied,
                                                        const std::optional<std::uint32_t>& random,
                                                        std::uint64_t seed);

/// The variants of a contest, each named by its values: "search.population=10, search.elitism=2".
std::vector<VariantWords> sweep_variants(const std::vector<VariedSetting>& varied,
                                         const std::vector<std::vector<std::size_t>>& combinations,
                                         const std::optional<std::string>& engine);

/// Throws Error where a varied setting is one of an engine that nobody searches with, or there are too many searches.
void check_sweep(const std::vector<VariedSetting>& varied, const Contest& contest);

}  // namespace espalier
