#pragma once
// GeneSweep: visits the genes of a derivation, or of one subtree, in their order (parents first), and knows of each
// where it stands. Linear time in genes and slots. Keep one and reuse it: its storage stays.

#include <cstdint>
#include <vector>

#include "derivation/position.h"

namespace espalier {

class GeneSweep {
 public:
  static constexpr std::uint32_t kNoParent = 0xffffffff;

  /// The whole derivation. Graph and derivation must stay unchanged during the sweep.
  void begin(const GeneratorGraph& graph, const Derivation& derivation);
  /// The subtree at `top`, as if `above` counted the genes above it.
  void begin(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& top,
             const DepthCounts& above);
  /// To the next gene (the first call: the first one). False when all have been visited.
  bool next();

  const GenePosition& position() const { return stack_.back().gene; }
  const GeneRecord& gene() const { return derivation_->genes[position().gene]; }
  const Rule& rule() const { return *stack_.back().rule; }
  const Variant& variant() const { return *stack_.back().variant; }
  SlotState slot(std::size_t k) const { return derivation_->slots[position().slot + k]; }
  const Slot& slot_of_rule(std::size_t k) const { return rule().slots[variant().slots[k]]; }
  /// Gene number of the parent, kNoParent for the first gene; and which of the parent's variant's slots leads here.
  std::uint32_t parent() const { return parent_; }
  std::uint32_t parent_slot() const { return parent_slot_; }
  /// Genes above this gene: for its weights and the probabilities of its slots.
  DepthCounts above() const { return above_.counts(); }
  /// Genes above its children: for their guards.
  DepthCounts below() const { return below_.counts(); }

 private:
  struct Frame {
    GenePosition gene;
    std::uint32_t end = 0;   // gene number behind the subtree
    std::uint32_t slot = 0;  // next slot to look at
    const Rule* rule = nullptr;
    const Variant* variant = nullptr;
  };

  void push(const GenePosition& gene);

  const GeneratorGraph* graph_ = nullptr;
  const Derivation* derivation_ = nullptr;
  std::vector<Frame> stack_;
  DepthCounter above_, below_;
  GenePosition next_;  // of the gene that comes next
  std::uint32_t end_ = 0;
  std::uint32_t parent_ = kNoParent;
  std::uint32_t parent_slot_ = 0;
};

}  // namespace espalier
