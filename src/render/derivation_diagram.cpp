#include "render/derivation_diagram.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/check.h"
#include "base/counted.h"
#include "derivation/sweep.h"
#include "render/gene_text.h"
#include "render/rule_palette.h"
#include "render/svg.h"
#include "render/tidy_tree.h"

namespace espalier {
namespace {

constexpr const char *kInk = "#1c2430", *kQuiet = "#6b7480", *kLine = "#8a94a3";
constexpr double kMargin = 24, kTitle = 18, kSmall = 11;
constexpr double kHeading = 12, kBody = 10.5, kLineHeight = 13, kWidestLine = 190;
constexpr std::size_t kMostLines = 6;  // of one gene
constexpr double kBoxGap = 5, kBoxLevelGap = 36;
constexpr double kDot = 3.5, kDotGap = 3;
constexpr std::size_t kMostRulesInLegend = kRuleColors.size() * kRuleShapes;

/// A gene, or a slot without one.
struct Mark {
  SlotState state = SlotState::filled;
  GenePosition gene{};  // filled
  RuleId rule = 0;
  std::string heading{}, hint{};
  std::vector<std::string> lines{};
  Point2 size{10, 12};
};

class DerivationDrawing {
 public:
  DerivationDrawing(const GeneratorGraph& graph, const Derivation& derivation, const GrammarOutline& outline,
                    const std::vector<std::optional<float>>& values)
      : graph_(graph), derivation_(derivation), outline_(outline), values_(values),
        boxes_(derivation.size() <= kMostBoxedGenes) {
    CHECK(values.size() == derivation.draws.size() && derivation.size() > 0);
  }

  std::string run() {
    collect();
    places_ = lay_out_tree(nodes_, boxes_ ? kBoxGap : kDotGap);
    for (const TidyPlace& place : places_) columns_ = std::max<std::size_t>(columns_, place.level + 1);
    place_marks();
    const double bottom = top_ + extent_.y + 10 + 24 * zoom_;
    const double width = std::max(draw_titles(), draw_legend(bottom));
    shift_ = kMargin + std::max(0.0, (width - extent_.x) / 2);
    for (std::uint32_t n = 1; n < nodes_.size(); ++n) draw_link(n);
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) boxes_ ? draw_box(n) : draw_dot(n);
    return svg_.document({std::max(extent_.x, width) + 2 * kMargin, bottom + legend_height_ + kMargin},
                         graph_.name + ": derivation", about());
  }

 private:
  // Level by level, so that what is left out of a large derivation are its deepest genes.
  void collect() {
    add_gene({}, kNoNode);
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
      if (marks_[n].state != SlotState::filled) continue;
      const GenePosition gene = marks_[n].gene;
      const Variant& variant = variant_of(graph_, derivation_.genes[gene.gene]);
      std::vector<GenePosition> children(variant.slots.size());
      for_each_child(graph_, derivation_, gene,
                     [&](std::uint32_t slot, const GenePosition& child) { children[slot] = child; });
      for (std::size_t k = 0; k < variant.slots.size(); ++k) {
        const SlotState state = derivation_.slots[gene.slot + k];
        const std::string& slot = graph_.rules[marks_[n].rule].slots[variant.slots[k]].name;
        if (state != SlotState::filled) add_slot(state, slot, n);
        else if (genes_drawn_ < kMostDrawnGenes) add_gene(children[k], n);
      }
    }
  }

  void add_gene(const GenePosition& at, std::uint32_t parent) {
    const GeneRecord& gene = derivation_.genes[at.gene];
    const Variant& variant = variant_of(graph_, gene);
    Mark mark{.gene = at, .rule = graph_.edges[gene.edge].child};
    const std::string& rule = graph_.rules[mark.rule].name;
    mark.heading = variant.name.empty() ? rule : fmt::format("{} ({})", rule, variant.name);
    mark.hint = fmt::format("gene {}: {}", at.gene, mark.heading);
    ++genes_drawn_;
    if (boxes_) fill_box(mark);
    const double breadth = boxes_ ? mark.size.y : 2 * kDot;
    nodes_.push_back({parent, breadth});
    marks_.push_back(std::move(mark));
  }

  void fill_box(Mark& mark) {
    mark.lines = gene_lines(graph_, derivation_, mark.gene, outline_, values_);
    for (const std::string& line : mark.lines) mark.hint += "\n" + line;
    if (mark.lines.size() > kMostLines) {
      const std::size_t more = mark.lines.size() - (kMostLines - 1);
      mark.lines.resize(kMostLines - 1);
      mark.lines.push_back(fmt::format("and {} more", more));
    }
    double width = text_width(mark.heading, kHeading, true);
    for (std::string& line : mark.lines) {
      line = fitted(line, kWidestLine, kBody);
      width = std::max(width, text_width(line, kBody));
    }
    const double lines = static_cast<double>(mark.lines.size());
    mark.size = {std::ceil(width) + 20, 20 + (lines > 0 ? lines * kLineHeight + 3 : 0)};
  }

  void add_slot(SlotState state, const std::string& slot, std::uint32_t parent) {
    constexpr const char* kWords[] = {"open: not decided yet", "empty", "", "absent: the guard of its rule fails here"};
    if (!boxes_) return;
    Mark mark{.state = state};
    mark.hint = fmt::format("{}: {}", slot, kWords[static_cast<std::size_t>(state)]);
    nodes_.push_back({parent, mark.size.y});
    marks_.push_back(std::move(mark));
  }

  void place_marks();
  double draw_titles();
  double draw_legend(double y);
  void draw_link(std::uint32_t node);
  void draw_box(std::uint32_t node);
  void draw_slot(const Mark& mark, Point2 centre);
  void draw_dot(std::uint32_t node) {
    draw_shape({at_[node].x + shift_, at_[node].y}, marks_[node].rule, marks_[node].hint);
  }
  void draw_shape(Point2 centre, RuleId rule, const std::string& hint, double zoom = 1);

  std::string about() const {
    std::uint32_t levels = 0;
    GeneSweep sweep;
    sweep.begin(graph_, derivation_);
    while (sweep.next()) levels = std::max(levels, sweep.above().depth + 1);
    return counted(derivation_.size(), "gene") + " on " + counted(levels, "level");
  }
  const char* color_of(RuleId rule) const { return kRuleColors[rule % kRuleColors.size()]; }

  const GeneratorGraph& graph_;
  const Derivation& derivation_;
  const GrammarOutline& outline_;
  const std::vector<std::optional<float>>& values_;
  bool boxes_;
  std::size_t genes_drawn_ = 0;
  std::size_t columns_ = 0;  // of the drawing: levels, and one for the slots below them
  std::vector<TidyNode> nodes_;
  std::vector<Mark> marks_;    // like nodes_
  std::vector<TidyPlace> places_;
  std::vector<Point2> at_;     // boxes: middle of the left side; dots: centre
  Point2 extent_{};
  double shift_ = kMargin, legend_height_ = 0;
  double zoom_ = 1, top_ = 0;  // of titles and legend, larger on large pictures; where the tree begins
  SvgWriter svg_;
};

// Boxes grow to the right, a column a level; dots grow down, with levels so far apart that the picture is no ribbon.
void DerivationDrawing::place_marks() {
  double breadth = 0;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    breadth = std::max(breadth, places_[n].centre + nodes_[n].breadth / 2);
  }
  std::vector<double> level_at(columns_, 0);
  if (boxes_) {
    std::vector<double> width(columns_, 0);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      width[places_[n].level] = std::max(width[places_[n].level], marks_[n].size.x);
    }
    for (std::size_t l = 1; l < columns_; ++l) level_at[l] = level_at[l - 1] + width[l - 1] + kBoxLevelGap;
    extent_ = {level_at.back() + width.back(), breadth};
  } else {
    const double gap = std::clamp(breadth / (2.5 * static_cast<double>(columns_)), 16.0, 160.0);
    for (std::size_t l = 1; l < columns_; ++l) level_at[l] = level_at[l - 1] + gap;
    extent_ = {breadth, level_at.back() + 2 * kDot};
  }
  zoom_ = std::clamp(extent_.x / 1600, 1.0, 6.0);
  top_ = kMargin + 48 * zoom_;
  for (const TidyPlace& place : places_) {
    const double along = level_at[place.level];
    at_.push_back(boxes_ ? Point2{along, top_ + place.centre} : Point2{place.centre, top_ + kDot + along});
  }
}

double DerivationDrawing::draw_titles() {
  std::string line = about();
  if (genes_drawn_ < derivation_.size()) {
    line += fmt::format("; only the first {} are drawn, level by level: {} are left out", genes_drawn_,
                        derivation_.size() - genes_drawn_);
  }
  svg_.text({kMargin, kMargin + 12 * zoom_}, graph_.name, {kTitle * zoom_, kInk, true});
  svg_.text({kMargin, kMargin + 29 * zoom_}, line, {kSmall * zoom_, kQuiet});
  return std::max(text_width(graph_.name, kTitle * zoom_, true), text_width(line, kSmall * zoom_));
}

// One entry a rule, with its number of genes; lines break so that they are no wider than the tree, but at least 600.
double DerivationDrawing::draw_legend(double y) {
  std::vector<std::size_t> genes(graph_.rules.size(), 0);
  for (const GeneRecord& gene : derivation_.genes) ++genes[graph_.edges[gene.edge].child];
  std::size_t slots[4] = {};  // by state
  for (const SlotState state : derivation_.slots) ++slots[static_cast<std::size_t>(state)];
  const double room = std::max(extent_.x, 600.0);
  double x = kMargin, widest = 0;
  std::size_t shown = 0, others = 0;
  const auto entry = [&](const std::string& words, auto draw_mark) {
    const double width = 32 * zoom_ + text_width(words, kSmall * zoom_);
    if (x > kMargin && x + width > kMargin + room) x = kMargin, y += 18 * zoom_, legend_height_ += 18 * zoom_;
    draw_mark(Point2{x + 5 * zoom_, y - 4 * zoom_});
    svg_.text({x + 16 * zoom_, y}, words, {kSmall * zoom_, kQuiet});
    x += width;
    widest = std::max(widest, x - kMargin - 16 * zoom_);
  };
  for (std::size_t r = 0; r < genes.size(); ++r) {
    if (genes[r] == 0) continue;
    if (++shown > kMostRulesInLegend) ++others;
    else entry(fmt::format("{} {}", graph_.rules[r].name, genes[r]),
               [&](Point2 at) { draw_shape(at, static_cast<RuleId>(r), "", zoom_); });
  }
  if (others > 0) entry(fmt::format("and {} more rules", others), [](Point2) {});
  constexpr const char* kWords[] = {"open", "empty", "", "absent"};
  for (const std::size_t state : {1, 0, 3}) {
    if (slots[state] == 0) continue;
    const std::string words = fmt::format("{} {} slots", slots[state], kWords[state]);
    entry(boxes_ ? words : words + ", not drawn", [&](Point2 at) {
      if (boxes_) draw_slot(Mark{.state = static_cast<SlotState>(state)}, at);
    });
  }
  return widest;
}

void DerivationDrawing::draw_link(std::uint32_t node) {
  const std::uint32_t parent = nodes_[node].parent;
  Point2 from = at_[parent], to = at_[node];
  from.x += shift_ + (boxes_ ? marks_[parent].size.x : 0);
  to.x += shift_;
  // From afar only lines are seen, so they take the colour of the gene that they lead to.
  if (!boxes_) return svg_.line(from, to, {"", color_of(marks_[node].rule), 0.7 * std::min(zoom_, 3.0), ""});
  const SvgStyle style{"", marks_[node].state == SlotState::filled ? kLine : "#c3c9d1", 1.1, ""};
  // The columns are as wide as their widest box: first straight to the end of the column, then over.
  const double turn = to.x - kBoxLevelGap, middle = turn + kBoxLevelGap / 2;
  svg_.path(fmt::format("M{0} {1}H{2}C{3} {1} {3} {4} {5} {4}", svg_number(from.x), svg_number(from.y),
                        svg_number(std::max(turn, from.x)), svg_number(middle), svg_number(to.y), svg_number(to.x)),
            style);
}

void DerivationDrawing::draw_box(std::uint32_t node) {
  const Mark& mark = marks_[node];
  Point2 at = at_[node];
  at.x += shift_;
  if (mark.state != SlotState::filled) return draw_slot(mark, {at.x + 5, at.y});
  at.y -= mark.size.y / 2;
  svg_.rect(at, mark.size, 4, {"#ffffff", kInk, 1, ""}, mark.hint);
  svg_.rect({at.x, at.y}, {6, mark.size.y}, 2, {color_of(mark.rule), "", 0, ""});
  svg_.text({at.x + 12, at.y + 14}, mark.heading, {kHeading, kInk, true});
  double y = at.y + 14;
  for (const std::string& line : mark.lines) svg_.text({at.x + 12, y += kLineHeight}, line, {kBody, kInk});
}

void DerivationDrawing::draw_slot(const Mark& mark, Point2 centre) {
  switch (mark.state) {
    case SlotState::open: return svg_.circle(centre, 4.5, {"#ffffff", kInk, 1, "2 2"}, mark.hint);
    case SlotState::empty: return svg_.circle(centre, 3, {"#ffffff", kLine, 1, ""}, mark.hint);
    case SlotState::absent: return svg_.circle(centre, 2, {"#c3c9d1", "", 0, ""}, mark.hint);
    case SlotState::filled: break;
  }
}

// Colours first, then shapes.
void DerivationDrawing::draw_shape(Point2 c, RuleId rule, const std::string& hint, double zoom) {
  const SvgStyle style{color_of(rule), "", 0, ""};
  const auto n = [](double v) { return svg_number(v); };
  const std::string move = fmt::format("M{} {}", n(c.x), n(c.y - 4 * zoom));
  switch (rule / kRuleColors.size() % kRuleShapes) {
    case 0: return svg_.circle(c, kDot * zoom, style, hint);
    case 1: return svg_.rect({c.x - 3 * zoom, c.y - 3 * zoom}, {6 * zoom, 6 * zoom}, 0, style, hint);
    case 2: return svg_.path(fmt::format("{0}l{1} {1}l-{1} {1}l-{1} -{1}z", move, n(4 * zoom)), style, false, hint);
    default: return svg_.path(fmt::format("{}l{} {}h-{}z", move, n(4 * zoom), n(7 * zoom), n(8 * zoom)), style, false,
                              hint);
  }
}

}  // namespace

std::string derivation_diagram(const GeneratorGraph& graph, const Derivation& derivation, const GrammarOutline& outline,
                               const std::vector<std::optional<float>>& values) {
  return DerivationDrawing(graph, derivation, outline, values).run();
}

}  // namespace espalier
