#pragma once
// What a generator diagram shows, before it has places: nodes with their words and sizes, arrows with their labels.
// Internal to generator_diagram.

#include <string>
#include <vector>

#include "grammar/graph.h"
#include "grammar/outline.h"
#include "render/layered_layout.h"
#include "render/svg.h"

namespace espalier {

namespace diagram {
inline constexpr const char *kInk = "#1c2430", *kOptional = "#0072b2", *kQuiet = "#6b7480", *kDetail = "#a3abb5";
inline constexpr const char *kOptionalDashes = "6 4", *kDetailDashes = "1.5 3";
inline constexpr double kHeading = 14, kBody = 11.5, kSmall = 11;  // sizes of text
inline constexpr double kHeadingHeight = 25, kLineHeight = 16, kPadding = 10, kLoopReach = 30;
}  // namespace diagram

/// A `spawn`, or a detail that is called.
struct GeneratorArrow {
  std::uint32_t from = 0, to = 0;
  std::string label, hint;
  SvgStyle style;
  const char* ink = "";  // of the label
};

/// A rule or a detail.
struct GeneratorNode {
  std::string heading, hint;
  std::vector<std::string> lines, notes;  // draws; guard, limit, variants
  bool start = false, detail = false;
  std::vector<GeneratorArrow> loops;
  LayerNode box;
};

struct GeneratorNodes {
  std::vector<GeneratorNode> nodes;    // the rules, then the details
  std::vector<GeneratorArrow> arrows;  // between different nodes
};

GeneratorNodes generator_nodes(const GeneratorGraph& graph, const GrammarOutline& outline);

}  // namespace espalier
