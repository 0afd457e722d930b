#pragma once
// What Genesis does to strings of bits, one generation at a time (Grefenstette 1990; Baker 1987): pure functions.

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "base/random.h"
#include "search/genesis_encoding.h"
#include "search/genesis_settings.h"

namespace espalier {

/// How many places each of `values` (finite, higher is better) expects among as many: they sum to their number. All
/// equal: 1 each. `worst_of_window`: the scaling window's least value, at most the least of these; ranking does not
/// look at it, and gives equal values the mean of their ranks.
std::vector<double> expected_places(std::span<const double> values, double worst_of_window,
                                    const GenesisSettings& settings);

/// Baker's stochastic universal sampling: `count` indices in random order, each so often that it is the floor or the
/// ceiling of expected[i] * count / sum. One uniform number chooses all.
std::vector<std::uint32_t> sample_universally(std::span<const double> expected, std::uint32_t count,
                                              RandomStream& random);

/// Draws each bit anew with chance `rate`; it flips half as often. Bits with held[i] != 0 stay (empty: none).
void mutate_bits(BitString& string, double rate, std::span<const std::uint8_t> held, RandomStream& random);

/// Swaps what lies between two points, but for the bits that are held. Both children together keep the bits that their
/// parents had at every place. Returns whether any bit changed.
bool cross_at_two_points(BitString& a, BitString& b, std::span<const std::uint8_t> held, RandomStream& random);

/// A new string and where it comes from.
struct GenesisChild {
  BitString string;
  std::uint32_t parent = 0;   // index into the generation before: the string it was before anything changed
  std::uint32_t partner = 0;  // the one that it was crossed with, itself where it was not
  bool changed = false;       // it differs from its parent, so it must be scored
};

/// The next generation: selection, mutation, crossover, and the elite put back. Exactly `count` >= 1 children. With
/// elitism the string of the highest value (of equals the first) is always among them. The places behind the share
/// `gap` go to strings of the old generation, drawn without replacement.
std::vector<GenesisChild> next_strings(std::span<const BitString> strings, std::span<const double> values,
                                       std::uint32_t count, double worst_of_window, const GenesisSettings& settings,
                                       std::span<const std::uint8_t> held, RandomStream& random);

/// The worst values of the last generations.
class ScalingWindow {
 public:
  explicit ScalingWindow(std::uint32_t generations) : generations_(generations) {}
  /// Of a generation; the oldest is forgotten where more than `generations` came before this one.
  void add(double worst);
  /// The least of those remembered. Only after `add`.
  double worst() const;
  const std::deque<double>& remembered() const { return worst_; }

 private:
  std::uint32_t generations_;
  std::deque<double> worst_;
};

}  // namespace espalier
