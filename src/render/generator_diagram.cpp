#include "render/generator_diagram.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/counted.h"
#include "render/generator_nodes.h"

namespace espalier {
namespace {

using namespace diagram;

constexpr const char* kTint = "#dfe9f3";
constexpr double kMargin = 24, kTitle = 18;

class GeneratorDrawing {
 public:
  GeneratorDrawing(const GeneratorGraph& graph, const GrammarOutline& outline)
      : graph_(graph), content_(generator_nodes(graph, outline)) {}

  std::string draw();

 private:
  void draw_node(const GeneratorNode& node, Point2 at);
  void draw_loops(const GeneratorNode& node, Point2 at);
  void draw_label(Point2 centre, const GeneratorArrow& arrow);
  double draw_key(double y);

  const GeneratorGraph& graph_;
  GeneratorNodes content_;
  SvgWriter svg_;
};

void GeneratorDrawing::draw_label(Point2 centre, const GeneratorArrow& arrow) {
  if (arrow.label.empty()) return;
  const double width = text_width(arrow.label, kSmall) + 6;
  svg_.rect({centre.x - width / 2, centre.y - 8}, {width, 16}, 3, {"#ffffff", "", 0, ""});
  svg_.text({centre.x, centre.y + 4}, arrow.label, {kSmall, arrow.ink, false, false, Anchor::middle});
}

// Right of the box, one below the other: out at the upper end, in at the lower.
void GeneratorDrawing::draw_loops(const GeneratorNode& node, Point2 at) {
  const double each = node.box.height / static_cast<double>(node.loops.size());
  const double x = at.x + node.box.width, half = std::min(each / 2 - 4, 10.0);
  for (std::size_t i = 0; i < node.loops.size(); ++i) {
    const GeneratorArrow& loop = node.loops[i];
    const double y = at.y + (static_cast<double>(i) + 0.5) * each, out = x + kLoopReach * 1.25;
    svg_.path(fmt::format("M{} {}C{} {} {} {} {} {}", svg_number(x), svg_number(y - half), svg_number(out),
                          svg_number(y - half - 3), svg_number(out), svg_number(y + half + 3), svg_number(x),
                          svg_number(y + half)),
              loop.style, true, loop.hint);
    svg_.text({x + kLoopReach + 3, y + 4}, loop.label, {kSmall, loop.ink});
  }
}

void GeneratorDrawing::draw_node(const GeneratorNode& node, Point2 at) {
  const Point2 size{node.box.width, node.box.height};
  if (node.detail) {
    svg_.rect(at, size, 12, {"#f6f7f9", kDetail, 1, ""}, node.hint);
    svg_.text({at.x + size.x / 2, at.y + 17}, node.heading, {12, kQuiet, false, true, Anchor::middle});
    return;
  }
  svg_.rect(at, size, 6, {"#ffffff", kInk, 1.2, ""}, node.hint.empty() ? node.heading : node.hint);
  const double x = at.x, y = at.y, w = size.x;
  const bool only = node.box.height < kHeadingHeight + 1;
  const std::string heading = fmt::format(
      "M{0} {2}v-{3}q0 -6 6 -6h{4}q6 0 6 6v{3}{5}z", svg_number(x), 0, svg_number(y + kHeadingHeight - (only ? 6 : 0)),
      svg_number(kHeadingHeight - (only ? 12 : 6)), svg_number(w - 12),
      only ? fmt::format("q0 6 -6 6h-{}q-6 0 -6 -6", svg_number(w - 12)) : "");
  svg_.path(heading, {node.start ? "#1f4e79" : kTint, kInk, 1.2, ""});
  svg_.text({x + kPadding, y + 17.5}, node.heading, {kHeading, node.start ? "#ffffff" : kInk, true});
  if (node.start) svg_.text({x + w - kPadding, y + 17}, "start", {kSmall, "#ffffff", false, true, Anchor::end});
  double line = y + kHeadingHeight + kLineHeight;
  for (const std::string& text : node.lines) svg_.text({x + kPadding, line}, text, {kBody, kInk}), line += kLineHeight;
  for (const std::string& text : node.notes) {
    svg_.text({x + kPadding, line}, text, {kBody, kQuiet, false, true});
    line += kLineHeight;
  }
}

// What the lines mean; returns its width.
double GeneratorDrawing::draw_key(double y) {
  struct Entry {
    const char* words;
    SvgStyle style;
  };
  std::vector<Entry> entries = {{"required child", {"", kInk, 1.4, ""}},
                                {"optional child and its probability", {"", kOptional, 1.4, kOptionalDashes}}};
  if (!graph_.details.empty()) entries.push_back({"calls a detail", {"", kDetail, 1, kDetailDashes}});
  double x = kMargin;
  for (const Entry& entry : entries) {
    svg_.path(fmt::format("M{} {}h30", svg_number(x), svg_number(y - 4)), entry.style, true);
    svg_.text({x + 37, y}, entry.words, {kSmall, kQuiet});
    x += 37 + text_width(entry.words, kSmall) + 20;
  }
  constexpr const char* kSlots = "\u00d7n: n slots";
  svg_.text({x, y}, kSlots, {kSmall, kQuiet});
  return x + text_width(kSlots, kSmall);
}

std::string GeneratorDrawing::draw() {
  std::vector<LayerNode> boxes;
  std::vector<LayerEdge> edges;
  for (const GeneratorNode& node : content_.nodes) boxes.push_back(node.box);
  for (const GeneratorArrow& arrow : content_.arrows) {
    const bool empty = arrow.label.empty();
    edges.push_back({arrow.from, arrow.to, empty ? 0 : text_width(arrow.label, kSmall) + 8, empty ? 6.0 : 16.0});
  }
  const LayeredLayout layout = lay_out_graph(boxes, edges);
  const std::string title = graph_.name;
  const std::string counts = fmt::format("{}, {}, {}", counted(graph_.rules.size(), "rule"),
                                         counted(graph_.edges.size() - 1, "edge"),
                                         counted(graph_.details.size(), "detail"));
  svg_.text({kMargin, kMargin + 12}, title, {kTitle, kInk, true});
  svg_.text({kMargin, kMargin + 29}, counts, {kSmall, kQuiet});
  const double top = kMargin + 48, bottom = top + layout.size.y + 34;
  const double key = draw_key(bottom);
  const double width =
      std::max({layout.size.x, key - kMargin, text_width(title, kTitle, true), text_width(counts, kSmall)});
  const double left = kMargin + (width - layout.size.x) / 2;
  for (std::size_t e = 0; e < content_.arrows.size(); ++e) {
    std::vector<Point2> points = layout.routes[e].points;
    for (Point2& p : points) p.x += left, p.y += top;
    svg_.path(route_path(points), content_.arrows[e].style, true, content_.arrows[e].hint);
  }
  for (std::size_t e = 0; e < content_.arrows.size(); ++e) {
    draw_label({layout.routes[e].label.x + left, layout.routes[e].label.y + top}, content_.arrows[e]);
  }
  for (std::size_t n = 0; n < content_.nodes.size(); ++n) {
    const Point2 at{layout.boxes[n].x + left, layout.boxes[n].y + top};
    draw_node(content_.nodes[n], at);
    if (!content_.nodes[n].loops.empty()) draw_loops(content_.nodes[n], at);
  }
  return svg_.document({width + 2 * kMargin, bottom + kMargin}, title + ": generator graph", counts);
}

}  // namespace

std::string generator_diagram(const GeneratorGraph& graph, const GrammarOutline& outline) {
  return GeneratorDrawing(graph, outline).draw();
}

}  // namespace espalier
