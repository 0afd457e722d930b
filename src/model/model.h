#pragma once
// Model: what a derivation looks like. Instances of a few meshes, and bones; each knows its gene.

#include <cstdint>
#include <span>
#include <vector>

#include "grammar/graph.h"
#include "model/mesh.h"
#include "model/mesh_source.h"

namespace espalier {

/// Who made an instance. Targets see *parts* (emits of rules, proxies included) or *full* (emits of rules except
/// proxies, and of details).
enum class Layer : std::uint8_t { rule, proxy, detail };

struct Instance {
  Frame model_from_mesh;       // meshes fit the unit box, `as is` meshes keep file coordinates
  float top = 1;               // cones: upper over lower radius
  std::uint16_t mesh = 0;      // index into GeneratorGraph::meshes
  std::uint16_t material = 0;  // index into GeneratorGraph::materials, and behind those into Model::materials
  std::uint32_t gene = 0;      // index into Derivation::genes
  Layer layer = Layer::rule;
};

inline bool in_parts(const Instance& i) { return i.layer != Layer::detail; }
inline bool in_full(const Instance& i) { return i.layer != Layer::proxy; }

struct Bone {
  Vec3 from{0}, to{0};
  std::int32_t parent = -1;  // index into Model::bones
  std::uint32_t gene = 0;
};

/// A material that the model's draws made: a recipe, and the steps of its slots (MaterialRecipe::material).
struct MadeMaterial {
  std::uint64_t steps = 0;
  std::uint16_t recipe = 0;  // index into GeneratorGraph::recipes
};

struct Model {
  static constexpr std::size_t kMostMaterials = 256;

  std::vector<Instance> instances;
  std::vector<Bone> bones;
  std::vector<MadeMaterial> materials;  // at most kMostMaterials, in the order in which they came up
  std::uint32_t dropped = 0;  // subtrees or emits left out because a frame was not finite or a size negative
  bool truncated = false;     // a budget ran out (ExpandLimits): parts are missing
  std::uint32_t plain_paints = 0;  // paints that got the middle of their recipe since there were materials enough

  void clear() {
    instances.clear();
    bones.clear();
    materials.clear();
    dropped = 0;
    plain_paints = 0;
    truncated = false;
  }
};

/// The meshes of a grammar, loaded and (unless `as is`) fitted to the unit box; index = Instance::mesh. Primitives are
/// there too, tessellated (cones with top = 1: draw those by make_primitive with the instance's own top).
class MeshTable {
 public:
  MeshTable() = default;
  /// Paths are taken relative to `folder`. Throws Error.
  MeshTable(const GeneratorGraph& graph, const std::string& folder, MeshSource& source);

  const MeshRef& ref(std::size_t i) const { return refs_[i]; }
  const Mesh& mesh(std::size_t i) const { return meshes_[i]; }
  const Bounds& mesh_bounds(std::size_t i) const { return bounds_[i]; }
  std::size_t size() const { return meshes_.size(); }

 private:
  std::vector<MeshRef> refs_;
  std::vector<Mesh> meshes_;
  std::vector<Bounds> bounds_;
};

/// The box around the instances that `full` (else: parts) shows, from their meshes' bounds. Empty if there are none.
Bounds bounds(const Model& model, const MeshTable& meshes, bool full);

}  // namespace espalier
