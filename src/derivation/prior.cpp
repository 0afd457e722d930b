#include <limits>

#include "derivation/chances.h"
#include "base/natural_log.h"
#include "derivation/sample.h"
#include "derivation/sweep.h"

namespace espalier {

double log_prior(const GeneratorGraph& graph, const Derivation& derivation) {
  static thread_local GeneSweep sweep;
  double sum = 0;
  sweep.begin(graph, derivation);
  while (sweep.next()) {
    const DepthCounts above = sweep.above();
    if (sweep.rule().variants.size() > 1) sum += natural_log(variant_probability(sweep.variant(), above));
    for (std::size_t k = 0; k < sweep.variant().slots.size(); ++k) {
      const Edge& edge = graph.edges[sweep.slot_of_rule(k).edge];
      if (edge.required) continue;
      const SlotState state = sweep.slot(k);
      if (state == SlotState::filled) sum += natural_log(fill_probability(edge, above));
      if (state == SlotState::empty) sum += natural_log(1 - fill_probability(edge, above));
    }
  }
  return sum;
}

}  // namespace espalier
