#include "render/ghost.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace espalier {
namespace {

constexpr int kMostShells = 6;
constexpr float kBlend = 6e-3f;  // depth over which coinciding faces fade; the scene has unit radius
const Vec3 kTint(0.16f, 0.42f, 0.90f);

float smooth(float x) {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

}  // namespace

void add_ghosts(const Tracer& ghosts, const Ray& ray, float far, Sample& sample) {
  float near = ray.near;
  for (int shell = 0; shell < kMostShells; ++shell) {
    const Tracer::Hit hit = ghosts.intersect({ray.origin, ray.direction, near});
    if (!hit) break;
    near = hit.t + 2 * Tracer::kTie;
    Vec3 flat, n;
    ghosts.normals(hit, ray.direction, flat, n);
    if (shell == 0) sample.ghost_normal = n;
    const float seen = smooth((far - hit.t) / (2 * kBlend) + 0.5f);
    if (seen == 0) break;
    const float grazing = 1 - std::min(std::abs(glm::dot(n, ray.direction)), 1.0f);
    const float density = 0.13f + 0.5f * grazing * grazing * grazing;
    const float alpha = std::min(seen * density * (shell == 0 ? 1.0f : 0.45f), 0.8f);
    const Vec3 colour = kTint * (0.95f + 0.35f * n.y);
    sample.veil += sample.clear * alpha * colour;
    sample.clear *= 1 - alpha;
  }
}

Vec3 ghost_edge(const Vec3& colour, const Vec3& edge, float change) {
  return colour + 0.75f * smooth((change - 0.25f) / 0.9f) * (edge - colour);
}

}  // namespace espalier
