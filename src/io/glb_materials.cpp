#include "io/glb_materials.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "io/writers.h"

namespace espalier {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

std::uint32_t GlbMaterials::index_of(std::uint16_t index, bool open) {
  const auto [it, fresh] = material_of_.try_emplace({index, open}, materials_.size());
  if (!fresh) return it->second;
  const auto unit = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
  const Material& m = surfaces_.material(index);
  const TexturePicture* const picture = surfaces_.texture(index);
  const std::uint32_t shown = picture ? texture(*picture) : 0;
  const Vec3 color(unit(m.color.x), unit(m.color.y), unit(m.color.z));
  TextBuffer& out = materials_.next();
  out << "{\"name\":" << quoted(m.name.empty() ? "material" : m.name);
  (out << ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[").vector(color, ",") << "," << unit(m.opacity) << "]";
  if (picture) out << ",\"baseColorTexture\":{\"index\":" << shown << "}";
  out << ",\"metallicFactor\":" << unit(m.metal) << ",\"roughnessFactor\":" << unit(m.roughness) << "}";
  if (m.glow > 0) (out << ",\"emissiveFactor\":[").vector(unit(m.glow) * color, ",") << "]";
  if (m.glow > 0 && picture) out << ",\"emissiveTexture\":{\"index\":" << shown << "}";
  if (m.glow > 1) {
    out << ",\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":" << m.glow << "}}";
    emissive_strength_ = true;
  }
  switch (surfaces_.alpha_mode(index)) {
    case AlphaMode::opaque: break;
    case AlphaMode::mask: out << ",\"alphaMode\":\"MASK\",\"alphaCutoff\":" << m.cutout; break;
    case AlphaMode::blend: out << ",\"alphaMode\":\"BLEND\""; break;
  }
  if (open || m.two_sided) out << ",\"doubleSided\":true";
  out << "}";
  return it->second;
}

std::uint32_t GlbMaterials::texture(const TexturePicture& picture) {
  const auto [it, fresh] = texture_of_.try_emplace(&picture, textures_.size());
  if (!fresh) return it->second;
  const std::uint32_t image = images_.size();
  images_.next() << "{\"name\":" << quoted(picture.name) << ",\"mimeType\":\"image/"
                 << (picture.ending == "jpg" ? "jpeg" : "png")
                 << "\",\"bufferView\":" << buffer_.add_image(texture_bytes(picture, nullptr)) << "}";
  textures_.next() << "{\"sampler\":0,\"source\":" << image << "}";
  return it->second;
}

void GlbMaterials::finish(TextBuffer& json) const {
  json << ",\"materials\":[" << materials_.text() << "]";
  if (textures_.size() == 0) return;
  json << ",\"textures\":[" << textures_.text() << "],\"images\":[" << images_.text() << "]";
  // Trilinear, repeating.
  json << ",\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":10497,\"wrapT\":10497}]";
}

}  // namespace espalier
