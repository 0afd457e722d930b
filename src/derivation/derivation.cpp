#include "derivation/derivation.h"

#include <type_traits>

#include "base/hash.h"

namespace espalier {

static_assert(sizeof(GeneRecord) == 16 && std::has_unique_object_representations_v<GeneRecord>);

std::uint64_t hash(const Derivation& derivation) {
  std::uint64_t h = hash_bytes(std::as_bytes(std::span(derivation.genes)), derivation.detail_seed);
  h = hash_bytes(std::as_bytes(std::span(derivation.slots)), h);
  return hash_bytes(std::as_bytes(std::span(derivation.draws)), h);
}

}  // namespace espalier
