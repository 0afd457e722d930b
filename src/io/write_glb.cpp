#include <algorithm>
#include <map>
#include <tuple>

#include <nlohmann/json.hpp>

#include "io/glb_buffer.h"
#include "io/glb_container.h"
#include "io/placement.h"
#include "io/writers.h"

namespace espalier {
namespace {

/// A list of JSON objects in the making.
class JsonList {
 public:
  TextBuffer& next() { return text_ << (size_++ > 0 ? "," : ""); }
  std::uint32_t size() const { return size_; }
  const std::string& text() const { return text_.text(); }

 private:
  TextBuffer text_;
  std::uint32_t size_ = 0;
};

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

class GlbWriter {
 public:
  GlbWriter(const WriterInput& input, bool gpu_instancing) : input_(input), gpu_instancing_(gpu_instancing) {}

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
  void add_baked(const Part& part, const Shape& shape) {
    const Mesh mesh = baked(shape, part.model_from_shape);
    if (mesh.triangles.empty()) return;
    const GlbBuffer::ShapeAccessors accessors = buffer_.add_shape(mesh);
    add_node(add_mesh(shape.mesh.name, accessors, material(part.material, shape.open)), nullptr, part.gene);
  }

  std::uint32_t shared_mesh(const Part& part) {
    const auto [it, fresh] = mesh_of_.try_emplace({part.shape, part.material}, meshes_.size());
    if (fresh) {
      const Shape& shape = input_.parts.shapes[part.shape];
      auto known = accessors_of_.find(part.shape);
      if (known == accessors_of_.end()) known = accessors_of_.emplace(part.shape, buffer_.add_shape(shape.mesh)).first;
      add_mesh(shape.mesh.name, known->second, material(part.material, shape.open));
    }
    return it->second;
  }

  std::uint32_t add_mesh(const std::string& name, const GlbBuffer::ShapeAccessors& a, std::uint32_t material) {
    meshes_.next() << "{\"name\":" << quoted(name) << ",\"primitives\":[{\"attributes\":{\"POSITION\":" << a.position
                   << ",\"NORMAL\":" << a.normal << "},\"indices\":" << a.indices << ",\"material\":" << material
                   << "}]}";
    return meshes_.size() - 1;
  }

  /// The glTF material of a grammar's material; open shapes are seen from both sides.
  std::uint32_t material(std::uint16_t index, bool open) {
    const auto [it, fresh] = material_of_.try_emplace({index, open}, materials_.size());
    if (!fresh) return it->second;
    const auto unit = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
    const Material& m = material_at(input_.materials, index);
    const Vec3 color(unit(m.color.x), unit(m.color.y), unit(m.color.z));
    TextBuffer& out = materials_.next();
    out << "{\"name\":" << quoted(m.name.empty() ? "material" : m.name);
    (out << ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[").vector(color, ",") << "," << unit(m.opacity) << "]";
    out << ",\"metallicFactor\":" << unit(m.metal) << ",\"roughnessFactor\":" << unit(m.roughness) << "}";
    if (m.glow > 0) (out << ",\"emissiveFactor\":[").vector(unit(m.glow) * color, ",") << "]";
    if (m.glow > 1) {
      out << ",\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":" << m.glow << "}}";
      emissive_strength_ = true;
    }
    if (m.opacity < 1) out << ",\"alphaMode\":\"BLEND\"";
    if (open) out << ",\"doubleSided\":true";
    out << "}";
    return it->second;
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
    const std::string_view instancing = instanced_ ? "\"EXT_mesh_gpu_instancing\"" : "",
                           strength = emissive_strength_ ? "\"KHR_materials_emissive_strength\"" : "";
    if (instanced_ || emissive_strength_) {
      json << ",\"extensionsUsed\":[" << instancing << (instanced_ && emissive_strength_ ? "," : "") << strength << "]";
    }
    // Required: importers that do not know the extension would silently show one instance of each.
    if (instanced_) json << ",\"extensionsRequired\":[" << instancing << "]";
    const std::string name = quoted(input_.name);
    const bool empty = nodes_.size() == 1;
    json << ",\"scene\":0,\"scenes\":[{\"name\":" << name << (empty ? "" : ",\"nodes\":[0]") << "}]";
    if (empty) return pack_glb((json << "}").text(), "");
    json << ",\"nodes\":[{\"name\":" << name << ",\"children\":[1";
    for (std::uint32_t i = 2; i < nodes_.size(); ++i) json << "," << i;
    json << "]}" << nodes_.text() << "],\"meshes\":[" << meshes_.text() << "],\"materials\":[" << materials_.text()
         << "],";
    const std::string bytes = buffer_.finish(json);
    return pack_glb((json << "}").text(), bytes);
  }

  const WriterInput& input_;
  const bool gpu_instancing_;
  bool instanced_ = false, emissive_strength_ = false;
  GlbBuffer buffer_;
  JsonList nodes_, meshes_, materials_;
  std::map<std::pair<std::uint32_t, std::uint16_t>, std::uint32_t> mesh_of_;      // by shape and material
  std::map<std::uint32_t, GlbBuffer::ShapeAccessors> accessors_of_;               // by shape
  std::map<std::pair<std::uint16_t, bool>, std::uint32_t> material_of_;           // by material and openness
};

}  // namespace

std::string write_glb(const WriterInput& input, bool gpu_instancing) {
  return GlbWriter(input, gpu_instancing).write();
}

}  // namespace espalier
