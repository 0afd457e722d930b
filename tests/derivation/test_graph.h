#pragma once
// Generator graphs made by hand, for tests of everything that works on derivations. Programs are empty.

#include <string>
#include <utility>
#include <vector>

#include "grammar/graph.h"

namespace espalier::test {

/// depth < n
inline DepthValue depth_below(double n) {
  using Step = DepthValue::Step;
  return DepthValue(std::vector<Step>{{Step::Kind::depth, Arithmetic::add, 0, 0},
                                      {Step::Kind::constant, Arithmetic::add, 0, n},
                                      {Step::Kind::apply, Arithmetic::less, 0, 0}});
}
/// depth(R) < n, R = counted_rules[index]
inline DepthValue count_below(std::uint16_t index, double n) {
  using Step = DepthValue::Step;
  return DepthValue(std::vector<Step>{{Step::Kind::depth_of, Arithmetic::add, index, 0},
                                      {Step::Kind::constant, Arithmetic::add, 0, n},
                                      {Step::Kind::apply, Arithmetic::less, 0, 0}});
}
/// depth < n ? low : high
inline DepthValue by_depth(double n, double low, double high) {
  using Step = DepthValue::Step;
  return DepthValue(std::vector<Step>{{Step::Kind::depth, Arithmetic::add, 0, 0},
                                      {Step::Kind::constant, Arithmetic::add, 0, n},
                                      {Step::Kind::apply, Arithmetic::less, 0, 0},
                                      {Step::Kind::constant, Arithmetic::add, 0, low},
                                      {Step::Kind::constant, Arithmetic::add, 0, high},
                                      {Step::Kind::apply, Arithmetic::select, 0, 0}});
}

class GraphBuilder {
 public:
  explicit GraphBuilder(std::string name) {
    graph_.name = std::move(name);
    graph_.source_hash = "hash of " + graph_.name;
    graph_.edges.resize(1);
  }

  /// The first rule is the start rule.
  RuleId rule(const std::string& name, int draws = 0) {
    Rule rule;
    rule.name = name;
    for (int d = 0; d < draws; ++d) rule.draws.push_back({name + ".u" + std::to_string(d), DrawShape::continuous, 0});
    graph_.rules.push_back(std::move(rule));
    return static_cast<RuleId>(graph_.rules.size() - 1);
  }
  void guard(RuleId rule, DepthValue holds) {
    graph_.rules[rule].guard = std::move(holds);
    graph_.rules[rule].guarded = true;
  }
  void limit(RuleId rule, std::uint32_t most) { graph_.rules[rule].limit = most; }
  /// depth(rule) is read somewhere: its index.
  std::uint16_t count(RuleId rule) {
    graph_.rules[rule].counted = static_cast<std::uint16_t>(graph_.counted_rules.size());
    graph_.counted_rules.push_back(rule);
    return *graph_.rules[rule].counted;
  }
  /// One `maybe p spawn` with so many slots in a row.
  EdgeId maybe(RuleId parent, RuleId child, DepthValue p, int slots = 1) {
    return edge(parent, child, false, std::move(p), slots);
  }
  EdgeId spawn(RuleId parent, RuleId child, int slots = 1) { return edge(parent, child, true, 1, slots); }

  /// A rule without variants gets one, with all its draws and slots.
  void variant(RuleId rule, DepthValue probability, std::vector<std::uint16_t> draws,
               std::vector<std::uint16_t> slots) {
    std::vector<Variant>& variants = graph_.rules[rule].variants;
    Variant variant;
    variant.name = std::to_string(variants.size() + 1);
    variant.probability = std::move(probability);
    variant.draws = std::move(draws);
    variant.slots = std::move(slots);
    variants.push_back(std::move(variant));
  }

  GeneratorGraph build() {
    for (Rule& rule : graph_.rules) {
      name_slots(rule);
      if (!rule.variants.empty()) continue;
      Variant all;
      for (std::size_t d = 0; d < rule.draws.size(); ++d) all.draws.push_back(static_cast<std::uint16_t>(d));
      for (std::size_t s = 0; s < rule.slots.size(); ++s) all.slots.push_back(static_cast<std::uint16_t>(s));
      rule.variants.push_back(std::move(all));
    }
    return graph_;
  }

 private:
  EdgeId edge(RuleId parent, RuleId child, bool required, DepthValue p, int slots) {
    Edge edge;
    edge.parent = parent;
    edge.child = child;
    edge.required = required;
    edge.probability = std::move(p);
    edge.name = graph_.rules[parent].name + "/" + graph_.rules[child].name;
    graph_.edges.push_back(std::move(edge));
    const EdgeId id = static_cast<EdgeId>(graph_.edges.size() - 1);
    for (int s = 0; s < slots; ++s) graph_.rules[parent].slots.push_back({"", id});
    return id;
  }
  void name_slots(Rule& rule) {
    for (std::size_t s = 0; s < rule.slots.size(); ++s) {
      const RuleId child = graph_.edges[rule.slots[s].edge].child;
      int before = 0, all = 0;
      for (std::size_t t = 0; t < rule.slots.size(); ++t) {
        if (graph_.edges[rule.slots[t].edge].child != child) continue;
        ++all;
        if (t < s) ++before;
      }
      rule.slots[s].name = graph_.rules[child].name;
      if (all > 1) rule.slots[s].name += "[" + std::to_string(before) + "]";
    }
  }

  GeneratorGraph graph_;
};

/// The spaceship of language.md 4: a hull of bodies, wings at their sides, towers on top.
inline GeneratorGraph spaceship() {
  GraphBuilder b("spaceship");
  const RuleId ship = b.rule("Ship"), body = b.rule("Body", 3);
  const RuleId wing = b.rule("Wing", 4), wing_part = b.rule("WingPart", 4);
  const RuleId top = b.rule("Top", 3), top_part = b.rule("TopPart", 3);
  b.spawn(ship, body);
  b.maybe(body, body, 1.0 / 3);
  b.maybe(body, wing, 1.0 / 3);
  b.maybe(body, top, 1.0 / 3);
  b.maybe(wing, wing_part, 0.9);
  b.maybe(wing_part, wing_part, 0.9);
  b.maybe(top, top_part, 0.9);
  b.maybe(top_part, top_part, 0.9);
  return b.build();
}

/// A tree of three rules of branches with a guard by depth: slots of one edge, of several edges to one rule.
inline GeneratorGraph guarded_tree(double most_depth = 8) {
  GraphBuilder b("tree");
  const RuleId trunk = b.rule("Trunk", 1), branch = b.rule("Branch", 3), leader = b.rule("Leader", 2);
  b.guard(branch, depth_below(most_depth));
  b.guard(leader, depth_below(most_depth));
  for (const RuleId rule : {trunk, branch, leader}) {
    b.maybe(rule, branch, 0.4, 2);
    b.maybe(rule, leader, 0.5);
  }
  return b.build();
}

}  // namespace espalier::test
