#include "render/tidy_tree.h"

#include <algorithm>
#include <map>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace espalier {
namespace {

constexpr double kGap = 3;

std::vector<TidyNode> random_tree(std::size_t most, std::uint32_t most_children) {
  const auto n = *rc::gen::inRange<std::size_t>(1, most);
  std::vector<TidyNode> nodes;
  std::vector<std::uint32_t> children;
  for (std::uint32_t v = 0; v < n; ++v) {
    TidyNode node;
    node.breadth = *rc::gen::inRange(1, 40);
    if (v > 0) {
      std::vector<std::uint32_t> free;
      for (std::uint32_t p = 0; p < v; ++p)
        if (children[p] < most_children) free.push_back(p);
      node.parent = *rc::gen::elementOf(free);
      ++children[node.parent];
    }
    nodes.push_back(node);
    children.push_back(0);
  }
  return nodes;
}

std::vector<std::vector<std::uint32_t>> children_of(const std::vector<TidyNode>& nodes) {
  std::vector<std::vector<std::uint32_t>> children(nodes.size());
  for (std::uint32_t v = 1; v < nodes.size(); ++v) children[nodes[v].parent].push_back(v);
  return children;
}

RC_GTEST_PROP(TidyTree, NothingOverlapsAndParentsStandOverTheMiddleOfTheirChildren, ()) {
  const std::vector<TidyNode> nodes = random_tree(120, 6);
  const std::vector<TidyPlace> places = lay_out_tree(nodes, kGap);
  const auto children = children_of(nodes);
  double least = 1e9;
  for (std::uint32_t v = 0; v < nodes.size(); ++v) {
    least = std::min(least, places[v].centre - nodes[v].breadth / 2);
    if (v > 0) RC_ASSERT(places[v].level == places[nodes[v].parent].level + 1);
    for (std::uint32_t w = 0; w < v; ++w) {
      if (places[v].level != places[w].level) continue;
      const double room = (nodes[v].breadth + nodes[w].breadth) / 2 + kGap;
      RC_ASSERT(std::abs(places[v].centre - places[w].centre) >= room - 1e-6);
    }
    if (children[v].empty()) continue;
    for (std::size_t i = 1; i < children[v].size(); ++i)
      RC_ASSERT(places[children[v][i - 1]].centre < places[children[v][i]].centre);
    const double middle = (places[children[v].front()].centre + places[children[v].back()].centre) / 2;
    RC_ASSERT(std::abs(middle - places[v].centre) < 1e-6);
  }
  RC_ASSERT(std::abs(least) < 1e-6);
}

// With at most two children a tidy drawing is unique: each pair of subtrees as near as their levels allow.
struct Outline {
  std::vector<double> left, right;  // by level, relative to the root
};
Outline reference(const std::vector<TidyNode>& nodes, const std::vector<std::vector<std::uint32_t>>& children,
                  std::uint32_t v, std::vector<double>& offset) {
  Outline out{{-nodes[v].breadth / 2}, {nodes[v].breadth / 2}};
  std::vector<Outline> below;
  for (const std::uint32_t c : children[v]) below.push_back(reference(nodes, children, c, offset));
  double apart = 0;
  if (below.size() == 2)
    for (std::size_t l = 0; l < std::min(below[0].left.size(), below[1].left.size()); ++l)
      apart = std::max(apart, below[0].right[l] - below[1].left[l] + kGap);
  for (std::size_t i = 0; i < below.size(); ++i) {
    const double x = below.size() == 1 ? 0 : (i == 0 ? -apart / 2 : apart / 2);
    offset[children[v][i]] = x;
    for (std::size_t l = 0; l < below[i].left.size(); ++l) {
      if (out.left.size() == l + 1) out.left.push_back(1e9), out.right.push_back(-1e9);
      out.left[l + 1] = std::min(out.left[l + 1], x + below[i].left[l]);
      out.right[l + 1] = std::max(out.right[l + 1], x + below[i].right[l]);
    }
  }
  return out;
}

RC_GTEST_PROP(TidyTree, BinaryTreesAreAsNarrowAsTheyCanBe, ()) {
  const std::vector<TidyNode> nodes = random_tree(80, 2);
  const std::vector<TidyPlace> places = lay_out_tree(nodes, kGap);
  std::vector<double> offset(nodes.size(), 0);
  reference(nodes, children_of(nodes), 0, offset);
  for (std::uint32_t v = 1; v < nodes.size(); ++v)
    RC_ASSERT(std::abs(places[v].centre - places[nodes[v].parent].centre - offset[v]) < 1e-6);
}

TEST(TidyTree, ALongChainIsNoTrouble) {
  std::vector<TidyNode> nodes(200'000);
  for (std::uint32_t v = 1; v < nodes.size(); ++v) nodes[v].parent = v - 1;
  EXPECT_EQ(lay_out_tree(nodes, 1).back().level, 199'999u);
}

TEST(TidyTree, SmallTreesBetweenLargeOnesAreSpreadOut) {
  // Root with three children; the outer two have broad subtrees that push each other apart.
  std::vector<TidyNode> nodes = {{kNoNode, 1}, {0, 1}, {0, 1}, {0, 1}, {1, 50}, {3, 50}};
  const auto places = lay_out_tree(nodes, 0);
  EXPECT_NEAR(places[2].centre, (places[1].centre + places[3].centre) / 2, 1e-9);
}

}  // namespace
}  // namespace espalier
