#include "derivation/position.h"

#include <algorithm>

#include "base/check.h"

namespace espalier {

bool operator==(const DepthCounts& a, const DepthCounts& b) {
  return a.depth == b.depth && std::equal(a.of_rule.begin(), a.of_rule.end(), b.of_rule.begin(), b.of_rule.end());
}

GenePosition child_in_slot(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& gene,
                           std::uint32_t slot) {
  GenePosition child = first_child(graph, derivation, gene);
  for (std::uint32_t k = 0; k < slot; ++k) {
    if (derivation.slots[gene.slot + k] != SlotState::filled) continue;
    child = end_of(subtree_at(graph, derivation, child));
  }
  return child;
}

void locate(const GeneratorGraph& graph, const Derivation& derivation, std::uint32_t gene, GenePath& path) {
  DCHECK(gene < derivation.size());
  path.steps.clear();
  path.above.reset(graph);
  GenePosition here;
  while (here.gene != gene) {
    GenePosition child = first_child(graph, derivation, here);
    std::uint32_t slot = 0;
    for (;; ++slot) {
      if (derivation.slots[here.slot + slot] != SlotState::filled) continue;
      if (gene <= child.gene + derivation.genes[child.gene].genes_below) break;
      child = end_of(subtree_at(graph, derivation, child));
    }
    path.steps.push_back({here, slot});
    path.above.enter(rule_of(graph, derivation.genes[here.gene]));
    here = child;
  }
  path.gene = here;
}

}  // namespace espalier
