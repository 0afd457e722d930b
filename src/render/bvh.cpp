#include "render/bvh.h"

#include <algorithm>

#include "base/check.h"

namespace espalier {
namespace {

constexpr int kBins = 16;
constexpr int kMostSahDepth = 48;  // below, halves: keeps the traversal stack bounded whatever the input

float half_area(const Bounds& b) {
  const Vec3 s = b.size();
  return b.empty() ? 0 : s.x * s.y + s.y * s.z + s.z * s.x;
}

}  // namespace

class BvhBuilder {
 public:
  BvhBuilder(Bvh& out, std::span<const Bounds> items, std::uint32_t leaf_size)
      : out_(out), items_(items), leaf_size_(leaf_size), order_(items.size()) {
    for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  }

  void build() {
    const Range all = range(0, static_cast<std::uint32_t>(order_.size()));
    out_.box_ = all.box;
    make_node(all, 0);
  }

 private:
  struct Range {
    std::uint32_t begin, end;
    Bounds box, centres;
    std::uint32_t size() const { return end - begin; }
  };

  Range range(std::uint32_t begin, std::uint32_t end) const {
    Range r{begin, end, {}, {}};
    for (std::uint32_t i = begin; i < end; ++i) {
      r.box.add(items_[order_[i]]);
      r.centres.add(items_[order_[i]].centre());
    }
    return r;
  }

  std::uint32_t make_leaf(const Range& r) {
    Bvh::Leaf leaf;
    leaf.fill(Bvh::kNone);
    for (std::uint32_t i = 0; i < r.size(); ++i) leaf[i] = order_[r.begin + i];
    out_.leaves_.push_back(leaf);
    return static_cast<std::uint32_t>(out_.leaves_.size() - 1) | Bvh::kLeafBit;
  }

  std::uint32_t make_node(const Range& r, int depth) {
    // Up to four children: the one with the largest surface is split again.
    std::vector<Range> children{r};
    while (children.size() < 4) {
      std::size_t widest = children.size();
      for (std::size_t k = 0; k < children.size(); ++k) {
        if (children[k].size() <= leaf_size_) continue;
        if (widest == children.size() || half_area(children[k].box) > half_area(children[widest].box)) widest = k;
      }
      if (widest == children.size()) break;
      const std::uint32_t middle = split(children[widest], depth);
      const std::uint32_t begin = children[widest].begin, end = children[widest].end;
      children[widest] = range(begin, middle);
      children.push_back(range(middle, end));
    }
    const auto index = static_cast<std::uint32_t>(out_.nodes_.size());
    out_.nodes_.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) {
      const bool used = k < children.size();
      const Bounds box = used ? children[k].box : Bounds{};
      for (int axis = 0; axis < 3; ++axis) {
        out_.nodes_[index].side[2 * axis][k] = box.min[axis];
        out_.nodes_[index].side[2 * axis + 1][k] = box.max[axis];
      }
      const std::uint32_t child = !used                             ? Bvh::kNone
                                  : children[k].size() <= leaf_size_ ? make_leaf(children[k])
                                                                     : make_node(children[k], depth + 1);
      out_.nodes_[index].child[k] = child;
    }
    return index;
  }

  /// A plane between two bins.
  struct Border {
    int axis = 0, bin = 0;  // the first bin of the second part; 0: none parts the items
    float cost = 0;         // area * count, of both parts
  };

  static int bin_of(float centre, float low, float scale) {
    return std::clamp(static_cast<int>((centre - low) * scale), 0, kBins - 1);
  }

  /// Reorders the range and gives where its second part begins.
  std::uint32_t split(const Range& r, int depth) {
    const std::uint32_t half = r.begin + r.size() / 2;
    const Vec3 extent = r.centres.size();
    const int longest = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    if (!(extent[longest] > 0)) return half;
    Border best;
    for (int axis = 0; axis < 3 && depth < kMostSahDepth; ++axis) {
      const Border border = best_border(r, axis);
      if (border.bin > 0 && (best.bin == 0 || border.cost < best.cost)) best = border;
    }
    const auto begin = order_.begin() + r.begin, end = order_.begin() + r.end;
    if (best.bin == 0) {
      std::nth_element(begin, order_.begin() + half, end, [&](std::uint32_t a, std::uint32_t b) {
        const float ca = items_[a].centre()[longest], cb = items_[b].centre()[longest];
        return ca != cb ? ca < cb : a < b;
      });
      return half;
    }
    const float low = r.centres.min[best.axis], scale = kBins / extent[best.axis];
    const auto middle = std::stable_partition(begin, end, [&](std::uint32_t item) {
      return bin_of(items_[item].centre()[best.axis], low, scale) < best.bin;
    });
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  Border best_border(const Range& r, int axis) const {
    const float low = r.centres.min[axis], scale = kBins / r.centres.size()[axis];
    Border best{axis, 0, 0};
    if (!(scale < 1e30f)) return best;
    Bounds boxes[kBins];
    std::uint32_t counts[kBins] = {};
    for (std::uint32_t i = r.begin; i < r.end; ++i) {
      const Bounds& item = items_[order_[i]];
      const int bin = bin_of(item.centre()[axis], low, scale);
      boxes[bin].add(item);
      ++counts[bin];
    }
    float right_cost[kBins] = {};
    Bounds right;
    std::uint32_t right_count = 0;
    for (int b = kBins - 1; b > 0; --b) {
      right.add(boxes[b]);
      right_count += counts[b];
      right_cost[b] = half_area(right) * static_cast<float>(right_count);
    }
    Bounds left;
    std::uint32_t left_count = 0;
    for (int b = 1; b < kBins; ++b) {
      left.add(boxes[b - 1]);
      left_count += counts[b - 1];
      if (left_count == 0 || left_count == r.size()) continue;
      const float cost = half_area(left) * static_cast<float>(left_count) + right_cost[b];
      if (best.bin == 0 || cost < best.cost) best.bin = b, best.cost = cost;
    }
    return best;
  }

  Bvh& out_;
  std::span<const Bounds> items_;
  std::uint32_t leaf_size_;
  std::vector<std::uint32_t> order_;
};

Bvh::Bvh(std::span<const Bounds> items, std::uint32_t leaf_size) {
  CHECK(leaf_size >= 1 && leaf_size <= 4 && items.size() < kLeafBit);
  if (!items.empty()) BvhBuilder(*this, items, leaf_size).build();
}

}  // namespace espalier
