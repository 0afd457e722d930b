#pragma once
// The derivation tree of a model as a picture: its genes and which stands in whose slot. (ShapeGenetics 2017, figures
// 4b and 4c.) Small derivations from left to right, a box a gene with its variant and the values of its draws, empty
// slots as small circles, open ones dashed; large ones from top to bottom, a dot a gene, coloured by rule.

#include <optional>
#include <string>
#include <vector>

#include "derivation/derivation.h"
#include "grammar/outline.h"

namespace espalier {

inline constexpr std::size_t kMostBoxedGenes = 200;  // more are dots
inline constexpr std::size_t kMostDrawnGenes = 5000;  // more are left out, the deepest first, and the picture says so

/// An SVG document. `values`: see draw_values; where there is none the quantile is shown ("u 0.25"), and where the
/// outline lacks a draw its plain number.
std::string derivation_diagram(const GeneratorGraph& graph, const Derivation& derivation, const GrammarOutline& outline,
                               const std::vector<std::optional<float>>& values);

}  // namespace espalier
