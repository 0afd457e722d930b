#include "studio/message_writer.h"

namespace espalier::studio {
namespace {

Vec3 seen_color(const Material& material) {
  const bool made = material.textured() && material.texture.kind != TextureKind::image;
  return made ? material.color * (0.5f * (material.texture.colors[0] + material.texture.colors[1])) : material.color;
}

}  // namespace

void MessageWriter::add(const Material& material) {
  const Vec3 color = seen_color(material);
  add(color);
  add(material.opacity);
  add(color);
  add(material.glow);
  add(material.roughness);
  add(material.metal);
  add(0.0f), add(0.0f);
}

}  // namespace espalier::studio
