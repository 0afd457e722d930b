// Machine: the operations that are rarer or heavier than a function call: turns, aims, bones, truncated normals.

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "model/machine.h"

namespace espalier {
namespace {

float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
float length(const Vec3& v) { return std::sqrt(dot(v, v)); }
Vec3 vec3(const Lanes& v) { return {v[0], v[1], v[2]}; }
Lanes lanes(const Vec3& v) { return Lanes{v.x, v.y, v.z, 0}; }

/// Columns of the rotation about the unit vector `u` whose angle has this sine and cosine (Rodrigues).
Mat3 rotation(const Vec3& u, float s, float c) {
  const float t = 1 - c;
  return Mat3(Vec3(c + t * u.x * u.x, t * u.x * u.y + s * u.z, t * u.x * u.z - s * u.y),
              Vec3(t * u.x * u.y - s * u.z, c + t * u.y * u.y, t * u.y * u.z + s * u.x),
              Vec3(t * u.x * u.z + s * u.y, t * u.y * u.z - s * u.x, c + t * u.z * u.z));
}

}  // namespace

float Machine::draw_normal(const Op& op, float u) const {
  const float mean = value(op.x), sd = value(op.y), low = value(op.z), high = registers_[op.dst];
  const double p_low = normal_cdf((low - mean) / sd), p_high = normal_cdf((high - mean) / sd);
  const double p = p_low + (p_high - p_low) * u;
  if (!(p > 0 && p < 1)) return u < 0.5f ? low : high;
  const float drawn = mean + sd * inverse_normal_cdf(p);
  return std::min(std::max(drawn, low), high);
}

Vec3 Machine::point(const Lanes& local) const {
  const State& s = current_.state;
  return vec3(s.origin + local[0] * s.axis[0] + local[1] * s.axis[1] + local[2] * s.axis[2]);
}

void Machine::turn_axis(int axis, float angle) {
  float s, c;
  sin_cos(angle, s, c);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  Lanes* const a = current_.state.axis;
  const Lanes u = a[i], v = a[j];
  a[i] = c * u + s * v;
  a[j] = c * v - s * u;
}

void Machine::turn(const Op& op) {
  const Vec3 about = vector_at(op.a);
  const float size = length(about);
  if (!(size > 0)) return;
  float s, c;
  sin_cos(value(op.x), s, c);
  const Mat3 r = rotation(about / size, s, c);
  Lanes* const a = current_.state.axis;
  const Lanes x = a[0], y = a[1], z = a[2];
  for (int i = 0; i < 3; ++i) a[i] = r[i].x * x + r[i].y * y + r[i].z * z;
}

// Turns the local axis, as it stands in model space, by the shortest arc towards a direction (language.md 30).
void Machine::aim(const Op& op) {
  Lanes* const a = current_.state.axis;
  const Vec3 wanted = op.flags & kAimAt ? vector_at(op.a) - vec3(current_.state.origin) : vector_at(op.a);
  const Vec3 axis = vec3(a[op.axis]);
  const float size = length(wanted) * length(axis);
  if (!(size > 0)) return;
  const float c = std::min(std::max(dot(axis, wanted) / size, -1.0f), 1.0f);
  Vec3 about = cross(axis, wanted);
  if (length(about) < 1e-6f * size) {
    if (c > 0) return;
    about = vec3(a[(op.axis + 1) % 3]);  // opposite: about the next axis
  }
  float s, turned;
  sin_cos(value(op.x) * std::acos(c), s, turned);
  const Mat3 r = rotation(about / length(about), s, turned);
  for (int i = 0; i < 3; ++i) a[i] = lanes(r * vec3(a[i]));
}

// The axes change places, so a face of an exact frame is exact.
void Machine::enter_face(Face face) {
  Lanes* const a = current_.state.axis;
  const Lanes x = a[0], y = a[1], z = a[2];
  const auto turn = [&](const Lanes& across, const Lanes& up, const Lanes& outward, int width, int height, int depth) {
    current_.state.origin += 0.5f * registers_[kScopeRegister + depth] * outward;
    a[0] = across, a[1] = up, a[2] = outward;
    const float w = registers_[kScopeRegister + width], h = registers_[kScopeRegister + height];
    set_scope(0, w), set_scope(1, h), set_scope(2, 0);
  };
  switch (face) {
    case Face::front: return turn(x, y, z, 0, 1, 2);
    case Face::back: return turn(-x, y, -z, 0, 1, 2);
    case Face::right: return turn(-z, y, x, 2, 1, 0);
    case Face::left: return turn(z, y, -x, 2, 1, 0);
    case Face::top: return turn(x, -z, y, 0, 2, 1);
    case Face::bottom: return turn(x, z, -y, 0, 2, 1);
  }
}

void Machine::make_bone(const Op& op) {
  const Vec3 from = point(lanes_at(op.a)), to = point(lanes_at(op.b));
  if (broken_scope() || !(length(to - from) < INFINITY) || !(length(to) < INFINITY)) {
    ++model->dropped;
    return;
  }
  Bone& bone = model->bones.emplace_back();  // field by field: a copy would wait for the parts just written
  bone.from = from;
  bone.to = to;
  bone.parent = current_.state.bone;
  bone.gene = current_.at.gene;
  current_.state.bone = static_cast<std::int32_t>(model->bones.size()) - 1;
}

}  // namespace espalier
