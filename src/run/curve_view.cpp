#include "run/curve_view.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "base/math.h"
#include "model/parts.h"
#include "model/primitives.h"
#include "render/bone_model.h"
#include "render/camera.h"
#include "render/line_drawing.h"
#include "render/sampling.h"
#include "run/silhouette_view.h"

namespace espalier {
namespace {

constexpr float kMargin = 0.07f;       // of the picture's sides
constexpr float kWire = 0.0042f;       // a wire's radius, of what the picture shows from corner to corner
constexpr float kThickest = 1.6f;      // of bones, in radii of a wire
constexpr float kGlow = 0.3f;
constexpr std::uint32_t kPale = 118;    // of 256: how much of the model's picture is paper
constexpr std::uint32_t kHidden = 150;  // of 256: how strong a wire is seen through bones
constexpr std::uint32_t kLeastPieces = 96, kMostPieces = 2048;  // of a curve

/// A curve as it is drawn: so many pieces, equal in the parameter.
struct Polyline {
  std::vector<Vec3> points;
  std::vector<std::uint16_t> inks;  // per piece: the mark of its segment
};

Polyline polyline(const CurveCost& cost, std::uint32_t curve, const std::vector<std::uint8_t>& uses) {
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

void add_corners(const Bounds& box, const Frame& frame, std::vector<Vec3>& out) {
  for (int k = 0; k < 8; ++k)
    out.push_back(frame.point(
        {k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y, k & 4 ? box.max.z : box.min.z}));
}

/// The curves of a scene with what belongs to them, and how much room they take.
class CurvePicture {
 public:
  CurvePicture(const Setup& setup, const Model& model, const MarkedCurves& marked)
      : setup_(setup),
        settings_(setup.curves->cost().settings()),
        wires_(start_drawing(inks(), kGlow)) {
    for (std::uint32_t i = 0; i < settings_.curves.size(); ++i)
      lines_.push_back(polyline(setup.curves->cost(), i, marked.uses[i]));
    add_ghosts();
    measure(model);
    const float radius = kWire * glm::length(box_.size());
    for (const Polyline& line : lines_) draw_wire(wires_, line.points, line.inks, radius);
    all_ = wires_;
    const float thick = std::min(bone_thickness(model), kThickest * radius);
    for (std::size_t i = 0; i < model.bones.size(); ++i)
      draw_bone(all_, model.bones[i], thick, static_cast<std::uint16_t>(marked.bones[i]));
  }

  const LineDrawing& wires() const { return wires_; }
  const LineDrawing& wires_and_bones() const { return all_; }
  const std::vector<Mesh>& ghosts() const { return ghosts_; }

  CameraPlace place(const RenderSettings& look) const {
    return place_of(frame_points(points_, look.azimuth_deg, look.elevation_deg, look.width, look.height, kMargin));
  }

 private:
  static std::vector<Colour> inks() {
    std::vector<Colour> inks;
    for (std::size_t i = 0; i < kCurveMarks; ++i) inks.push_back(colour_of(static_cast<CurveMark>(i)));
    return inks;
  }

  void add_ghosts() {
    ghosts_ = setup_.targets;
    for (const GuidingCurve& guide : settings_.curves) {
      Mesh tube = thickness_tube(guide);
      if (!tube.triangles.empty()) ghosts_.push_back(std::move(tube));
    }
    if (!settings_.density) return;
    Mesh box = make_primitive(MeshKind::box, 1, 4);
    const Vec3 middle = 0.5f * (settings_.density->min + settings_.density->max);
    for (Vec3& p : box.positions) p = middle + p * (settings_.density->max - settings_.density->min);
    ghosts_.push_back(std::move(box));
  }

  void measure(const Model& model) {
    for (const Polyline& line : lines_) points_.insert(points_.end(), line.points.begin(), line.points.end());
    for (const Mesh& ghost : ghosts_) add_corners(bounds(ghost), {Mat3(1), Vec3(0)}, points_);
    const Parts parts = collect_parts(model, setup_.meshes, true);
    for (const Part& part : parts.parts) add_corners(parts.shapes[part.shape].box, part.model_from_shape, points_);
    for (const Vec3& point : points_) box_.add(point);
  }

  const Setup& setup_;
  const CurveSettings& settings_;
  LineDrawing wires_, all_;
  std::vector<Polyline> lines_;
  std::vector<Mesh> ghosts_;
  std::vector<Vec3> points_;  // that the camera shall show
  Bounds box_;
};

void make_pale(Picture& picture) {
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    const Colour pale = mix({{picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]}}, kPaper, kPale);
    std::copy(std::begin(pale.rgb), std::end(pale.rgb), picture.rgb.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// `strength`: of 256.
void lay_over(Picture& picture, const Picture& lines, std::uint32_t strength) {
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const std::uint32_t alpha = lines.alpha[i / 3] * strength / 256;
    picture.rgb[i] = static_cast<std::uint8_t>((lines.rgb[i] * alpha + picture.rgb[i] * (255 - alpha) + 127) / 255);
  }
}

Picture drawn_alone(const LineDrawing& drawing, const RenderSettings& look, Executor& executor) {
  return render(drawing.model, drawing.meshes, drawing.surfaces, {}, look, executor);
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

Picture curve_view(const Setup& setup, const RenderSettings& look, Executor& executor) {
  CHECK(setup.curves != nullptr);
  const Model nothing;
  const MarkedCurves marked = mark_curves(*setup.curves, nothing);
  const CurvePicture curves(setup, nothing, marked);
  RenderSettings placed = look;
  placed.place = curves.place(look), placed.fov_deg.reset(), placed.tall.reset();
  const LineDrawing& wires = curves.wires();
  return render(wires.model, wires.meshes, wires.surfaces, curves.ghosts(), placed, executor);
}

Picture curve_view(const Setup& setup, const Model& model, const Surfaces& surfaces, const RenderSettings& look,
                   Executor& executor) {
  CHECK(setup.curves != nullptr);
  const MarkedCurves marked = mark_curves(*setup.curves, model);
  const CurvePicture curves(setup, model, marked);
  RenderSettings placed = look;
  placed.place = curves.place(look), placed.fov_deg.reset(), placed.tall.reset();
  Picture picture = render(model, setup.meshes, surfaces, curves.ghosts(), placed, executor);
  make_pale(picture);
  placed.transparent = true, placed.ground = false, placed.background.reset();
  lay_over(picture, drawn_alone(curves.wires_and_bones(), placed, executor), 256);
  lay_over(picture, drawn_alone(curves.wires(), placed, executor), kHidden);
  picture.alpha.clear();
  return picture;
}

}  // namespace espalier
