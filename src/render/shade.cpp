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
constexpr float kBounce = 0.28f;        // of the sky comes back from what hides it: surfaces nearby are lit too
constexpr float kGroundEdge2 = 36;      // squared distance where the ground ends
constexpr float kMirrors = 0.05f;       // what metal below shows of its surroundings is not looked for
constexpr int kMostLayers = 8;

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

/// `pixel`: how wide what a pixel shows is there.
Look look_of(const Set& set, const Tracer& tracer, const Tracer::Hit& hit, float pixel) {
  const std::uint16_t index = tracer.part(hit.part).material;
  const Material& m = set.material(index);
  Look look{m.color, std::clamp(m.opacity, 0.0f, 1.0f), 1};
  if (const TextureSampler* texture = set.texture(index)) {
    float share = 0;
    const Vec2 repeats = m.repeats(), uv = tracer.uv(hit, share) * repeats;
    const auto texel = texture->at(uv, share * pixel * std::sqrt(repeats.x * repeats.y));
    look.color *= texel.color;
    look.texture_alpha = texel.alpha;
    look.opacity *= texel.alpha;
  }
  return look;
}

void see_surface(const View& view, const Tracer& tracer, const Ray& ray, const Tracer::Hit& hit, const Vec3& color,
                 Sample& out) {
  const Material& m = view.set.material(tracer.part(hit.part).material);
  tracer.normals(hit, ray.direction, out.flat, out.normal);
  out.seen = Seen::model;
  out.surface = hit.part;
  out.position = ray.at(hit.t);
  out.to_eye = -ray.direction;
  out.color = color;
  out.metal = std::clamp(m.metal, 0.0f, 1.0f), out.roughness = std::clamp(m.roughness, 0.0f, 1.0f);
  out.glow = m.glow;
}

/// The ground, which shows nothing but shadows, or the backdrop; how far away it is.
float see_stage(const View& view, const Ray& ray, const Vec2& picture, Sample& out) {
  const Stage& stage = view.stage;
  out.albedo = backdrop(stage, picture);
  out.light = Vec3(1);
  out.surface = kBackdrop;
  out.alpha = stage.clear ? 0 : 1;
  if (!stage.ground || !(ray.direction.y < -1e-4f) || !(ray.origin.y > stage.ground_y)) return 1e30f;
  const float t = (stage.ground_y - ray.origin.y) / ray.direction.y;
  const Vec3 p = ray.at(t);
  if (p.x * p.x + p.z * p.z > kGroundEdge2) return t;
  out.seen = Seen::ground;
  out.surface = kGround;
  out.position = p;
  out.flat = out.normal = Vec3(0, 1, 0);
  return t;
}

/// Roughly the light from a part that a mirroring surface shows, as if nothing stood around it.
Vec3 mirrored_part(const View& view, const Ray& ray, const Tracer::Hit& hit) {
  Vec3 flat, smooth;
  view.set.opaque.normals(hit, ray.direction, flat, smooth);
  const Vec3 color = look_of(view.set, view.set.opaque, hit, 0.02f * (1 + hit.t)).color;
  const float facing = std::max(glm::dot(smooth, view.stage.to_key), 0.0f);
  return color * (0.7f * sky(smooth) + 0.45f * facing * key_radiance());
}

void gather_mirrored(const View& view, const Sample& sample, const Vec3& start, std::uint32_t number, Light& light) {
  const float n_v = std::max(glm::dot(sample.normal, sample.to_eye), 0.0f);
  const Vec3 mirror = 2 * n_v * sample.normal - sample.to_eye;
  if (!(sample.metal > kMirrors)) {  // a faint sheen: the middle of what it mirrors will do, and has no noise
    light.mirrored = studio(glm::normalize(mirror + 0.5f * sample.roughness * (sample.normal - mirror)),
                            view.stage.to_key);
    return;
  }
  const Vec3 direction = in_cone(mirror, 0.02f + 0.7f * sample.roughness, view.stage.tables->in_lobe(number));
  const Ray ray{start, direction, 0};
  if (const Tracer::Hit hit = view.set.opaque.intersect(ray, kSkyReach)) {
    light.mirrored = mirrored_part(view, ray, hit);
    return;
  }
  light.mirrored = studio(direction, view.stage.to_key);
}

/// Lays translucent parts in front of what the sample holds, the farthest first.
void add_layers(const View& view, const Ray& ray, float far, std::uint32_t number, Sample& sample) {
  Tracer::Hit hits[kMostLayers];
  int count = 0;
  Ray rest = ray;
  while (count < kMostLayers) {
    const Tracer::Hit hit = view.set.translucent.intersect(rest, far);
    if (!hit) break;
    hits[count++] = hit;
    rest.near = hit.t + 2 * Tracer::kTie;
  }
  if (count == 0) return;
  lit(view, gather(view, sample, number), sample);
  if (sample.seen == Seen::ground && view.stage.clear) sample.alpha = shadow_alpha(sample.light);
  for (int k = count; k-- > 0;) {
    Sample layer;
    const Look look =
        look_of(view.set, view.set.translucent, hits[k], view.camera.pixel_width(hits[k].t, view.height));
    see_surface(view, view.set.translucent, ray, hits[k], look.color, layer);
    lit(view, gather(view, layer, number), layer);
    const Vec3 behind = sample.albedo * sample.light + sample.extra;
    sample.extra = look.opacity * (layer.albedo * layer.light) + look.texture_alpha * layer.extra +
                   (1 - look.opacity) * behind;
    sample.alpha = 1 - (1 - look.opacity) * (1 - sample.alpha);
    sample.albedo = Vec3(0);
  }
  sample.seen = Seen::model;
  sample.layered = true;
}

}  // namespace

void see(const View& view, const Vec2& picture, bool may_hit, std::uint32_t number, Sample& sample) {
  const Set& set = view.set;
  const Ray ray = view.camera.ray(picture.x, picture.y);
  const Tracer::Hit hit = may_hit ? set.opaque.intersect(ray) : Tracer::Hit{};
  float far = hit.t;
  if (hit) {
    const Look look = look_of(set, set.opaque, hit, view.camera.pixel_width(hit.t, view.height));
    see_surface(view, set.opaque, ray, hit, look.color, sample);
  } else {
    far = see_stage(view, ray, picture, sample);
  }
  if (may_hit && !set.translucent.empty()) add_layers(view, ray, far, number, sample);
  if (may_hit && !set.ghosts.empty()) add_ghosts(set.ghosts, ray, far, sample);
}

Light gather(const View& view, const Sample& sample, std::uint32_t number) {
  Light light;
  if (sample.seen == Seen::backdrop) return light;
  const Tracer& opaque = view.set.opaque;
  const LightTables& tables = *view.stage.tables;
  const Vec3 start = sample.position + kOffset * sample.flat;
  const bool ground = sample.seen == Seen::ground;
  if (ground && view.ground_shade && !view.ground_shade->may_hide(sample.position)) {
    light.key = 1;
  } else {
    const Vec3 to_key = in_cone(view.stage.to_key, kKeySpread, tables.on_light(number));
    const float facing = glm::dot(sample.normal, to_key);
    if (facing > 0 && glm::dot(sample.flat, to_key) > 0 && !opaque.blocks({start, to_key, 0}, 1e30f)) {
      light.key = 1;
      light.diffuse += facing * key_radiance();
    }
  }
  Vec3 out = tables.over_hemisphere(sample.normal, number);
  if (glm::dot(out, sample.flat) < 0) out -= 2 * glm::dot(out, sample.flat) * sample.flat;
  const bool blocked = opaque.blocks({start, out, 0}, ground ? kGroundReach : kSkyReach);
  light.open = blocked ? 0 : 1;
  if (ground) return light;
  light.diffuse += (blocked ? kBounce : 1.0f) * sky(out);
  gather_mirrored(view, sample, start, number, light);
  return light;
}

void lit(const View& view, const Light& light, Sample& out) {
  if (out.seen == Seen::backdrop) return;
  if (out.seen == Seen::ground) {
    const float away2 = out.position.x * out.position.x + out.position.z * out.position.z;
    const float fade = std::clamp((kGroundEdge2 - away2) / 20, 0.0f, 1.0f);
    out.light = Vec3(1) + fade * (ground_light(light.key, light.open) - Vec3(1));
    return;
  }
  const Vec3 &n = out.normal, &color = out.color, &to_key = view.stage.to_key;
  const float metal = out.metal;
  const Vec3 facing_colour = Vec3(0.04f * (1 - metal)) + metal * color;
  out.extra = light.key * key_radiance();
  if (light.key > 0) out.extra *= highlight(n, out.to_eye, to_key, out.roughness, facing_colour);
  // The surroundings mirrored: sharper for smooth surfaces, brighter at grazing angles. What metals mirror is noisy and
  // has their colour, so it counts as light.
  const float m1 = 1 - std::max(glm::dot(n, out.to_eye), 0.0f), m5 = m1 * m1 * m1 * m1 * m1;
  out.albedo = color;
  out.light = (1 - metal) * light.diffuse + metal * light.mirrored;
  const float sheen = (1 - metal) * (0.04f + (1 - out.roughness) * m5) + metal * 0.5f * m5;
  out.extra += sheen * (0.4f + 0.6f * light.open) * light.mirrored;
  // A faint rim from above and behind parts dark shapes from dark neighbours.
  out.extra += Vec3(0.10f * m1 * m1 * m1 * (0.6f + 0.4f * n.y) * light.open) * (Vec3(0.3f) + color);
  out.extra += std::min(out.glow, 4.0f) * color;
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

float shadow_alpha(const Vec3& light) { return std::clamp(1 - (light.x + light.y + light.z) / 3, 0.0f, 1.0f); }

Vec3 colour_of(const Sample& s) {
  const Vec3 base = s.albedo * s.light + s.extra;
  return s.veil + s.clear * (s.seen == Seen::model ? tone(base) : base);
}

float alpha_of(const View& view, const Sample& s) {
  const float base = view.stage.clear && s.seen == Seen::ground ? shadow_alpha(s.light) : s.alpha;
  return 1 - s.clear * (1 - base);
}

}  // namespace espalier
