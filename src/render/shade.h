#pragma once
// Shade: what a camera ray sees. A sample keeps surface colour and arriving light apart, so that the light, which is
// noisy, can be gathered once for many samples and smoothed without blurring the colours.

#include "render/ground_shade.h"
#include "render/sampling.h"
#include "render/set.h"
#include "render/stage.h"

namespace espalier {

/// What is looked at, from where.
struct View {
  const Set& set;
  Stage stage;
  Camera camera;
  std::uint32_t width = 1, height = 1;
  const GroundShade* ground_shade = nullptr;  // of this stage; null: not known

  /// The picture point of a place in the picture, in pixels from its upper left corner.
  Vec2 picture_point(float x, float y) const {
    return {2 * x / static_cast<float>(width) - 1, 1 - 2 * y / static_cast<float>(height)};
  }
};

/// What arrives at a surface, or the mean of several samples of it.
struct Light {
  Vec3 diffuse{0};   // per unit albedo
  Vec3 mirrored{0};  // from where a mirror would show
  float key = 0;     // share of the key light seen
  float open = 0;    // share of the sky seen
};

enum class Seen : std::uint8_t { model, ground, backdrop };

/// Linear light: colour = veil + clear * tone(albedo * light + extra).
struct Sample {
  Vec3 albedo{0}, light{0}, extra{0};
  Vec3 normal{0}, position{0};  // of the surface; normal 0: backdrop
  std::uint32_t surface = 0;    // differs between parts, ground and backdrop
  Seen seen = Seen::backdrop;
  bool layered = false;         // seen through something translucent; then it is lit
  float alpha = 1;              // less on a clear stage
  Vec3 veil{0};                 // of ghosts in front
  float clear = 1;
  Vec3 ghost_normal{0};         // of the nearest ghost, wherever it is; 0 if there is none

  // What light needs.
  Vec3 flat{0}, to_eye{0};  // unit; flat: normal of the triangle
  Vec3 color{0};
  float metal = 0, roughness = 1, glow = 0;
};

/// What a ray through the picture point sees, not lit yet, into a fresh `out`. `may_hit`: else the ray is known to pass
/// the model and the ghosts. `number`: of the sample, for its light if it is layered.
void see(const View& view, const Vec2& picture, bool may_hit, std::uint32_t number, Sample& out);

/// One sample of the light that arrives at what was seen.
Light gather(const View& view, const Sample& sample, std::uint32_t number);

/// Fills in what the light does.
void lit(const View& view, const Light& light, Sample& sample);

/// Compresses bright light smoothly below 1; the identity up to 0.7.
Vec3 tone(const Vec3& light);

/// How much a ground that only shows shadows covers, where so much light arrives on it.
float shadow_alpha(const Vec3& light);

/// The colour of a sample with its own light, multiplied by its alpha, and that alpha.
Vec3 colour_of(const Sample& sample);
float alpha_of(const View& view, const Sample& sample);

}  // namespace espalier
