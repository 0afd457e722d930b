#include "render/render.h"

#include <algorithm>

#include "base/check.h"
#include "render/camera.h"
#include "render/film.h"
#include "render/set.h"
#include "render/shade.h"

namespace espalier {
namespace {

constexpr float kMargin = 0.07f;       // of the picture's sides
constexpr std::uint32_t kMostSamples = 256;

/// The first samples of a pixel tell whether it sees one surface; only where it does not, the others follow.
void trace_pixel(const Set& set, const Stage& stage, const Camera& camera, std::uint32_t x, std::uint32_t y,
                 const RenderSettings& settings, std::vector<Sample>& scratch, Pixel& out) {
  const std::uint32_t all =
      std::clamp<std::uint32_t>(static_cast<std::uint32_t>(std::max(settings.samples, 1)), 1, kMostSamples);
  const std::uint32_t few = std::min(all, std::max(2u, all / 4));
  const PixelSamples samples(x, y);
  scratch.clear();
  const auto take = [&](std::uint32_t end) {
    for (auto s = static_cast<std::uint32_t>(scratch.size()); s < end; ++s) {
      const Vec2 jitter = samples.in_pixel(s);
      const Vec2 picture(2 * (static_cast<float>(x) + jitter.x) / static_cast<float>(settings.width) - 1,
                         1 - 2 * (static_cast<float>(y) + jitter.y) / static_cast<float>(settings.height));
      scratch.push_back(trace_sample(set, stage, camera, camera.direction(picture.x, picture.y), picture, samples, s));
    }
  };
  take(few);
  if (is_plain(scratch)) {
    out = develop_plain(scratch);
  } else {
    take(all);
    out = develop_mixed(scratch);
  }
}

}  // namespace

Picture render(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
               const std::vector<Mesh>& ghosts, const RenderSettings& settings, Executor& executor) {
  CHECK(settings.width > 0 && settings.height > 0);
  Set set = build_set(model, meshes, surfaces, ghosts, settings.full);
  const Camera camera = frame_points(set.corners, settings.azimuth_deg, settings.elevation_deg, settings.width,
                                     settings.height, kMargin);
  const Stage stage = make_stage(set.lowest, camera);
  set.pixel_angle = 2 * camera.tan_y / static_cast<float>(settings.height);
  Film film(settings.width, settings.height);
  std::vector<std::vector<Sample>> scratch(static_cast<std::size_t>(executor.workers()));
  executor.for_each(settings.height, [&](std::size_t row, int worker) {
    const auto y = static_cast<std::uint32_t>(row);
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      trace_pixel(set, stage, camera, x, y, settings, scratch[static_cast<std::size_t>(worker)], film.at(x, y));
    }
  });
  for (const std::uint32_t step : {1u, 2u}) film.smooth_light(step, executor);
  return film.develop(executor);
}

}  // namespace espalier
