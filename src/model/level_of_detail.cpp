#include "model/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/check.h"
#include "base/error.h"
#include "base/hash.h"
#include "model/limbs.h"
#include "model/primitives.h"
#include "model/surface_scale.h"
#include "model/tube.h"
#include "model/uv.h"

namespace espalier {
namespace {

constexpr float kSides = 110;  // of something round as thick as the whole model is large; its root counts
constexpr float kFewerSides[LevelOfDetail::kCount] = {1, 0.6f, 0.4f, 0.3f};
constexpr std::uint32_t kLeastSides[LevelOfDetail::kCount] = {4, 3, 3, 3}, kMostSides = 24;
constexpr float kStraighter[LevelOfDetail::kCount] = {0, 0.25f, 0.6f, 1.2f};  // radii that tubes may stray
constexpr float kLargestGrowth = 3;  // of leaves that stand for others
constexpr std::uint32_t kCollarLevels = 2;  // levels that have collars
constexpr std::uint32_t kCollarSides = 6;   // limbs that have: one on a twig is not seen
constexpr LeafOutline kOutlines[LevelOfDetail::kCount] = {LeafOutline::fine, LeafOutline::plain, LeafOutline::coarse,
                                                          LeafOutline::coarse};

constexpr std::uint64_t kLeafTriangles[LevelOfDetail::kCount] = {10, 4, 2, 2};  // two fewer than corners

/// Pieces that are kept or left out as a whole.
enum class Sort : std::uint8_t { limb, foliage, round, other };

struct Piece {
  Sort sort;
  bool stays;           // is never left out
  std::uint32_t index;  // of a limb, or of an instance
  float size;           // what is smallest goes first, m2
  std::uint64_t triangles = 0;  // at this level
};

/// The merged meshes: one per material, closed ones and open ones apart.
class Merger {
 public:
  explicit Merger(const std::vector<Material>& materials) : materials_(materials) {}

  /// The mesh that closed pieces of a material are added to, with normals and uvs.
  Mesh& closed(std::uint16_t material) { return meshes_[{material, false}]; }

  void add(const Shape& shape, const Frame& frame, std::uint16_t material) {
    Mesh mesh = baked(shape, frame);
    mesh = with_uvs(mesh);
    Mesh& all = meshes_[{material, shape.open}];
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
    all.uvs.insert(all.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    for (const Triangle& t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }

  Parts finish() {
    Parts out;
    for (auto& [key, mesh] : meshes_) {
      Mesh whole = with_normals(mesh);  // without what has no area
      if (whole.triangles.empty()) continue;
      whole.name = key.first < materials_.size() ? materials_[key.first].name : "";
      out.parts.push_back({Frame{}, static_cast<std::uint32_t>(out.shapes.size()), key.first, 0});
      Shape& shape = out.shapes.emplace_back();
      shape.open = key.second, shape.box = bounds(whole);
      shape.mesh = std::move(whole);
    }
    return out;
  }

 private:
  const std::vector<Material>& materials_;
  std::map<std::pair<std::uint16_t, bool>, Mesh> meshes_;
};

class Leveller {
 public:
  Leveller(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
           const LevelOfDetail& lod, bool full)
      : model_(model), meshes_(meshes), materials_(materials), lod_(lod), full_(full) {
    CHECK(lod.level < LevelOfDetail::kCount);
    const Bounds box = bounds(model, meshes, full);
    extent_ = box.empty() ? 1 : std::max(glm::length(box.size()), 1e-20f);
    if (lod.joints == Joints::smooth) limbs_ = find_limbs(model, meshes, full);
    collect();
  }

  /// Of all pieces that stay.
  std::uint64_t count() {
    keep_largest();
    thin_foliage();
    return triangles();
  }

  Parts make() {
    keep_largest();
    const std::uint64_t leaves = thin_foliage();
    require_few();
    const float growth = leaves == 0 ? 1 : std::min(kLargestGrowth, std::sqrt(static_cast<float>(foliage_.size()) /
                                                                             static_cast<float>(leaves)));
    Merger merger(materials_);
    for (const Piece& piece : solids_) {
      if (piece.sort == Sort::limb) {
        const Limb& limb = limbs_.limbs[piece.index];
        add_tube(merger.closed(limb.material), joints_of(limb, lod_.level), look_of(limb, lod_.level));
      } else {
        const Instance& instance = model_.instances[piece.index];
        merger.add(shape_of(instance), instance.model_from_mesh, instance.material);
      }
    }
    for (const Piece& piece : foliage_) {
      if (piece.triangles == 0) continue;
      const Instance& instance = model_.instances[piece.index];
      merger.add(shape_of(instance), grown(instance.model_from_mesh, growth), instance.material);
    }
    return merger.finish();
  }

 private:
  const Material* material_of(std::uint16_t index) const {
    return index < materials_.size() ? &materials_[index] : nullptr;
  }
  MeshKind kind_of(const Instance& instance) const { return meshes_.ref(instance.mesh).kind; }

  Sort sort_of(const Instance& instance) const {
    const Material* const material = material_of(instance.material);
    const MeshKind kind = kind_of(instance);
    if (kind == MeshKind::leaf || (material && material->cutout > 0)) return Sort::foliage;
    if (kind == MeshKind::cone || kind == MeshKind::cylinder || kind == MeshKind::sphere) return Sort::round;
    return Sort::other;
  }

  void collect() {
    for (std::uint32_t k = 0; k < limbs_.limbs.size(); ++k) {
      const Limb& limb = limbs_.limbs[k];
      float size = 0;
      for (std::size_t j = 1; j < limb.joints.size(); ++j)
        size += glm::length(limb.joints[j].at - limb.joints[j - 1].at) *
                (limb.joints[j].radius + limb.joints[j - 1].radius);
      solids_.push_back({Sort::limb, false, k, size});
    }
    for (std::uint32_t i = 0; i < model_.instances.size(); ++i) {
      const Instance& instance = model_.instances[i];
      if (!is_shown(instance, full_) || (!limbs_.limb_of.empty() && limbs_.limb_of[i] != Limbs::kNone)) continue;
      const Sort sort = sort_of(instance);
      const Mat3& m = instance.model_from_mesh.basis;
      const float lengths[] = {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
      const float size = std::max({lengths[0] * lengths[1], lengths[1] * lengths[2], lengths[0] * lengths[2]});
      const bool stays = sort == Sort::other && instance.layer != Layer::detail;
      (sort == Sort::foliage ? foliage_ : solids_).push_back({sort, stays, i, size});
    }
  }

  std::uint32_t sides_of(float radius, std::uint32_t level) const {
    const float sides = kSides * std::sqrt(radius / extent_) * kFewerSides[level];
    return std::clamp(static_cast<std::uint32_t>(std::min(sides, 1000.0f) + 0.5f), kLeastSides[level], kMostSides);
  }

  std::vector<LimbJoint> joints_of(const Limb& limb, std::uint32_t level) const {
    const bool collar = level < kCollarLevels && sides_of(limb.joints[0].radius, 0) >= kCollarSides;
    const std::vector<LimbJoint> joints = collar ? with_collar(limb) : limb.joints;
    return kStraighter[level] > 0 ? without_straight_joints(joints, kStraighter[level]) : joints;
  }

  TubeLook look_of(const Limb& limb, std::uint32_t level) const {
    float radius = 0;
    for (const LimbJoint& joint : limb.joints) radius += joint.radius;
    radius /= static_cast<float>(limb.joints.size());
    const Material* const material = material_of(limb.material);
    return {sides_of(radius, level), material && material->textured() ? material->metres : 0};
  }

  /// The sides of something round that stands by itself, at most those of the grammar.
  std::uint32_t sides_of(const Instance& instance, std::uint32_t level) const {
    const Mat3& m = instance.model_from_mesh.basis;
    const float radius = 0.5f * std::max(glm::length(m[0]), glm::length(m[2]));
    const std::uint32_t asked = meshes_.ref(instance.mesh).sides;
    return std::min(sides_of(radius, level), std::max(asked, 3u));
  }

  std::uint64_t triangles_of(const Piece& piece, std::uint32_t level) const {
    if (piece.sort == Sort::limb) {
      const Limb& limb = limbs_.limbs[piece.index];
      return tube_triangles(joints_of(limb, level).size(), look_of(limb, level).sides);
    }
    const Instance& instance = model_.instances[piece.index];
    const std::uint32_t sides = sides_of(instance, level);
    switch (kind_of(instance)) {
      case MeshKind::cone:
        if (!(instance.top > 0)) return 2 * sides - 2;
        [[fallthrough]];
      case MeshKind::cylinder: return 4 * sides - 4;
      case MeshKind::sphere: return std::uint64_t{2} * sides * (std::max<std::uint32_t>(sides / 2, 2) - 1);
      case MeshKind::leaf: return kLeafTriangles[level];
      default: return meshes_.mesh(instance.mesh).triangles.size();
    }
  }

  /// Leaves out the smallest solids until the others have the level's share of what the finest level has.
  void keep_largest() {
    std::uint64_t finest = 0, now = 0;
    for (Piece& piece : solids_) {
      finest += triangles_of(piece, 0);
      now += piece.triangles = triangles_of(piece, lod_.level);
    }
    const auto target = static_cast<std::uint64_t>(LevelOfDetail::kShares[lod_.level] * static_cast<double>(finest));
    if (lod_.level == 0 || now <= target) return;
    std::vector<std::uint32_t> order(solids_.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return solids_[a].size < solids_[b].size; });
    for (std::size_t k = 0; k + 1 < order.size() && now > target; ++k) {  // the largest always stays
      Piece& piece = solids_[order[k]];
      if (piece.stays) continue;
      now -= piece.triangles, piece.triangles = 0;
    }
    std::erase_if(solids_, [](const Piece& piece) { return piece.triangles == 0; });
  }

  std::uint64_t triangles() const {
    std::uint64_t sum = 0;
    for (const std::vector<Piece>* pieces : {&solids_, &foliage_})
      for (const Piece& piece : *pieces) sum += piece.triangles;
    return sum;
  }

  /// Merged meshes copy what instances share.
  void require_few() const {
    const std::uint64_t all = triangles();
    if (all <= LevelOfDetail::kMostTriangles) return;
    throw Error(fmt::format("level of detail {} must have at most {} triangles, got {}", lod_.level,
                            LevelOfDetail::kMostTriangles, all));
  }

  /// Leaves that are not chosen get no triangles. How many are left.
  std::uint64_t thin_foliage() {
    std::uint64_t finest = 0, now = 0;
    for (Piece& piece : foliage_) {
      finest += triangles_of(piece, 0);
      now += piece.triangles = triangles_of(piece, lod_.level);
    }
    const double target = LevelOfDetail::kShares[lod_.level] * static_cast<double>(finest);
    if (lod_.level == 0 || static_cast<double>(now) <= target) return foliage_.size();
    // The same order at every level, so a coarser one's leaves are among a finer one's.
    std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
    for (std::uint32_t k = 0; k < foliage_.size(); ++k) order.emplace_back(scatter(foliage_[k].index), k);
    std::sort(order.begin(), order.end());
    std::uint64_t left = 0;
    double sum = 0;
    for (const auto& [key, k] : order) {
      Piece& piece = foliage_[k];
      if (sum + static_cast<double>(piece.triangles) > target) piece.triangles = 0;
      sum += static_cast<double>(piece.triangles), left += piece.triangles > 0;
    }
    return left;
  }

  /// Larger, from its stem, which stands at the lower edge.
  static Frame grown(const Frame& frame, float growth) {
    const Vec3 stem = frame.origin - 0.5f * frame.basis[1];
    return {frame.basis * growth, stem + 0.5f * growth * frame.basis[1]};
  }

  /// The instance's shape at this level, with its pictures to scale. Shapes that parts share are made once.
  const Shape& shape_of(const Instance& instance) {
    const MeshRef& ref = meshes_.ref(instance.mesh);
    const Material* const material = material_of(instance.material);
    const bool round = ref.kind == MeshKind::cone || ref.kind == MeshKind::cylinder || ref.kind == MeshKind::sphere;
    const float top = ref.kind == MeshKind::cone ? std::max(instance.top, 0.0f) : 1;
    Key key{instance.mesh, top, round ? sides_of(instance, lod_.level) : 0, 0, {}};
    if (material && material->textured() && ref.kind != MeshKind::file) key.metres = material->metres;
    if (key.metres > 0) key.size = PartSize(instance.model_from_mesh.basis);
    const auto [it, fresh] = shapes_.try_emplace(key);
    Shape& shape = it->second;
    if (!fresh) return shape;
    Mesh mesh = ref.kind == MeshKind::sphere ? make_sphere(key.sides)
                : ref.kind == MeshKind::leaf ? make_leaf(kOutlines[lod_.level])
                : round                      ? make_primitive(ref.kind, top, static_cast<std::uint16_t>(key.sides))
                                             : meshes_.mesh(instance.mesh);
    shape.open = open_edges(mesh) > 0;
    shape.mesh = with_uvs(with_normals(mesh));
    if (key.metres > 0) scale_uvs(shape.mesh, ref.kind, top, key.size.metres(), key.metres);
    shape.box = bounds(shape.mesh);
    return shape;
  }

  struct Key {
    std::uint16_t mesh;
    float top;
    std::uint32_t sides;
    float metres;
    PartSize size;
    auto operator<=>(const Key&) const = default;
  };

  const Model& model_;
  const MeshTable& meshes_;
  const std::vector<Material>& materials_;
  const LevelOfDetail lod_;
  const bool full_;
  float extent_ = 1;  // m, across the model
  Limbs limbs_;
  std::vector<Piece> solids_, foliage_;
  std::map<Key, Shape> shapes_;
};

}  // namespace

Parts parts_at(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
               const LevelOfDetail& lod, bool full) {
  return Leveller(model, meshes, materials, lod, full).make();
}

std::uint64_t most_triangles_at(const Model& model, const MeshTable& meshes, const std::vector<Material>& materials,
                                const LevelOfDetail& lod, bool full) {
  return Leveller(model, meshes, materials, lod, full).count();
}

std::uint64_t triangle_count(const Parts& parts) {
  std::uint64_t count = 0;
  for (const Part& part : parts.parts) count += parts.shapes[part.shape].mesh.triangles.size();
  return count;
}

}  // namespace espalier
