#include "derivation/join.h"

#include <gtest/gtest.h>

#include "derivation/crossover.h"
#include "derivation/encode.h"
#include "derivation/nudge.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

/// A derivation as a tree of nodes, to merge by recursion: what the slices must come to.
struct Node {
  EdgeId edge = 0;
  std::uint16_t variant = 0;
  std::vector<std::uint32_t> draws;
  std::vector<SlotState> slots;
  std::vector<std::optional<Node>> children;  // one per slot

  bool operator==(const Node&) const = default;
  bool same_gene(const Node& other) const {
    return edge == other.edge && variant == other.variant && draws == other.draws;
  }
};

Node tree_of(const GeneratorGraph& graph, const Derivation& d, const GenePosition& at = {}) {
  const Variant& variant = variant_of(graph, d.genes[at.gene]);
  Node node{d.genes[at.gene].edge, d.genes[at.gene].variant, {}, {}, {}};
  node.draws.assign(d.draws.begin() + at.draw, d.draws.begin() + at.draw + static_cast<long>(variant.draws.size()));
  node.slots.assign(d.slots.begin() + at.slot, d.slots.begin() + at.slot + static_cast<long>(variant.slots.size()));
  node.children.resize(variant.slots.size());
  for_each_child(graph, d, at, [&](std::uint32_t slot, const GenePosition& child) {
    node.children[slot] = tree_of(graph, d, child);
  });
  return node;
}

/// Three-way: what one of two changed, and where both did, what is below.
Node merged(const Node& base, const Node& a, const Node& b) {
  if (a == base) return b;
  if (b == base) return a;
  EXPECT_TRUE(base.same_gene(a) && base.same_gene(b)) << "changes are not apart";
  Node node = base;
  for (std::size_t k = 0; k < base.slots.size(); ++k) {
    const bool of_a = a.slots[k] != base.slots[k] || a.children[k] != base.children[k];
    const bool of_b = b.slots[k] != base.slots[k] || b.children[k] != base.children[k];
    const Node& from = of_a ? a : b;
    node.slots[k] = from.slots[k], node.children[k] = from.children[k];
    if (!of_a || !of_b) continue;
    EXPECT_TRUE(base.children[k] && a.children[k] && b.children[k]) << "changes are not apart";
    node.children[k] = merged(*base.children[k], *a.children[k], *b.children[k]);
  }
  return node;
}

bool any_move(const GeneratorGraph& graph, Derivation& derivation, RandomStream& random) {
  switch (random.below(4)) {
    case 0: return grow(graph, derivation, {}, random);
    case 1: return cut(graph, derivation, {}, random);
    case 2: return alter(graph, derivation, {}, random);
    default: return nudge(graph, derivation, {}, random);
  }
}

bool breaks_a_limit(const std::string& fault) { return fault.find("limit") != std::string::npos; }

TEST(Join, OfRandomChangesIsWhatMergingTreesGives) {
  int joined_many = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = seed % 4 ? random_graph(random) : guarded_tree(5);
    const std::optional<Derivation> parent = random_derivation(graph, random);
    if (!parent) continue;
    std::vector<Derivation> children(8, *parent);
    std::vector<Change> changes;
    Node expected = tree_of(graph, *parent);
    for (Derivation& child : children) {
      Change change;
      if (!any_move(graph, child, random) || !find_change(graph, *parent, child, change)) continue;
      const bool apart =
          std::all_of(changes.begin(), changes.end(), [&](const Change& c) { return are_apart(c, change); });
      refused += !apart;
      if (!apart) continue;
      changes.push_back(change);
      expected = merged(tree_of(graph, *parent), expected, tree_of(graph, child));
    }
    joined_many += changes.size() > 2;
    Derivation joined;
    join(graph, *parent, changes, joined);
    const std::string fault = find_fault(graph, joined);
    ASSERT_TRUE(fault.empty() || breaks_a_limit(fault)) << fault << ", seed " << seed;
    ASSERT_EQ(tree_of(graph, joined), expected) << "seed " << seed;
    ASSERT_EQ(joined.detail_seed, parent->detail_seed);
  }
  EXPECT_GT(joined_many, 300);
  EXPECT_GT(refused, 100);
}

TEST(Join, OfOneChangeIsTheChild) {
  int checked = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = guarded_tree(6);
    const std::optional<Derivation> parent = random_derivation(graph, random), other = random_derivation(graph, random);
    if (!parent || !other) continue;
    Derivation child = *parent, crossed, joined;
    Change change;
    EXPECT_FALSE(find_change(graph, *parent, child, change)) << "there is none";
    if (random.chance(0.5)) {
      crossover(graph, *parent, *other, {}, {}, {}, random, child, crossed);
    } else {
      any_move(graph, child, random);
    }
    if (!find_change(graph, *parent, child, change)) continue;
    std::vector<Change> changes = {change};
    join(graph, *parent, changes, joined);
    ASSERT_EQ(joined, child) << "seed " << seed;
    ++checked;
  }
  EXPECT_GT(checked, 200);
}

TEST(Join, AChangeIsAsSmallAsCanBe) {
  const GeneratorGraph graph = guarded_tree(6);
  RandomStream random = stream(4);
  Derivation parent;
  while (parent.size() < 30) parent = random_derivation(graph, random).value_or(Derivation{});
  for (int i = 0; i < 50; ++i) {
    Derivation child = parent;
    Change change;
    if (!grow(graph, child, {}, random)) continue;
    ASSERT_TRUE(find_change(graph, parent, child, change));
    EXPECT_EQ(change.removed.genes, 0u) << "growing replaces nothing";
    EXPECT_EQ(change.inserted.genes, child.size() - parent.size());
    EXPECT_EQ(change.state, SlotState::filled);
    EXPECT_FALSE(are_apart(change, change));
  }
}

}  // namespace
}  // namespace espalier
