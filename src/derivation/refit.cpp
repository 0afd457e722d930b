#include "derivation/refit.h"

#include "derivation/chances.h"

namespace espalier {

bool refit(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& top, const DepthCounts& above,
           GeneSweep& sweep, std::vector<SlotPatch>& patches) {
  patches.clear();
  sweep.begin(graph, derivation, top, above);
  while (sweep.next()) {
    if (variant_probability(sweep.variant(), sweep.above()) <= 0) return false;
    EdgeId guarded = 0;  // the edge that `stands` is about: slots of a `for` share theirs
    bool stands = false;
    for (std::uint32_t k = 0; k < sweep.variant().slots.size(); ++k) {
      const EdgeId edge = sweep.slot_of_rule(k).edge;
      const SlotState state = sweep.slot(k);
      if (edge != guarded) stands = may_stand(graph, guarded = edge, sweep.below());
      if (state == SlotState::filled && !(stands && fill_probability(graph.edges[edge], sweep.above()) > 0)) {
        return false;
      }
      if (state == SlotState::filled || stands == (state != SlotState::absent)) continue;
      if (stands && graph.edges[edge].required) return false;
      patches.push_back({sweep.position().slot + k - top.slot, stands ? SlotState::empty : SlotState::absent});
    }
  }
  return true;
}

}  // namespace espalier
