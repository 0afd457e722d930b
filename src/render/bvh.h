#pragma once
// Bvh: a tree of boxes, four children to a node, over items of any kind (triangles in fours, parts one by one). Built
// by binned surface area heuristic, serially, so that equal input gives an equal tree.

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "render/float4.h"
#include "render/ray.h"

namespace espalier {

class Bvh {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// Up to four items; unused places hold kNone.
  using Leaf = std::array<std::uint32_t, 4>;

  Bvh() = default;
  /// At most `leaf_size` (1..4) items share a leaf.
  Bvh(std::span<const Bounds> items, std::uint32_t leaf_size);

  const std::vector<Leaf>& leaves() const { return leaves_; }
  const Bounds& box() const { return box_; }

  /// Calls visit(leaf index) for the leaves that the ray meets before `far`, roughly front to back, until one returns
  /// true. `visit` may lower `far`.
  template <typename Visit>
  bool traverse(const Ray& ray, const float& far, Visit&& visit) const {
    return walk<true>(ray, far, visit);
  }
  /// The same in any order.
  template <typename Visit>
  bool traverse_unordered(const Ray& ray, float far, Visit&& visit) const {
    return walk<false>(ray, far, visit);
  }

 private:
  struct alignas(64) Node {
    float side[6][4];        // low x, high x, low y, ..; what holds nothing lies beyond everything
    std::uint32_t child[4];  // node index; leaf index with kLeafBit; kNone
  };
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  static constexpr int kStackSize = 256;  // bounded by the builder's depth limit

  friend class BvhBuilder;

  template <bool kOrdered, typename Visit>
  bool walk(const Ray& ray, const float& far, Visit&& visit) const;

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  Bounds box_;
};

template <bool kOrdered, typename Visit>
bool Bvh::walk(const Ray& ray, const float& far, Visit&& visit) const {
  if (nodes_.empty()) return false;
  const Float4 origin[3] = {Float4(ray.origin.x), Float4(ray.origin.y), Float4(ray.origin.z)};
  alignas(16) float scales[4] = {1, 1, 1, 1};
  int first_side[3];  // the ray comes in through it
  for (int axis = 0; axis < 3; ++axis) {
    const float d = ray.direction[axis];
    scales[axis] = d > 1e-20f || d < -1e-20f ? d : 1e-20f;  // its inverse is finite, so that 0 * it is 0
    first_side[axis] = 2 * axis + (d < -1e-20f ? 1 : 0);
  }
  (Float4(1) / Float4::load(scales)).store(scales);
  const Float4 inverse[3] = {Float4(scales[0]), Float4(scales[1]), Float4(scales[2])};
  struct Entry {
    std::uint32_t child;
    float near;
  } stack[kStackSize];
  int size = 0;
  Entry entry = {0, ray.near};
  for (;; entry = stack[--size]) {
    if (!(entry.near > far)) {
      if (entry.child & kLeafBit) {
        if (visit(entry.child & ~kLeafBit)) return true;
      } else {
        const Node& node = nodes_[entry.child];
        Float4 enter(ray.near), leave(far);
        for (int axis = 0; axis < 3; ++axis) {
          const int side = first_side[axis];
          enter = larger(enter, (Float4::load(node.side[side]) - origin[axis]) * inverse[axis]);
          leave = smaller(leave, (Float4::load(node.side[side ^ 1]) - origin[axis]) * inverse[axis]);
        }
        // Wider by a few ulp, for the rounding of the slabs.
        unsigned mask = less_equal(enter * Float4(0.999999f), leave * Float4(1.000001f) + Float4(1e-30f));
        alignas(16) float enters[4];
        enter.store(enters);
        const int first = size;
        for (; mask; mask &= mask - 1) {
          const int k = std::countr_zero(mask);
          if (node.child[k] == kNone) continue;  // met by rays that are not finite
          int place = size++;
          // Kept sorted, the nearest on top.
          if constexpr (kOrdered) {
            for (; place > first && stack[place - 1].near < enters[k]; --place) stack[place] = stack[place - 1];
          }
          stack[place] = {node.child[k], enters[k]};
        }
      }
    }
    if (size == 0) return false;
  }
}

}  // namespace espalier
