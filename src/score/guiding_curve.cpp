#include "score/guiding_curve.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"

namespace espalier {
namespace {

void require(bool holds, const std::string& what, double value) {
  if (!holds) throw Error(fmt::format("{}, got {}", what, value));
}

void require_range(const std::string& what, double value, double low, double high) {
  require(value >= low && value <= high, fmt::format("{} must be {} to {}", what, low, high), value);
}

void require_point(const std::string& what, const Vec3& point) {
  for (int axis = 0; axis < 3; ++axis) require_range(what, point[axis], -1e5, 1e5);
}

void validate_curve(const GuidingCurve& curve, const std::string& name) {
  for (const Vec3& point : curve.curve.points) require_point(name + ".points", point);
  for (const double scale : curve.distance) require_range(name + ".distance", scale, -1e6, 1e6);
  require_range(name + ".alignment", curve.alignment, 0, 1e6);
  require_range(name + ".offset", curve.offset, -1, 1);
  require_range(name + ".utilisation", curve.utilisation, 0, 1e6);
  for (const double radius : curve.thickness) require_range(name + ".thickness", radius, 0, 1e5);
  require(curve.segment > 0, name + ".segment must be above 0", curve.segment);
  const double segments = length_to(curve.curve, 1) / curve.segment;
  if (!(segments <= GuidingCurve::kMostSegments)) {
    throw Error(fmt::format("{}.segment must leave at most {} segments, got {}: {:.0f} of them", name,
                            GuidingCurve::kMostSegments, curve.segment, std::ceil(segments)));
  }
}

void validate_density(const BoneDensity& density) {
  require_point("density.min", density.min);
  require_point("density.max", density.max);
  require(density.cell > 0 && std::isfinite(density.cell), "density.cell must be above 0 and finite", density.cell);
  require_range("density.wanted", density.wanted, 0, 1e9);
  require_range("density.cost", density.cost, 0, 1e6);
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = static_cast<double>(density.max[axis]) - density.min[axis];
    require(size > 0, "density.max must be above density.min along every axis: they differ by more than 0", size);
    cells *= std::ceil(size / density.cell);
  }
  if (!(cells <= BoneDensity::kMostCells)) {
    throw Error(fmt::format("density.cell must leave at most {} cells, got {}: {:.0f} of them", BoneDensity::kMostCells,
                            density.cell, cells));
  }
}

}  // namespace

void validate(const CurveSettings& settings) {
  const std::size_t curves = settings.curves.size();
  require(curves >= 1 && curves <= CurveSettings::kMostCurves,
          fmt::format("there must be 1 to {} guiding curves", CurveSettings::kMostCurves),
          static_cast<double>(curves));
  for (std::size_t i = 0; i < curves; ++i) validate_curve(settings.curves[i], fmt::format("curve.{}", i));
  if (settings.field_cells != 0) {
    require_range("field_cells", settings.field_cells, 8, 128);
    const double nodes = settings.field_cells + 1.0;
    constexpr double kMostNumbers = 1 << 25;
    if (nodes * nodes * nodes * static_cast<double>(curves) > kMostNumbers) {
      throw Error(fmt::format("field_cells must be smaller with so many curves, got {} with {}", settings.field_cells,
                              curves));
    }
  }
  if (settings.density) validate_density(*settings.density);
}

}  // namespace espalier
