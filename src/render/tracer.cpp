#include "render/tracer.h"

#include <glm/geometric.hpp>

namespace espalier {
namespace {

/// Triangles may overlap their neighbours by this share, so that no ray slips through an edge.
constexpr float kEdgeSlack = 1e-5f;

Bounds moved(const Bounds& box, const Frame& frame) {
  Bounds out;
  for (int corner = 0; corner < 8; ++corner) {
    out.add(frame.point({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                         corner & 4 ? box.max.z : box.min.z}));
  }
  return out;
}

Float4 dot(const Float4 (&a)[3], const Float4 (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void cross(const Float4 (&a)[3], const Float4 (&b)[3], Float4 (&out)[3]) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    out[k] = a[i] * b[j] - a[j] * b[i];
  }
}

Vec3 unit(const Vec3& v, const Vec3& fallback) {
  const float length2 = glm::dot(v, v);
  return length2 > 0 && length2 < 1e37f ? v / std::sqrt(length2) : fallback;
}

}  // namespace

TriangleSet::TriangleSet(const Mesh& mesh) : mesh_(&mesh) {
  std::vector<Bounds> boxes(mesh.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const std::uint32_t corner : mesh.triangles[i]) boxes[i].add(mesh.positions[corner]);
  }
  bvh_ = Bvh(boxes, 4);
  blocks_.reserve(bvh_.leaves().size());
  for (const Bvh::Leaf& leaf : bvh_.leaves()) {
    Block& block = blocks_.emplace_back();
    for (int k = 0; k < 4; ++k) {
      Vec3 corner(0), edge1(0), edge2(0);
      if (leaf[k] != Bvh::kNone) {
        const Triangle& t = mesh.triangles[leaf[k]];
        corner = mesh.positions[t[0]];
        edge1 = mesh.positions[t[1]] - corner;
        edge2 = mesh.positions[t[2]] - corner;
      }
      for (int axis = 0; axis < 3; ++axis) {
        block.corner[axis][k] = corner[axis];
        block.edge1[axis][k] = edge1[axis];
        block.edge2[axis][k] = edge2[axis];
      }
    }
  }
}

// Moeller and Trumbore 1997, four triangles at a time.
unsigned TriangleSet::intersect_block(const Block& block, const Ray& ray, float far, float* t, float* u, float* v) {
  const Float4 d[3] = {Float4(ray.direction.x), Float4(ray.direction.y), Float4(ray.direction.z)};
  const Float4 e1[3] = {Float4::load(block.edge1[0]), Float4::load(block.edge1[1]), Float4::load(block.edge1[2])};
  const Float4 e2[3] = {Float4::load(block.edge2[0]), Float4::load(block.edge2[1]), Float4::load(block.edge2[2])};
  const Float4 s[3] = {Float4(ray.origin.x) - Float4::load(block.corner[0]),
                       Float4(ray.origin.y) - Float4::load(block.corner[1]),
                       Float4(ray.origin.z) - Float4::load(block.corner[2])};
  Float4 p[3] = {d[0], d[0], d[0]}, q[3] = {d[0], d[0], d[0]};
  cross(d, e2, p);
  cross(s, e1, q);
  const Float4 scale = Float4(1) / dot(e1, p);  // parallel or without area: not a number or infinite, never a hit
  const Float4 us = dot(s, p) * scale, vs = dot(d, q) * scale, ts = dot(e2, q) * scale;
  const Float4 slack(-kEdgeSlack);
  const unsigned mask = less_equal(slack, us) & less_equal(slack, vs) & less_equal(us + vs, Float4(1 + kEdgeSlack)) &
                        less_equal(Float4(ray.near), ts) & less_equal(ts, Float4(far));
  if (mask) ts.store(t), us.store(u), vs.store(v);
  return mask;
}

bool TriangleSet::intersect_leaf(std::uint32_t leaf, const Ray& ray, Hit& hit, const Cutout* cutout) const {
  alignas(16) float t[4], u[4], v[4];
  const unsigned mask = intersect_block(blocks_[leaf], ray, hit.t, t, u, v);
  bool found = false;
  for (int k = 0; mask >> k; ++k) {
    if (!(mask >> k & 1) || !(t[k] < hit.t)) continue;
    if (cutout && !cutout->shows(uv(bvh_.leaves()[leaf][k], u[k], v[k]))) continue;
    hit = {t[k], u[k], v[k], bvh_.leaves()[leaf][k]}, found = true;
  }
  return found;
}

bool TriangleSet::leaf_blocks(std::uint32_t leaf, const Ray& ray, float far, const Cutout* cutout) const {
  alignas(16) float t[4], u[4], v[4];
  const unsigned mask = intersect_block(blocks_[leaf], ray, far, t, u, v);
  if (!cutout) return mask != 0;
  for (int k = 0; mask >> k; ++k) {
    if ((mask >> k & 1) && cutout->shows(uv(bvh_.leaves()[leaf][k], u[k], v[k]))) return true;
  }
  return false;
}

bool TriangleSet::intersect(const Ray& ray, Hit& hit, const Cutout* cutout) const {
  bool found = false;
  if (blocks_.size() <= kFewBlocks) {
    for (std::uint32_t leaf = 0; leaf < blocks_.size(); ++leaf) found |= intersect_leaf(leaf, ray, hit, cutout);
    return found;
  }
  bvh_.traverse(ray, hit.t, [&](std::uint32_t leaf) {
    found |= intersect_leaf(leaf, ray, hit, cutout);
    return false;
  });
  return found;
}

bool TriangleSet::blocks(const Ray& ray, float far, const Cutout* cutout) const {
  if (blocks_.size() <= kFewBlocks) {
    for (std::uint32_t leaf = 0; leaf < blocks_.size(); ++leaf) {
      if (leaf_blocks(leaf, ray, far, cutout)) return true;
    }
    return false;
  }
  return bvh_.traverse_unordered(ray, far, [&](std::uint32_t leaf) { return leaf_blocks(leaf, ray, far, cutout); });
}

Tracer::Tracer(std::vector<Placed> parts) : parts_(std::move(parts)) {
  std::vector<Bounds> boxes;
  for (const Placed& part : parts_) boxes.push_back(moved(part.shape->box(), part.world_from_shape));
  bvh_ = Bvh(boxes, 1);
  entries_.reserve(parts_.size());
  for (const Bvh::Leaf& leaf : bvh_.leaves()) {
    const Placed& part = parts_[leaf[0]];
    entries_.push_back({part.shape_from_world, part.shape, leaf[0], part.cutout != nullptr});
  }
}

Tracer::Hit Tracer::intersect(const Ray& ray, float far) const {
  Hit best;
  best.t = far;
  float limit = far;  // hits just behind the best may still win the tie
  bvh_.traverse(ray, limit, [&](std::uint32_t leaf) {
    const Entry& entry = entries_[leaf];
    const std::uint32_t index = entry.part;
    TriangleSet::Hit hit;
    hit.t = limit;
    if (!entry.shape->intersect(entry.local(ray), hit, cutout(entry))) return false;
    const bool wins = !best || hit.t < best.t - kTie || (hit.t <= best.t + kTie && index < best.part);
    if (wins) {
      best = {hit.t, hit.u, hit.v, index, hit.triangle};
      limit = best.t + kTie < far ? best.t + kTie : far;
    }
    return false;
  });
  return best;
}

bool Tracer::blocks(const Ray& ray, float far) const {
  return bvh_.traverse_unordered(ray, far, [&](std::uint32_t leaf) {
    const Entry& entry = entries_[leaf];
    return entry.shape->blocks(entry.local(ray), far, cutout(entry));
  });
}

void Tracer::normals(const Hit& hit, const Vec3& ray_direction, Vec3& flat, Vec3& smooth) const {
  const Placed& part = parts_[hit.part];
  const Mesh& mesh = part.shape->mesh();
  const Triangle& t = mesh.triangles[hit.triangle];
  const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
  flat = unit(part.normals_from_shape * unit(glm::cross(b - a, c - a), Vec3(0, 1, 0)), -ray_direction);
  const Vec3 blend = (1 - hit.u - hit.v) * mesh.normals[t[0]] + hit.u * mesh.normals[t[1]] + hit.v * mesh.normals[t[2]];
  smooth = unit(part.normals_from_shape * blend, flat);
  if (glm::dot(flat, ray_direction) > 0) flat = -flat;
  if (glm::dot(smooth, flat) < 0) smooth = -smooth;
}

Vec2 Tracer::uv(const Hit& hit, float& share_per_length) const {
  const Placed& part = parts_[hit.part];
  const Mesh& mesh = part.shape->mesh();
  const Triangle& t = mesh.triangles[hit.triangle];
  const Vec3 a = part.world_from_shape.vector(mesh.positions[t[1]] - mesh.positions[t[0]]);
  const Vec3 b = part.world_from_shape.vector(mesh.positions[t[2]] - mesh.positions[t[0]]);
  const Vec2 p = mesh.uvs[t[1]] - mesh.uvs[t[0]], q = mesh.uvs[t[2]] - mesh.uvs[t[0]];
  const float area = glm::length(glm::cross(a, b)), shown = std::abs(p.x * q.y - p.y * q.x);
  share_per_length = area > 0 ? std::sqrt(shown / area) : 0;
  return part.shape->uv(hit.triangle, hit.u, hit.v);
}

}  // namespace espalier
