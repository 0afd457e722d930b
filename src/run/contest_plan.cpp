#include "run/contest_plan.h"

#include <algorithm>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "run/toml_value.h"

namespace espalier {
namespace {

constexpr std::size_t kMostSeeds = 1000;
constexpr std::uint64_t kLargestSeed = std::uint64_t{1} << 62;
constexpr std::size_t kLongestName = 40;

std::string_view stripped(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\n") + 1 - begin);
}

std::optional<std::uint64_t> whole(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Variants name files.
void check_name(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  const bool good = !name.empty() && name.size() <= kLongestName && name[0] != '.' && name[0] != '-' &&
                    std::all_of(name.begin(), name.end(), fits);
  if (!good) {
    throw Error(fmt::format("--variant: a name must be 1 to {} letters, digits, '-', '_' and '.', beginning with a "
                            "letter or digit, got {}", kLongestName, quote_toml(name)));
  }
}

/// Some file systems take "X.png" and "x.png" for one.
void check_names(const std::vector<VariantWords>& variants) {
  std::map<std::string, std::string> names;  // without case
  for (const VariantWords& variant : variants) {
    std::string plain = variant.name;
    for (char& c : plain) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto [place, fresh] = names.try_emplace(plain, variant.name);
    if (fresh) continue;
    if (place->second == variant.name)
      throw Error(fmt::format("two variants are called {}; --variant \"NAME: ...\" gives names", variant.name));
    throw Error(fmt::format("two variants are called {} and {}: names must differ by more than case, they name files",
                            place->second, variant.name));
  }
}

/// The part of the scene's settings that all variants share.
SceneOverrides common_overrides(const ContestWords& words) {
  SceneOverrides overrides = {words.settings, words.attributes};
  if (words.seed) overrides.settings.push_back(fmt::format("seed={}", *words.seed));
  return overrides;
}

/// What the command line gives; none: nothing.
std::optional<SceneBudget> budget_given(const ContestWords& words) {
  const int given = words.seconds.has_value() + words.evaluations.has_value() + words.generations.has_value();
  if (given > 1) throw Error("of --time, --evaluations and --generations only one can be the budget of all");
  if (given == 0) return std::nullopt;
  return SceneBudget{words.seconds, words.evaluations, words.generations};
}

/// The part of a scene's budget that can be the same for all.
SceneBudget common_budget(const std::string& path, const SceneBudget& budget, bool generations_count) {
  if (budget.seconds) return {budget.seconds, {}, {}};
  if (budget.evaluations) return {{}, budget.evaluations, {}};
  if (generations_count) return budget;
  throw Error(fmt::format("{}: its budget is one of generations, which do not compare; give --time or --evaluations",
                          path));
}

/// As one writes it after --set, so that its rules are told in the same words.
std::string setting_of(const SceneBudget& budget) {
  if (budget.seconds) return fmt::format("budget={{seconds = {}}}", format_toml(*budget.seconds));
  if (budget.evaluations) return fmt::format("budget={{evaluations = {}}}", *budget.evaluations);
  return fmt::format("budget={{generations = {}}}", *budget.generations);
}

}  // namespace

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> members;
  std::string member;
  int depth = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == ',' && depth == 0 && !quote) {
      members.emplace_back(stripped(member));
      member.clear();
      continue;
    }
    member += c;
    if (quote == '"' && c == '\\' && i + 1 < text.size()) member += text[++i];
    else if (quote) quote = c == quote ? 0 : quote;
    else if (c == '"' || c == '\'') quote = c;
    else if (c == '[' || c == '{') ++depth;
    else if (c == ']' || c == '}') depth = std::max(0, depth - 1);
  }
  members.emplace_back(stripped(member));
  return members;
}

std::vector<VariantWords> parse_engines(std::string_view text) {
  std::vector<VariantWords> variants;
  for (const std::string& name : split_list(text)) {
    if (std::find(kEngineNames.begin(), kEngineNames.end(), name) == kEngineNames.end()) {
      throw Error(fmt::format("--engines must be of {}, got {}", fmt::join(kEngineNames, ", "), quote_toml(name)));
    }
    variants.push_back({name, {fmt::format("search.engine=\"{}\"", name)}});
  }
  return variants;
}

VariantWords parse_variant(std::string_view text) {
  VariantWords variant;
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) {
    throw Error(fmt::format("--variant must be \"NAME: KEY=VALUE, KEY=VALUE\", got {}", quote_toml(text)));
  }
  variant.name = stripped(text.substr(0, colon));
  check_name(variant.name);
  if (stripped(text.substr(colon + 1)).empty()) return variant;  // the scene as it is
  for (const std::string& member : split_list(text.substr(colon + 1))) {
    const std::size_t equals = member.find('=');
    const std::string key(stripped(std::string_view(member).substr(0, equals)));
    const std::string value(equals == std::string::npos ? "" : stripped(std::string_view(member).substr(equals + 1)));
    if (key.empty() || value.empty()) {
      throw Error(fmt::format("--variant {}: must be KEY=VALUE, got {}", variant.name, quote_toml(member)));
    }
    check_own_setting(fmt::format("--variant {}: {}", variant.name, key), key);
    variant.settings.push_back(fmt::format("{}={}", key == "engine" ? "search.engine" : key, value));
  }
  return variant;
}

void check_own_setting(std::string_view where, std::string_view key) {
  const auto below = [&](std::string_view table) {
    return key.starts_with(table) && (key.size() == table.size() || key[table.size()] == '.');
  };
  if (key == "seed") throw Error(fmt::format("{}: name seeds by --seeds, which all share", where));
  if (below("budget")) {
    throw Error(fmt::format("{}: the budget is the same for all; give --time or --evaluations (sweep: or "
                            "--generations)", where));
  }
  if (key == "threads" || key == "espalier" || below("output"))
    throw Error(fmt::format("{}: no search depends on it", where));
}

std::vector<std::uint64_t> contest_seeds(const ContestWords& words) {
  return parse_seeds(words.seeds, load_scene(words.scene, common_overrides(words)).seed);
}

std::vector<std::uint64_t> parse_seeds(std::string_view text, std::uint64_t first) {
  const std::vector<std::string> members = split_list(text);
  std::vector<std::uint64_t> seeds;
  for (const std::string& member : members) {
    const std::optional<std::uint64_t> value = whole(member);
    if (!value || *value > kLargestSeed) {
      throw Error(fmt::format("--seeds must be how many, or seeds with commas between (3,7,9), got {}",
                              quote_toml(text)));
    }
    if (std::find(seeds.begin(), seeds.end(), *value) != seeds.end()) {
      throw Error(fmt::format("--seeds names {} twice", *value));
    }
    seeds.push_back(*value);
  }
  const std::uint64_t count = members.size() == 1 ? seeds[0] : seeds.size();
  if (count < 1 || count > kMostSeeds) {
    throw Error(fmt::format("--seeds must be 1 to {}, got {}", kMostSeeds, count));
  }
  if (members.size() > 1) return seeds;
  seeds.clear();
  for (std::uint64_t i = 0; i < count; ++i) seeds.push_back(std::min(first, kLargestSeed - count) + i);
  return seeds;
}

StopwatchClock parse_clock(std::string_view text) {
  if (text == "wall") return StopwatchClock::wall;
  if (text == "computing") return StopwatchClock::computing;
  throw Error(fmt::format("--clock must be wall or computing, got \"{}\"", text));
}

Contest make_contest(const ContestWords& words, const std::vector<VariantWords>& variants, bool generations_count) {
  CHECK(!variants.empty());
  check_names(variants);
  Contest contest;
  contest.scene_path = words.scene;
  contest.clock = parse_clock(words.clock);
  const std::optional<SceneBudget> given = budget_given(words);
  for (const VariantWords& variant : variants) {
    SceneOverrides overrides = common_overrides(words);
    if (given) overrides.settings.push_back(setting_of(*given));
    overrides.settings.insert(overrides.settings.end(), variant.settings.begin(), variant.settings.end());
    try {
      contest.variants.push_back({variant.name, variant.settings, load_scene(words.scene, overrides)});
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", variant.name, error.what()));
    }
  }
  const Scene& first = contest.variants.front().scene;
  contest.budget = given ? *given : common_budget(words.scene, first.budget, generations_count);
  contest.seeds = parse_seeds(words.seeds, first.seed);
  for (ContestVariant& variant : contest.variants) {
    variant.scene.budget = contest.budget;
    variant.scene.seed = contest.seeds.front();
  }
  return contest;
}

Effort effort_of(const SceneBudget& budget) { return budget.seconds ? Effort::seconds : Effort::evaluations; }

std::string in_words(const SceneBudget& budget) {
  if (budget.seconds) return in_words(Effort::seconds, *budget.seconds);
  if (budget.evaluations) return in_words(Effort::evaluations, static_cast<double>(*budget.evaluations));
  return grouped(*budget.generations) + " generations";
}

std::string in_words(Effort effort, double spent) {
  if (effort == Effort::seconds) return fmt::format("{:.3g} s", spent);
  return grouped(static_cast<std::uint64_t>(spent)) + " evaluations";
}

std::string grouped(std::uint64_t value) {
  std::string text = fmt::format("{}", value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ' ');
  return text;
}

}  // namespace espalier
