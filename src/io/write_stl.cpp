#include <glm/geometric.hpp>

#include "io/text.h"
#include "io/writers.h"

namespace espalier {

std::string write_stl(const WriterInput& input) {
  // Must not begin with "solid", which marks the text format.
  std::string header = "espalier " + input.provenance.version + " " + input.provenance.derivation;
  header.resize(80);
  TextBuffer triangles;
  std::uint32_t count = 0;
  for (const Part& part : input.parts.parts) {
    const Mesh mesh = baked(input.parts.shapes[part.shape], part.model_from_shape);
    for (const Triangle& t : mesh.triangles) {
      const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
      triangles.raw(Vec3(glm::normalize(glm::cross(b - a, c - a))));
      for (const std::uint32_t corner : t) triangles.raw(mesh.positions[corner]);
      triangles.raw(std::uint16_t{0});
    }
    count += static_cast<std::uint32_t>(mesh.triangles.size());
  }
  TextBuffer out;
  out << header;
  out.raw(count);
  return std::move(out.text()) + triangles.text();
}

}  // namespace espalier
