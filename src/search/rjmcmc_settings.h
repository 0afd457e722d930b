#pragma once
// Settings of reversible-jump Markov chain Monte Carlo.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "derivation/proposal.h"
#include "search/gene_limits.h"
#include "search/score_weight.h"

namespace espalier {

struct RjmcmcSettings {
  std::uint32_t chains = 4;          // 1..100000
  std::uint32_t temperatures = 4;    // chains of a ladder, 1..chains; chain i has rung i mod temperatures
  /// Hottest over coldest temperature: 12.91 lets through in the coldest 1 % of what passes in the hottest with 70 %
  /// (ln 0.01 / ln 0.7; Talton et al. 2011, section 5.2). 1..1e6.
  double heat = 12.91;
  ScoreWeight weight = ScoreWeight::exponential;
  /// Of the coldest chain, > 0; none: a 3000th of the optimum, or 1 where that is not above 0; 1 with ratios.
  std::optional<double> temperature;
  double anneal = 1;                  // beta grows by this factor every `anneal_every` steps, 1..100
  std::uint32_t anneal_every = 1000;  // 1..1e9
  double anneal_most = 100;           // beta grows so many times at most, 1..1e12
  double draws = 0.25, nudges = 0.25, slots = 0.25, jumps = 0.25;  // shares of the kinds of proposals
  PlaceChoice choice = PlaceChoice::by_level;
  bool delayed = true;                // fresh draws that are rejected are followed by a nudge of the same gene
  std::uint32_t swap_every = 10;      // steps between tries to swap neighbours of the ladders; 0 = never
  std::uint32_t initial_length_min = 50, initial_length_max = 50;  // genes of first individuals
  GeneLimits genes;

  bool operator==(const RjmcmcSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const RjmcmcSettings& settings);
/// All of them in words: equal texts, equal settings.
std::string to_text(const RjmcmcSettings& settings);

}  // namespace espalier
