#pragma once
// How the pictures of a scene look: their size, and from which side they show the model.

#include "render/render.h"
#include "run/scene.h"

namespace espalier {

inline RenderSettings look_of(const SceneOutput& output) {
  RenderSettings look;
  look.width = output.picture[0], look.height = output.picture[1];
  look.azimuth_deg = static_cast<float>(output.azimuth_deg);
  look.elevation_deg = static_cast<float>(output.elevation_deg);
  return look;
}

}  // namespace espalier
