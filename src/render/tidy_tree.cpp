#include "render/tidy_tree.h"

#include <algorithm>

#include "base/check.h"

namespace espalier {
namespace {

// Names as in the paper: `prelim` is a node's place relative to its siblings, `mod` moves all below it, `thread` leads
// on along a contour where a subtree ends, `change` and `shift` spread the siblings between two that were pushed apart.
class TreeLayout {
 public:
  TreeLayout(const std::vector<TidyNode>& nodes, double gap) : nodes_(nodes), gap_(gap), work_(nodes.size()) {
    for (std::uint32_t v = 0; v < nodes_.size(); ++v) {
      Work& own = work_[v];
      own.ancestor = v;
      const std::uint32_t parent = nodes_[v].parent;
      if (parent == kNoNode) continue;
      CHECK(parent < v);
      Work& above = work_[parent];
      own.level = above.level + 1;
      own.number = above.children++;
      own.left_sibling = above.last_child;
      if (above.last_child != kNoNode) work_[above.last_child].right_sibling = v;
      else above.first_child = v;
      above.last_child = v;
    }
  }

  std::vector<TidyPlace> run() {
    for (auto v = static_cast<std::uint32_t>(nodes_.size()); v-- > 0;) place_children(v);
    std::vector<TidyPlace> places(nodes_.size());
    std::vector<double> moved(nodes_.size(), 0);  // the sum of all mods above
    double least = 0;
    for (std::uint32_t v = 0; v < nodes_.size(); ++v) {
      const std::uint32_t parent = nodes_[v].parent;
      if (parent != kNoNode) moved[v] = moved[parent] + work_[parent].mod;
      places[v] = {work_[v].prelim + moved[v], work_[v].level};
      const double left = places[v].centre - nodes_[v].breadth / 2;
      least = v == 0 ? left : std::min(least, left);
    }
    for (TidyPlace& place : places) place.centre -= least;
    return places;
  }

 private:
  struct Work {
    std::uint32_t first_child = kNoNode, last_child = kNoNode, left_sibling = kNoNode, right_sibling = kNoNode;
    std::uint32_t thread = kNoNode, ancestor = 0, number = 0, children = 0, level = 0;
    double prelim = 0, mod = 0, change = 0, shift = 0, middle = 0;
  };

  std::uint32_t next_left(std::uint32_t v) const {
    return work_[v].first_child != kNoNode ? work_[v].first_child : work_[v].thread;
  }
  std::uint32_t next_right(std::uint32_t v) const {
    return work_[v].last_child != kNoNode ? work_[v].last_child : work_[v].thread;
  }
  double distance(std::uint32_t a, std::uint32_t b) const {
    return (nodes_[a].breadth + nodes_[b].breadth) / 2 + gap_;
  }

  // Everything below the children of v has its place already.
  void place_children(std::uint32_t v) {
    Work& parent = work_[v];
    if (parent.first_child == kNoNode) return;
    std::uint32_t default_ancestor = parent.first_child;
    for (std::uint32_t w = parent.first_child; w != kNoNode; w = work_[w].right_sibling) {
      Work& child = work_[w];
      child.prelim = child.middle;
      if (child.left_sibling == kNoNode) continue;
      child.prelim = work_[child.left_sibling].prelim + distance(child.left_sibling, w);
      child.mod = child.first_child != kNoNode ? child.prelim - child.middle : 0;
      default_ancestor = apportion(w, default_ancestor);
    }
    spread(v);
    parent.middle = (work_[parent.first_child].prelim + work_[parent.last_child].prelim) / 2;
    if (v == 0) parent.prelim = parent.middle;
  }

  // Pushes the subtree at v clear of everything left of it.
  std::uint32_t apportion(std::uint32_t v, std::uint32_t default_ancestor) {
    std::uint32_t in_right = v, out_right = v;
    std::uint32_t in_left = work_[v].left_sibling;
    std::uint32_t out_left = work_[nodes_[v].parent].first_child;
    double s_in_right = work_[in_right].mod, s_out_right = work_[out_right].mod;
    double s_in_left = work_[in_left].mod, s_out_left = work_[out_left].mod;
    while (next_right(in_left) != kNoNode && next_left(in_right) != kNoNode) {
      in_left = next_right(in_left);
      in_right = next_left(in_right);
      out_left = next_left(out_left);
      out_right = next_right(out_right);
      work_[out_right].ancestor = v;
      const double push = work_[in_left].prelim + s_in_left + distance(in_left, in_right) -
                          (work_[in_right].prelim + s_in_right);
      if (push > 0) {
        const std::uint32_t a = work_[in_left].ancestor;
        move_subtree(nodes_[a].parent == nodes_[v].parent ? a : default_ancestor, v, push);
        s_in_right += push;
        s_out_right += push;
      }
      s_in_left += work_[in_left].mod;
      s_in_right += work_[in_right].mod;
      s_out_left += work_[out_left].mod;
      s_out_right += work_[out_right].mod;
    }
    if (next_right(in_left) != kNoNode && next_right(out_right) == kNoNode) {
      work_[out_right].thread = next_right(in_left);
      work_[out_right].mod += s_in_left - s_out_right;
    }
    if (next_left(in_right) != kNoNode && next_left(out_left) == kNoNode) {
      work_[out_left].thread = next_left(in_right);
      work_[out_left].mod += s_in_right - s_out_left;
      return v;
    }
    return default_ancestor;
  }

  void move_subtree(std::uint32_t from, std::uint32_t to, double by) {
    const double each = by / (work_[to].number - work_[from].number);
    work_[to].change -= each;
    work_[to].shift += by;
    work_[from].change += each;
    work_[to].prelim += by;
    work_[to].mod += by;
  }

  void spread(std::uint32_t v) {
    double shift = 0, change = 0;
    for (std::uint32_t w = work_[v].last_child; w != kNoNode; w = work_[w].left_sibling) {
      work_[w].prelim += shift;
      work_[w].mod += shift;
      change += work_[w].change;
      shift += work_[w].shift + change;
    }
  }

  const std::vector<TidyNode>& nodes_;
  double gap_;
  std::vector<Work> work_;
};

}  // namespace

std::vector<TidyPlace> lay_out_tree(const std::vector<TidyNode>& nodes, double gap) {
  return TreeLayout(nodes, gap).run();
}

}  // namespace espalier
