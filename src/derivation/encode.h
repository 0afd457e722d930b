#pragma once
// Derivations as JSON (format: docs/formats.md). Exact: decode(encode(d)) == d.

#include <string>
#include <string_view>

#include "derivation/derivation.h"

namespace espalier {

/// The JSON object of a derivation: grammar name and hash, detail seed, and one entry per gene by names of rule and edge.
/// `indent` < 0: one line.
std::string encode(const GeneratorGraph& graph, const Derivation& derivation);

/// Reads what `encode` wrote. Throws Error (place, rule, value) for anything that is not a derivation of this graph:
/// unknown version, rule or edge, wrong counts, broken guards or limits, more than `most_genes` genes.
Derivation decode(const GeneratorGraph& graph, std::string_view json, std::uint32_t most_genes = 4'000'000);

/// Empty if `derivation` is a valid derivation of `graph`, otherwise what is wrong with it. Checks everything: counts,
/// edges against slots, guards, limits. Linear time.
std::string find_fault(const GeneratorGraph& graph, const Derivation& derivation);

}  // namespace espalier
