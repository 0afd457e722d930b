#include "run/sweep_plan.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/random.h"
#include "run/toml_value.h"

namespace espalier {
namespace {

constexpr std::size_t kMostSettings = 16;

VariedSetting parse_one(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(fmt::format("--vary must be KEY=VALUE,VALUE, got {}", quote_toml(text)));
  }
  VariedSetting varied = {text.substr(0, equals), split_list(std::string_view(text).substr(equals + 1))};
  check_own_setting("--vary " + varied.key, varied.key);
  std::set<std::string> seen;
  for (const std::string& value : varied.values) {
    if (value.empty()) throw Error(fmt::format("--vary {}: a value is empty, in {}", varied.key, quote_toml(text)));
    if (!seen.insert(value).second) throw Error(fmt::format("--vary {}: {} is there twice", varied.key, value));
  }
  return varied;
}

/// Combination of this number; the last setting varies fastest.
std::vector<std::size_t> combination_of(const std::vector<VariedSetting>& varied, std::uint64_t number) {
  std::vector<std::size_t> choice(varied.size());
  for (std::size_t i = varied.size(); i-- > 0;) {
    choice[i] = static_cast<std::size_t>(number % varied[i].values.size());
    number /= varied[i].values.size();
  }
  return choice;
}

/// Each value by itself, so that there may be any number of combinations; in their order.
std::vector<std::vector<std::size_t>> draw_combinations(const std::vector<VariedSetting>& varied, std::size_t count,
                                                        std::uint64_t seed) {
  std::set<std::vector<std::size_t>> drawn;
  RandomStream random({seed, Purpose::sample, 0, 0, 0});
  while (drawn.size() < count) {
    std::vector<std::size_t> choice;
    for (const VariedSetting& one : varied)
      choice.push_back(random.below(static_cast<std::uint32_t>(one.values.size())));
    drawn.insert(std::move(choice));
  }
  return {drawn.begin(), drawn.end()};
}

}  // namespace

std::vector<VariedSetting> parse_varied(const std::vector<std::string>& texts) {
  std::vector<VariedSetting> varied;
  std::set<std::string> keys;
  for (const std::string& text : texts) {
    varied.push_back(parse_one(text));
    if (!keys.insert(varied.back().key).second) throw Error(fmt::format("--vary {} is there twice", varied.back().key));
  }
  if (varied.empty() || varied.size() > kMostSettings)
    throw Error(fmt::format("--vary must name 1 to {} settings, got {}", kMostSettings, varied.size()));
  return varied;
}

std::vector<std::vector<std::size_t>> plan_combinations(const std::vector<VariedSetting>& varied,
                                                        const std::optional<std::uint32_t>& random,
                                                        std::uint64_t seed) {
  double product = 1;  // too many for a whole number, it may be
  for (const VariedSetting& one : varied) product *= static_cast<double>(one.values.size());
  if (random && static_cast<double>(*random) < product) return draw_combinations(varied, *random, seed);
  if (product > static_cast<double>(kMostSweepSearches)) {
    throw Error(fmt::format("--vary gives {:.0f} combinations, at most {} searches make a sweep; --random N takes N of "
                            "them", product, kMostSweepSearches));
  }
  std::vector<std::vector<std::size_t>> all;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(product); ++i) all.push_back(combination_of(varied, i));
  return all;
}

std::vector<VariantWords> sweep_variants(const std::vector<VariedSetting>& varied,
                                         const std::vector<std::vector<std::size_t>>& combinations,
                                         const std::optional<std::string>& engine) {
  std::vector<VariantWords> variants;
  for (const std::vector<std::size_t>& choice : combinations) {
    VariantWords variant;
    if (engine) variant.settings.push_back(fmt::format("search.engine=\"{}\"", *engine));
    for (std::size_t i = 0; i < varied.size(); ++i) {
      const std::string setting = varied[i].key + "=" + varied[i].values[choice[i]];
      variant.name += (i > 0 ? ", " : "") + setting;
      variant.settings.push_back(setting);
    }
    variants.push_back(std::move(variant));
  }
  return variants;
}

void check_sweep(const std::vector<VariedSetting>& varied, const Contest& contest) {
  const std::size_t searches = contest.variants.size() * contest.seeds.size();
  if (searches > kMostSweepSearches) {
    throw Error(fmt::format("a sweep is at most {} searches, got {} combinations x {} seeds = {}; --random N takes N "
                            "of the combinations", kMostSweepSearches, contest.variants.size(), contest.seeds.size(),
                            searches));
  }
  for (const VariedSetting& one : varied) {
    if (!one.key.starts_with("engine.")) continue;
    const std::string engine = one.key.substr(7, one.key.find('.', 7) - 7);
    const bool used = std::any_of(contest.variants.begin(), contest.variants.end(), [&](const ContestVariant& variant) {
      const EngineKind kind = variant.scene.search.engine;
      const bool of_hybrid = engine == "sosmc" || engine == "ga" || engine == "rjmcmc";
      return name_of(kind) == engine || (kind == EngineKind::hybrid && of_hybrid);
    });
    if (!used) {
      throw Error(fmt::format("--vary {}: changes nothing, the engine is {}; choose it with --engine {}", one.key,
                              name_of(contest.variants[0].scene.search.engine), engine));
    }
  }
}

}  // namespace espalier
