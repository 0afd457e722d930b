#include "derivation/lock_map.h"

#include "derivation/position.h"

namespace espalier {

void LockMap::reset(const GeneratorGraph& graph, const Derivation& derivation, const Locks& locks) {
  held_.clear();
  for (const Lock& lock : locks) {
    const std::optional<std::uint32_t> gene = find_gene(graph, derivation, lock.path);
    if (!gene) continue;
    held_.resize(derivation.size());
    static thread_local GenePath path;
    locate(graph, derivation, *gene, path);
    for (const PathStep& step : path.steps) held_[step.gene.gene] |= kPinned;
    held_[*gene] |= kPinned;
    if (lock.scope == LockScope::draws) {
      held_[*gene] |= kDraws | kVariant;
      continue;
    }
    const std::uint8_t what = kPinned | kVariant | kSlots | (lock.scope == LockScope::subtree ? kDraws : 0);
    const std::uint32_t end = *gene + derivation.genes[*gene].genes_below;
    for (std::uint32_t g = *gene; g <= end; ++g) held_[g] |= what;
  }
}

}  // namespace espalier
