#pragma once
// Surfaces: the materials of one model with the pictures of their textures: what is drawn and written.

#include <cstdint>
#include <vector>

#include "model/model.h"
#include "model/texture_table.h"

namespace espalier {

/// How opacity is to be taken (glTF 2.0, section 3.9.4).
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// The materials that Instance::material means: the graph's, and behind them those that the model made.
std::vector<Material> materials_of(const GeneratorGraph& graph, const Model& model);

class Surfaces {
 public:
  Surfaces() = default;
  /// Materials without textures.
  Surfaces(std::vector<Material> materials);  // NOLINT: plain materials are surfaces

  /// The graph's materials, and behind them those that the model made; pictures for those that it shows.
  Surfaces(const GeneratorGraph& graph, const Model& model, TextureTable& textures);

  std::size_t size() const { return materials_.size(); }
  const std::vector<Material>& materials() const { return materials_; }
  /// A default for an index beyond the list.
  const Material& material(std::uint16_t index) const;
  /// Null where the material has no texture, or no part shows it.
  const TexturePicture* texture(std::uint16_t index) const {
    return index < textures_.size() ? textures_[index].get() : nullptr;
  }
  AlphaMode alpha_mode(std::uint16_t index) const;

 private:
  std::vector<Material> materials_;
  std::vector<TexturePicturePtr> textures_;  // like materials_
};

}  // namespace espalier
