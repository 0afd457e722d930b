#pragma once
// LockMap: what locks hold of each gene of one derivation.

#include <cstdint>
#include <vector>

#include "derivation/locks.h"

namespace espalier {

class LockMap {
 public:
  static constexpr std::uint8_t kPinned = 1;   // it stays in its slot: it or a gene below is locked, or one above whole
  static constexpr std::uint8_t kDraws = 2;    // its draws stay
  static constexpr std::uint8_t kVariant = 4;  // its variant stays
  static constexpr std::uint8_t kSlots = 8;    // the states of its slots stay

  void reset(const GeneratorGraph& graph, const Derivation& derivation, const Locks& locks);

  /// Nothing is held at all.
  bool free() const { return held_.empty(); }
  std::uint8_t held(std::uint32_t gene) const { return held_.empty() ? 0 : held_[gene]; }
  bool pinned(std::uint32_t gene) const { return held(gene) & kPinned; }

 private:
  std::vector<std::uint8_t> held_;  // per gene; empty if free
};

}  // namespace espalier
