#include "score/curve_field.h"

#include <algorithm>
#include <cmath>

namespace espalier {

CurveField::CurveField(const CurveSettings& settings, const CurveFinder& finder) : finder_(finder) {
  Bounds curves;
  for (const GuidingCurve& guide : settings.curves) {
    for (const Vec3& point : guide.curve.points) curves.add(point);
  }
  const Vec3 size = curves.size();
  const float largest = std::max({size.x, size.y, size.z, 1e-3f});
  const float margin = 0.25f * largest;
  cell_ = (largest + 2 * margin) / static_cast<float>(settings.field_cells);
  per_cell_ = 1 / cell_;
  for (int axis = 0; axis < 3; ++axis) {
    const float extent = size[axis] + 2 * margin;
    cells_[static_cast<std::size_t>(axis)] =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(extent * per_cell_)), 1, settings.field_cells);
  }
  box_.min = curves.min - Vec3(margin);
  box_.max = node_at(cells_[0], cells_[1], cells_[2]);
  row_ = cells_[0] + 1;
  slice_ = row_ * (cells_[1] + 1);
  const std::size_t nodes = slice_ * (cells_[2] + 1);
  nearest_.resize(nodes);
  curve_.resize(nodes);
  parameters_.resize(nodes * finder.size());
  std::size_t node = 0;
  for (std::size_t z = 0; z <= cells_[2]; ++z) {
    for (std::size_t y = 0; y <= cells_[1]; ++y) {
      for (std::size_t x = 0; x <= cells_[0]; ++x, ++node) {
        const Vec3 p = node_at(x, y, z);
        const CurvePoint point = finder.nearest(p);
        nearest_[node] = Four{point.tangent.x, point.tangent.y, point.tangent.z, point.distance};
        curve_[node] = static_cast<std::uint8_t>(point.curve);
        for (std::uint32_t c = 0; c < finder.size(); ++c) parameters_[c * nodes + node] = finder.parameter_on(c, p);
      }
    }
  }
}

Vec3 CurveField::node_at(std::size_t x, std::size_t y, std::size_t z) const {
  return box_.min + cell_ * Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
}

bool CurveField::locate(const Vec3& p, Place& place) const {
  const Vec3 at = per_cell_ * (p - box_.min);
  const auto x = static_cast<float>(cells_[0]), y = static_cast<float>(cells_[1]), z = static_cast<float>(cells_[2]);
  if (!(at.x >= 0 && at.x <= x && at.y >= 0 && at.y <= y && at.z >= 0 && at.z <= z)) return false;
  const std::size_t i = std::min(static_cast<std::size_t>(at.x), cells_[0] - 1);
  const std::size_t j = std::min(static_cast<std::size_t>(at.y), cells_[1] - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at.z), cells_[2] - 1);
  place.node = k * slice_ + j * row_ + i;
  place.x = at.x - static_cast<float>(i);
  place.y = at.y - static_cast<float>(j);
  place.z = at.z - static_cast<float>(k);
  return true;
}

template <class T>
T CurveField::interpolate(const T* values, const Place& place) const {
  const T* const v = values + place.node;
  const auto along_x = [&](std::size_t at) { return v[at] + place.x * (v[at + 1] - v[at]); };
  const T low = along_x(0) + place.y * (along_x(row_) - along_x(0));
  const T high = along_x(slice_) + place.y * (along_x(slice_ + row_) - along_x(slice_));
  return low + place.z * (high - low);
}

std::size_t CurveField::nearest_node(const Place& place) const {
  return place.node + (place.x > 0.5f) + (place.y > 0.5f ? row_ : 0) + (place.z > 0.5f ? slice_ : 0);
}

CurvePoint CurveField::nearest(const Vec3& p) const {
  Place place;
  if (!locate(p, place)) return finder_.nearest(p);
  const Four value = interpolate(nearest_.data(), place);
  CurvePoint point;
  point.curve = curve_[nearest_node(place)];
  point.t = interpolate(parameters_.data() + point.curve * nearest_.size(), place);
  point.distance = value[3];
  const float length = std::sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]);
  if (length > 1e-6f) point.tangent = Vec3(value[0] / length, value[1] / length, value[2] / length);
  return point;
}

float CurveField::parameter_on(std::uint32_t curve, const Vec3& p) const {
  Place place;
  if (!locate(p, place)) return finder_.parameter_on(curve, p);
  return interpolate(parameters_.data() + curve * nearest_.size(), place);
}

}  // namespace espalier
