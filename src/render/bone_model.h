#pragma once
// BoneModel: the bones of a model as something to draw: a double pyramid each, widest near its joint, coloured by rule.

#include <cstdint>
#include <functional>

#include "model/model.h"
#include "model/surfaces.h"

namespace espalier {

struct BoneModel {
  Model model;
  MeshTable meshes;
  Surfaces surfaces;
};

/// `rule_of` gives the rule of a gene. Bones without length are left out.
BoneModel bone_model(const Model& model, const std::function<std::size_t(std::uint32_t gene)>& rule_of);

}  // namespace espalier
