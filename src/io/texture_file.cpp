// Textures as the writers need them.

#include "io/png.h"
#include "io/writers.h"
#include "model/uv.h"

namespace espalier {

std::string texture_bytes(const TexturePicture& picture, const Provenance* provenance) {
  if (!picture.bytes.empty()) return picture.bytes;
  const Image& image = picture.image;
  if (!provenance) return encode_png_with_alpha(image.width, image.height, image.rgba);
  return encode_png_with_alpha(image.width, image.height, image.rgba, "espalier", to_json(*provenance));
}

Mesh mapped(const Mesh& mesh, const Surfaces& surfaces, std::uint16_t material) {
  if (!surfaces.texture(material)) {
    Mesh out = mesh;
    out.uvs.clear();
    return out;
  }
  Mesh out = with_uvs(mesh);
  const Vec2 repeats = surfaces.material(material).repeats();
  for (Vec2& uv : out.uvs) uv *= repeats;
  return out;
}

}  // namespace espalier
