#include "model/surfaces.h"

#include <algorithm>

#include "base/check.h"
#include "model/texture.h"

namespace espalier {
namespace {

/// So that many pictures together stay within a budget of about 8 million pixels.
std::uint32_t size_for(std::size_t pictures) {
  return pictures <= 32 ? kTextureSize : pictures <= 128 ? kTextureSize / 2 : kTextureSize / 4;
}

}  // namespace

std::vector<Material> materials_of(const GeneratorGraph& graph, const Model& model) {
  std::vector<Material> materials = graph.materials;
  for (const MadeMaterial& made : model.materials) materials.push_back(graph.recipes[made.recipe].material(made.steps));
  return materials;
}

Surfaces::Surfaces(std::vector<Material> materials) : materials_(std::move(materials)) {
  for (const Material& material : materials_) CHECK(!material.textured());
}

Surfaces::Surfaces(const GeneratorGraph& graph, const Model& model, TextureTable& textures)
    : materials_(materials_of(graph, model)) {
  std::vector<char> shown(materials_.size(), false);
  for (const Instance& instance : model.instances)
    if (instance.material < shown.size()) shown[instance.material] = true;
  std::vector<const TextureRef*> made;
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    const TextureRef& texture = materials_[i].texture;
    if (!shown[i] || !materials_[i].textured() || texture.kind == TextureKind::image) continue;
    const auto same = [&](const TextureRef* known) { return *known == texture; };
    if (std::none_of(made.begin(), made.end(), same)) made.push_back(&texture);
  }
  const std::uint32_t size = size_for(made.size());
  textures_.resize(materials_.size());
  for (std::size_t i = 0; i < materials_.size(); ++i)
    if (shown[i] && materials_[i].textured()) textures_[i] = textures.picture(materials_[i].texture, size);
}

const Material& Surfaces::material(std::uint16_t index) const {
  static const Material kDefault;
  return index < materials_.size() ? materials_[index] : kDefault;
}

AlphaMode Surfaces::alpha_mode(std::uint16_t index) const {
  const Material& m = material(index);
  if (m.cutout > 0) return AlphaMode::mask;
  const TexturePicture* const picture = texture(index);
  return m.opacity < 1 || (picture && picture->transparent) ? AlphaMode::blend : AlphaMode::opaque;
}

}  // namespace espalier
