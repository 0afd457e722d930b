#pragma once
// CellMap: which of many things of very different sizes may be near a point. Things lie in the cells of grids, one grid
// per octave of size; what is asked is answered in the order in which things were added.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "base/vec.h"

namespace espalier {

class CellMap {
 public:
  static constexpr std::size_t kMostInCell = 256;  // looked at; what is crowded beyond is not found

  /// A thing of about `size` m that fills a box. What is much wider than its size may be near anything.
  void add(std::uint32_t thing, const Bounds& box, float size) {
    const int level = level_of(size);
    // The last level is of all that is larger, and for its largest the cells are small.
    if (level == kLevels / 2 - 1 || !(cells_across(box, level) <= kMostCells)) return wide_.push_back(thing);
    levels_ |= std::uint64_t{1} << (level + kLevels / 2);
    for_each_cell(box, level, [&](std::uint64_t cell) { entries_.emplace_back(cell, thing); });
  }
  void finish() { std::sort(entries_.begin(), entries_.end()); }

  /// Calls visit(thing) for all that may touch a box; maybe several times, and for some that do not touch.
  template <class Visit>
  void visit_near(const Bounds& box, float least, float most, const Visit& visit) const {
    for (std::size_t i = 0; i < std::min(wide_.size(), kMostInCell); ++i) visit(wide_[i]);
    const int low = level_of(least), high = level_of(most);
    for (int level = low; level <= high; ++level) {
      if (!(levels_ >> (level + kLevels / 2) & 1)) continue;
      for_each_cell(box, level, [&](std::uint64_t cell) {
        auto at = std::lower_bound(entries_.begin(), entries_.end(), std::pair(cell, std::uint32_t{0}));
        for (std::size_t seen = 0; at != entries_.end() && at->first == cell && seen < kMostInCell; ++at, ++seen)
          visit(at->second);
      });
    }
  }

 private:
  static constexpr int kLevels = 64;
  static constexpr float kMostCells = 125;  // of a thing

  /// Cells that a box touches, about.
  static float cells_across(const Bounds& box, int level) {
    const Vec3 cells = box.size() / std::ldexp(4.0f, level) + Vec3(1);
    return cells.x * cells.y * cells.z;
  }

  static int level_of(float size) {
    const int exponent = size > 0 ? std::ilogb(size) : -kLevels / 2;
    return std::clamp(exponent, -kLevels / 2, kLevels / 2 - 1);
  }
  template <class Visit>
  static void for_each_cell(const Bounds& box, int level, const Visit& visit) {
    const float side = std::ldexp(4.0f, level);
    const auto cell = [&](float x) {
      return static_cast<std::int64_t>(std::floor(std::clamp(x / side, -1e15f, 1e15f)));
    };
    for (std::int64_t x = cell(box.min.x); x <= cell(box.max.x); ++x)
      for (std::int64_t y = cell(box.min.y); y <= cell(box.max.y); ++y)
        for (std::int64_t z = cell(box.min.z); z <= cell(box.max.z); ++z) {
          std::uint64_t key = static_cast<std::uint64_t>(level + kLevels);
          for (const std::int64_t c : {x, y, z}) key = key_below(key, static_cast<std::uint64_t>(c));
          visit(key);
        }
  }

  std::vector<std::pair<std::uint64_t, std::uint32_t>> entries_;  // by cell, then thing
  std::uint64_t levels_ = 0;                                      // that are in use
  std::vector<std::uint32_t> wide_;                               // in no cell
};

}  // namespace espalier
