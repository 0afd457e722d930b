#pragma once
// TreeWriter: appends genes to a derivation in depth-first order and fills in their counts.

#include <vector>

#include "derivation/position.h"

namespace espalier {

class TreeWriter {
 public:
  /// Appends to `out`, which may hold genes already: they are left as they are.
  void begin(Derivation& out) {
    out_ = &out;
    open_.clear();
  }
  /// Appends a gene. The caller then appends its own slots and draws to the derivation and calls `opened`.
  void open(EdgeId edge, std::uint16_t variant) {
    open_.push_back({out_->genes.size(), 0, 0});
    out_->genes.push_back({edge, variant, 0, 0, 0});
  }
  void opened() {
    open_.back().slots_end = out_->slots.size();
    open_.back().draws_end = out_->draws.size();
  }
  /// All that stands below the gene opened last has been appended.
  void close() {
    const Open& top = open_.back();
    GeneRecord& record = out_->genes[top.gene];
    record.genes_below = static_cast<std::uint32_t>(out_->genes.size() - top.gene - 1);
    record.slots_below = static_cast<std::uint32_t>(out_->slots.size() - top.slots_end);
    record.draws_below = static_cast<std::uint32_t>(out_->draws.size() - top.draws_end);
    open_.pop_back();
  }
  /// Appends a finished subtree.
  void append(const Derivation& from, const SubtreeSlice& slice) {
    const GenePosition end = end_of(slice);
    out_->genes.insert(out_->genes.end(), from.genes.begin() + slice.begin.gene, from.genes.begin() + end.gene);
    out_->slots.insert(out_->slots.end(), from.slots.begin() + slice.begin.slot, from.slots.begin() + end.slot);
    out_->draws.insert(out_->draws.end(), from.draws.begin() + slice.begin.draw, from.draws.begin() + end.draw);
  }

 private:
  struct Open {
    std::size_t gene, slots_end, draws_end;
  };
  Derivation* out_ = nullptr;
  std::vector<Open> open_;
};

}  // namespace espalier
