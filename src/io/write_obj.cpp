#include <algorithm>
#include <numeric>
#include <set>

#include "io/text.h"
#include "io/writers.h"

namespace espalier {
namespace {

/// One name per material in the list (and one for parts beyond it): no blanks, none twice.
std::vector<std::string> material_names(const std::vector<Material>& materials) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t i = 0; i <= materials.size(); ++i) {
    std::string name = i < materials.size() ? materials[i].name : "";
    for (char& c : name) {
      if (static_cast<unsigned char>(c) <= ' ') c = '_';
    }
    if (name.empty()) name = "material";
    const std::string stem = name;
    for (int k = 2; !taken.insert(name).second; ++k) name = stem + "_" + std::to_string(k);
    names.push_back(name);
  }
  return names;
}

void append_head(TextBuffer& out, const Provenance& provenance) {
  out << "# made by Espalier " << provenance.version << "\n# espalier: " << to_json(provenance) << "\n";
}

void append_part(TextBuffer& out, const Mesh& mesh, std::uint32_t first) {
  for (const Vec3& p : mesh.positions) (out << "v ").vector(p, " ") << "\n";
  for (const Vec3& n : mesh.normals) (out << "vn ").vector(n, " ") << "\n";
  for (const Triangle& t : mesh.triangles) {
    out << "f";
    for (const std::uint32_t corner : t) out << " " << first + corner << "//" << first + corner;
    out << "\n";
  }
}

void append_material(TextBuffer& out, const std::string& name, const Material& m) {
  const float roughness = std::clamp(m.roughness, 0.0f, 1.0f), metal = std::clamp(m.metal, 0.0f, 1.0f);
  // The classic fields for old readers, then the physically based ones (Pr, Pm).
  out << "\nnewmtl " << name << "\n";
  (out << "Kd ").vector(m.color, " ") << "\n";
  (out << "Ks ").vector(0.04f * Vec3(1 - metal) + metal * m.color, " ") << "\n";
  out << "Ns " << 1000 * (1 - roughness) * (1 - roughness) << "\n";
  (out << "Ke ").vector(m.glow * m.color, " ") << "\n";
  out << "d " << std::clamp(m.opacity, 0.0f, 1.0f) << "\nPr " << roughness << "\nPm " << metal << "\nillum 2\n";
}

}  // namespace

const Material& material_at(const std::vector<Material>& materials, std::uint16_t index) {
  static const Material kDefault;
  return index < materials.size() ? materials[index] : kDefault;
}

ObjFiles write_obj(const WriterInput& input, std::string_view mtl_name) {
  const std::vector<std::string> names = material_names(input.materials);
  const std::vector<Part>& parts = input.parts.parts;
  const auto slot = [&](const Part& p) { return std::min<std::size_t>(p.material, input.materials.size()); };
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return slot(parts[a]) < slot(parts[b]); });

  TextBuffer obj, mtl;
  append_head(obj, input.provenance);
  append_head(mtl, input.provenance);
  obj << "mtllib " << mtl_name << "\n";
  std::size_t current = names.size();  // none
  std::uint32_t first = 1;             // OBJ counts from 1
  for (const std::uint32_t i : order) {
    const Part& part = parts[i];
    const Mesh mesh = baked(input.parts.shapes[part.shape], part.model_from_shape);
    if (mesh.triangles.empty()) continue;
    if (slot(part) != current) {
      current = slot(part);
      obj << "g " << names[current] << "\nusemtl " << names[current] << "\n";
      append_material(mtl, names[current], material_at(input.materials, part.material));
    }
    append_part(obj, mesh, first);
    first += static_cast<std::uint32_t>(mesh.positions.size());
  }
  return {std::move(obj.text()), std::move(mtl.text())};
}

}  // namespace espalier
