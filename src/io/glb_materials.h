#pragma once
// GlbMaterials: the materials of a GLB with their textures, each made once, in the order in which they are asked for.

#include <cstdint>
#include <map>
#include <utility>

#include "io/glb_buffer.h"
#include "io/json_list.h"
#include "model/surfaces.h"

namespace espalier {

class GlbMaterials {
 public:
  /// Images go into the buffer.
  GlbMaterials(const Surfaces& surfaces, GlbBuffer& buffer) : surfaces_(surfaces), buffer_(buffer) {}

  /// The glTF material of a surface; open shapes are seen from both sides.
  std::uint32_t index_of(std::uint16_t material, bool open);

  bool uses_emissive_strength() const { return emissive_strength_; }
  /// Appends `,"materials":[..]` and, if there are any, textures, images and their sampler.
  void finish(TextBuffer& json) const;

 private:
  std::uint32_t texture(const TexturePicture& picture);

  const Surfaces& surfaces_;
  GlbBuffer& buffer_;
  JsonList materials_, textures_, images_;
  std::map<std::pair<std::uint16_t, bool>, std::uint32_t> material_of_;  // by material and openness
  std::map<const TexturePicture*, std::uint32_t> texture_of_;
  bool emissive_strength_ = false;
};

}  // namespace espalier
