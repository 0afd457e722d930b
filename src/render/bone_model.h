#pragma once
// BoneModel: the bones of a model as something to draw, coloured by rule.

#include <cstdint>
#include <functional>

#include "render/line_drawing.h"

namespace espalier {

/// How thick the bones of a model are drawn at most, m: a part of their whole extent.
float bone_thickness(const Model& model);

/// `rule_of` gives the rule of a gene. Bones without length are left out.
LineDrawing bone_model(const Model& model, const std::function<std::size_t(std::uint32_t gene)>& rule_of);

}  // namespace espalier
