#pragma once
// Settings of a breeding session.

#include <cstdint>
#include <string_view>

#include "search/genesis_settings.h"

namespace espalier {

enum class BreedMethod : std::uint8_t {
  classic,  // GenTree's: Genesis over bit strings. Only for genomes that are draws of the start rule alone
  free,     // derivations of any grammar: the best kept, crossover of subtrees and draws, mutation by a dial, newcomers
};

std::string_view name_of(BreedMethod method);

struct BreedSettings {
  static constexpr std::uint32_t kLeastPopulation = 9, kMostPopulation = 20;

  BreedMethod method = BreedMethod::free;
  std::uint32_t population = 12;  // members of a generation, kLeastPopulation..kMostPopulation
  double strength = 0.4;          // of mutation, from 0 (subtle) to 1 (wild)
  std::uint32_t keep = 6;         // free: the best that were rated above 0 go on unchanged, 0..population - 1
  double crossover = 0.9;         // free: share of the children that has several parents, 0..1
  double blend = 0.8;             // free: share of the children of several that is a mixture of up to three and
                                  // not a patchwork of two, 0..1
  double lean = 1;                // free: share of the children moved on, from what was disliked to what was liked
  double newcomers = 0;           // free: share of a generation that is drawn from the grammar, 0..1
  bool use_ratings = true;        // false: everybody is as likely to have children (GenTree's variants without ratings)
  GenesisSettings genesis = classic_genesis();  // classic; its population is the one above

  /// GenTree's own: 20 strings at a time, the rates of Genesis.
  static GenesisSettings classic_genesis();
  bool operator==(const BreedSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const BreedSettings& settings);

}  // namespace espalier
