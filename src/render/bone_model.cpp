#include "render/bone_model.h"

#include <string>

#include <glm/geometric.hpp>

#include "render/rule_palette.h"

namespace espalier {
namespace {

constexpr float kThickest = 0.02f;  // of the skeleton's diagonal

Colour parsed(const char* hex) {
  const unsigned long rgb = std::stoul(hex + 1, nullptr, 16);
  const auto byte = [&](int shift) { return static_cast<std::uint8_t>(rgb >> shift); };
  return {{byte(16), byte(8), byte(0)}};
}

}  // namespace

float bone_thickness(const Model& model) {
  Bounds box;
  for (const Bone& bone : model.bones) box.add(bone.from), box.add(bone.to);
  return box.empty() ? 0 : kThickest * glm::length(box.size());
}

LineDrawing bone_model(const Model& model, const std::function<std::size_t(std::uint32_t)>& rule_of) {
  std::vector<Colour> inks;
  for (const char* hex : kRuleColors) inks.push_back(parsed(hex));
  LineDrawing drawing = start_drawing(inks);
  const float thick = bone_thickness(model);
  for (const Bone& bone : model.bones)
    draw_bone(drawing, bone, thick, static_cast<std::uint16_t>(rule_of(bone.gene) % inks.size()));
  return drawing;
}

}  // namespace espalier
