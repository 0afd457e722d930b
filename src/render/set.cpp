#include "render/set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_set>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/box_corner.h"
#include "base/hash.h"
#include "model/uv.h"
#include "render/crease.h"

namespace espalier {
namespace {

constexpr std::size_t kMostSnugCorners = 2'000'000;  // of a mesh's positions, for a snug frame; its box beyond

/// Flat shapes often come with no length along their flat axis: gives them one, so that the frame can be inverted.
Mat3 with_depth(Mat3 basis, const Bounds& shape_box) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 across = glm::cross(basis[(i + 1) % 3], basis[(i + 2) % 3]);
    const float length = glm::length(across);
    if (shape_box.size()[i] == 0 && length > 0) basis[i] = across / std::sqrt(length);
  }
  return basis;
}

bool invertible(const glm::dmat3& m) {
  const double volume = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
  return std::abs(glm::determinant(m)) > 1e-7 * volume && volume > 1e-24;
}

Mat3 cofactors(const glm::dmat3& m) {
  const glm::dmat3 c(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  // Only the direction counts; the scale keeps tiny parts' normals representable.
  const double scale = std::max({glm::length(c[0]), glm::length(c[1]), glm::length(c[2])});
  const double sign = glm::determinant(m) < 0 ? -1 : 1;
  return scale > 0 ? Mat3(c * (sign / scale)) : Mat3(1);
}

/// Parts met before: of the same shape and material, and all but in one place.
class Twins {
 public:
  /// `centre` and `sides`: of the shape's box, in the scene of unit size.
  bool met(const Part& part, const Vec3& centre, const Vec3 (&sides)[3]) {
    Key key{part.shape, part.material};
    std::size_t at = 2;
    for (const Vec3& v : {centre, sides[0], sides[1], sides[2]}) {
      for (int i = 0; i < 3; ++i) key[at++] = cell(v[i]);
    }
    return !seen_.insert(key).second;
  }

 private:
  static constexpr float kCell = Tracer::kTie;  // surfaces this close coincide anyway
  using Key = std::array<std::uint32_t, 14>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::uint32_t word : key) hash = scatter(hash ^ word);
      return hash;
    }
  };
  static std::uint32_t cell(float x) {
    const float cells = std::clamp(x / kCell, -1e9f, 1e9f);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(cells + (x < 0 ? -0.5f : 0.5f)));
  }

  std::unordered_set<Key, Hash> seen_;
};

class SetBuilder {
 public:
  /// `merged`: parts are many in one, so their boxes would frame the model too widely.
  SetBuilder(Parts parts, const std::vector<Mesh>& ghosts, bool merged) : parts_(std::move(parts)), merged_(merged) {
    for (const Mesh& ghost : ghosts) ghosts_.push_back(with_crease_normals(ghost));
    measure();
  }

  Set build(const Surfaces& surfaces) {
    set_.surfaces = surfaces;
    add_textures();
    std::vector<Placed> opaque, translucent, ghosts;
    shapes_.resize(2 * parts_.shapes.size());
    Twins twins;
    for (const Part& part : parts_.parts) {
      const Shape& shape = parts_.shapes[part.shape];
      const AlphaMode alpha = surfaces.alpha_mode(part.material);
      const Material& m = surfaces.material(part.material);
      const bool nowhere = alpha == AlphaMode::mask && m.opacity < m.cutout;
      if (shape.mesh.triangles.empty() || nowhere) continue;
      // Thousands of parts in one place, or a hair's breadth apart, look like one, but every ray would try them all.
      if (alpha != AlphaMode::blend && met(twins, part, shape.box)) continue;
      (alpha == AlphaMode::blend ? translucent : opaque).push_back(place(part, shape));
    }
    for (Mesh& ghost : ghosts_) {
      if (ghost.triangles.empty()) continue;
      for (Vec3& p : ghost.positions) p = unit_point(p);
      add_corners(ghost);
      ghosts.push_back({keep(std::move(ghost)), {}, {}, Mat3(1), 0, nullptr});
    }
    set_.opaque = Tracer(std::move(opaque));
    set_.translucent = Tracer(std::move(translucent));
    set_.ghosts = Tracer(std::move(ghosts));
    set_.lowest = 1e30f;
    for (const Vec3& p : set_.corners) set_.lowest = std::min(set_.lowest, p.y);
    if (set_.corners.empty()) set_.lowest = 0;
    return std::move(set_);
  }

 private:
  /// The middle and size of all that is shown.
  void measure() {
    Bounds all;
    for (const Part& part : parts_.parts) {
      for (const Vec3& corner : box_corners(parts_.shapes[part.shape].box)) {
        all.add(part.model_from_shape.point(corner));
      }
    }
    for (const Mesh& ghost : ghosts_) all.add(bounds(ghost));
    if (all.empty()) return;
    set_.centre = 0.5 * (glm::dvec3(all.min) + glm::dvec3(all.max));
    const double radius = 0.5 * glm::length(glm::dvec3(all.max) - glm::dvec3(all.min));
    set_.scale = radius > 0 ? 1 / radius : 1;
  }

  static std::vector<Vec3> box_corners(const Bounds& b) {
    if (b.empty()) return {};
    std::vector<Vec3> out;
    for (int k = 0; k < 8; ++k) out.push_back(corner_of(b, k));
    return out;
  }

  Vec3 unit_point(const Vec3& p) const { return set_.unit_point(p); }

  bool met(Twins& twins, const Part& part, const Bounds& box) const {
    Vec3 sides[3];
    for (int i = 0; i < 3; ++i)
      sides[i] = Vec3(glm::dvec3(part.model_from_shape.basis[i]) * (set_.scale * static_cast<double>(box.size()[i])));
    return twins.met(part, unit_point(part.model_from_shape.point(box.centre())), sides);
  }

  Placed place(const Part& part, const Shape& shape) {
    Placed placed;
    placed.material = part.material;
    placed.cutout = part.material < cutout_of_.size() ? cutout_of_[part.material] : nullptr;
    const bool textured = set_.texture(part.material);
    const Mat3 basis = with_depth(part.model_from_shape.basis, shape.box);
    const glm::dmat3 unit_basis = glm::dmat3(basis) * set_.scale;
    for (const Vec3& corner : merged_ ? snug_corners(shape.mesh) : box_corners(shape.box)) {
      set_.corners.push_back(unit_point(part.model_from_shape.point(corner)));
    }
    if (!invertible(unit_basis)) {  // squeezed flat: a shape of its own, in place
      Mesh mesh = baked(shape, part.model_from_shape);
      for (Vec3& p : mesh.positions) p = unit_point(p);
      placed.shape = keep(textured ? with_uvs(mesh) : std::move(mesh));
      placed.normals_from_shape = Mat3(1);
      return placed;
    }
    TriangleSet*& known = shapes_[2 * part.shape + (textured ? 1 : 0)];
    if (!known) known = keep(textured ? with_uvs(shape.mesh) : Mesh(shape.mesh));
    placed.shape = known;
    const glm::dvec3 origin = (glm::dvec3(part.model_from_shape.origin) - set_.centre) * set_.scale;
    const glm::dmat3 inverse = glm::inverse(unit_basis);
    placed.world_from_shape = {Mat3(unit_basis), Vec3(origin)};
    placed.shape_from_world = {Mat3(inverse), Vec3(-(inverse * origin))};
    placed.normals_from_shape = cofactors(unit_basis);
    return placed;
  }

  void add_textures() {
    std::map<const TexturePicture*, const TextureSampler*> sampler_of;
    const Surfaces& surfaces = set_.surfaces;
    cutout_of_.resize(surfaces.size());
    set_.texture_of.resize(surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      const auto material = static_cast<std::uint16_t>(i);
      const TexturePicture* const picture = surfaces.texture(material);
      if (!picture) continue;
      const TextureSampler*& sampler = sampler_of[picture];
      if (!sampler) {
        set_.textures.push_back(std::make_unique<TextureSampler>(picture->image));
        sampler = set_.textures.back().get();
      }
      set_.texture_of[i] = sampler;
      const Material& m = surfaces.material(material);
      if (surfaces.alpha_mode(material) != AlphaMode::mask || !picture->transparent) continue;
      set_.cutouts.push_back(std::make_unique<Cutout>(Cutout{sampler, m.repeats(), m.cutout / m.opacity}));
      cutout_of_[i] = set_.cutouts.back().get();
    }
  }

  TriangleSet* keep(Mesh mesh) {
    set_.meshes.push_back(std::make_unique<Mesh>(std::move(mesh)));
    set_.shapes.push_back(std::make_unique<TriangleSet>(*set_.meshes.back()));
    return set_.shapes.back().get();
  }

  static std::vector<Vec3> snug_corners(const Mesh& mesh) {
    return mesh.positions.size() > kMostSnugCorners ? box_corners(bounds(mesh)) : mesh.positions;
  }

  void add_corners(const Mesh& ghost) {
    const std::vector<Vec3> corners = snug_corners(ghost);
    set_.corners.insert(set_.corners.end(), corners.begin(), corners.end());
  }

  Parts parts_;
  bool merged_;
  std::vector<Mesh> ghosts_;
  std::vector<TriangleSet*> shapes_;  // per shape of parts_, without and with texture coordinates; once used
  std::vector<const Cutout*> cutout_of_;  // per material
  Set set_;
};

}  // namespace

Set build_set(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
              const std::vector<Mesh>& ghosts, bool full, const std::optional<LevelOfDetail>& detail) {
  const std::vector<Material>& materials = surfaces.materials();
  Parts parts = detail ? parts_at(model, meshes, materials, *detail, full)
                       : collect_parts(model, meshes, full, materials);
  return SetBuilder(std::move(parts), ghosts, detail.has_value()).build(surfaces);
}

}  // namespace espalier
