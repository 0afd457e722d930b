#pragma once
// Tracer: finds what a ray meets among placed shapes. Exact arithmetic in single precision, ties between surfaces that
// coincide go to the part of lower index: pictures do not depend on the CPU. Expects a scene of about unit size.

#include <cstdint>
#include <memory>
#include <vector>

#include "model/mesh.h"
#include "render/bvh.h"
#include "render/texture_sampler.h"

namespace espalier {

/// The triangles of one mesh.
class TriangleSet {
 public:
  explicit TriangleSet(const Mesh& mesh);

  struct Hit {
    float t = 0, u = 0, v = 0;  // barycentric: (1 - u - v), u, v
    std::uint32_t triangle = Bvh::kNone;
  };
  /// Lowers hit.t to the nearest hit before it, if there is one; true then. Rays pass where a cutout shows nothing.
  bool intersect(const Ray& ray, Hit& hit, const Cutout* cutout = nullptr) const;
  /// Whether anything lies between ray.near and far.
  bool blocks(const Ray& ray, float far, const Cutout* cutout = nullptr) const;

  /// The texture coordinates of a hit; the mesh must have some.
  Vec2 uv(std::uint32_t triangle, float u, float v) const {
    const Triangle& t = mesh_->triangles[triangle];
    return (1 - u - v) * mesh_->uvs[t[0]] + u * mesh_->uvs[t[1]] + v * mesh_->uvs[t[2]];
  }

  const Mesh& mesh() const { return *mesh_; }
  const Bounds& box() const { return bvh_.box(); }

 private:
  /// Corner and two edges of four triangles; unused ones have no area.
  struct alignas(16) Block {
    float corner[3][4], edge1[3][4], edge2[3][4];
  };
  /// Bits of the triangles that are hit; t, u and v go to arrays of four.
  static unsigned intersect_block(const Block& block, const Ray& ray, float far, float* t, float* u, float* v);

  bool intersect_leaf(std::uint32_t leaf, const Ray& ray, Hit& hit, const Cutout* cutout) const;
  bool leaf_blocks(std::uint32_t leaf, const Ray& ray, float far, const Cutout* cutout) const;

  static constexpr std::size_t kFewBlocks = 2;  // so many are tried one after another

  const Mesh* mesh_;
  Bvh bvh_;
  std::vector<Block> blocks_;
};

struct Placed {
  const TriangleSet* shape = nullptr;
  Frame world_from_shape, shape_from_world;
  Mat3 normals_from_shape;       // to world, not normalised
  std::uint16_t material = 0;
  const Cutout* cutout = nullptr;  // null: all is solid
};

class Tracer {
 public:
  Tracer() = default;
  explicit Tracer(std::vector<Placed> parts);

  static constexpr float kTie = 2e-5f;  // surfaces this close coincide

  struct Hit {
    float t = 1e30f, u = 0, v = 0;
    std::uint32_t part = Bvh::kNone, triangle = 0;
    explicit operator bool() const { return part != Bvh::kNone; }
  };
  Hit intersect(const Ray& ray, float far = 1e30f) const;
  bool blocks(const Ray& ray, float far) const;

  const Placed& part(std::uint32_t i) const { return parts_[i]; }
  bool empty() const { return parts_.empty(); }
  std::size_t size() const { return parts_.size(); }
  const Bounds& box() const { return bvh_.box(); }

  /// Unit normals at a hit: of the triangle, and interpolated. Both on the side that the ray comes from.
  void normals(const Hit& hit, const Vec3& ray_direction, Vec3& flat, Vec3& smooth) const;

  /// Texture coordinates at a hit, and how much of the picture's side a unit of length in the world covers there.
  Vec2 uv(const Hit& hit, float& share_per_length) const;

 private:
  /// What a ray needs of a part before it hits, in one line of the cache; in the order of the tree's leaves.
  struct alignas(64) Entry {
    Frame shape_from_world;
    const TriangleSet* shape = nullptr;
    std::uint32_t part = 0;
    bool cut_out = false;

    Ray local(const Ray& ray) const {
      return {shape_from_world.point(ray.origin), shape_from_world.vector(ray.direction), ray.near};
    }
  };
  const Cutout* cutout(const Entry& entry) const { return entry.cut_out ? parts_[entry.part].cutout : nullptr; }

  std::vector<Placed> parts_;
  std::vector<Entry> entries_;
  Bvh bvh_;
};

}  // namespace espalier
