#include "render/render.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "base/check.h"
#include "render/camera.h"
#include "render/coverage.h"
#include "render/film.h"
#include "render/set.h"
#include "render/shade.h"

namespace espalier {
namespace {

constexpr float kMargin = 0.07f;       // of the picture's sides
constexpr std::uint32_t kMostSamples = 256;
constexpr float kAlike = 0.95f;        // cosine of normals that may share their light
constexpr std::uint32_t kTile = 16;    // pixels; tiles are handed to threads

void add(const Light& one, Light& sum) {
  sum.diffuse += one.diffuse, sum.mirrored += one.mirrored;
  sum.key += one.key, sum.open += one.open;
}

Light mean(const Light& sum, std::uint32_t count) {
  const float share = 1 / static_cast<float>(count);
  return {share * sum.diffuse, share * sum.mirrored, share * sum.key, share * sum.open};
}

/// Traces pixels one by one; every worker has its own.
class PixelTracer {
 public:
  PixelTracer(const View& view, int samples)
      : view_(view),
        all_(std::clamp<std::uint32_t>(static_cast<std::uint32_t>(std::max(samples, 1)), 1, kMostSamples)),
        few_(std::min(all_, std::max(2u, all_ / 4))) {}

  /// The first samples of a pixel tell whether it sees one surface; only where it does not, the others follow. Where
  /// there is only the stage, the first tells.
  Pixel trace(std::uint32_t x, std::uint32_t y, bool may_hit) {
    const PixelSamples places(x, y);
    samples_.clear();
    if (!may_hit) return trace_stage(places, x, y);
    look(places, x, y, few_, may_hit);
    const bool plain = is_plain(samples_);
    if (!plain) look(places, x, y, all_, may_hit);
    light(places);
    return plain ? develop_plain(samples_) : develop_mixed(view_, samples_);
  }

 private:
  /// Samples of one surface in one pixel.
  struct Group {
    std::uint32_t surface = 0, count = 0;
    Vec3 normal{0};
    Light light;
  };

  Pixel trace_stage(const PixelSamples& places, std::uint32_t x, std::uint32_t y) {
    look(places, x, y, 1, false);
    Sample& sample = samples_[0];
    if (sample.seen != Seen::backdrop) {
      Light light;
      std::uint32_t count = 0;
      const auto take = [&](std::uint32_t end) {
        for (; count < end; ++count) add(gather(view_, sample, places.number(count)), light);
      };
      take((few_ + 1) / 2);
      // Far from all shadows half of the samples are enough.
      const float open = static_cast<float>(count);
      if (light.key < open || light.open < open) take(few_);
      // In half shadow, where noise shows, twice as many.
      if (light.key > 0 && light.key < static_cast<float>(count)) take(2 * few_);
      lit(view_, mean(light, count), sample);
    }
    return develop_plain(samples_);
  }

  void look(const PixelSamples& places, std::uint32_t x, std::uint32_t y, std::uint32_t end, bool may_hit) {
    for (auto s = static_cast<std::uint32_t>(samples_.size()); s < end; ++s) {
      const Vec2 in_pixel = places.in_pixel(s);
      const Vec2 point =
          view_.picture_point(static_cast<float>(x) + in_pixel.x, static_cast<float>(y) + in_pixel.y);
      see(view_, point, may_hit, places.number(s), samples_.emplace_back());
    }
  }

  /// Light is gathered for the first samples of every surface, the fewer the more there are, and shared with the rest.
  void light(const PixelSamples& places) {
    groups_.clear();
    group_of_.assign(samples_.size(), 0);
    std::uint32_t gathered = 0;
    const std::uint32_t most = samples_.size() > few_ ? 2 * few_ : few_;  // only plain pixels are smoothed
    for (std::uint32_t s = 0; s < samples_.size(); ++s) {
      const Sample& sample = samples_[s];
      if (sample.layered || sample.seen == Seen::backdrop) continue;
      std::uint32_t g = 0;
      while (g < groups_.size() && !(groups_[g].surface == sample.surface &&
                                     glm::dot(groups_[g].normal, sample.normal) >= kAlike)) ++g;
      if (g == groups_.size()) groups_.push_back({sample.surface, 0, sample.normal, {}});
      group_of_[s] = g;
      Group& group = groups_[g];
      if (group.count >= most || (group.count > 0 && gathered >= 3 * few_)) continue;
      add(gather(view_, sample, places.number(s)), group.light);
      ++group.count, ++gathered;
    }
    for (Group& group : groups_) group.light = mean(group.light, group.count);
    for (std::size_t s = 0; s < samples_.size(); ++s) {
      Sample& sample = samples_[s];
      if (!sample.layered && sample.seen != Seen::backdrop) lit(view_, groups_[group_of_[s]].light, sample);
    }
  }

  const View& view_;
  std::uint32_t all_, few_;
  std::vector<Sample> samples_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> group_of_;  // per sample
};

Picture picture_of(View view, int samples, Executor& executor) {
  const GroundShade ground_shade(view.stage, view.set.opaque);
  view.ground_shade = &ground_shade;
  Coverage coverage(view.camera, view.width, view.height);
  for (const Tracer* tracer : {&view.set.opaque, &view.set.translucent, &view.set.ghosts}) coverage.add(*tracer);
  Film film(view.width, view.height, !view.set.ghosts.empty());
  std::vector<PixelTracer> tracers(static_cast<std::size_t>(executor.workers()), PixelTracer(view, samples));
  const std::uint32_t columns = (view.width + kTile - 1) / kTile, rows = (view.height + kTile - 1) / kTile;
  executor.for_each(std::size_t{columns} * rows, [&](std::size_t tile, int worker) {
    const std::uint32_t left = static_cast<std::uint32_t>(tile % columns) * kTile,
                        top = static_cast<std::uint32_t>(tile / columns) * kTile;
    PixelTracer& tracer = tracers[static_cast<std::size_t>(worker)];
    for (std::uint32_t y = top; y < std::min(top + kTile, view.height); ++y) {
      for (std::uint32_t x = left; x < std::min(left + kTile, view.width); ++x)
        film.put(x, y, tracer.trace(x, y, coverage.may_show(x, y)));
    }
  });
  for (const std::uint32_t step : {1u, 2u, 4u}) film.smooth_light(step, executor);
  return film.develop(view, executor);
}

Lens lens_for(const RenderSettings& s, const Set& set) {
  CHECK(s.width > 0 && s.height > 0);
  if (s.tall) return parallel_lens(static_cast<float>(*s.tall * set.scale), s.width, s.height);
  return s.fov_deg ? lens_of_angle(*s.fov_deg, s.width, s.height) : long_lens(s.width, s.height);
}

/// What a placed camera looks at.
Vec3 looked_at(const CameraPlace& place, const Set& set) { return place.at ? set.unit_point(*place.at) : Vec3(0); }

Camera placed(const CameraPlace& place, const Set& set, const Lens& lens) {
  // The way to look is worked out from the places that were given: far away, both may be one place of the unit space.
  glm::dvec3 ahead = (place.at ? glm::dvec3(*place.at) : set.centre) - glm::dvec3(place.eye);
  if (ahead == glm::dvec3(0)) ahead.z = -1;  // in the very middle of the model
  return placed_camera(set.unit_point(place.eye), ahead, lens, place.up);
}

Stage stage_for(const RenderSettings& settings, const Set& set, const Camera& camera) {
  Stage stage = make_stage(set.lowest, camera);
  stage.ground = settings.ground, stage.clear = settings.transparent, stage.background = settings.background;
  if (settings.to_light) stage.to_key = glm::normalize(*settings.to_light);
  return stage;
}

}  // namespace

Picture render(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
               const std::vector<Mesh>& ghosts, const RenderSettings& settings, Executor& executor) {
  const Set set = build_set(model, meshes, surfaces, ghosts, settings.full, settings.detail);
  const Lens lens = lens_for(settings, set);
  const Camera camera =
      settings.place ? placed(*settings.place, set, lens)
                     : frame_points(set.corners, settings.azimuth_deg, settings.elevation_deg, lens, kMargin);
  const View view{set, stage_for(settings, set, camera), camera, settings.width, settings.height, nullptr};
  return picture_of(view, settings.samples, executor);
}

void render_turntable(const Model& model, const MeshTable& meshes, const Surfaces& surfaces,
                      const std::vector<Mesh>& ghosts, const RenderSettings& settings, const Turntable& turntable,
                      Executor& executor, const std::function<void(std::uint32_t, Picture)>& take) {
  const Set set = build_set(model, meshes, surfaces, ghosts, settings.full, settings.detail);
  const Lens lens = lens_for(settings, set);
  const Camera first =
      settings.place ? placed(*settings.place, set, lens)
                     : frame_turning(set.corners, settings.azimuth_deg, settings.elevation_deg, lens, kMargin);
  const Vec3 axis = settings.place ? looked_at(*settings.place, set) : Vec3(0);
  View view{set, stage_for(settings, set, first), first, settings.width, settings.height, nullptr};
  const std::uint32_t begin = turntable.only.value_or(0), end = turntable.only ? begin + 1 : turntable.frames;
  for (std::uint32_t frame = begin; frame < end; ++frame) {
    view.camera = turned(first, axis, 360.0f * static_cast<float>(frame) / static_cast<float>(turntable.frames));
    if (!turntable.fixed_light) view.stage.to_key = make_stage(set.lowest, view.camera).to_key;
    take(frame, picture_of(view, settings.samples, executor));
  }
}

}  // namespace espalier
