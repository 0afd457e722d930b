#include "model/texture.h"

#include "base/check.h"
#include "grammar/surface_arguments.h"

namespace espalier {

float texture_number(const TextureRef& texture, std::string_view name) {
  const auto numbers = texture_numbers(texture.kind);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i].name == name) return texture.numbers[i];
  }
  CHECK(!"a number that the texture has");
  return 0;
}

Image make_texture(const TextureRef& texture, std::uint32_t size) {
  CHECK(size >= 1 && size <= 4096);
  switch (texture.kind) {
    case TextureKind::bark: return make_bark(texture, size);
    case TextureKind::leaf: return make_leaf_picture(texture, size);
    case TextureKind::noise: return make_noise(texture, size);
    case TextureKind::none:
    case TextureKind::image: break;
  }
  CHECK(!"a procedural texture");
  return {};
}

}  // namespace espalier
