#pragma once
// Settings of the genetic algorithm, and the published sets of them by name.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "derivation/moves.h"
#include "search/gene_limits.h"
#include "search/selection.h"

namespace espalier {

/// The defaults are the preset `ga-2017`.
struct GaSettings {
  std::uint32_t population = 150;          // individuals, 2..1000000
  std::uint32_t elitism = 30;              // best copied unchanged, 0..population - 1
  std::uint32_t initial_length_min = 50;   // genes of a new individual, drawn uniformly from min..max
  std::uint32_t initial_length_max = 50;
  double mutation = 0.3;                   // chance that a pair is mutated; else it is crossed
  double grow = 0.45, cut = 0.45, alter = 0.10, nudge = 0;  // shares of the kinds of mutation; only ratios matter
  SelectionScheme first = SelectionScheme::tournament;  // of the first parent
  SelectionScheme second = SelectionScheme::roulette;   // of the second
  std::uint32_t tournament_size = 10;      // k, 1..10000
  Compatibility crossover = Compatibility::edge;
  std::uint32_t retries = 3;               // attempts of a crossover in all, 1..1000
  double replace_probability = 1;          // by symbol only: see CrossoverSettings
  GeneLimits genes;
  bool reuse_scores = false;               // a child equal to a parent generation's member gets its score unscored
  std::uint32_t restart_after = 0;         // generations without a better individual before a new population; 0 = never
  bool unique = false;                     // a child equal to a member of its own generation is redrawn
  bool adapt = false;                      // the chances of crossover and of mutations follow what each gained lately
  bool join = false;                       // what several children of one parent gained is joined in one more child

  bool operator==(const GaSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const GaSettings& settings);
/// All of them in words: equal texts, equal settings.
std::string to_text(const GaSettings& settings);

struct GaPreset {
  std::string_view name;
  std::string_view summary;  // one line for people, with its source
};
std::span<const GaPreset> ga_presets();
/// Throws Error listing the presets when there is none of that name.
GaSettings ga_preset(std::string_view name);

}  // namespace espalier
