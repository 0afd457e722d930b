#pragma once
// Small scenes for the tests of pictures.

#include <algorithm>
#include <cstdlib>

#include "base/executor.h"
#include "model/primitives.h"
#include "no_files.h"
#include "render/render.h"

namespace espalier {

/// All primitives; the index of a mesh is the number of its kind.
inline MeshTable primitive_table() {
  GeneratorGraph graph;
  for (int kind = 0; kind < static_cast<int>(MeshKind::file); ++kind) {
    graph.meshes.emplace_back().kind = static_cast<MeshKind>(kind);
    graph.meshes.back().sides = 16;
  }
  return test::meshes_of(graph);
}

inline Mat3 scaling(float x, float y, float z) { return Mat3(Vec3(x, 0, 0), Vec3(0, y, 0), Vec3(0, 0, z)); }

inline Instance part(MeshKind kind, const Vec3& origin, const Mat3& basis = Mat3(1), std::uint16_t material = 0) {
  Instance instance;
  instance.mesh = static_cast<std::uint16_t>(kind);
  instance.model_from_mesh = {basis, origin};
  instance.material = material;
  return instance;
}

/// 0 grey, 1 red, 2 glass, 3 glowing, 4 metal.
inline std::vector<Material> test_materials() {
  std::vector<Material> materials(5);
  materials[1].color = {0.7f, 0.05f, 0.05f};
  materials[2].opacity = 0.3f;
  materials[3].glow = 3;
  materials[4].metal = 1;
  materials[4].roughness = 0.3f;
  return materials;
}

inline Model small_ship() {
  Model model;
  model.instances = {part(MeshKind::box, {0, 0, 0}, scaling(1, 0.6f, 3)),
                     part(MeshKind::wedge, {1.2f, 0, 0}, scaling(1.4f, 0.2f, 1), 1),
                     part(MeshKind::wedge, {-1.2f, 0, 0}, scaling(-1.4f, 0.2f, 1), 1),
                     part(MeshKind::sphere, {0, 0.4f, 0.5f}, scaling(0.5f, 0.5f, 0.8f), 2),
                     part(MeshKind::cylinder, {0, -0.3f, -1.2f}, scaling(0.5f, 0.5f, 0.5f), 4),
                     part(MeshKind::leaf, {0, 0.7f, -1}, scaling(0.6f, 0.8f, 0), 3)};
  return model;
}

inline RenderSettings small_settings() {
  RenderSettings settings;
  settings.width = 160;
  settings.height = 120;
  settings.samples = 8;
  return settings;
}

inline Picture picture_of(const Model& model, const std::vector<Mesh>& ghosts = {},
                          const RenderSettings& settings = small_settings()) {
  return render(model, primitive_table(), test_materials(), ghosts, settings, *make_serial_executor());
}

inline Mesh moved_primitive(MeshKind kind, const Vec3& origin, const Vec3& size) {
  Mesh mesh = make_primitive(kind, 1, 32);
  for (Vec3& p : mesh.positions) p = origin + size * p;
  return mesh;
}

inline const std::uint8_t* pixel(const Picture& picture, std::uint32_t x, std::uint32_t y) {
  return picture.rgb.data() + 3 * (x + std::size_t{picture.width} * y);
}

/// The largest difference of a channel between two pictures of one size at a pixel.
inline int difference(const Picture& a, const Picture& b, std::uint32_t x, std::uint32_t y) {
  int most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(pixel(a, x, y)[c] - pixel(b, x, y)[c]));
  return most;
}

}  // namespace espalier
