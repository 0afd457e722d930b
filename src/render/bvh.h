#pragma once
// Bvh: a tree of boxes, four children to a node, over items of any kind (triangles in fours, parts one by one). Built
// by binned surface area heuristic, serially, so that equal input gives an equal tree.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "render/float4.h"

namespace espalier {

struct Ray {
  Vec3 origin{0};
  Vec3 direction{0, 0, 1};  // not necessarily of unit length
  float near = 0;           // hits before are ignored
};

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
  bool traverse(const Ray& ray, const float& far, Visit&& visit) const;

 private:
  struct alignas(16) Node {
    float low[3][4], high[3][4];
    std::uint32_t child[4];  // node index; leaf index with kLeafBit; kNone
  };
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  static constexpr int kStackSize = 256;  // bounded by the builder's depth limit

  friend class BvhBuilder;

  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  Bounds box_;
};

template <typename Visit>
bool Bvh::traverse(const Ray& ray, const float& far, Visit&& visit) const {
  if (nodes_.empty()) return false;
  Float4 origin[3] = {Float4(ray.origin.x), Float4(ray.origin.y), Float4(ray.origin.z)};
  Float4 inverse[3] = {Float4(0), Float4(0), Float4(0)};
  for (int axis = 0; axis < 3; ++axis) {
    const float d = ray.direction[axis];
    inverse[axis] = Float4(1 / (d > 1e-20f || d < -1e-20f ? d : 1e-20f));  // finite, so that 0 * it is 0
  }
  struct Entry {
    std::uint32_t child;
    float near;
  } stack[kStackSize];
  int size = 0;
  stack[size++] = {0, ray.near};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.near > far) continue;
    if (entry.child & kLeafBit) {
      if (visit(entry.child & ~kLeafBit)) return true;
      continue;
    }
    const Node& node = nodes_[entry.child];
    Float4 enter(ray.near), leave(far);
    for (int axis = 0; axis < 3; ++axis) {
      const Float4 a = (Float4::load(node.low[axis]) - origin[axis]) * inverse[axis];
      const Float4 b = (Float4::load(node.high[axis]) - origin[axis]) * inverse[axis];
      enter = larger(enter, smaller(a, b));
      leave = smaller(leave, larger(a, b));
    }
    // Wider by a few ulp, for the rounding of the slabs.
    unsigned mask = less_equal(enter * Float4(0.999999f), leave * Float4(1.000001f) + Float4(1e-30f));
    alignas(16) float enters[4];
    enter.store(enters);
    const int first = size;
    for (int k = 0; k < 4; ++k) {
      if (!(mask >> k & 1) || node.child[k] == kNone) continue;
      // Kept sorted, the nearest on top.
      int place = size++;
      for (; place > first && stack[place - 1].near < enters[k]; --place) stack[place] = stack[place - 1];
      stack[place] = {node.child[k], enters[k]};
    }
  }
  return false;
}

}  // namespace espalier
