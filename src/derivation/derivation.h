#pragma once
// Derivation: the genome. A derivation tree in depth-first order, packed flat, so that every subtree is one slice of
// each array: cutting, copying and crossing over are block moves, and only the counts of ancestors change.
//
//   genes   one record per gene, parents before children, children in slot order
//   slots   one state per slot of each gene: the gene's own first, then those of its descendants
//   draws   one 32-bit quantile per draw component, in the same order
//
// A quantile q stands for u = q * 2^-32 in [0, 1); its distribution maps u to a value during expansion, so a gene stays
// valid wherever it is put. A derivation is a value: it knows nothing of its graph, which every function takes beside
// it.

#include <cstdint>
#include <vector>

#include "grammar/graph.h"

namespace espalier {

enum class SlotState : std::uint8_t {
  open,    // not decided yet; shows its `otherwise`
  empty,   // decided: no child; shows its `else`
  filled,  // has a child
  absent,  // the guard of its rule fails here; shows its `else`
};

struct GeneRecord {
  EdgeId edge = 0;            // the way in; its child is the gene's rule
  std::uint16_t variant = 0;  // index into Rule::variants
  std::uint32_t genes_below = 0;
  std::uint32_t slots_below = 0;  // of the genes below, not counting its own
  std::uint32_t draws_below = 0;

  bool operator==(const GeneRecord&) const = default;
};

struct Derivation {
  std::vector<GeneRecord> genes;
  std::vector<SlotState> slots;
  std::vector<std::uint32_t> draws;
  std::uint64_t detail_seed = 0;

  std::size_t size() const { return genes.size(); }
  bool operator==(const Derivation&) const = default;
};

/// Where a gene's slices start.
struct GenePosition {
  std::uint32_t gene = 0;
  std::uint32_t slot = 0;
  std::uint32_t draw = 0;
};

inline const Rule& rule_of(const GeneratorGraph& graph, const GeneRecord& gene) { return graph.rule_of(gene.edge); }
inline const Variant& variant_of(const GeneratorGraph& graph, const GeneRecord& gene) {
  return graph.rule_of(gene.edge).variants[gene.variant];
}

/// 64-bit hash of the whole value.
std::uint64_t hash(const Derivation& derivation);

}  // namespace espalier
