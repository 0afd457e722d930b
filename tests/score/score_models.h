#pragma once
// Random and hand-made models for the tests of the score room.

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "model/model.h"
#include "model/primitives.h"

namespace espalier::test {

/// Draws for tests: float values in a range.
class Dice {
 public:
  explicit Dice(std::uint32_t number) : stream_({20261122, Purpose::test, 7, number, 0}) {}
  float between(float a, float b) { return a + (b - a) * static_cast<float>(stream_.next_unit()); }
  std::uint32_t below(std::uint32_t n) { return stream_.below(n); }
  bool chance(double p) { return stream_.chance(p); }

 private:
  RandomStream stream_;
};

inline Frame box_frame(const Vec3& low, const Vec3& high) {
  Frame frame;
  for (int i = 0; i < 3; ++i) frame.basis[i] = Vec3(0), frame.basis[i][i] = high[i] - low[i];
  frame.origin = 0.5f * (low + high);
  return frame;
}

inline Instance part(std::uint16_t mesh, const Frame& frame, float top = 1) {
  Instance instance;
  instance.mesh = mesh;
  instance.model_from_mesh = frame;
  instance.top = top;
  return instance;
}

inline void append(Mesh& mesh, const Mesh& other, const Vec3& move = Vec3(0)) {
  mesh.uvs.clear();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : other.positions) mesh.positions.push_back(p + move);
  for (const Triangle& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

inline Mesh box_mesh(const Vec3& low, const Vec3& high) {
  Mesh mesh = make_primitive(MeshKind::box, 1, 0);
  for (Vec3& p : mesh.positions) p = low + (p + Vec3(0.5f)) * (high - low);
  mesh.normals.clear();
  mesh.uvs.clear();
  return mesh;
}

/// An L of two boxes as one closed sheet: not convex.
inline Mesh corner_mesh() {
  Mesh mesh;
  const float h = 0.5f;
  const float x[6] = {-h, h, h, 0, 0, -h}, y[6] = {-h, -h, 0, 0, h, h};  // counter-clockwise from the front
  for (const float z : {-h, h}) {
    for (int i = 0; i < 6; ++i) mesh.positions.push_back({x[i], y[i], z});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  const Triangle front[4] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const Triangle& t : front) {
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
    mesh.triangles.push_back({t[2], t[1], t[0]});
  }
  return mesh;
}

/// An irregular closed convex mesh with 8 triangles.
inline Mesh gem_mesh() {
  Mesh mesh;
  mesh.positions = {{0.5f, 0, 0.1f}, {0.05f, 0.5f, 0}, {-0.5f, 0.1f, 0}, {0, -0.5f, 0.1f}, {0.1f, 0, 0.5f},
                    {-0.1f, 0.1f, -0.5f}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  return mesh;
}

/// Meshes of the table below, by the order of its graph.
enum Shape : std::uint16_t { kBox, kCylinder, kCone, kSphere, kWedge, kPyramid, kCone5, kCylinder6, kGem, kCorner,
                             kTwoBoxes, kQuad, kShapes };

class TestFiles final : public MeshSource {
 public:
  Mesh load(const std::string& path) override {
    if (path.find("gem") != std::string::npos) return gem_mesh();
    if (path.find("corner") != std::string::npos) return corner_mesh();
    Mesh two = box_mesh(Vec3(-0.5f, -0.5f, -0.5f), Vec3(0.2f, 0.3f, 0.1f));  // two boxes that cut each other
    append(two, box_mesh(Vec3(-0.1f, -0.2f, -0.3f), Vec3(0.5f, 0.5f, 0.5f)));
    return two;
  }
};

inline MeshTable test_meshes() {
  GeneratorGraph graph;
  const auto add = [&](MeshKind kind, std::uint16_t sides = 32, const char* path = "") {
    MeshRef& ref = graph.meshes.emplace_back();
    ref.kind = kind;
    ref.sides = sides;
    ref.path = path;
  };
  add(MeshKind::box), add(MeshKind::cylinder), add(MeshKind::cone), add(MeshKind::sphere), add(MeshKind::wedge);
  add(MeshKind::pyramid), add(MeshKind::cone, 5), add(MeshKind::cylinder, 6), add(MeshKind::file, 0, "gem");
  add(MeshKind::file, 0, "corner"), add(MeshKind::file, 0, "two"), add(MeshKind::quad);
  TestFiles files;
  return MeshTable(graph, "", files);
}

/// A random rotation, by a random quaternion.
inline Mat3 random_rotation(Dice& dice) {
  float q[4], square;
  do {
    square = 0;
    for (float& v : q) v = dice.between(-1, 1), square += v * v;
  } while (square > 1 || square < 0.01f);
  const float w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / square;
  return Mat3(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y), s * (x * y - w * z),
              1 - s * (x * x + z * z), s * (y * z + w * x), s * (x * z + w * y), s * (y * z - w * x),
              1 - s * (x * x + y * y));
}

/// A frame of about `size` within a box: along the axes, turned about one axis, turned freely, or sheared; some are
/// mirrored.
inline Frame random_frame(Dice& dice, const Vec3& low, const Vec3& high, float size) {
  Frame frame;
  const std::uint32_t how = dice.below(4);
  Mat3 turn(1);
  if (how == 1) {
    const float a = dice.between(-1, 1), b = dice.between(-1, 1), r = std::sqrt(a * a + b * b) + 1e-6f;
    const int i = static_cast<int>(dice.below(3)), j = (i + 1) % 3;
    turn[i][i] = turn[j][j] = a / r;
    turn[i][j] = b / r;
    turn[j][i] = -b / r;
  } else if (how == 2) {
    turn = random_rotation(dice);
  }
  for (int i = 0; i < 3; ++i) {
    const float scale = size * dice.between(0.1f, 1) * (dice.chance(0.3) ? -1.0f : 1.0f);
    frame.basis[i] = turn[i] * scale;
    if (how == 3) frame.basis[i] = Vec3(dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1)) * size;
    frame.origin[i] = dice.between(low[i], high[i]);
  }
  return frame;
}

}  // namespace espalier::test
