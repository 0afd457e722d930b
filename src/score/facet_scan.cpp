#include "score/facet_scan.h"

#include <algorithm>
#include <utility>

namespace espalier {

bool FacetScan::begin(const Mesh& mesh, const GridPlacement& placement, const std::int32_t low[3],
                      const std::int32_t high[3]) {
  position_.clear();
  facets_.clear();
  if (mesh.positions.empty()) return false;
  double least[3], most[3];
  for (const Vec3& p : mesh.positions) {
    for (int i = 0; i < 3; ++i) {
      const double v = placement.at(i, p);
      least[i] = position_.size() < 3 ? v : std::min(least[i], v);
      most[i] = position_.size() < 3 ? v : std::max(most[i], v);
      position_.push_back(v);
    }
  }
  for (int i = 0; i < 3; ++i) {
    reach_.low[i] = ceil_clamped(least[i], low[i], high[i]);
    reach_.high[i] = ceil_clamped(most[i], low[i], high[i]);
  }
  if (reach_.empty()) return false;
  first_word_ = reach_.low[2] >> 5;
  words_ = ((reach_.high[2] - 1) >> 5) - first_word_ + 1;

  const auto before = [this](std::uint32_t a, std::uint32_t b) {
    const double* p = &position_[3 * std::size_t{a}];
    const double* q = &position_[3 * std::size_t{b}];
    if (p[1] != q[1]) return p[1] < q[1];
    return p[0] != q[0] ? p[0] < q[0] : p[2] < q[2];
  };
  for (const Triangle& t : mesh.triangles) {
    Facet f{{t[0], t[1], t[2]}, 0, 0};
    std::sort(f.corner, f.corner + 3, before);
    f.row_low = ceil_clamped(position_[3 * std::size_t{f.corner[0]} + 1], reach_.low[1], reach_.high[1]);
    f.row_high = ceil_clamped(position_[3 * std::size_t{f.corner[2]} + 1], reach_.low[1], reach_.high[1]);
    if (f.row_low < f.row_high) facets_.push_back(f);
  }
  return true;
}

const std::uint32_t* FacetScan::scan(std::int32_t tile) {
  const auto columns = static_cast<std::size_t>(reach_.high[0] - reach_.low[0]);
  bits_.assign(columns * static_cast<std::size_t>(words_) * 8, 0);
  odd_.assign(columns, 0);
  for (const Facet& facet : facets_) {
    const std::int32_t end = std::min(facet.row_high, tile * 8 + 8);
    for (std::int32_t y = std::max(facet.row_low, tile * 8); y < end; ++y) scan_row(facet, y);
  }
  drop_open_rows();
  return bits_.data();
}

namespace {

/// Where the edge a -> b (a.y <= y < b.y) meets the row. Depends on the edge alone: its two triangles agree.
std::pair<double, double> meet(const double* a, const double* b, double y) {
  const double t = (y - a[1]) / (b[1] - a[1]);
  return {a[0] + t * (b[0] - a[0]), a[2] + t * (b[2] - a[2])};
}

}  // namespace

void FacetScan::scan_row(const Facet& facet, std::int32_t y) {
  const double* a = &position_[3 * std::size_t{facet.corner[0]}];
  const double* b = &position_[3 * std::size_t{facet.corner[1]}];
  const double* c = &position_[3 * std::size_t{facet.corner[2]}];
  auto left = meet(a, c, y);
  auto right = y < b[1] ? meet(a, b, y) : meet(b, c, y);
  if (right.first < left.first) std::swap(left, right);
  const std::int32_t from = ceil_clamped(left.first, reach_.low[0], reach_.high[0]);
  const std::int32_t to = ceil_clamped(right.first, reach_.low[0], reach_.high[0]);
  if (from >= to) return;
  const double slope = (right.second - left.second) / (right.first - left.first);
  for (std::int32_t x = from; x < to; ++x) cross(x, y & 7, left.second + (x - left.first) * slope);
}

/// Everything from z up changes sides.
void FacetScan::cross(std::int32_t x, std::int32_t lane, double z) {
  const auto column = static_cast<std::size_t>(x - reach_.low[0]);
  odd_[column] ^= static_cast<std::uint8_t>(1 << lane);
  const std::int32_t from = ceil_clamped(z, reach_.low[2], reach_.high[2]) - 32 * first_word_;
  std::uint32_t* bits = bits_.data() + column * static_cast<std::size_t>(words_) * 8 + lane;
  std::int32_t word = from >> 5;
  if (word >= words_) return;
  bits[word * 8] ^= ~0u << (from & 31);
  for (++word; word < words_; ++word) bits[word * 8] ^= ~0u;
}

void FacetScan::drop_open_rows() {
  const auto stride = static_cast<std::size_t>(words_) * 8;
  const std::int32_t end = reach_.high[2] - 32 * first_word_;
  const std::uint32_t last = end % 32 == 0 ? ~0u : (1u << (end % 32)) - 1;
  for (std::size_t column = 0; column < odd_.size(); ++column) {
    std::uint32_t* bits = bits_.data() + column * stride;
    for (std::size_t i = stride - 8; i < stride; ++i) bits[i] &= last;
    if (odd_[column] == 0) continue;
    for (std::size_t i = 0; i < stride; ++i) {
      if (odd_[column] >> (i % 8) & 1) bits[i] = 0;
    }
  }
}

}  // namespace espalier
