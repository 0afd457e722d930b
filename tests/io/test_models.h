#pragma once
// Models made by hand for the tests of io: a table of all primitives, and parts placed one by one.

#include <string>
#include <unistd.h>
#include <vector>

#include <filesystem>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "io/export.h"
#include "io/mesh_import.h"
#include "model/model.h"

namespace espalier {

inline constexpr MeshKind kAllKinds[] = {MeshKind::box,   MeshKind::cylinder, MeshKind::cone, MeshKind::sphere,
                                         MeshKind::wedge, MeshKind::pyramid,  MeshKind::quad, MeshKind::leaf};

/// All primitives; the index of a mesh is the number of its kind.
inline MeshTable primitive_table() {
  GeneratorGraph graph;
  for (const MeshKind kind : kAllKinds) {
    graph.meshes.emplace_back().kind = kind;
    graph.meshes.back().sides = 16;
  }
  AssimpMeshSource source;
  return MeshTable(graph, "", source);
}

inline Instance part(MeshKind kind, const Vec3& origin, const Mat3& basis = Mat3(1), std::uint16_t material = 0) {
  Instance instance;
  instance.mesh = static_cast<std::uint16_t>(kind);
  instance.model_from_mesh = {basis, origin};
  instance.material = material;
  return instance;
}

inline Mat3 scaling(float x, float y, float z) { return Mat3(Vec3(x, 0, 0), Vec3(0, y, 0), Vec3(0, 0, z)); }

/// The turn by `sine` and `cosine` about z.
inline Mat3 turn_z(float sine, float cosine) {
  return Mat3(Vec3(cosine, sine, 0), Vec3(-sine, cosine, 0), Vec3(0, 0, 1));
}

inline std::vector<Material> two_materials() {
  std::vector<Material> materials(3);
  materials[0].name = "hull";
  materials[0].color = {0.5f, 0.25f, 0.1f};
  materials[1].name = "glass pane";
  materials[1].opacity = 0.4f;
  materials[2].name = "engine";
  materials[2].glow = 4;
  return materials;
}

/// Every kind of placement: plain, turned, mirrored, sheared, flat, and shapes that are shared or not.
inline Model mixed_model() {
  Model model;
  auto& out = model.instances;
  out.push_back(part(MeshKind::box, {0, 0, 0}, scaling(4, 1, 2)));
  out.push_back(part(MeshKind::box, {0, 3, 0}, turn_z(0.6f, 0.8f) * scaling(1, 2, 1), 1));
  out.push_back(part(MeshKind::wedge, {3, 0, 0}, turn_z(0.6f, 0.8f) * scaling(2, 1, 1)));
  out.push_back(part(MeshKind::wedge, {-3, 0, 0}, scaling(-1, 1, 1) * turn_z(0.6f, 0.8f) * scaling(2, 1, 1)));
  out.push_back(part(MeshKind::sphere, {0, 0, 5}, scaling(1, 3, 1) * turn_z(0.6f, 0.8f), 2));   // sheared
  out.push_back(part(MeshKind::sphere, {0, 0, -5}, scaling(-1, 3, 1) * turn_z(0.6f, 0.8f)));    // sheared, mirrored
  out.push_back(part(MeshKind::cone, {6, 0, 0}));
  out.back().top = 0.25f;
  out.push_back(part(MeshKind::cone, {8, 0, 0}));
  out.back().top = 0;
  out.push_back(part(MeshKind::cylinder, {-8, 1, 0}, scaling(1, 2, 1), 1));
  out.push_back(part(MeshKind::pyramid, {0, 7, 0}, turn_z(-1, 0)));
  out.push_back(part(MeshKind::quad, {0, -4, 0}, scaling(2, 2, 0)));
  out.push_back(part(MeshKind::leaf, {0, -5, 0}, turn_z(0.6f, 0.8f), 1));
  for (std::uint32_t i = 0; i < out.size(); ++i) out[i].gene = 100 + i;
  return model;
}

inline Provenance test_provenance() {
  Provenance p;
  p.version = "0.1.0";
  p.made_by = "run";
  p.seed = 0xfedcba9876543210u;
  p.steps = 1234;
  p.index = 2;
  p.engine = "ga";
  p.inputs = {{"inputs/spaceship.esp", "00ff"}, {"inputs/Ziel \xc3\xa4.obj", "11aa"}};
  p.settings = "[search]\nengine = \"ga\"  # \\ and a long line\n" + std::string(5000, 'x') + "\ttab \xe2\x82\xac\n";
  p.settings_folder = "..";
  p.derivation = "0123456789abcdef0123456789abcdef";
  p.score = 0.1 + 0.2;
  p.optimum = 1e300;
  return p;
}

/// A folder of its own for a test, removed with all that it holds.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "espalier-test-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  std::size_t file_count() const {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(path_)) ++n;
    return n;
  }

 private:
  std::string path_;
};

/// The message of the Error that `run` throws; empty when it throws none.
template <typename Run>
std::string error_of(const Run& run) {
  try {
    run();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

}  // namespace espalier
