#include "run/silhouette_view.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "base/box_corner.h"
#include "base/math.h"
#include "render/paint.h"
#include "run/scene_silhouettes.h"

namespace espalier {
namespace {

constexpr std::uint32_t kFineSide = 1600;  // pixels of the shadow's longer side, as it is drawn
constexpr int kPlaneSamples = 3;           // along each side of a pixel
constexpr float kMargin = 0.05f;
constexpr Colour kAround{{226, 228, 230}}, kSheet{{253, 253, 252}}, kWished{{255, 221, 148}}, kShade{{62, 70, 86}};

DVec3 wide(const Vec3& v) { return {v.x, v.y, v.z}; }

/// The largest size of the target's proportions that fits.
std::array<std::uint32_t, 2> fitted(std::array<std::uint32_t, 2> size, std::array<std::uint32_t, 2> room) {
  const std::uint64_t w = size[0], h = size[1];
  if (room[0] * h <= room[1] * w) return {room[0], std::max(1u, static_cast<std::uint32_t>(room[0] * h / w))};
  return {std::max(1u, static_cast<std::uint32_t>(room[1] * w / h)), room[1]};
}

Picture camera_view(const Setup& setup, const SceneSilhouette& silhouette, const Model& model,
                    const Surfaces& surfaces, RenderSettings look, Executor& executor) {
  const SceneCamera& camera = silhouette.camera;
  const auto size = fitted(*silhouette.size, {look.width, look.height});
  look.width = size[0], look.height = size[1];
  look.place = CameraPlace{camera.eye, camera.at, camera.up};
  if (camera.tall) look.tall = static_cast<float>(*camera.tall);
  else look.fov_deg = static_cast<float>(camera.fov_deg);
  return render(model, setup.meshes, surfaces, {}, look, executor);
}

/// The plane of a shadow, and what lies on it, pixel by pixel.
class ShadowPlane {
 public:
  ShadowPlane(const SceneSilhouette& silhouette, const SilhouetteTarget& target, const MeshTable& meshes,
              const Model& model)
      : screen_(*silhouette.shadow) {
    const WeightImage& image = target.settings().image;
    const auto size = fitted({image.width, image.height}, {kFineSide, kFineSide});
    SilhouetteSettings settings;
    settings.projection = projection_of(silhouette, size);
    settings.image = resized(image, size[0], size[1]);
    const SilhouetteTarget finer(std::move(settings), meshes);
    projection_ = finer.settings().projection;
    wished_ = finer.settings().image;
    shadow_ = finer.silhouette(model.instances);
    out_ = glm::normalize(wide(screen_.normal));
    right_ = glm::normalize(glm::cross(wide(screen_.up), out_));
    up_ = glm::cross(out_, right_);
    // Of both sides of the plane the one that the light comes from.
    const DVec3 to_light = screen_.lamp ? wide(screen_.light) - wide(screen_.centre) : -wide(screen_.light);
    lit_side_ = glm::dot(to_light, out_) < 0 ? -out_ : out_;
  }

  const DVec3& lit_side() const { return lit_side_; }
  const DVec3& up() const { return up_; }
  Vec3 corner(int k) const {
    const double tall = 0.5 * screen_.tall, across = tall * projection_.width / projection_.height;
    return Vec3(wide(screen_.centre) + (k & 1 ? across : -across) * right_ + (k & 2 ? tall : -tall) * up_);
  }
  Colour seen(const DVec3& eye, const DVec3& direction) const {
    const double facing = glm::dot(direction, out_), t = glm::dot(wide(screen_.centre) - eye, out_) / facing;
    if (!(t > 0) || !std::isfinite(t)) return kAround;
    const DVec3 p = projection_.point(eye + t * direction);
    const double column = p.x / p.z, row = p.y / p.z;
    if (!(column >= 0 && row >= 0 && column < projection_.width && row < projection_.height)) return kAround;
    const auto x = static_cast<std::uint32_t>(column), y = static_cast<std::uint32_t>(row);
    const std::int32_t degree = std::max(0, wished_.at(x, y));
    const auto strength = static_cast<std::uint32_t>(std::int64_t{256} * degree / WeightImage::kFull);
    const Colour sheet = mix(kSheet, kWished, strength);
    return shadow_.get(x, y) ? mix(sheet, kShade, 190) : sheet;
  }

 private:
  SceneShadow screen_;
  Projection projection_;
  WeightImage wished_;
  PixelCanvas shadow_;
  DVec3 out_, right_, up_, lit_side_;
};

/// So that the drawing is upright: from below its lower edge on a floor, from the front of a wall; both a bit from
/// aside.
Camera shadow_camera(const ShadowPlane& plane, std::span<const Vec3> points, const RenderSettings& look) {
  const Vec3 side = Vec3(plane.lit_side()), up = Vec3(plane.up());
  const auto degrees = [](float x, float z) { return std::atan2(x, z) * static_cast<float>(180 / kPi); };
  const bool floor = std::fabs(side.y) > 0.6f;
  const float azimuth = floor ? degrees(-up.x, -up.z) + 14 : degrees(side.x, side.z) + 30;
  const float elevation = floor ? (side.y > 0 ? 46.0f : -46.0f) : 14;
  return frame_points(points, azimuth, elevation, look.width, look.height, kMargin);
}

/// The size in which the points fill the picture as they are seen, at least half as wide or high as there is room.
std::array<std::uint32_t, 2> snug(const Camera& camera, std::span<const Vec3> points, const RenderSettings& room) {
  float low[2] = {1, 1}, high[2] = {-1, -1};
  for (const Vec3& point : points) {
    const Vec3 seen = camera.picture_point(point);
    for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], seen[i]), high[i] = std::max(high[i], seen[i]);
  }
  const auto part = [&](std::uint32_t side, int i) {
    const float share = std::clamp((high[i] - low[i]) / 2 + 2 * kMargin, 0.5f, 1.0f);
    return std::max(1u, static_cast<std::uint32_t>(static_cast<float>(side) * share));
  };
  return {part(room.width, 0), part(room.height, 1)};
}

void lay_behind(Picture& picture, const Camera& camera, const ShadowPlane& plane, Executor& executor) {
  executor.for_each(picture.height, [&](std::size_t row, int) {
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const std::size_t at = x + picture.width * row;
      const std::uint32_t alpha = picture.alpha.empty() ? 255 : picture.alpha[at];
      if (alpha == 255) continue;
      std::uint32_t sum[3] = {0, 0, 0};
      for (int k = 0; k < kPlaneSamples * kPlaneSamples; ++k) {
        const float dx = (static_cast<float>(k % kPlaneSamples) + 0.5f) / kPlaneSamples;
        const float dy = (static_cast<float>(k / kPlaneSamples) + 0.5f) / kPlaneSamples;
        const Vec3 direction =
            camera.direction(2 * (static_cast<float>(x) + dx) / static_cast<float>(picture.width) - 1,
                             1 - 2 * (static_cast<float>(row) + dy) / static_cast<float>(picture.height));
        const Colour colour = plane.seen(wide(camera.eye), wide(direction));
        for (int c = 0; c < 3; ++c) sum[c] += colour.rgb[c];
      }
      std::uint8_t* rgb = picture.rgb.data() + 3 * at;
      constexpr std::uint32_t kAll = kPlaneSamples * kPlaneSamples;
      for (int c = 0; c < 3; ++c)
        rgb[c] = static_cast<std::uint8_t>((rgb[c] * alpha * kAll + sum[c] * (255 - alpha) + 255 * kAll / 2) /
                                           (255 * kAll));
    }
  });
  picture.alpha.clear();
}

Picture shadow_view(const Setup& setup, std::size_t index, const Model& model, const Surfaces& surfaces,
                    RenderSettings look, Executor& executor) {
  const SceneSilhouette& silhouette = setup.scene.silhouettes[index];
  const ShadowPlane plane(silhouette, *setup.silhouettes[index], setup.meshes, model);
  const Bounds box = bounds(model, setup.meshes, true);
  std::vector<Vec3> points;
  for (int k = 0; k < 4; ++k) points.push_back(plane.corner(k));
  for (int k = 0; k < 8 && !box.empty(); ++k) points.push_back(corner_of(box, k));
  const auto size = snug(shadow_camera(plane, points, look), points, look);
  const auto larger = fitted(size, {look.width, look.height});
  look.width = larger[0], look.height = larger[1];
  const Camera camera = shadow_camera(plane, points, look);
  look.place = place_of(camera);
  look.ground = false, look.transparent = true;
  const SceneShadow& shadow = *silhouette.shadow;
  const Vec3 to_light = shadow.lamp ? shadow.light - (box.empty() ? shadow.centre : box.centre()) : -shadow.light;
  if (glm::length(to_light) > 0) look.to_light = to_light;
  Picture picture = render(model, setup.meshes, surfaces, {}, look, executor);
  lay_behind(picture, camera, plane, executor);
  return picture;
}

}  // namespace

// Far enough that `at` is another point, however far out the eye is.
CameraPlace place_of(const Camera& camera) {
  return {camera.eye, camera.eye + std::max(1.0f, glm::length(camera.eye)) * camera.forward};
}

Picture silhouette_view(const Setup& setup, std::size_t index, const Model& model, const Surfaces& surfaces,
                        std::array<std::uint32_t, 2> room, int samples, Executor& executor) {
  RenderSettings look;
  look.width = room[0], look.height = room[1];
  look.samples = samples;
  const SceneSilhouette& silhouette = setup.scene.silhouettes[index];
  return silhouette.shadow ? shadow_view(setup, index, model, surfaces, look, executor)
                           : camera_view(setup, silhouette, model, surfaces, look, executor);
}

}  // namespace espalier
