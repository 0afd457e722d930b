#include "render/generator_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/counted.h"
#include "render/rule_palette.h"

namespace espalier {
namespace {

using namespace diagram;

constexpr double kWidestLine = 340, kLoopHeight = 22;

bool is_number(std::string_view text) { return text.find_first_not_of("0123456789./%") == std::string_view::npos; }

std::string multiplied(std::size_t count) { return count > 1 ? fmt::format("\u00d7{}", count) : ""; }

class Collector {
 public:
  Collector(const GeneratorGraph& graph, const GrammarOutline& outline) : graph_(graph), outline_(outline) {}

  GeneratorNodes run() {
    for (const Rule& rule : graph_.rules) add_rule(rule);
    for (std::size_t e = 1; e < graph_.edges.size(); ++e) add_edge(static_cast<EdgeId>(e));
    for (std::size_t d = 0; d < graph_.details.size(); ++d) add_detail(d);
    add_calls();
    for (Node& node : nodes_) measure(node);
    return {std::move(nodes_), std::move(arrows_)};
  }

 private:
  using Node = GeneratorNode;
  using Arrow = GeneratorArrow;

  void add_rule(const Rule& rule) {
    Node& node = nodes_.emplace_back();
    node.start = &rule == &graph_.rules[graph_.start()];
    node.heading = rule.name;
    const auto written = outline_.rules.find(rule.name);
    const bool known = written != outline_.rules.end();
    if (known && !written->second.parameters.empty()) {
      node.heading += fmt::format("({})", fmt::join(written->second.parameters, ", "));
    }
    known ? add_written_draws(rule, written->second, node) : add_named_draws(rule, node);
    const std::string guard = known ? written->second.guard : "";
    if (rule.guarded) node.notes.push_back(guard.empty() ? "has a guard" : "when " + guard);
    if (rule.limit) node.notes.push_back(fmt::format("limit {}", *rule.limit));
    if (rule.variants.size() > 1) node.notes.push_back(fmt::format("{} variants", rule.variants.size()));
  }

  // One line a statement; those that no loop or condition leaves in the graph are not shown.
  static void add_written_draws(const Rule& rule, const RuleOutline& written, Node& node) {
    std::map<std::string_view, std::size_t> components, statements;
    for (const DrawComponent& draw : rule.draws) ++components[draw_base(draw.name)];
    for (const DrawOutline& draw : written.draws) ++statements[draw.name];
    for (const DrawOutline& draw : written.draws) {
      const std::size_t width = static_cast<std::size_t>(components_of(draw.kind)) * statements[draw.name];
      const std::size_t turns = components[draw.name] / width;
      if (components[draw.name] == 0) continue;
      node.lines.push_back(fmt::format("{} ~ {}{}{}", draw.name, draw.text, turns > 1 ? "  " : "", multiplied(turns)));
    }
  }

  static void add_named_draws(const Rule& rule, Node& node) {
    std::vector<std::string> names;
    for (const DrawComponent& draw : rule.draws) {
      const std::string name(draw_base(draw.name));
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    for (const std::string& name : names) node.lines.push_back(name + " ~");
  }

  // As it is written, and what that comes to where it is a name for a constant.
  std::string probability(const Edge& edge) const {
    const auto found = outline_.probabilities.find({edge.span.file, edge.span.offset});
    const bool constant = edge.probability.constant();
    const std::string value = constant ? fmt::format("{:.3g}", edge.probability.at({})) : "by depth";
    if (found == outline_.probabilities.end()) return value;
    return is_number(found->second) || !constant ? found->second : fmt::format("{} = {}", found->second, value);
  }

  void add_edge(EdgeId id) {
    const Edge& edge = graph_.edges[id];
    std::size_t slots = 0;
    for (const Slot& slot : graph_.rules[edge.parent].slots) slots += slot.edge == id;
    const char* ink = edge.required ? kInk : kOptional;
    Arrow arrow{edge.parent, edge.child, "", "", {"", ink, 1.4, edge.required ? "" : kOptionalDashes}, ink};
    const std::string chance = edge.required ? "" : probability(edge);
    arrow.hint = fmt::format("{}: {}, {}", edge.name, edge.required ? "required" : "optional, " + chance,
                             counted(slots, "slot"));
    arrow.label = fitted(chance, kWidestLine / 2, kSmall);
    if (slots > 1) arrow.label += (arrow.label.empty() ? "" : " ") + multiplied(slots);
    add_arrow(std::move(arrow));
  }

  void add_arrow(Arrow arrow) {
    if (arrow.from == arrow.to) nodes_[arrow.from].loops.push_back(std::move(arrow));
    else arrows_.push_back(std::move(arrow));
  }

  void add_detail(std::size_t detail) {
    Node& node = nodes_.emplace_back();
    node.heading = node.hint = graph_.detail_names[detail];
    node.detail = true;
  }

  // Who calls which detail, and where: of "detail", "else" and "otherwise" all that apply.
  void add_calls() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<std::string>> ways;
    const auto rules = static_cast<std::uint32_t>(graph_.rules.size());
    const auto scan = [&](std::uint32_t caller, const Program& program) {
      std::set<std::uint16_t> on_empty, on_open;
      for (const SlotCode& slot : program.slots) {
        if (slot.on_empty != kNoCall) on_empty.insert(slot.on_empty);
        if (slot.on_open != kNoCall) on_open.insert(slot.on_open);
      }
      for (std::size_t c = 0; c < program.calls.size(); ++c) {
        const auto call = static_cast<std::uint16_t>(c);
        std::set<std::string>& way = ways[{caller, rules + program.calls[c].detail}];
        if (on_empty.contains(call)) way.insert("else");
        else if (on_open.contains(call)) way.insert("otherwise");
        else way.insert("");
      }
    };
    for (std::uint32_t r = 0; r < rules; ++r) {
      for (const Variant& variant : graph_.rules[r].variants) scan(r, variant.program);
    }
    for (std::uint32_t d = 0; d < graph_.details.size(); ++d) scan(rules + d, graph_.details[d]);
    for (const auto& [ends, way] : ways) {
      std::string label = way.contains("") ? "" : fmt::format("{}", fmt::join(way, ", "));
      const std::string& caller = ends.first < rules ? graph_.rules[ends.first].name : nodes_[ends.first].heading;
      const std::string hint = fmt::format("{} calls {}", caller, nodes_[ends.second].heading);
      add_arrow({ends.first, ends.second, label, hint, {"", kDetail, 1, kDetailDashes}, kQuiet});
    }
  }

  static void measure(Node& node) {
    double width = text_width(node.heading, kHeading, !node.detail) + (node.start ? 40 : 0);
    for (std::string& line : node.lines) {
      node.hint += (node.hint.empty() ? "" : "\n") + line;
      line = fitted(line, kWidestLine, kBody);
      width = std::max(width, text_width(line, kBody));
    }
    for (std::string& note : node.notes) {
      node.hint += (node.hint.empty() ? "" : "\n") + note;
      note = fitted(note, kWidestLine, kBody);
      width = std::max(width, text_width(note, kBody));
    }
    const double lines = static_cast<double>(node.lines.size() + node.notes.size());
    node.box.width = std::ceil(width) + 2 * kPadding;
    node.box.height = kHeadingHeight + (lines > 0 ? lines * kLineHeight + 8 : 0);
    if (node.loops.empty()) return;
    node.box.height = std::max(node.box.height, static_cast<double>(node.loops.size()) * kLoopHeight);
    for (const Arrow& loop : node.loops) {
      node.box.beside = std::max(node.box.beside, kLoopReach + 6 + text_width(loop.label, kSmall));
    }
  }

  const GeneratorGraph& graph_;
  const GrammarOutline& outline_;
  std::vector<Node> nodes_;
  std::vector<Arrow> arrows_;
};

}  // namespace

GeneratorNodes generator_nodes(const GeneratorGraph& graph, const GrammarOutline& outline) {
  return Collector(graph, outline).run();
}

}  // namespace espalier
