#pragma once
// Rises: how the best score of a search rose, thinned to what a sparkline shows.

#include <array>
#include <vector>

namespace espalier::studio {

class Rises {
 public:
  static constexpr std::size_t kMost = 200;

  void clear() { pairs_.clear(); }
  /// `best` was reached after so many seconds; nothing is noted where it is no better than before.
  void note(double seconds, double best);
  /// Seconds and best score.
  const std::vector<std::array<double, 2>>& pairs() const { return pairs_; }

 private:
  std::vector<std::array<double, 2>> pairs_;
};

}  // namespace espalier::studio
