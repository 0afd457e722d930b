#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "io/glb_buffer.h"
#include "io/glb_container.h"
#include "io/glb_materials.h"
#include "io/placement.h"
#include "io/writers.h"

namespace espalier {
namespace {

class GlbWriter {
 public:
  GlbWriter(const WriterInput& input, bool gpu_instancing)
      : input_(input), gpu_instancing_(gpu_instancing), materials_(input.surfaces, buffer_) {}

  std::string write() {
    nodes_.next();  // the root; its children are known at the end
    const std::vector<Part>& parts = input_.parts.parts;
    /// Parts of one glTF mesh that a placement can hold, in order of first use.
    std::vector<std::vector<std::pair<const Part*, Placement>>> groups;
    std::map<std::uint32_t, std::uint32_t> group_of_mesh;
    for (const Part& part : parts) {
      const Shape& shape = input_.parts.shapes[part.shape];
      if (shape.mesh.triangles.empty()) continue;
      const auto placement = find_placement(part.model_from_shape, shape.box);
      if (!placement) {
        add_baked(part, shape);
      } else if (!gpu_instancing_) {
        add_node(shared_mesh(part), &*placement, part.gene);
      } else {
        const auto next = static_cast<std::uint32_t>(groups.size());
        const auto [it, fresh] = group_of_mesh.try_emplace(shared_mesh(part), next);
        if (fresh) groups.emplace_back();
        groups[it->second].emplace_back(&part, *placement);
      }
    }
    for (const auto& group : groups) add_group(group);
    return finish();
  }

 private:
  /// The accessors of a primitive.
  struct Attributes {
    GlbBuffer::ShapeAccessors shape;
    std::optional<std::uint32_t> uvs;
  };

  void add_baked(const Part& part, const Shape& shape) {
    const Mesh mesh = mapped(baked(shape, part.model_from_shape), input_.surfaces, part.material);
    if (mesh.triangles.empty()) return;
    Attributes attributes{buffer_.add_shape(mesh), {}};
    if (!mesh.uvs.empty()) attributes.uvs = buffer_.add_uvs(mesh);
    add_node(add_mesh(shape.mesh.name, attributes, materials_.index_of(part.material, shape.open)), nullptr, part.gene);
  }

  std::uint32_t shared_mesh(const Part& part) {
    const auto [it, fresh] = mesh_of_.try_emplace({part.shape, part.material}, meshes_.size());
    if (fresh) {
      const Shape& shape = input_.parts.shapes[part.shape];
      add_mesh(shape.mesh.name, attributes_of(part, shape), materials_.index_of(part.material, shape.open));
    }
    return it->second;
  }

  /// Surfaces share a shape's accessors; those with a texture those for as many repeats of it, too.
  Attributes attributes_of(const Part& part, const Shape& shape) {
    const bool textured = input_.surfaces.texture(part.material);
    const Mesh mesh = mapped(shape.mesh, input_.surfaces, part.material);
    const bool split = textured && shape.mesh.uvs.empty();
    auto known = accessors_of_.find({part.shape, split});
    if (known == accessors_of_.end())
      known = accessors_of_.emplace(std::pair(part.shape, split), buffer_.add_shape(mesh)).first;
    Attributes out{known->second, {}};
    if (!textured) return out;
    const Vec2 repeats = input_.surfaces.material(part.material).repeats();
    const auto place = std::tuple(part.shape, repeats.x, repeats.y);
    const auto uvs = uvs_of_.find(place);
    out.uvs = uvs != uvs_of_.end() ? uvs->second : uvs_of_.emplace(place, buffer_.add_uvs(mesh)).first->second;
    return out;
  }

  std::uint32_t add_mesh(const std::string& name, const Attributes& a, std::uint32_t material) {
    TextBuffer& out = meshes_.next();
    out << "{\"name\":" << quoted(name) << ",\"primitives\":[{\"attributes\":{\"POSITION\":" << a.shape.position
        << ",\"NORMAL\":" << a.shape.normal;
    if (a.uvs) out << ",\"TEXCOORD_0\":" << *a.uvs;
    out << "},\"indices\":" << a.shape.indices << ",\"material\":" << material << "}]}";
    return meshes_.size() - 1;
  }

  void add_node(std::uint32_t mesh, const Placement* placement, std::uint32_t gene) {
    TextBuffer& out = nodes_.next();
    out << "{\"mesh\":" << mesh;
    if (placement) {
      const auto& [translation, r, scale] = *placement;
      if (translation != Vec3(0)) (out << ",\"translation\":[").vector(translation, ",") << "]";
      if (r[3] != 1) out << ",\"rotation\":[" << r[0] << "," << r[1] << "," << r[2] << "," << r[3] << "]";
      if (scale != Vec3(1)) (out << ",\"scale\":[").vector(scale, ",") << "]";
    }
    out << ",\"extras\":{\"gene\":" << gene << "}}";
  }

  void add_group(const std::vector<std::pair<const Part*, Placement>>& group) {
    const std::uint32_t mesh = shared_mesh(*group[0].first);
    if (group.size() == 1) return add_node(mesh, &group[0].second, group[0].first->gene);
    instanced_ = true;
    std::vector<float> translations, rotations, scales;
    for (const auto& [part, placement] : group) {
      for (int axis = 0; axis < 3; ++axis) {
        translations.push_back(placement.translation[axis]);
        scales.push_back(placement.scale[axis]);
      }
      rotations.insert(rotations.end(), placement.rotation.begin(), placement.rotation.end());
    }
    const std::uint32_t t = buffer_.add_rows(translations, 3), r = buffer_.add_rows(rotations, 4),
                        s = buffer_.add_rows(scales, 3);
    nodes_.next() << "{\"mesh\":" << mesh << ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
                  << "\"TRANSLATION\":" << t << ",\"ROTATION\":" << r << ",\"SCALE\":" << s << "}}}}";
  }

  std::string finish() const {
    TextBuffer json;
    json << "{\"asset\":{\"version\":\"2.0\",\"generator\":" << quoted("Espalier " + input_.provenance.version)
         << ",\"extras\":{\"espalier\":" << to_json(input_.provenance) << "}}";
    const bool strong = materials_.uses_emissive_strength();
    const std::string_view instancing = instanced_ ? "\"EXT_mesh_gpu_instancing\"" : "",
                           strength = strong ? "\"KHR_materials_emissive_strength\"" : "";
    if (instanced_ || strong) {
      json << ",\"extensionsUsed\":[" << instancing << (instanced_ && strong ? "," : "") << strength << "]";
    }
    // Required: importers that do not know the extension would silently show one instance of each.
    if (instanced_) json << ",\"extensionsRequired\":[" << instancing << "]";
    const std::string name = quoted(input_.name);
    const bool empty = nodes_.size() == 1;
    json << ",\"scene\":0,\"scenes\":[{\"name\":" << name << (empty ? "" : ",\"nodes\":[0]") << "}]";
    if (empty) return pack_glb((json << "}").text(), "");
    json << ",\"nodes\":[{\"name\":" << name << ",\"children\":[1";
    for (std::uint32_t i = 2; i < nodes_.size(); ++i) json << "," << i;
    json << "]}" << nodes_.text() << "],\"meshes\":[" << meshes_.text() << "]";
    materials_.finish(json);
    json << ",";
    const std::string bytes = buffer_.finish(json);
    return pack_glb((json << "}").text(), bytes);
  }

  const WriterInput& input_;
  const bool gpu_instancing_;
  bool instanced_ = false;
  GlbBuffer buffer_;
  GlbMaterials materials_;
  JsonList nodes_, meshes_;
  std::map<std::pair<std::uint32_t, std::uint16_t>, std::uint32_t> mesh_of_;      // by shape and material
  /// By shape, and whether its vertices were split for texture coordinates.
  std::map<std::pair<std::uint32_t, bool>, GlbBuffer::ShapeAccessors> accessors_of_;
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> uvs_of_;       // by shape and repeats
};

}  // namespace

std::string write_glb(const WriterInput& input, bool gpu_instancing) {
  return GlbWriter(input, gpu_instancing).write();
}

}  // namespace espalier
