#pragma once
// Settings of Genesis, the genetic algorithm over bit strings (Grefenstette 1990) that GenTree was bred with (Congdon
// and Mazza 2003).

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

enum class GenesisSelection : std::uint8_t {
  proportional,  // to the value less the worst of the scaling window
  ranking,       // linear in the rank: the worst expects `rank_min` places, the best 2 - rank_min
};

std::string_view name_of(GenesisSelection selection);

/// The defaults are those that Genesis proposes. GenTree breeds 20 at a time with the same rates.
struct GenesisSettings {
  std::uint32_t population = 50;  // strings, 2..100000
  double crossover = 0.6;         // share of a generation's new strings that is crossed, 0..1
  double mutation = 0.001;        // chance of each bit to be drawn anew, 0..1: it flips half as often
  double gap = 1;                 // share of the population that is replaced, above 0 to 1; the rest is carried over
  GenesisSelection selection = GenesisSelection::proportional;
  std::uint32_t window = 5;       // generations whose worst is the zero of fitness; 0: this one's. At most 1000000: all
  double rank_min = 0.75;         // ranking only, 0..1
  bool elitism = true;            // the best of a generation is put back where it was lost
  bool gray = true;               // neighbouring values of a gene differ in one bit
  std::uint32_t idle = 2;         // generations with nothing new to score, after which a new population begins; 1..1000
  /// Of the draws of the start rule, in their order, 1..32 each; empty: by kind (genesis_encoding.h).
  std::vector<std::uint32_t> bits = {};

  bool operator==(const GenesisSettings&) const = default;
};

/// Throws Error stating the first rule broken, with setting and value.
void validate(const GenesisSettings& settings);
/// All of them in words: equal texts, equal settings.
std::string to_text(const GenesisSettings& settings);

}  // namespace espalier
