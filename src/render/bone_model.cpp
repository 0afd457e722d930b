#include "render/bone_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "grammar/surface_arguments.h"
#include "render/rule_palette.h"
#include "render/sampling.h"

namespace espalier {
namespace {

constexpr float kJoint = 0.15f;       // of the bone's length: where it is widest
constexpr float kThick = 0.12f;       // of its length
constexpr float kThickest = 0.02f;    // of the skeleton's diagonal

class NoFiles final : public MeshSource {
 public:
  Mesh load(const std::string&) override { return {}; }
};

Material colored(const char* hex) {
  Material material;
  for (std::size_t c = 0; c < 3; ++c) {
    const int byte = static_cast<int>(std::stoul(std::string(hex + 1 + 2 * c, 2), nullptr, 16));
    material.color[static_cast<int>(c)] = linear_light(byte);
  }
  return material;
}

/// A pyramid from its square base round `base` to the tip.
Instance spike(const Vec3& base, const Vec3& tip, float thick) {
  const Vec3 axis = tip - base;
  Vec3 aside, across;
  complete_basis(glm::normalize(axis), aside, across);
  Instance instance;
  // Right-handed with y along the axis.
  instance.model_from_mesh = {Mat3(thick * across, axis, thick * aside), 0.5f * (base + tip)};
  return instance;
}

}  // namespace

BoneModel bone_model(const Model& model, const std::function<std::size_t(std::uint32_t)>& rule_of) {
  BoneModel out;
  GeneratorGraph graph;
  graph.meshes.emplace_back().kind = MeshKind::pyramid;
  NoFiles source;
  out.meshes = MeshTable(graph, "", source);
  std::vector<Material> materials;
  for (const char* hex : kRuleColors) materials.push_back(colored(hex));
  out.surfaces = Surfaces(std::move(materials));
  Bounds box;
  for (const Bone& bone : model.bones) box.add(bone.from), box.add(bone.to);
  const float thickest = kThickest * glm::length(box.size());
  for (const Bone& bone : model.bones) {
    const Vec3 along = bone.to - bone.from;
    const float length = glm::length(along);
    if (!(length > 1e-6f * thickest) || !std::isfinite(length)) continue;
    const float thick = std::min(kThick * length, thickest);
    const Vec3 joint = bone.from + kJoint * along;
    for (const Vec3& tip : {bone.from, bone.to}) {
      Instance part = spike(joint, tip, thick);
      part.material = static_cast<std::uint16_t>(rule_of(bone.gene) % kRuleColors.size());
      part.gene = bone.gene;
      out.model.instances.push_back(part);
    }
  }
  return out;
}

}  // namespace espalier
