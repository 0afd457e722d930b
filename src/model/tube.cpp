#include "model/tube.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "base/math.h"
#include "model/circle.h"
#include "model/surface_scale.h"

namespace espalier {
namespace {

constexpr float kCollar = 0.3f;      // how much wider a limb is where it meets its host
constexpr float kCollarRun = 1.6f;   // radii from there to where it has its own width again
constexpr double kBetterFit = 0.75;   // pictures around that a tube may be off before their number changes
constexpr float kThicknessMatters = 0.4f;  // a change of thickness is seen sooner than one of place
constexpr float kThinForHost = 0.8f;  // of the host's radius; thicker limbs fork and need no collar

bool finite(const LimbJoint& joint) {
  const float sum = joint.at.x + joint.at.y + joint.at.z + joint.radius;
  return sum - sum == 0 && joint.radius >= 0;
}

std::vector<LimbJoint> usable(std::span<const LimbJoint> joints) {
  std::vector<LimbJoint> out;
  for (const LimbJoint& joint : joints) {
    if (!finite(joint)) continue;
    const float step = out.empty() ? 1 : glm::length(joint.at - out.back().at);
    if (step > 1e-6f * std::max(joint.radius, 1e-20f)) out.push_back(joint);
  }
  return out;
}

/// A direction across `axis`, the same for equal axes.
Vec3 across(const Vec3& axis) {
  const Vec3 size = glm::abs(axis);
  const bool x = size.x <= size.y && size.x <= size.z;
  const Vec3 least = x ? Vec3(1, 0, 0) : size.z <= size.y ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  return glm::normalize(least - axis * glm::dot(least, axis));
}

/// One ring: where it stands, and how the surface leans there.
struct Ring {
  Vec3 at, along, x, z;  // along the axis and across it; right-handed as x, along, z
  float radius;
  float widening;        // of the radius per metre of the axis, mean of both sides
  double from_base;      // m along the surface
};

std::vector<Ring> sweep(const std::vector<LimbJoint>& joints) {
  std::vector<Ring> rings(joints.size());
  const std::size_t last = joints.size() - 1;
  const auto direction = [&](std::size_t k) { return glm::normalize(joints[k + 1].at - joints[k].at); };
  const auto widening = [&](std::size_t k) {
    return (joints[k + 1].radius - joints[k].radius) / glm::length(joints[k + 1].at - joints[k].at);
  };
  for (std::size_t k = 0; k <= last; ++k) {
    Ring& ring = rings[k];
    ring.at = joints[k].at, ring.radius = joints[k].radius;
    const Vec3 in = direction(k == 0 ? 0 : k - 1), out = direction(k == last ? last - 1 : k), sum = in + out;
    ring.along = glm::dot(sum, sum) > 1e-6f ? glm::normalize(sum) : out;  // it turns right back: as it goes on
    ring.widening = 0.5f * (widening(k == 0 ? 0 : k - 1) + widening(k == last ? last - 1 : k));
    if (k == 0) {
      ring.x = across(ring.along), ring.from_base = 0;
    } else {
      // The ring before, turned by the least turn that takes one direction to the other (double reflection).
      const Ring& before = rings[k - 1];
      const Vec3 step = ring.at - before.at;
      const float squared = glm::dot(step, step);
      const Vec3 x = before.x - step * (2 * glm::dot(step, before.x) / squared);
      const Vec3 along = before.along - step * (2 * glm::dot(step, before.along) / squared);
      const Vec3 back = ring.along - along;
      const float turned = glm::dot(back, back);
      const Vec3 moved = turned > 1e-12f ? x - back * (2 * glm::dot(back, x) / turned) : x;
      const Vec3 flat = moved - ring.along * glm::dot(moved, ring.along);
      ring.x = glm::dot(flat, flat) > 1e-6f ? glm::normalize(flat) : across(ring.along);
      const double rise = static_cast<double>(ring.radius) - before.radius;
      ring.from_base = before.from_base + std::sqrt(static_cast<double>(squared) + rise * rise);
    }
    ring.z = glm::cross(ring.x, ring.along);
  }
  return rings;
}

/// Of the surface between a ring and the next.
double girth_above(const std::vector<Ring>& rings, std::size_t k) {
  return kPi * (static_cast<double>(rings[k].radius) + rings[k + 1].radius);
}

/// Of all the surface, weighted by its length.
double mean_girth(const std::vector<Ring>& rings) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < rings.size(); ++k)
    sum += girth_above(rings, k) * (rings[k + 1].from_base - rings[k].from_base);
  return sum / rings.back().from_base;
}

/// How many pictures stand around the surface between each ring and the next. Where the girth changes so much that
/// another number fits clearly better, that one goes on.
std::vector<float> pictures(const std::vector<Ring>& rings, double metres) {
  std::vector<float> out;
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    const double girth = girth_above(rings, k);
    const bool stays = k > 0 && std::abs(girth / metres - static_cast<double>(out.back())) < kBetterFit;
    out.push_back(stays ? out.back() : pictures_around(girth, metres));
  }
  return out;
}

void add_vertex(Mesh& mesh, const Vec3& position, const Vec3& normal, const Vec2& uv) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.uvs.push_back(uv);
}

Vec3 rim(const Ring& ring, std::uint32_t i, std::uint32_t sides) {
  const CirclePoint c = circle_point(i % sides, sides);
  return static_cast<float>(c.cos) * ring.x + static_cast<float>(c.sin) * ring.z;
}

void add_end(Mesh& mesh, const Ring& ring, std::uint32_t sides, double metres, bool up) {
  if (!(ring.radius > 0)) return;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto scale = static_cast<float>(ring.radius / metres);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const CirclePoint c = circle_point(i, sides);
    const Vec2 uv(scale * static_cast<float>(c.cos), scale * static_cast<float>(up ? -c.sin : c.sin));
    add_vertex(mesh, ring.at + ring.radius * rim(ring, i, sides), up ? ring.along : -ring.along, uv);
  }
  for (std::uint32_t k = 2; k < sides; ++k)
    mesh.triangles.push_back(up ? Triangle{first, first + k, first + k - 1}
                                : Triangle{first, first + k - 1, first + k});
}

}  // namespace

void add_tube(Mesh& mesh, std::span<const LimbJoint> given, const TubeLook& look) {
  CHECK(look.sides >= 3 && mesh.normals.size() == mesh.positions.size() && mesh.uvs.size() == mesh.positions.size());
  const std::vector<LimbJoint> joints = usable(given);
  const auto thick = [](const LimbJoint& joint) { return joint.radius > 0; };
  if (joints.size() < 2 || std::none_of(joints.begin(), joints.end(), thick)) return;
  const std::vector<Ring> rings = sweep(joints);
  const double girth = mean_girth(rings), metres = look.metres > 0 ? look.metres : girth;
  const std::vector<float> around = pictures(rings, metres);
  const std::uint32_t sides = look.sides;
  const auto add_ring = [&](const Ring& ring, float pictures_here) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto v = static_cast<float>(ring.from_base / metres);
    for (std::uint32_t i = 0; i <= sides; ++i) {  // the first side's twice: the picture's edges meet there
      const Vec3 outward = rim(ring, i, sides);
      const float u = pictures_here * (1 - static_cast<float>(i) / static_cast<float>(sides));
      add_vertex(mesh, ring.at + ring.radius * outward, glm::normalize(outward - ring.widening * ring.along), {u, v});
    }
    return first;
  };
  std::uint32_t low = add_ring(rings[0], around[0]);
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    if (k > 0 && around[k] != around[k - 1]) low = add_ring(rings[k], around[k]);
    const std::uint32_t high = add_ring(rings[k + 1], around[k]);
    for (std::uint32_t i = 0; i < sides; ++i) {
      if (rings[k].radius > 0) mesh.triangles.push_back({low + i, high + i, low + i + 1});
      if (rings[k + 1].radius > 0) mesh.triangles.push_back({low + i + 1, high + i, high + i + 1});
    }
    low = high;
  }
  add_end(mesh, rings.front(), sides, metres, false);
  add_end(mesh, rings.back(), sides, metres, true);
}

std::vector<LimbJoint> with_collar(const Limb& limb) {
  const std::vector<LimbJoint>& joints = limb.joints;
  CHECK(joints.size() >= 2);
  const float radius = joints[0].radius, first = glm::length(joints[1].at - joints[0].at);
  if (!(limb.depth > 0) || radius > kThinForHost * limb.host) return joints;
  const float end = limb.depth + kCollarRun * radius;
  if (end >= first) return joints;
  const Vec3 along = (joints[1].at - joints[0].at) / first;
  const auto at = [&](float distance, float widened) {
    const float own = radius + (joints[1].radius - radius) * (distance / first);
    return LimbJoint{joints[0].at + distance * along, own * widened};
  };
  const float widest = std::min(1 + kCollar, 0.95f * limb.host / radius);
  std::vector<LimbJoint> out = {at(0, 1), at(0.9f * limb.depth, widest),
                                at(limb.depth + 0.45f * kCollarRun * radius, 1 + 0.3f * (widest - 1)), at(end, 1)};
  out.insert(out.end(), joints.begin() + 1, joints.end());
  return out;
}

std::vector<LimbJoint> without_straight_joints(std::span<const LimbJoint> joints, float tolerance) {
  std::vector<LimbJoint> out;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    if (k == 0 || k + 1 == joints.size()) {
      out.push_back(joints[k]);
      continue;
    }
    const LimbJoint &a = out.back(), &b = joints[k], &c = joints[k + 1];
    const Vec3 line = c.at - a.at;
    const float squared = glm::dot(line, line);
    const float share = squared > 0 ? std::clamp(glm::dot(b.at - a.at, line) / squared, 0.0f, 1.0f) : 0;
    const float off = glm::length(b.at - (a.at + share * line));
    const float wider = std::abs(b.radius - (a.radius + share * (c.radius - a.radius)));
    if (off > tolerance * b.radius || wider > kThicknessMatters * tolerance * b.radius) out.push_back(b);
  }
  return out;
}

std::uint64_t tube_triangles(std::size_t joints, std::uint32_t sides) {
  return std::uint64_t{2} * sides * (joints - 1) + std::uint64_t{2} * (sides - 2);
}

}  // namespace espalier
