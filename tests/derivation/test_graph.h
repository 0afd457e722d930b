#pragma once
// Generator graphs made by hand and at random, for tests of everything that works on derivations. Programs are empty.

#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
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
  const RuleId ship = b.rule("Ship"), body = b.rule("Body", 3), wing = b.rule("Wing", 4), wing_part = b.rule("WingPart", 4);
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

/// A graph in which anything may happen: guards by depth and by depth of a rule, limits, choices whose variants share and
/// lack draws and slots, weights and probabilities by depth, required recursion that a guard ends. The start rule is
/// never spawned; what is required always ends.
inline GeneratorGraph random_graph(RandomStream& random) {
  GraphBuilder b("random");
  const std::uint32_t rules = 2 + random.below(5);
  for (std::uint32_t r = 0; r < rules; ++r) b.rule("R" + std::to_string(r), static_cast<int>(random.below(4)));
  std::vector<bool> guarded(rules);
  std::vector<std::uint16_t> slots(rules);
  for (std::uint32_t r = 1; r < rules; ++r) {
    const RuleId rule = static_cast<RuleId>(r);
    guarded[r] = random.chance(0.5);
    if (guarded[r]) {
      const double most = 2 + random.below(5);
      b.guard(rule, random.chance(0.7) ? depth_below(most) : count_below(b.count(rule), most));
    }
    if (random.chance(0.2)) b.limit(rule, 1 + random.below(6));
  }
  for (std::uint32_t r = 0; r < rules; ++r) {
    const std::uint32_t edges = random.below(4) + (r == 0 ? 1 : 0);
    for (std::uint32_t e = 0; e < edges; ++e) {
      const std::uint32_t child = 1 + random.below(rules - 1);
      const int copies = 1 + static_cast<int>(random.below(2));
      const double p = 0.1 + 0.7 * random.next_unit();
      const bool ends = guarded[child] ? copies == 1 : child > r;
      if (ends && random.chance(0.3)) {
        b.spawn(static_cast<RuleId>(r), static_cast<RuleId>(child), copies);
      } else if (random.chance(0.2)) {
        b.maybe(static_cast<RuleId>(r), static_cast<RuleId>(child), by_depth(3, p, 0.5 * p), copies);
      } else {
        b.maybe(static_cast<RuleId>(r), static_cast<RuleId>(child), p, copies);
      }
      slots[r] = static_cast<std::uint16_t>(slots[r] + copies);
    }
  }
  GeneratorGraph plain = b.build();
  for (std::uint32_t r = 0; r < rules; ++r) {
    if (random.chance(0.6)) continue;
    const std::uint32_t variants = 2 + random.below(3);
    for (std::uint32_t v = 0; v < variants; ++v) {
      std::vector<std::uint16_t> draws, own;
      for (std::uint16_t d = 0; d < plain.rules[r].draws.size(); ++d) {
        if (random.chance(0.6)) draws.push_back(d);
      }
      for (std::uint16_t s = 0; s < slots[r]; ++s) {
        if (random.chance(0.7)) own.push_back(s);
      }
      const bool by = variants == 2 && random.chance(0.3);  // at depth >= 4 only the second is left
      const DepthValue probability = by ? by_depth(4, 0.5, v == 0 ? 0 : 1) : DepthValue(1.0 / variants);
      b.variant(static_cast<RuleId>(r), probability, draws, own);
    }
  }
  return b.build();
}

}  // namespace espalier::test
