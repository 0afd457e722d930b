#include "model/surface_scale.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/math.h"
#include "model/uv.h"

namespace espalier {
namespace {

constexpr int kStepsPerOctave = 8;
constexpr float kPerOctave = 1.44269504f * kStepsPerOctave;  // steps per unit of the natural logarithm

float metres_of(std::int16_t step) {
  if (step == PartSize::kNone) return 0;
  const int octave = step >= 0 ? step / kStepsPerOctave : -((kStepsPerOctave - 1 - step) / kStepsPerOctave);
  float value = std::ldexp(1.0f, octave);
  for (int k = octave * kStepsPerOctave; k < step; ++k) value *= 1.0905077f;  // 2^(1/8)
  return value;
}

/// Around and up a cone or cylinder; its ends lie flat, in metres too.
void scale_cone(Mesh& mesh, float top, const Vec3& size, float metres) {
  const double width = 0.5 * (static_cast<double>(size.x) + size.z), upper = std::max(top, 0.0f);
  const double lean = 0.5 * width * (1 - upper), slant = std::sqrt(size.y * static_cast<double>(size.y) + lean * lean);
  const float around = pictures_around(0.5 * kPi * width * (1 + upper), metres);
  const auto up = static_cast<float>(slant / metres);
  for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
    const bool end = std::abs(mesh.normals[i].y) == 1;
    mesh.uvs[i] *= end ? Vec2(size.x / metres, size.z / metres) : Vec2(around, up);
  }
}

/// The width and height of the side of a box that a face looks to (uv.h).
Vec2 side_size(const Vec3& normal, const Vec3& size) {
  switch (box_side(normal)) {
    case 0:
    case 1: return {size.z, size.y};
    case 2:
    case 3: return {size.x, size.z};
    default: return {size.x, size.y};
  }
}

}  // namespace

PartSize::PartSize(const Mat3& basis) {
  for (int axis = 0; axis < 3; ++axis) {
    const float length = glm::length(basis[axis]);
    if (!(length > 1e-30f)) continue;
    steps[static_cast<std::size_t>(axis)] =
        static_cast<std::int16_t>(std::lround(std::log(std::min(length, 1e30f)) * kPerOctave));
  }
}

Vec3 PartSize::metres() const { return {metres_of(steps[0]), metres_of(steps[1]), metres_of(steps[2])}; }

float pictures_around(double girth, double metres) {
  return static_cast<float>(std::max(1.0, std::floor(std::min(girth / metres, 1e6) + 0.5)));
}

void scale_uvs(Mesh& mesh, MeshKind kind, float top, const Vec3& size, float metres) {
  switch (kind) {
    case MeshKind::cylinder: return scale_cone(mesh, 1, size, metres);
    case MeshKind::cone: return scale_cone(mesh, top, size, metres);
    case MeshKind::sphere: {
      const double girth = 0.5 * kPi * (static_cast<double>(size.x) + size.z);
      const Vec2 scale(pictures_around(girth, metres), static_cast<float>(0.5 * kPi * size.y / metres));
      for (Vec2& uv : mesh.uvs) uv *= scale;
      return;
    }
    case MeshKind::file: return;
    default: break;
  }
  for (std::size_t i = 0; i < mesh.uvs.size(); ++i) mesh.uvs[i] *= side_size(mesh.normals[i], size) / metres;
}

}  // namespace espalier
