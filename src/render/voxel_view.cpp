#include "render/voxel_view.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/box_corner.h"

namespace espalier {
namespace {

constexpr float kMargin = 0.04f;          // of the picture's sides
constexpr float kHaze = 2.2f;             // density of what is missed, per longest side of the grid
constexpr float kShell = 0.16f;           // opacity of its surface besides
constexpr int kNormalReach = 2;           // voxels around one that tell its normal
constexpr float kEdgeDepth = 0.02f;       // of the longest side: a step in depth that is drawn as an edge
const Vec3 kToViewer(0.5213f, 0.4226f, 0.7413f);  // 35 degrees aside, 25 up
const Vec3 kToLight(-0.30f, 0.85f, 0.43f);

struct Seen {
  Vec3 colour{0};  // 0..255, multiplied by what covers
  float clear = 1;
  float depth = 1e30f;
};

Vec3 as_light(const Colour& c) { return {c.rgb[0], c.rgb[1], c.rgb[2]}; }

/// The box of all that is shown; of the grid where there is nothing.
Bounds content_of(const MarkedVoxels& voxels) {
  std::uint32_t low[3] = {~0u, ~0u, ~0u}, high[3] = {0, 0, 0};
  std::size_t i = 0;
  for (std::uint32_t z = 0; z < voxels.cells[2]; ++z) {
    for (std::uint32_t y = 0; y < voxels.cells[1]; ++y) {
      for (std::uint32_t x = 0; x < voxels.cells[0]; ++x, ++i) {
        if (voxels.mark(i) == VoxelMark::free) continue;
        const std::uint32_t at[3] = {x, y, z};
        for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], at[k]), high[k] = std::max(high[k], at[k] + 1);
      }
    }
  }
  if (low[0] == ~0u) return {voxels.min, voxels.max};
  Bounds box;
  for (int k = 0; k < 3; ++k) {
    const float cell = (voxels.max[k] - voxels.min[k]) / static_cast<float>(voxels.cells[static_cast<std::size_t>(k)]);
    box.min[k] = voxels.min[k] + cell * static_cast<float>(low[k]);
    box.max[k] = voxels.min[k] + cell * static_cast<float>(high[k]);
  }
  return box;
}

class View {
 public:
  View(const MarkedVoxels& voxels, const Bounds& shown, std::uint32_t width, std::uint32_t height)
      : voxels_(voxels), width_(width), height_(height) {
    right_ = glm::normalize(glm::cross(Vec3(0, 1, 0), kToViewer));
    up_ = glm::cross(kToViewer, right_);
    const Vec3 size = voxels.max - voxels.min;
    longest_ = std::max({size.x, size.y, size.z});
    for (int i = 0; i < 3; ++i) cell_[i] = size[i] / static_cast<float>(voxels.cells[static_cast<std::size_t>(i)]);
    centre_ = shown.centre();
    float wide = 0, tall = 0;
    for (int k = 0; k < 8; ++k) {
      const Vec3 p = corner_of(shown, k) - centre_;
      wide = std::max(wide, std::fabs(glm::dot(p, right_)));
      tall = std::max(tall, std::fabs(glm::dot(p, up_)));
    }
    const float inside = 1 - 2 * kMargin;
    per_pixel_ = std::max(2 * wide / (inside * static_cast<float>(width)),
                          2 * tall / (inside * static_cast<float>(height)));
  }

  /// Of the grid.
  Vec3 corner(int k) const { return corner_of({voxels_.min, voxels_.max}, k); }
  /// Picture coordinates.
  Vec2 pixel(const Vec3& p) const {
    return {0.5f * static_cast<float>(width_) + glm::dot(p - centre_, right_) / per_pixel_,
            0.5f * static_cast<float>(height_) - glm::dot(p - centre_, up_) / per_pixel_};
  }
  Seen look(float x, float y) const;
  float longest() const { return longest_; }

 private:
  bool enter(const Vec3& origin, float& near, float& far) const;
  Vec3 normal(const int (&at)[3], const Vec3& face) const;
  Vec3 shaded(const Vec3& colour, const Vec3& normal) const {
    return colour * (0.58f + 0.42f * std::max(0.0f, glm::dot(normal, kToLight)));
  }

  const MarkedVoxels& voxels_;
  std::uint32_t width_, height_;
  Vec3 right_, up_, centre_, cell_;
  float longest_, per_pixel_;
};

bool View::enter(const Vec3& origin, float& near, float& far) const {
  near = -1e30f, far = 1e30f;
  for (int i = 0; i < 3; ++i) {  // no component of the direction is 0
    const float a = (voxels_.min[i] - origin[i]) / -kToViewer[i], b = (voxels_.max[i] - origin[i]) / -kToViewer[i];
    near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
  }
  return near < far;
}

/// Towards where neighbours are not covered.
Vec3 View::normal(const int (&at)[3], const Vec3& face) const {
  Vec3 sum(0);
  for (int k = -kNormalReach; k <= kNormalReach; ++k) {
    for (int j = -kNormalReach; j <= kNormalReach; ++j) {
      for (int i = -kNormalReach; i <= kNormalReach; ++i) {
        const int x = at[0] + i, y = at[1] + j, z = at[2] + k;
        const bool inside = x >= 0 && y >= 0 && z >= 0 && x < static_cast<int>(voxels_.cells[0]) &&
                            y < static_cast<int>(voxels_.cells[1]) && z < static_cast<int>(voxels_.cells[2]);
        const auto cell = [](int i_at) { return static_cast<std::uint32_t>(i_at); };
        const bool solid = inside && is_covered(voxels_.mark(voxels_.index(cell(x), cell(y), cell(z))));
        if (!solid) sum += Vec3(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
      }
    }
  }
  const float length = glm::length(sum);
  return length > 0.5f ? glm::normalize(sum / length + 0.35f * face) : face;
}

/// A ray's way from cell to cell (Amanatides and Woo 1987). Every component of its direction is below 0.
struct Walk {
  Walk(const MarkedVoxels& grid, const Vec3& cell, const Vec3& origin, float near) : t(near) {
    const Vec3 start = origin - near * kToViewer;
    for (int i = 0; i < 3; ++i) {
      const auto cells = static_cast<int>(grid.cells[static_cast<std::size_t>(i)]);
      at[i] = std::clamp(static_cast<int>((start[i] - grid.min[i]) / cell[i]), 0, cells - 1);
      step[i] = cell[i] / kToViewer[i];
      next[i] = (origin[i] - grid.min[i] - static_cast<float>(at[i]) * cell[i]) / kToViewer[i];
      if (std::fabs(start[i] - grid.max[i]) < std::fabs(start[axis] - grid.max[axis])) axis = i;
    }
  }
  int leaving() const { return next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2); }
  float leaves_at() const { return next[leaving()]; }
  /// False when it leaves the grid.
  bool advance() {
    axis = leaving();
    t = next[axis], next[axis] += step[axis];
    return --at[axis] >= 0;
  }
  std::size_t index(const MarkedVoxels& grid) const {
    return grid.index(static_cast<std::uint32_t>(at[0]), static_cast<std::uint32_t>(at[1]),
                      static_cast<std::uint32_t>(at[2]));
  }

  int at[3], axis = 0;  // the cell, and across which axis it was entered
  float t, next[3], step[3];
};

/// Lays what the ray meets behind what it has met.
Seen View::look(float x, float y) const {
  Seen seen;
  const Vec3 origin = centre_ + (x - 0.5f * static_cast<float>(width_)) * per_pixel_ * right_ +
                      (0.5f * static_cast<float>(height_) - y) * per_pixel_ * up_ + 4 * longest_ * kToViewer;
  float near, far;
  if (!enter(origin, near, far)) return seen;
  bool in_haze = false;
  Walk walk(voxels_, cell_, origin, near);
  do {
    const std::size_t i = walk.index(voxels_);
    const VoxelMark mark = voxels_.mark(i);
    if (is_covered(mark)) {
      Vec3 face(0);
      face[walk.axis] = 1;
      seen.colour += seen.clear * shaded(as_light(colour_of(mark, voxels_.twice(i))), normal(walk.at, face));
      seen.clear = 0, seen.depth = walk.t;
      return seen;
    }
    const bool hazy = mark == VoxelMark::missed || mark == VoxelMark::avoided;
    if (hazy) {
      const float shell = in_haze ? 0.0f : kShell;
      const float opacity = std::min(0.9f, kHaze * (walk.leaves_at() - walk.t) / longest_ + shell);
      seen.colour += seen.clear * opacity * as_light(colour_of(mark));
      seen.clear *= 1 - opacity;
    }
    in_haze = hazy;
  } while (seen.clear > 0.01f && walk.advance());
  return seen;
}

void draw_box(Picture& picture, const View& view) {
  for (int k = 0; k < 8; ++k) {
    for (int axis = 1; axis < 8; axis *= 2) {
      if (k & axis) continue;
      const Vec2 a = view.pixel(view.corner(k)), b = view.pixel(view.corner(k | axis));
      draw_line(picture, static_cast<std::int64_t>(a.x), static_cast<std::int64_t>(a.y),
                static_cast<std::int64_t>(b.x), static_cast<std::int64_t>(b.y), mix(kPaper, kInk, 70));
    }
  }
}

/// Where the depth jumps, the nearer side gets a dark rim.
void draw_edges(std::vector<Seen>& seen, std::uint32_t width, std::uint32_t height, float jump) {
  std::vector<std::uint8_t> edge(seen.size());
  for (std::uint32_t y = 1; y + 1 < height; ++y) {
    for (std::uint32_t x = 1; x + 1 < width; ++x) {
      const std::size_t i = x + std::size_t{width} * y;
      const float depth = seen[i].depth + jump;
      if (depth > 1e29f) continue;
      edge[i] = seen[i - 1].depth > depth || seen[i + 1].depth > depth || seen[i - width].depth > depth ||
                seen[i + width].depth > depth;
    }
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (edge[i] != 0) seen[i].colour *= 0.62f;
}

}  // namespace

Picture voxel_view(const MarkedVoxels& voxels, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                   Executor& executor) {
  const std::uint32_t wide = width * samples, tall = height * samples;
  const Bounds shown = content_of(voxels);
  const View view(voxels, shown, wide, tall);
  std::vector<Seen> seen(std::size_t{wide} * tall);
  executor.for_each(tall, [&](std::size_t row, int) {
    for (std::uint32_t x = 0; x < wide; ++x)
      seen[x + wide * row] = view.look(static_cast<float>(x) + 0.5f, static_cast<float>(row) + 0.5f);
  });
  draw_edges(seen, wide, tall, kEdgeDepth * view.longest());
  Picture picture = blank(width, height, kPaper);
  draw_box(picture, View(voxels, shown, width, height));
  const float share = 1 / static_cast<float>(samples * samples);
  executor.for_each(height, [&](std::size_t row, int) {
    for (std::uint32_t x = 0; x < width; ++x) {
      Vec3 colour(0);
      float clear = 0;
      for (std::uint32_t j = 0; j < samples; ++j) {
        for (std::uint32_t i = 0; i < samples; ++i) {
          const Seen& s = seen[x * samples + i + wide * (row * samples + j)];
          colour += s.colour, clear += s.clear;
        }
      }
      std::uint8_t* rgb = picture.rgb.data() + 3 * (x + width * row);
      for (int c = 0; c < 3; ++c)
        rgb[c] = static_cast<std::uint8_t>(std::clamp(share * (colour[c] + clear * rgb[c]), 0.0f, 255.0f) + 0.5f);
    }
  });
  return picture;
}

}  // namespace espalier
