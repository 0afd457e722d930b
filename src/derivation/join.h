#pragma once
// Join: what several children changed in one parent, put together in one derivation. Where children of a large tree
// each got better in a place of their own, their join is better in all of these at once.

#include <cstdint>
#include <span>
#include <vector>

#include "derivation/position.h"

namespace espalier {

/// One slot of a parent as a child has it: the smallest part that holds every difference between the two.
struct Change {
  std::uint32_t owner = 0;     // gene of the parent whose slot it is
  std::uint32_t slot = 0;      // index into its variant's slots
  SubtreeSlice removed;        // of the parent; length 0 where the slot has no child
  const Derivation* donor = nullptr;
  SubtreeSlice inserted;       // of the donor; length 0 where the slot has no child there
  SlotState state = SlotState::empty;  // there
};

/// False if they are equal, or differ in the start gene or in several of its slots: then no slot holds it all. `child`
/// must outlive the change. Linear time.
bool find_change(const GeneratorGraph& graph, const Derivation& parent, const Derivation& child, Change& change);

/// No change lies in a part that the other one replaces.
bool are_apart(const Change& a, const Change& b);

/// joined = `parent` with all changes made. Any two must be apart. The result may break a `limit` of a rule, nothing
/// else. `joined` is neither the parent nor a donor; `changes` is put in another order.
void join(const GeneratorGraph& graph, const Derivation& parent, std::vector<Change>& changes, Derivation& joined);

}  // namespace espalier
