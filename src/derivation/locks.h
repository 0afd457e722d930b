#pragma once
// Locks: genes that the search must leave alone, named by the path of slots that leads to them.
//
// A locked gene stays where it is: no move empties or swaps a slot on the way to it, and no gene above it changes to a
// variant that lacks such a slot. What else is held depends on the scope. A lock whose path leads to no gene holds
// nothing (until a gene comes to stand there).

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

enum class LockScope : std::uint8_t {
  subtree,    // the gene and all genes below: edges, variants, slot states, draws
  draws,      // the gene's own variant and draws; its slots may be filled, emptied and swapped
  structure,  // the gene and all genes below: edges, variants and slot states; their draws are free
};

struct Lock {
  std::vector<std::uint16_t> path;  // rule-slot indices (into Rule::slots) from the start gene
  LockScope scope = LockScope::subtree;
};

using Locks = std::vector<Lock>;

/// "Trunk/Branch[2]/Branch[0]" (the start rule first) to a path; throws Error naming the step that does not exist.
std::vector<std::uint16_t> parse_gene_path(const GeneratorGraph& graph, const std::string& text);
/// The inverse; CHECKs that the path exists in the graph.
std::string format_gene_path(const GeneratorGraph& graph, const std::vector<std::uint16_t>& path);

/// The path to gene number `gene` < derivation.size().
std::vector<std::uint16_t> gene_path(const GeneratorGraph& graph, const Derivation& derivation, std::uint32_t gene);
/// The number of the gene that a path leads to, if one stands there.
std::optional<std::uint32_t> find_gene(const GeneratorGraph& graph, const Derivation& derivation,
                                       const std::vector<std::uint16_t>& path);

}  // namespace espalier
