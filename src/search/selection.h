#pragma once
// Selection: who becomes a parent. A scheme is prepared once for the scores of a population and then picks indices.
// (Blickle and Thiele 1996; ShapeGenetics 2017, section 6; Haubenwallner et al. 2016, section 3.1.4.)

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/random.h"

namespace espalier {

enum class SelectionScheme : std::uint8_t {
  /// With probability proportional to f - f_worst (the papers' f / sum f needs positive scores; ours may be negative).
  /// All scores equal: uniform.
  roulette,
  /// The best of k drawn uniformly with replacement; of equal ones the one with the lowest index.
  tournament,
  random,  // uniform
};

std::string_view name_of(SelectionScheme scheme);

class Selection {
 public:
  /// `tournament_size` >= 1; the other schemes ignore it.
  Selection(SelectionScheme scheme, std::uint32_t tournament_size) : scheme_(scheme), size_(tournament_size) {}

  /// Takes a copy of the scores (higher is better, finite, at least one). No allocation once warm.
  void prepare(std::span<const double> scores);
  /// An index into the scores last prepared. Cost: log n (roulette), k (tournament).
  std::uint32_t pick(RandomStream& random) const;

 private:
  std::uint32_t pick_by_roulette(RandomStream& random) const;
  std::uint32_t pick_by_tournament(RandomStream& random) const;

  SelectionScheme scheme_;
  std::uint32_t size_;
  std::vector<double> scores_;
  std::vector<double> cumulative_;  // roulette: cumulative[i] = sum of the weights of 0..i
};

}  // namespace espalier
