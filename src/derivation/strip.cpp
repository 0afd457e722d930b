#include "derivation/strip.h"

#include <vector>

#include "derivation/lock_map.h"
#include "derivation/writer.h"

namespace espalier {
namespace {

struct Frame {
  GenePosition gene, child;  // the child: of the next filled slot
  std::size_t slots;         // its own, in the copy
  std::size_t slot = 0;      // next to look at
};

class Stripper {
 public:
  Stripper(const GeneratorGraph& graph, const Derivation& from, const Locks& locks) : graph_(graph), from_(from) {
    locks_.reset(graph, from, locks);
  }

  Derivation run();

 private:
  void push(const GenePosition& gene);

  const GeneratorGraph& graph_;
  const Derivation& from_;
  LockMap locks_;
  std::vector<Frame> stack_;
  TreeWriter writer_;
  Derivation out_;
};

void Stripper::push(const GenePosition& gene) {
  const GeneRecord& record = from_.genes[gene.gene];
  const GenePosition child = first_child(graph_, from_, gene);
  writer_.open(record.edge, record.variant);
  stack_.push_back({gene, child, out_.slots.size()});
  out_.slots.insert(out_.slots.end(), from_.slots.begin() + gene.slot, from_.slots.begin() + child.slot);
  out_.draws.insert(out_.draws.end(), from_.draws.begin() + gene.draw, from_.draws.begin() + child.draw);
  writer_.opened();
}

Derivation Stripper::run() {
  out_.detail_seed = from_.detail_seed;
  writer_.begin(out_);
  push({});
  while (!stack_.empty()) {
    Frame& top = stack_.back();
    const GeneRecord& record = from_.genes[top.gene.gene];
    const Variant& variant = variant_of(graph_, record);
    if (top.slot == variant.slots.size()) {
      writer_.close();
      stack_.pop_back();
      continue;
    }
    SlotState& state = out_.slots[top.slots + top.slot];
    const EdgeId edge = rule_of(graph_, record).slots[variant.slots[top.slot++]].edge;
    if (state != SlotState::filled) continue;
    const GenePosition child = top.child;
    top.child = end_of(subtree_at(graph_, from_, child));
    if (graph_.edges[edge].required || locks_.pinned(child.gene)) {
      push(child);
    } else {
      state = SlotState::empty;
    }
  }
  return std::move(out_);
}

}  // namespace

Derivation stripped(const GeneratorGraph& graph, const Derivation& derivation, const Locks& locks) {
  return Stripper(graph, derivation, locks).run();
}

void reopen(const GeneratorGraph& graph, Derivation& derivation, const Locks& locks) {
  LockMap map;
  map.reset(graph, derivation, locks);
  std::size_t slot = 0;
  for (std::uint32_t gene = 0; gene < derivation.size(); ++gene) {
    const bool held = map.held(gene) & LockMap::kSlots;
    for (std::size_t n = variant_of(graph, derivation.genes[gene]).slots.size(); n > 0; --n, ++slot) {
      if (!held && derivation.slots[slot] == SlotState::empty) derivation.slots[slot] = SlotState::open;
    }
  }
}

}  // namespace espalier
