#pragma once
// Tidy drawings of trees: every level on its own line, children side by side in order below the middle of their parent,
// equal subtrees drawn equally, as narrow as that allows. (Buchheim, Jünger and Leipert, "Improving Walker's algorithm
// to run in linear time", 2002, for nodes of any breadth.)

#include <cstdint>
#include <vector>

namespace espalier {

inline constexpr std::uint32_t kNoNode = 0xffffffff;

/// A tree as a list, parents before children, children of one parent in their order. The first is the root.
struct TidyNode {
  std::uint32_t parent = kNoNode;
  double breadth = 1;  // room across the direction of growth, in pixels
};

struct TidyPlace {
  double centre = 0;        // across the direction of growth; the smallest left edge of all nodes is at 0
  std::uint32_t level = 0;  // of the root: 0
};

/// Places in the order of the nodes. Neighbours on a level are at least `gap` apart, edge to edge. Linear time; no
/// recursion, so chains may be long.
std::vector<TidyPlace> lay_out_tree(const std::vector<TidyNode>& nodes, double gap);

}  // namespace espalier
