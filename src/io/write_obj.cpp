#include <algorithm>
#include <numeric>
#include <set>

#include "io/text.h"
#include "io/writers.h"

namespace espalier {
namespace {

/// One name per material in the list (and one for parts beyond it): no blanks, none twice.
std::vector<std::string> material_names(const Surfaces& surfaces) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (std::size_t i = 0; i <= surfaces.size(); ++i) {
    std::string name = surfaces.material(static_cast<std::uint16_t>(i)).name;
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

/// Numbers of the next vertex and the next texture coordinate; OBJ counts from 1.
struct Numbers {
  std::uint32_t vertex = 1, uv = 1;
};

void append_part(TextBuffer& out, const Mesh& mesh, Numbers& next) {
  for (const Vec3& p : mesh.positions) (out << "v ").vector(p, " ") << "\n";
  for (const Vec2& uv : mesh.uvs) out << "vt " << uv.x << " " << uv.y << "\n";
  for (const Vec3& n : mesh.normals) (out << "vn ").vector(n, " ") << "\n";
  for (const Triangle& t : mesh.triangles) {
    out << "f";
    for (const std::uint32_t corner : t) {
      out << " " << next.vertex + corner << "/";
      if (!mesh.uvs.empty()) out << next.uv + corner;
      out << "/" << next.vertex + corner;
    }
    out << "\n";
  }
  next.vertex += static_cast<std::uint32_t>(mesh.positions.size());
  next.uv += static_cast<std::uint32_t>(mesh.uvs.size());
}

/// The files of textures, numbered in the order in which they are asked for.
class TextureFiles {
 public:
  TextureFiles(const std::string& stem, ObjFiles& files) : stem_(stem), files_(files) {}

  const std::string& name_of(const TexturePicture& picture) {
    for (const auto& [name, known] : files_.textures)
      if (known == &picture) return name;
    const std::string number = std::to_string(files_.textures.size() + 1);
    files_.textures.emplace_back(stem_ + "-texture-" + number + "." + picture.ending, &picture);
    return files_.textures.back().first;
  }

 private:
  const std::string& stem_;
  ObjFiles& files_;
};

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

ObjFiles write_obj(const WriterInput& input, const std::string& stem) {
  const Surfaces& surfaces = input.surfaces;
  const std::vector<std::string> names = material_names(surfaces);
  const std::vector<Part>& parts = input.parts.parts;
  const auto slot = [&](const Part& p) { return std::min<std::size_t>(p.material, surfaces.size()); };
  std::vector<std::uint32_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return slot(parts[a]) < slot(parts[b]); });

  ObjFiles files;
  TextureFiles textures(stem, files);
  TextBuffer obj, mtl;
  append_head(obj, input.provenance);
  append_head(mtl, input.provenance);
  obj << "mtllib " << stem << ".mtl\n";
  std::size_t current = names.size();  // none
  Numbers next;
  for (const std::uint32_t i : order) {
    const Part& part = parts[i];
    const Mesh mesh = mapped(baked(input.parts.shapes[part.shape], part.model_from_shape), surfaces, part.material);
    if (mesh.triangles.empty()) continue;
    if (slot(part) != current) {
      current = slot(part);
      obj << "g " << names[current] << "\nusemtl " << names[current] << "\n";
      append_material(mtl, names[current], surfaces.material(part.material));
      if (const TexturePicture* picture = surfaces.texture(part.material)) {
        const std::string& file = textures.name_of(*picture);
        mtl << "map_Kd " << file << "\n";
        if (picture->transparent) mtl << "map_d " << file << "\n";
      }
    }
    append_part(obj, mesh, next);
  }
  files.obj = std::move(obj.text());
  files.mtl = std::move(mtl.text());
  return files;
}

}  // namespace espalier
