#pragma once
// What takes part in a contest: variants of one scene, the same seeds and the same budget for all. Read from the words
// of the command line.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "run/rises.h"
#include "run/scene_toml.h"
#include "run/stopwatch.h"

namespace espalier {

/// A scene as one of those who take part has it.
struct ContestVariant {
  std::string name;                   // fit to name a file
  std::vector<std::string> settings;  // "dotted.key=value", what makes it differ from the scene
  Scene scene;
};

struct Contest {
  std::string scene_path;
  std::vector<ContestVariant> variants;
  std::vector<std::uint64_t> seeds;
  SceneBudget budget;  // of each search; one of the three
  StopwatchClock clock = StopwatchClock::wall;
};

/// A variant before its scene is read.
struct VariantWords {
  std::string name;
  std::vector<std::string> settings;
};

/// What of the command line says how much each search may spend, and whose scene it is.
struct ContestWords {
  std::string scene;
  std::vector<std::string> settings, attributes;  // of all
  std::optional<std::uint64_t> seed;              // the first one; none: the scene's
  std::string seeds = "5";
  std::optional<double> seconds;
  std::optional<std::uint64_t> evaluations, generations;
  std::string clock = "wall";  // or "computing"
};

/// "a,[1,2],\"x,y\"" as its three members: commas within brackets, braces and quotes part nothing. Blanks around
/// members go.
std::vector<std::string> split_list(std::string_view text);

/// "ga,smc": a variant each, of that engine. Throws Error for what is no engine.
std::vector<VariantWords> parse_engines(std::string_view text);
/// "NAME: KEY=VALUE, KEY=VALUE": settings of the scene; `engine=X` is short for search.engine=X. Throws Error, also for
/// a setting that all share.
VariantWords parse_variant(std::string_view text);

/// Throws Error, after `where` ("--vary seed"), for a setting that belongs to all searches alike, or to none.
void check_own_setting(std::string_view where, std::string_view key);

/// "5": that many from `first` on; "3,7,9": these. Throws Error for none, too many or the same twice.
std::vector<std::uint64_t> parse_seeds(std::string_view text, std::uint64_t first);

/// The seeds of make_contest, before its variants are known. Throws Error.
std::vector<std::uint64_t> contest_seeds(const ContestWords& words);

/// "wall" or "computing". Throws Error.
StopwatchClock parse_clock(std::string_view text);

/// Reads the scene of every variant. A budget in `words` takes the place of the scene's; without one, the scene's
/// seconds or else its evaluations hold, and its generations only where `generations_count`: engines mean different
/// things by them. Throws Error, naming the variant.
Contest make_contest(const ContestWords& words, const std::vector<VariantWords>& variants, bool generations_count);

/// What a budget is spent in; generations count as evaluations.
Effort effort_of(const SceneBudget& budget);
/// "60 s", "20 000 evaluations".
std::string in_words(const SceneBudget& budget);
std::string in_words(Effort effort, double spent);

/// 1234567 as "1 234 567".
std::string grouped(std::uint64_t value);

}  // namespace espalier
