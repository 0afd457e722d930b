#include "score/shape_descriptor.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/geometric.hpp>

#include "base/check.h"
#include "base/error.h"
#include "base/random.h"
#include "score/voxel_cutter.h"

namespace espalier {
namespace {

/// One point that is to be drawn: at this much of the area of its voxel, pieces taken in the order of the triangles.
struct Ticket {
  double at;  // m2
  std::uint32_t point;
};

/// Draws the points of all voxels in two passes over the triangles: the first adds up areas, the second stops at the
/// piece in which each point falls. So no piece is ever kept.
class PointDrawer {
 public:
  PointDrawer(const Shell& shell, const Subdivision& grid, const DescriptorSettings& settings, Executor& executor)
      : shell_(shell), grid_(grid), settings_(settings), executor_(executor), points_(2 * settings.pairs) {}

  std::vector<double> areas() {
    std::vector<double> areas(grid_.voxel_count(), 0.0);
    std::vector<std::uint64_t> pieces(groups(), 0);
    executor_.for_each(groups(), [&](std::size_t group, int) {
      for_each_piece(group, [&](std::uint32_t voxel, const Polygon&, double area) {
        if (++pieces[group] > settings_.most_pieces) refuse();
        areas[voxel] += area;
      });
    });
    std::uint64_t all = 0;
    for (const std::uint64_t count : pieces) all += count;
    if (all > settings_.most_pieces) refuse();
    return areas;
  }

  /// [voxel][point]; nothing where the voxel has no area.
  std::vector<std::vector<DVec3>> points(const std::vector<double>& areas) {
    std::vector<std::vector<DVec3>> drawn(areas.size());
    std::vector<std::vector<Ticket>> tickets(areas.size());
    executor_.for_each(areas.size(), [&](std::size_t voxel, int) {
      if (areas[voxel] <= 0) return;
      drawn[voxel].resize(points_);
      tickets[voxel] = tickets_of(static_cast<std::uint32_t>(voxel), areas[voxel]);
    });
    std::vector<double> passed(areas.size(), 0.0);  // m2
    std::vector<std::uint32_t> next(areas.size(), 0);
    executor_.for_each(groups(), [&](std::size_t group, int) {
      for_each_piece(group, [&](std::uint32_t voxel, const Polygon& piece, double area) {
        const double before = passed[voxel];
        passed[voxel] += area;
        const std::vector<Ticket>& queue = tickets[voxel];
        std::uint32_t& at = next[voxel];
        for (; at < queue.size() && queue[at].at < passed[voxel]; ++at) {
          RandomStream random = stream(voxel, queue[at].point);
          random.next_unit();  // the ticket's
          const double r = random.next_unit(), s = random.next_unit();
          drawn[voxel][queue[at].point] = piece.point(queue[at].at - before, r, s);
        }
      });
    });
    for (std::size_t voxel = 0; voxel < areas.size(); ++voxel) CHECK(next[voxel] == tickets[voxel].size());
    return drawn;
  }

 private:
  [[noreturn]] void refuse() const {
    throw Error(fmt::format("voxels must cut the triangles into at most {} pieces, got more; fewer voxels or triangles "
                            "make fewer", settings_.most_pieces));
  }

  /// Each works on layers of its own along z, so the order in which a voxel meets its pieces is always the triangles'.
  std::size_t groups() const { return std::min<std::size_t>(grid_.layers(), executor_.workers()); }

  template <class Visit>
  void for_each_piece(std::size_t group, const Visit& visit) const {
    const auto edge = [&](std::size_t g) { return static_cast<std::uint32_t>(g * grid_.layers() / groups()); };
    VoxelCutter cutter(grid_, edge(group), edge(group + 1));
    for_each_triangle(shell_, [&](const DVec3& a, const DVec3& b, const DVec3& c) { cutter.cut_up(a, b, c, visit); });
  }

  RandomStream stream(std::uint32_t voxel, std::uint32_t point) const {
    return RandomStream({settings_.seed, Purpose::points, settings_.draw, voxel, point});
  }

  std::vector<Ticket> tickets_of(std::uint32_t voxel, double area) const {
    std::vector<Ticket> tickets;
    tickets.reserve(points_);
    const double last = std::nextafter(area, 0.0);  // a product may be rounded up to the area, where no piece is
    for (std::uint32_t point = 0; point < points_; ++point)
      tickets.push_back({std::min(stream(voxel, point).next_unit() * area, last), point});
    std::sort(tickets.begin(), tickets.end(),
              [](const Ticket& a, const Ticket& b) { return a.at != b.at ? a.at < b.at : a.point < b.point; });
    return tickets;
  }

  const Shell& shell_;
  const Subdivision& grid_;
  const DescriptorSettings& settings_;
  Executor& executor_;
  std::uint32_t points_;
};

}  // namespace

void validate(const DescriptorSettings& s) {
  const auto within = [](const char* name, std::uint64_t value, std::uint64_t low, std::uint64_t high) {
    if (value < low || value > high)
      throw Error(fmt::format("{} must be from {} to {}, got {}", name, low, high, value));
  };
  within("grid", s.layers, 1, Subdivision::kMostLayers);
  within("pairs", s.pairs, 1, DescriptorSettings::kMostPairs);
  within("bins", s.bins, 2, DescriptorSettings::kMostBins);
  const std::uint64_t voxels = std::uint64_t{s.layers} * s.layers * s.layers;
  if (voxels * s.pairs > DescriptorSettings::kMostPairsInAll)
    throw Error(fmt::format("voxels times pairs must be at most {}, got {} x {}", DescriptorSettings::kMostPairsInAll,
                            voxels, s.pairs));
  if (s.range && !(*s.range >= DescriptorSettings::kLeastRange && *s.range <= DescriptorSettings::kMostRange))
    throw Error(fmt::format("range must be from {} to {} m, got {}", DescriptorSettings::kLeastRange,
                            DescriptorSettings::kMostRange, *s.range));
}

ShapeDescriptor describe(const Shell& shell, const Subdivision& grid, const DescriptorSettings& settings,
                         Executor& executor) {
  validate(settings);
  CHECK(grid.layers() == settings.layers);
  ShapeDescriptor descriptor{settings.layers, settings.pairs, settings.bins, {}, {}};
  PointDrawer drawer(shell, grid, settings, executor);
  descriptor.areas = drawer.areas();
  descriptor.counts.assign(std::size_t{grid.voxel_count()} * settings.bins, 0);
  const std::vector<std::vector<DVec3>> points = drawer.points(descriptor.areas);
  const double bins_per_metre = settings.bins / settings.range.value_or(grid.diagonal());
  for (std::size_t voxel = 0; voxel < points.size(); ++voxel) {
    for (std::size_t i = 0; i < points[voxel].size(); i += 2) {
      const double bin = glm::length(points[voxel][i] - points[voxel][i + 1]) * bins_per_metre;
      const double last = settings.bins - 1;
      ++descriptor.counts[voxel * settings.bins + static_cast<std::size_t>(std::min(bin, last))];
    }
  }
  return descriptor;
}

std::vector<double> voxel_distances(const ShapeDescriptor& a, const ShapeDescriptor& b) {
  CHECK(a.layers == b.layers && a.pairs == b.pairs && a.bins == b.bins && a.counts.size() == b.counts.size());
  std::vector<double> distances;
  distances.reserve(a.areas.size());
  for (std::size_t voxel = 0; voxel < a.areas.size(); ++voxel) {
    std::int64_t difference = 0, most = 0;
    for (std::size_t i = voxel * a.bins; i < (voxel + 1) * a.bins; ++i) {
      difference += std::int64_t{a.counts[i]} - std::int64_t{b.counts[i]};
      most = std::max(most, difference < 0 ? -difference : difference);
    }
    distances.push_back(static_cast<double>(most) / a.pairs);
  }
  return distances;
}

}  // namespace espalier
