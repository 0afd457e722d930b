#include "render/line_drawing.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "grammar/surface_arguments.h"
#include "render/sampling.h"

namespace espalier {
namespace {

constexpr float kJoint = 0.15f;  // of a bone's length: where it is widest
constexpr float kThick = 0.12f;  // of its length
constexpr float kBall = 2.2f, kHeadWide = 3.2f, kHeadLong = 9;  // of a wire's radius

enum LineMesh : std::uint16_t { kPyramid, kCylinder, kSphere, kCone };

class NoMeshFiles final : public MeshSource {
 public:
  Mesh load(const std::string&) override { return {}; }
};

/// With y from `base` to `tip`; right-handed. Half of `wide` on every side.
Frame along(const Vec3& base, const Vec3& tip, float wide) {
  const Vec3 axis = tip - base;
  Vec3 aside, across;
  complete_basis(glm::normalize(axis), aside, across);
  return {Mat3(wide * across, axis, wide * aside), 0.5f * (base + tip)};
}

void add(LineDrawing& drawing, LineMesh mesh, const Frame& frame, std::uint16_t ink, std::uint32_t gene = 0) {
  Instance instance;
  instance.model_from_mesh = frame;
  instance.mesh = mesh, instance.material = ink, instance.gene = gene;
  if (mesh == kCone) instance.top = 0;
  drawing.model.instances.push_back(instance);
}

void add_ball(LineDrawing& drawing, const Vec3& at, float radius, std::uint16_t ink) {
  add(drawing, kSphere, {Mat3(2 * radius), at}, ink);
}

bool has_length(const Vec3& v) {
  const float length = glm::length(v);
  return length > 0 && std::isfinite(length);
}

}  // namespace

LineDrawing start_drawing(const std::vector<Colour>& inks, float glow) {
  LineDrawing drawing;
  GeneratorGraph graph;
  for (const MeshKind kind : {MeshKind::pyramid, MeshKind::cylinder, MeshKind::sphere, MeshKind::cone}) {
    MeshRef& ref = graph.meshes.emplace_back();
    ref.kind = kind, ref.sides = 16;
  }
  NoMeshFiles source;
  drawing.meshes = MeshTable(graph, "", source);
  std::vector<Material> materials;
  for (const Colour& ink : inks) {
    Material& material = materials.emplace_back();
    for (int c = 0; c < 3; ++c) material.color[c] = linear_light(ink.rgb[c]);
    material.glow = glow;
  }
  drawing.surfaces = Surfaces(std::move(materials));
  return drawing;
}

void draw_bone(LineDrawing& drawing, const Bone& bone, float thick, std::uint16_t ink) {
  const Vec3 whole = bone.to - bone.from;
  const float length = glm::length(whole);
  if (!(length > 1e-6f * thick) || !std::isfinite(length)) return;
  const Vec3 joint = bone.from + kJoint * whole;
  for (const Vec3& tip : {bone.from, bone.to})
    add(drawing, kPyramid, along(joint, tip, std::min(kThick * length, thick)), ink, bone.gene);
}

void draw_wire(LineDrawing& drawing, std::span<const Vec3> points, std::span<const std::uint16_t> inks, float radius) {
  CHECK(points.size() >= 2 && inks.size() + 1 == points.size());
  add_ball(drawing, points.front(), kBall * radius, inks.front());
  Vec3 direction(0);
  for (std::size_t i = 0; i < inks.size(); ++i) {
    const Vec3 &from = points[i], &to = points[i + 1];
    if (!has_length(to - from)) continue;
    direction = glm::normalize(to - from);
    add(drawing, kCylinder, along(from, to, 2 * radius), inks[i]);
    add_ball(drawing, to, radius, inks[i]);
  }
  if (direction == Vec3(0)) return;
  // The point of the arrow lies a little beyond the end, so that the wire does not stick out of it.
  const Vec3 tip = points.back() + 0.5f * kHeadLong * radius * direction;
  add(drawing, kCone, along(tip - kHeadLong * radius * direction, tip, 2 * kHeadWide * radius), inks.back());
}

}  // namespace espalier
