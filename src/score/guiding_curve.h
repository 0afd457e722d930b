#pragma once
// GuidingCurve: a curve that a person draws, and how bones shall follow it (Guiding curves 2018, section 3.3).

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "score/bezier.h"

namespace espalier {

struct GuidingCurve {
  static constexpr std::uint32_t kMostSegments = 1024;

  CubicBezier curve;
  /// scale_d: a bone whose base is d metres away costs distance[0] + distance[1] d + distance[2] d^2. -1e6..1e6.
  std::array<double, 3> distance = {0, 0, 100};
  double alignment = 400;  // scale_a, 0..1e6
  /// delta_a, -1..1: how well aligned a bone must be to be worth anything; at 1 none ever is, at -1 all are.
  double offset = 0.6;
  double utilisation = 20;  // scale_u, 0..1e6: what the first use of a segment is worth
  double segment = 0.2;     // length of a segment, m, > 0; at most kMostSegments to a curve
  /// Radius within which distance costs nothing, m, at the start and at the end of the curve; linear along its length.
  std::array<double, 2> thickness = {0, 0};

  bool operator==(const GuidingCurve&) const = default;
};

/// How many bones a region may hold: what is beyond costs `cost` times the square of the excess, cell by cell.
struct BoneDensity {
  static constexpr std::uint32_t kMostCells = 4096;

  Vec3 min{0}, max{1};   // the region, m
  double cell = 0.5;     // edge of its cells, m; the region is covered by at most kMostCells
  double wanted = 10;    // bones per m3, >= 0; a bone counts where its middle is
  double cost = 10;      // 0..1e6

  bool operator==(const BoneDensity&) const = default;
};

struct CurveSettings {
  static constexpr std::size_t kMostCurves = 64;

  std::vector<GuidingCurve> curves;  // at least 1
  /// The tangents of the two nearest curves are blended by distance, so that no seam shows where the nearest changes.
  bool blend = false;
  /// Cells along the longest edge of a grid of distances and tangents, 8..128: quicker, and a little wrong. 0: exact.
  std::uint32_t field_cells = 0;
  std::optional<BoneDensity> density = {};

  bool operator==(const CurveSettings&) const = default;
};

/// Throws Error stating the first rule broken, with curve (from 0), setting and value.
void validate(const CurveSettings& settings);

}  // namespace espalier
