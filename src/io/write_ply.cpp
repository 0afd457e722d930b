#include <algorithm>

#include "io/text.h"
#include "io/writers.h"
#include "model/srgb.h"

namespace espalier {
namespace {

struct Colour {
  std::uint8_t channel[4];  // sRGB and opacity
};

/// Of the surface as a whole: with a texture, its mean.
Colour colour_of(const Surfaces& surfaces, std::uint16_t index) {
  const Material& m = surfaces.material(index);
  const TexturePicture* const picture = surfaces.texture(index);
  const Vec3 color = picture ? m.color * picture->mean : m.color;
  const float opacity = std::clamp(m.opacity, 0.0f, 1.0f);
  return {{srgb_byte(color.x), srgb_byte(color.y), srgb_byte(color.z),
           static_cast<std::uint8_t>(255 * opacity + 0.5f)}};
}

}  // namespace

std::string write_ply(const WriterInput& input) {
  TextBuffer vertices, faces;
  std::uint32_t vertex_count = 0, face_count = 0;
  for (const Part& part : input.parts.parts) {
    const Mesh mesh = baked(input.parts.shapes[part.shape], part.model_from_shape);
    const Colour colour = colour_of(input.surfaces, part.material);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      vertices.raw(mesh.positions[i]).raw(mesh.normals[i]).raw(colour);
    }
    for (const Triangle& t : mesh.triangles) {
      faces.raw(std::uint8_t{3});
      for (const std::uint32_t corner : t) faces.raw(vertex_count + corner);
    }
    vertex_count += static_cast<std::uint32_t>(mesh.positions.size());
    face_count += static_cast<std::uint32_t>(mesh.triangles.size());
  }
  TextBuffer out;
  out << "ply\nformat binary_little_endian 1.0\ncomment made by Espalier " << input.provenance.version << "\n";
  out << "comment espalier: " << to_json(input.provenance) << "\n";
  out << "element vertex " << vertex_count << "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out << "property float " << name << "\n";
  for (const char* name : {"red", "green", "blue", "alpha"}) out << "property uchar " << name << "\n";
  out << "element face " << face_count << "\nproperty list uchar uint vertex_indices\nend_header\n";
  return std::move(out.text()) + vertices.text() + faces.text();
}

}  // namespace espalier
