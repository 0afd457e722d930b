#pragma once
// The draws of a gene as short lines of text: "k 0.92, 1.1, 0.7", "lean 12.5°", "shape cone".

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "derivation/position.h"
#include "grammar/outline.h"

namespace espalier {

/// One line a draw of the gene at `position`; `values` and the rest as in derivation_diagram.
std::vector<std::string> gene_lines(const GeneratorGraph& graph, const Derivation& derivation,
                                    const GenePosition& position, const GrammarOutline& outline,
                                    std::span<const std::optional<float>> values);

}  // namespace espalier
