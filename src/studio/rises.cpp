#include "studio/rises.h"

namespace espalier::studio {

void Rises::note(double seconds, double best) {
  if (!pairs_.empty() && best <= pairs_.back()[1]) return;
  pairs_.push_back({seconds, best});
  if (pairs_.size() <= kMost) return;
  std::vector<std::array<double, 2>> thinned;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (i % 2 == 0 || i + 1 == pairs_.size()) thinned.push_back(pairs_[i]);
  }
  pairs_ = std::move(thinned);
}

}  // namespace espalier::studio
