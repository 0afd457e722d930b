#include "derivation/join.h"

#include <algorithm>
#include <tuple>

#include "base/check.h"
#include "derivation/splice.h"

namespace espalier {
namespace {

template <class T>
bool equal_range(const std::vector<T>& a, std::size_t a_begin, const std::vector<T>& b, std::size_t b_begin,
                 std::size_t n) {
  return std::equal(a.data() + a_begin, a.data() + a_begin + n, b.data() + b_begin);
}

bool equal_slices(const Derivation& a, const SubtreeSlice& in_a, const Derivation& b, const SubtreeSlice& in_b) {
  return in_a.genes == in_b.genes && in_a.slots == in_b.slots && in_a.draws == in_b.draws &&
         equal_range(a.genes, in_a.begin.gene, b.genes, in_b.begin.gene, in_a.genes) &&
         equal_range(a.slots, in_a.begin.slot, b.slots, in_b.begin.slot, in_a.slots) &&
         equal_range(a.draws, in_a.begin.draw, b.draws, in_b.begin.draw, in_a.draws);
}

class Comparison {
 public:
  Comparison(const GeneratorGraph& graph, const Derivation& parent, const Derivation& child)
      : graph_(graph), parent_(parent), child_(child) {}

  /// The genes themselves, without what is below them and whether anything is.
  bool same_gene(const GenePosition& p, const GenePosition& c) const {
    const GeneRecord &a = parent_.genes[p.gene], &b = child_.genes[c.gene];
    return a.edge == b.edge && a.variant == b.variant &&
           equal_range(parent_.draws, p.draw, child_.draws, c.draw, variant_of(graph_, a).draws.size());
  }

  /// Finds the slot of two such genes in which they differ. False if that is not exactly one.
  bool find_slot(const GenePosition& p, const GenePosition& c, Change& change) const {
    const std::size_t slots = variant_of(graph_, parent_.genes[p.gene]).slots.size();
    GenePosition at_p = first_child(graph_, parent_, p), at_c = first_child(graph_, child_, c);
    bool found = false;
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
      const SubtreeSlice in_p = slice(parent_, p, slot, at_p), in_c = slice(child_, c, slot, at_c);
      at_p = end_of(in_p), at_c = end_of(in_c);
      const SlotState state = child_.slots[c.slot + slot];
      if (state == parent_.slots[p.slot + slot] && equal_slices(parent_, in_p, child_, in_c)) continue;
      if (found) return false;
      found = true;
      change = {p.gene, slot, in_p, &child_, in_c, state};
    }
    return found;
  }

 private:
  SubtreeSlice slice(const Derivation& of, const GenePosition& gene, std::uint32_t slot, const GenePosition& at) const {
    if (of.slots[gene.slot + slot] != SlotState::filled) return {at};
    return subtree_at(graph_, of, at);
  }

  const GeneratorGraph& graph_;
  const Derivation &parent_, &child_;
};

}  // namespace

bool find_change(const GeneratorGraph& graph, const Derivation& parent, const Derivation& child, Change& change) {
  const Comparison compare(graph, parent, child);
  if (!compare.same_gene({}, {}) || !compare.find_slot({}, {}, change)) return false;
  for (Change deeper; change.removed.genes > 0 && change.inserted.genes > 0; change = deeper) {
    const GenePosition &p = change.removed.begin, &c = change.inserted.begin;
    if (!compare.same_gene(p, c) || !compare.find_slot(p, c, deeper)) break;
  }
  return true;
}

bool are_apart(const Change& a, const Change& b) {
  const auto holds = [](const SubtreeSlice& slice, std::uint32_t gene) {
    return gene >= slice.begin.gene && gene < slice.begin.gene + slice.genes;
  };
  return !(a.owner == b.owner && a.slot == b.slot) && !holds(a.removed, b.owner) && !holds(b.removed, a.owner);
}

void join(const GeneratorGraph& graph, const Derivation& parent, std::vector<Change>& changes, Derivation& joined) {
  // From the back to the front, so that what is still to be changed stays where it is in the parent. Where several
  // begin at one place, the slots of genes further down come before those of genes above them.
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
    return std::tuple(a.removed.begin.gene, b.owner, a.slot) > std::tuple(b.removed.begin.gene, a.owner, b.slot);
  });
  joined = parent;
  GenePath path;
  for (const Change& change : changes) {
    DCHECK(change.donor != &joined);
    locate(graph, joined, change.owner, path);
    path.steps.push_back({path.gene, change.slot});
    joined.slots[path.gene.slot + change.slot] = change.state;
    splice_in_place(joined, change.removed, *change.donor, change.inserted, path.steps);
  }
}

}  // namespace espalier
