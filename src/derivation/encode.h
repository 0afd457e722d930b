#pragma once
// Derivations as JSON (format: docs/formats.md). Exact: decode(encode(d)) == d.
//
//   {"espalier_derivation": 1, "grammar": "tree", "grammar_hash": "...", "detail_seed": "0123456789abcdef",
//    "genes": [
//   ["Trunk", "", "FE", [1234, 99]],
//   ["Trunk/Branch", "2", "A", []]]}
//
// One entry per gene, depth-first: the name of the edge that leads to it (of the start gene, its rule), its variant by
// name or index, a letter per slot (Filled, Empty, Open, Absent) and its draws as 32-bit quantiles. A member
// "provenance", any object, may stand beside these and is skipped; no other member may.

#include <string>
#include <string_view>

#include "derivation/derivation.h"

namespace espalier {

inline constexpr int kDerivationVersion = 1;

/// The JSON text of a valid derivation of `graph`, one line per gene, ending with "}" and no line end.
std::string encode(const GeneratorGraph& graph, const Derivation& derivation);

/// How well a derivation must fit: it names this grammar and its hash; it is valid whatever it names; it is valid but
/// for guards and probabilities, and wants to be adapted (adapt.h).
enum class Fit : std::uint8_t { same_grammar, valid, adaptable };

/// Reads what `encode` wrote. Throws Error (place, rule, value) for anything that does not fit this graph: malformed
/// JSON, unknown version, member, rule or edge, wrong counts, broken guards or limits, more than `most_genes` genes.
Derivation decode(const GeneratorGraph& graph, std::string_view json, std::uint32_t most_genes = 4'000'000,
                  Fit fit = Fit::same_grammar);

/// Empty if `derivation` is a valid derivation of `graph`, otherwise what is wrong with it and where. Trusts nothing
/// and checks everything: counts, edges against slots, variants, limits, and unless it need only be adaptable, guards
/// and probabilities. Linear time.
std::string find_fault(const GeneratorGraph& graph, const Derivation& derivation, Fit fit = Fit::valid);

}  // namespace espalier
