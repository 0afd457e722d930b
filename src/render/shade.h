#pragma once
// Shade: what a camera ray sees. A sample keeps surface colour and arriving light apart, so that the light, which is
// noisy, can be smoothed without blurring the colours.

#include "render/sampling.h"
#include "render/set.h"
#include "render/stage.h"

namespace espalier {

/// Linear light: colour = veil + clear * tone(albedo * light + extra).
struct Sample {
  Vec3 albedo{0}, light{0}, extra{0};
  Vec3 normal{0}, position{0};  // of the surface; normal 0: backdrop
  std::uint32_t surface = 0;    // differs between parts, ground and backdrop
  bool layered = false;         // seen through something translucent
  Vec3 veil{0};                 // of ghosts in front
  float clear = 1;
  Vec3 ghost_normal{0};         // of the nearest ghost, wherever it is; 0 if there is none
};

/// The sample number s of a pixel: `direction` leaves the camera's eye, `picture` is its place in [-1, 1].
Sample trace_sample(const Set& set, const Stage& stage, const Camera& camera, const Vec3& direction,
                    const Vec2& picture, const PixelSamples& samples, std::uint32_t s);

/// Compresses bright light smoothly below 1; the identity up to 0.7.
Vec3 tone(const Vec3& light);

/// The colour of a sample with its own light.
Vec3 colour_of(const Sample& sample);

}  // namespace espalier
