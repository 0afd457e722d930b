#include "breed/simulated_user.h"

#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/natural_log.h"

namespace espalier {

double gene_distance(const GeneratorGraph& graph, const Derivation& a, const Derivation& b) {
  const std::vector<DrawComponent>& draws = graph.rules[graph.start()].draws;
  CHECK(a.draws.size() == draws.size() && b.draws.size() == draws.size() && !draws.empty());
  double sum = 0;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const auto seen = [&](std::uint32_t quantile) {
      if (draws[i].shape != DrawShape::discrete || draws[i].values == 0) return quantile * 0x1.0p-32;
      return (static_cast<double>((std::uint64_t{quantile} * draws[i].values) >> 32) + 0.5) / draws[i].values;
    };
    const double apart = std::abs(seen(a.draws[i]) - seen(b.draws[i]));
    sum += draws[i].shape == DrawShape::circular ? std::min(apart, 1 - apart) : apart;
  }
  return sum / static_cast<double>(draws.size());
}

double SimulatedUser::rate(const Derivation& tree) {
  const double u = (static_cast<double>(random_.next_u32()) + 0.5) * 0x1.0p-32;
  constexpr double kMean = 0.5772156649015329;  // of the Gumbel distribution: it does not shift ratings
  const double gumbel = -natural_log(-natural_log(u)) - kMean;
  return std::round((kUsual - distance(tree) + noise_ * gumbel) / kStep);
}

}  // namespace espalier
