#pragma once
// The generator graph of a grammar as a picture: a box per rule with its draws, guard, limit and number of variants; an
// arrow per `spawn`, solid where it is required and dashed with its probability where it is optional; details beside,
// in grey. (ShapeGenetics 2017, figures 4a and 8.)

#include <string>

#include "grammar/graph.h"
#include "grammar/outline.h"

namespace espalier {

/// An SVG document. `outline`: of the grammar's text; what it lacks is shown by name or number. Throws Error where the
/// graph is too large to draw (render/layered_layout.h).
std::string generator_diagram(const GeneratorGraph& graph, const GrammarOutline& outline);

}  // namespace espalier
