#include "render/shade.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "render/ghost.h"

namespace espalier {
namespace {

constexpr std::uint32_t kGround = 0xfffffffeu, kBackdrop = 0xffffffffu;
constexpr float kOffset = 4e-4f;        // shadow rays start this far from the surface; the scene has unit radius
constexpr float kSkyReach = 1.2f;       // what is farther away does not darken the sky
constexpr float kGroundReach = 2.0f;
constexpr int kMostLayers = 8;

/// What arrives at a surface.
struct Light {
  Vec3 diffuse{0};  // per unit albedo
  float key = 0;    // share of the key light seen
  float open = 1;   // 0 where the sampled sky direction is blocked
};

Light gather(const Set& set, const Stage& stage, const Vec3& position, const Vec3& flat, const Vec3& smooth,
             const PixelSamples& samples, std::uint32_t s) {
  Light light;
  const Vec3 start = position + kOffset * flat;
  const Vec3 to_key = in_cone(stage.to_key, kKeySpread, samples.on_light(s));
  const float facing = glm::dot(smooth, to_key);
  if (facing > 0 && glm::dot(flat, to_key) > 0 && !set.opaque.blocks({start, to_key, 0}, 1e30f)) {
    light.key = 1;
    light.diffuse += facing * key_radiance();
  }
  Vec3 out = cosine_hemisphere(smooth, samples.over_hemisphere(s));
  if (glm::dot(out, flat) < 0) out -= 2 * glm::dot(out, flat) * flat;
  const bool blocked = set.opaque.blocks({start, out, 0}, kSkyReach);
  light.open = blocked ? 0 : 1;
  // Neighbouring surfaces are lit too: a share of the sky comes back from them.
  light.diffuse += (blocked ? 0.28f : 1.0f) * sky(out);
  return light;
}

/// GGX highlight of the key light with Kelemen's visibility, Schlick's Fresnel (Karis 2013).
Vec3 highlight(const Vec3& n, const Vec3& to_eye, const Vec3& to_key, float roughness, const Vec3& facing_colour) {
  const float n_l = glm::dot(n, to_key);
  if (n_l <= 0) return Vec3(0);
  const Vec3 half = glm::normalize(to_eye + to_key);
  const float n_h = std::max(glm::dot(n, half), 0.0f), l_h = std::max(glm::dot(to_key, half), 0.1f);
  const float a = std::max(roughness * roughness, 0.02f), a2 = a * a;
  const float lobe = n_h * n_h * (a2 - 1) + 1;
  const float distribution = a2 / (static_cast<float>(kPi) * lobe * lobe);
  const float m = 1 - l_h, m5 = m * m * m * m * m;
  const Vec3 fresnel = facing_colour + (Vec3(1) - facing_colour) * m5;
  return fresnel * (std::min(distribution / (4 * l_h * l_h), 8.0f) * n_l);
}

/// The colour and opacity of a surface where it was hit: the material's times the texture's.
struct Look {
  Vec3 color{0};
  float opacity = 1, texture_alpha = 1;
};

Look look_of(const Set& set, const Tracer& tracer, const Tracer::Hit& hit) {
  const std::uint16_t index = tracer.part(hit.part).material;
  const Material& m = set.material(index);
  Look look{m.color, std::clamp(m.opacity, 0.0f, 1.0f), 1};
  if (const TextureSampler* texture = set.texture(index)) {
    float share = 0;
    const Vec2 repeats = m.repeats(), uv = tracer.uv(hit, share) * repeats;
    const auto texel = texture->at(uv, share * hit.t * set.pixel_angle * std::sqrt(repeats.x * repeats.y));
    look.color *= texel.color;
    look.texture_alpha = texel.alpha;
    look.opacity *= texel.alpha;
  }
  return look;
}

/// Fills in colour and light of a hit on the model.
void shade_surface(const Set& set, const Stage& stage, const Tracer& tracer, const Tracer::Hit& hit, const Vec3& color,
                   const Vec3& eye, const Vec3& direction, const PixelSamples& samples, std::uint32_t s, Sample& out) {
  Vec3 flat, smooth;
  tracer.normals(hit, direction, flat, smooth);
  const Material& m = set.material(tracer.part(hit.part).material);
  const float metal = std::clamp(m.metal, 0.0f, 1.0f), roughness = std::clamp(m.roughness, 0.0f, 1.0f);
  out.position = eye + hit.t * direction;
  out.normal = smooth;
  const Light light = gather(set, stage, out.position, flat, smooth, samples, s);
  const Vec3 to_eye = -direction, facing_colour = Vec3(0.04f * (1 - metal)) + metal * color;
  if (light.key > 0) out.extra += key_radiance() * highlight(smooth, to_eye, stage.to_key, roughness, facing_colour);
  // The surroundings mirrored: sharper for smooth surfaces, brighter at grazing angles. What metals mirror is noisy and
  // has their colour, so it counts as light.
  const float n_v = std::max(glm::dot(smooth, to_eye), 0.0f), m1 = 1 - n_v, m5 = m1 * m1 * m1 * m1 * m1;
  const Vec3 mirrored = in_cone(2 * n_v * smooth - to_eye, 0.02f + 0.7f * roughness, samples.in_lobe(s));
  const bool dark = metal > 0.05f && set.opaque.blocks({out.position + kOffset * flat, mirrored, 0}, kSkyReach);
  const Vec3 reflection = (dark ? 0.35f : 1.0f) * studio(mirrored, stage.to_key);
  out.albedo = color;
  out.light = (1 - metal) * light.diffuse + metal * reflection;
  const float sheen = (1 - metal) * (0.04f + (1 - roughness) * m5) + metal * 0.5f * m5;
  out.extra += sheen * (0.4f + 0.6f * light.open) * reflection;
  // A faint rim from above and behind parts dark shapes from dark neighbours.
  out.extra += Vec3(0.10f * m1 * m1 * m1 * (0.6f + 0.4f * smooth.y) * light.open) * (Vec3(0.3f) + color);
  out.extra += std::min(m.glow, 4.0f) * color;
}

/// The ground, which shows nothing but shadows, and the backdrop.
void shade_stage(const Set& set, const Stage& stage, const Vec3& eye, const Vec3& direction, float ground_t,
                 const Vec2& picture, const PixelSamples& samples, std::uint32_t s, Sample& out) {
  out.albedo = backdrop(picture.x, picture.y);
  out.light = Vec3(1);
  out.surface = kBackdrop;
  if (!(ground_t < 1e30f)) return;
  const Vec3 p = eye + ground_t * direction;
  const float away2 = p.x * p.x + p.z * p.z;
  if (away2 > 36) return;
  out.surface = kGround;
  out.position = p;
  out.normal = Vec3(0, 1, 0);
  const Vec3 start = p + Vec3(0, kOffset, 0);
  const bool key = !set.opaque.blocks({start, in_cone(stage.to_key, kKeySpread, samples.on_light(s)), 0}, 1e30f);
  const Vec3 out_direction = cosine_hemisphere(out.normal, samples.over_hemisphere(s));
  const bool open = !set.opaque.blocks({start, out_direction, 0}, kGroundReach);
  const float fade = std::clamp((36 - away2) / 20, 0.0f, 1.0f);
  out.light = Vec3(1) + fade * (ground_light(key ? 1.0f : 0.0f, open ? 1.0f : 0.0f) - Vec3(1));
}

/// Lays translucent parts in front of what the sample holds, the farthest first.
void add_layers(const Set& set, const Stage& stage, const Vec3& eye, const Vec3& direction, float far,
                const PixelSamples& samples, std::uint32_t s, Sample& sample) {
  Tracer::Hit hits[kMostLayers];
  int count = 0;
  float near = 0;
  while (count < kMostLayers) {
    const Tracer::Hit hit = set.translucent.intersect({eye, direction, near}, far);
    if (!hit) break;
    hits[count++] = hit;
    near = hit.t + 2 * Tracer::kTie;
  }
  for (int k = count; k-- > 0;) {
    Sample layer;
    const Look look = look_of(set, set.translucent, hits[k]);
    shade_surface(set, stage, set.translucent, hits[k], look.color, eye, direction, samples, s, layer);
    const Vec3 behind = sample.albedo * sample.light + sample.extra;
    sample.extra = look.opacity * (layer.albedo * layer.light) + look.texture_alpha * layer.extra +
                   (1 - look.opacity) * behind;
    sample.albedo = Vec3(0);
    sample.layered = true;
  }
}

}  // namespace

Sample trace_sample(const Set& set, const Stage& stage, const Camera& camera, const Vec3& direction,
                    const Vec2& picture, const PixelSamples& samples, std::uint32_t s) {
  Sample sample;
  const Vec3& eye = camera.eye;
  const Tracer::Hit hit = set.opaque.intersect({eye, direction, 0});
  float far = hit.t;
  if (hit) {
    sample.surface = hit.part;
    const Vec3 color = look_of(set, set.opaque, hit).color;
    shade_surface(set, stage, set.opaque, hit, color, eye, direction, samples, s, sample);
  } else {
    const float ground_t = direction.y < -1e-4f && eye.y > stage.ground_y
                               ? (stage.ground_y - eye.y) / direction.y : 1e30f;
    shade_stage(set, stage, eye, direction, ground_t, picture, samples, s, sample);
    far = ground_t;
  }
  if (!set.translucent.empty()) add_layers(set, stage, eye, direction, far, samples, s, sample);
  if (!set.ghosts.empty()) add_ghosts(set.ghosts, {eye, direction, 0}, far, sample);
  return sample;
}

Vec3 tone(const Vec3& light) {
  constexpr float kKnee = 0.7f;
  Vec3 out = light;
  for (int c = 0; c < 3; ++c) {
    if (!(out[c] > 0)) out[c] = 0;
    const float over = out[c] - kKnee;
    if (over > 0) out[c] = kKnee + (1 - kKnee) * over / (1 - kKnee + over);
  }
  return out;
}

Vec3 colour_of(const Sample& s) { return s.veil + s.clear * tone(s.albedo * s.light + s.extra); }

}  // namespace espalier
