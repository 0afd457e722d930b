#pragma once
// Locks: genes that the search must leave alone, named by the path of slots that leads to them.

#include <cstdint>
#include <string>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

enum class LockScope : std::uint8_t {
  subtree,    // the gene, its draws, and everything below
  draws,      // the gene's own draws and variant
  structure,  // which slots of the gene are filled, and by what; draws are free
};

struct Lock {
  std::vector<std::uint16_t> path;  // rule-slot indices from the start gene
  LockScope scope = LockScope::subtree;
};

using Locks = std::vector<Lock>;

/// "Trunk/Branch[2]/Branch[0]" (the start rule first) to a path; throws Error naming the step that does not exist.
std::vector<std::uint16_t> parse_gene_path(const GeneratorGraph& graph, const std::string& text);
std::string format_gene_path(const GeneratorGraph& graph, const std::vector<std::uint16_t>& path);

}  // namespace espalier
