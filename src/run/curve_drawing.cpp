#include "run/curve_drawing.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/box_corner.h"
#include "base/math.h"
#include "model/parts.h"
#include "model/primitives.h"
#include "render/bone_model.h"
#include "render/camera.h"
#include "render/sampling.h"
#include "run/silhouette_view.h"

namespace espalier {
namespace {

constexpr float kMargin = 0.07f;    // of the picture's sides
constexpr float kWire = 0.0042f;    // a wire's radius, of what the picture shows from corner to corner
constexpr float kThickest = 1.6f;   // of bones, in radii of a wire
constexpr float kGlow = 0.3f;
constexpr std::uint32_t kLeastPieces = 96, kMostPieces = 2048;  // of a curve

void add_corners(const Bounds& box, const Frame& frame, std::vector<Vec3>& out) {
  for (int k = 0; k < 8; ++k) out.push_back(frame.point(corner_of(box, k)));
}

std::vector<Colour> all_inks() {
  std::vector<Colour> inks;
  for (std::size_t i = 0; i < kCurveMarks; ++i) inks.push_back(colour_of(static_cast<CurveMark>(i)));
  return inks;
}

Mesh box_mesh(const Vec3& min, const Vec3& max) {
  Mesh box = make_primitive(MeshKind::box, 1, 4);
  for (Vec3& p : box.positions) p = 0.5f * (min + max) + p * (max - min);
  return box;
}

Lens lens_of(const RenderSettings& look, float tall_unit) {
  if (look.tall) return parallel_lens(tall_unit, look.width, look.height);
  return look.fov_deg ? lens_of_angle(*look.fov_deg, look.width, look.height) : long_lens(look.width, look.height);
}

/// A ring around a point of the curve, or a cap's.
struct Ring {
  Vec3 centre;
  float radius = 0;
};

/// Rings from one end to the other; a quarter of a circle at each.
std::vector<Ring> rings_of(const GuidingCurve& guide, const std::vector<Vec3>& points,
                           const std::vector<Vec3>& tangents) {
  constexpr int kCap = 6;
  std::vector<Ring> rings;
  const double length = std::max(length_to(guide.curve, 1), 1e-12);
  const auto cap = [&](int i, const Vec3& end, const Vec3& out, double radius) {
    float s, c;
    sin_cos(static_cast<float>(kPi / 2) * static_cast<float>(i) / kCap, s, c);
    rings.push_back({end + c * static_cast<float>(radius) * out, s * static_cast<float>(radius)});
  };
  for (int i = 0; i < kCap; ++i) cap(i, points.front(), -tangents.front(), guide.thickness[0]);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = length_to(guide.curve, static_cast<double>(i) / static_cast<double>(points.size() - 1)) / length;
    rings.push_back({points[i], static_cast<float>(guide.thickness[0] + (guide.thickness[1] - guide.thickness[0]) * along)});
  }
  for (int i = kCap; i-- > 0;) cap(i, points.back(), tangents.back(), guide.thickness[1]);
  return rings;
}

}  // namespace

CurveDrawing::Polyline CurveDrawing::polyline(const CurveCost& cost, std::uint32_t curve,
                                              const std::vector<std::uint8_t>& uses) {
  const std::uint32_t pieces = std::clamp(4 * cost.segments(curve), kLeastPieces, kMostPieces);
  Polyline out;
  for (std::uint32_t i = 0; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    out.points.emplace_back(point_at(cost.settings().curves[curve].curve, t));
    if (i == pieces) break;
    const std::uint32_t segment = cost.segment_at(curve, (static_cast<float>(i) + 0.5f) / static_cast<float>(pieces));
    out.inks.push_back(static_cast<std::uint16_t>(uses[segment] > 0 ? CurveMark::used : CurveMark::unused));
  }
  return out;
}

CurveDrawing::CurveDrawing(const CurveStage& stage, const Model& model, const MarkedCurves& marked)
    : wires_(start_drawing(all_inks(), kGlow)) {
  std::vector<Polyline> lines;
  for (std::uint32_t i = 0; i < marked.uses.size(); ++i)
    lines.push_back(polyline(stage.curves.cost(), i, marked.uses[i]));
  add_ghosts(stage);
  measure(stage, model, lines);
  const float radius = kWire * glm::length(box_.size());
  for (const Polyline& line : lines) draw_wire(wires_, line.points, line.inks, radius);
  all_ = wires_;
  const float thick = std::min(bone_thickness(model), kThickest * radius);
  for (std::size_t i = 0; i < model.bones.size(); ++i)
    draw_bone(all_, model.bones[i], thick, static_cast<std::uint16_t>(marked.bones[i]));
}

void CurveDrawing::add_ghosts(const CurveStage& stage) {
  const CurveSettings& settings = stage.curves.cost().settings();
  ghosts_ = stage.targets;
  for (const GuidingCurve& guide : settings.curves) {
    Mesh tube = thickness_tube(guide);
    if (!tube.triangles.empty()) ghosts_.push_back(std::move(tube));
  }
  if (settings.density) ghosts_.push_back(box_mesh(settings.density->min, settings.density->max));
}

void CurveDrawing::measure(const CurveStage& stage, const Model& model, const std::vector<Polyline>& lines) {
  for (const Polyline& line : lines) points_.insert(points_.end(), line.points.begin(), line.points.end());
  for (const Mesh& ghost : ghosts_) add_corners(bounds(ghost), {Mat3(1), Vec3(0)}, points_);
  const Parts parts = collect_parts(model, stage.meshes, true);
  for (const Part& part : parts.parts) add_corners(parts.shapes[part.shape].box, part.model_from_shape, points_);
  for (const Vec3& point : points_) box_.add(point);
}

CameraPlace CurveDrawing::place(const RenderSettings& look) const {
  if (look.place) return *look.place;
  const Lens lens = lens_of(look, look.tall.value_or(1));
  return place_of(frame_points(points_, look.azimuth_deg, look.elevation_deg, lens, kMargin));
}

CameraPlace CurveDrawing::turning_place(const RenderSettings& look) const {
  if (look.place) return *look.place;
  const Vec3 axis(box_.centre().x, 0, box_.centre().z);
  std::vector<Vec3> around = points_;
  for (Vec3& point : around) point = point - axis;
  const Camera camera = frame_turning(around, look.azimuth_deg, look.elevation_deg, lens_of(look, look.tall.value_or(1)),
                                      kMargin);
  // The point of the axis that it looks at.
  const Vec2 out(camera.eye.x, camera.eye.z), ahead(camera.forward.x, camera.forward.z);
  const float level = glm::length(ahead);
  const float way = level > 1e-3f ? glm::length(out) / level : glm::length(camera.eye);
  return {camera.eye + axis, camera.eye + way * camera.forward + axis, {0, 1, 0}};
}

Mesh thickness_tube(const GuidingCurve& guide) {
  constexpr std::uint32_t kPieces = 64, kAround = 40;
  Mesh mesh;
  if (guide.thickness[0] == 0 && guide.thickness[1] == 0) return mesh;
  std::vector<Vec3> points, tangents;
  for (std::uint32_t i = 0; i <= kPieces; ++i) {
    const double t = static_cast<double>(i) / kPieces;
    points.emplace_back(point_at(guide.curve, t));
    const DVec3 d = derivative_at(guide.curve, t);
    const double speed = glm::length(d);
    tangents.push_back(speed > 0 ? Vec3(d / speed) : tangents.empty() ? Vec3(0, 1, 0) : tangents.back());
  }
  const std::vector<Ring> rings = rings_of(guide, points, tangents);
  const std::size_t cap = (rings.size() - points.size()) / 2;
  Vec3 aside, across;
  complete_basis(tangents.front(), aside, across);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Vec3& tangent = tangents[std::clamp(r, cap, cap + kPieces) - cap];
    // Turned no more than the curve turns, so that the tube does not wring itself.
    aside = aside - glm::dot(aside, tangent) * tangent;
    if (!(glm::length(aside) > 1e-4f)) complete_basis(tangent, aside, across);
    aside = glm::normalize(aside), across = glm::cross(tangent, aside);
    for (std::uint32_t k = 0; k < kAround; ++k) {
      float s, c;
      sin_cos(static_cast<float>(2 * kPi) * static_cast<float>(k) / kAround, s, c);
      mesh.positions.push_back(rings[r].centre + rings[r].radius * (c * aside + s * across));
      if (r == 0) continue;
      const auto below = static_cast<std::uint32_t>((r - 1) * kAround), next = (k + 1) % kAround;
      if (rings[r - 1].radius > 0) mesh.triangles.push_back({below + k, below + next, below + kAround + next});
      if (rings[r].radius > 0) mesh.triangles.push_back({below + k, below + kAround + next, below + kAround + k});
    }
  }
  return mesh;
}

}  // namespace espalier
