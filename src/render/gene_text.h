#pragma once
// The draws of a gene as short lines of text: "k 0.92, 1.1, 0.7", "lean 12.5°", "shape cone".

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "derivation/position.h"
#include "grammar/outline.h"

namespace espalier {

/// A draw's value with three digits: "0.92", "12.5" and `degrees`, "true", "cone"; "u 0.3", its quantile, where there is no
/// value. `draw` may be null: what the grammar says of it is not known.
std::string draw_text(const DrawOutline* draw, std::optional<float> value, std::uint32_t quantile,
                      std::string_view degrees);
/// One line a draw of the gene at `position`; `values` and the rest as in derivation_diagram.
std::vector<std::string> gene_lines(const GeneratorGraph& graph, const Derivation& derivation,
                                    const GenePosition& position, const GrammarOutline& outline,
                                    std::span<const std::optional<float>> values);

}  // namespace espalier
