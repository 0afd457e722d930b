#include "run/scene_silhouettes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/math.h"
#include "run/scene_choices.h"
#include "run/toml_section.h"

namespace espalier {
namespace {

constexpr float kFarthest = 1e6f;
constexpr double kMostWeight = 1e6;

DVec3 wide(const Vec3& v) { return {v.x, v.y, v.z}; }

/// From `at` towards a camera: azimuth 0 looks from +z, 90 degrees from +x; elevation upwards.
Vec3 towards_camera(double azimuth_deg, double elevation_deg) {
  const auto radians = [](double degrees) { return static_cast<float>(degrees * (kPi / 180)); };
  const float flat = cosine(radians(elevation_deg));
  return {flat * sine(radians(azimuth_deg)), sine(radians(elevation_deg)), flat * cosine(radians(azimuth_deg))};
}

SceneCamera read_camera(const TomlValue& table, const std::string& file, const std::string& path) {
  TomlSection s(table, file, path);
  SceneCamera camera;
  camera.fit = s.boolean("fit").value_or(false);
  const auto azimuth = s.number("azimuth_deg", -3600, 3600), elevation = s.number("elevation_deg", -90, 90);
  const auto distance = s.number("distance", 1e-6, kFarthest);
  const auto eye = s.vector("eye", -kFarthest, kFarthest), at = s.vector("at", -kFarthest, kFarthest);
  take(camera.up, s.vector("up", -kFarthest, kFarthest));
  take(camera.fov_deg, s.number("fov_deg", 0.01, 179));
  take(camera.near, s.number("near", 1e-6, kFarthest));
  camera.tall = s.number("tall", 1e-6, kFarthest);
  take(camera.azimuth_deg, azimuth);
  take(camera.elevation_deg, elevation);
  if (at) camera.at = *at;
  if (eye && (distance || camera.fit)) s.fail("eye", "must not stand beside distance or fit: those place the camera");
  if (!camera.fit && !eye && !distance) s.fail("", "must have eye, or distance with azimuth_deg, or fit = true");
  if (eye) camera.eye = *eye;
  if (distance)
    camera.eye = camera.at + static_cast<float>(*distance) * towards_camera(camera.azimuth_deg, camera.elevation_deg);
  if (!camera.fit) camera.azimuth_deg = camera.elevation_deg = 0;  // told by `eye` from here on
  s.finish();
  return camera;
}

SceneShadow read_shadow(const TomlValue& table, const std::string& file, const std::string& path) {
  TomlSection s(table, file, path);
  SceneShadow shadow;
  const auto sun = s.vector("sun", -kFarthest, kFarthest), lamp = s.vector("lamp", -kFarthest, kFarthest);
  if (sun.has_value() == lamp.has_value())
    s.fail("", "must have either sun (where its light goes) or lamp (where it is)");
  shadow.lamp = lamp.has_value();
  shadow.light = lamp ? *lamp : *sun;
  take(shadow.centre, s.vector("centre", -kFarthest, kFarthest));
  take(shadow.normal, s.vector("normal", -kFarthest, kFarthest));
  take(shadow.up, s.vector("up", -kFarthest, kFarthest));
  take(shadow.tall, s.number("tall", 1e-6, kFarthest));
  s.finish();
  return shadow;
}

std::string camera_text(const SceneCamera& c) {
  std::string text = "\n[silhouette.camera]\n";
  if (c.fit) {
    text += fmt::format("fit = true\nazimuth_deg = {}\nelevation_deg = {}\n", format_toml(c.azimuth_deg),
                        format_toml(c.elevation_deg));
  } else {
    text += fmt::format("eye = {}\nat = {}\n", format_vector(c.eye), format_vector(c.at));
  }
  text += fmt::format("up = {}\nfov_deg = {}\nnear = {}\n", format_vector(c.up), format_toml(c.fov_deg),
                      format_toml(c.near));
  if (c.tall) text += fmt::format("tall = {}\n", format_toml(*c.tall));
  return text;
}

/// One image, or one of what is wanted, one of what is avoided, or both of these.
void read_images(TomlSection& s, SceneSilhouette& out) {
  struct Key {
    const char* name;
    std::string SceneSilhouette::*path;
  };
  for (const Key& key : {Key{"image", &SceneSilhouette::image}, Key{"want_image", &SceneSilhouette::want_image},
                         Key{"avoid_image", &SceneSilhouette::avoid_image}}) {
    const auto path = s.text(key.name);
    if (path && path->empty()) s.fail(key.name, "must be the path of a PNG, JPG or PFM image, got \"\"");
    if (path) out.*key.path = *path;
  }
  const bool apart = !out.want_image.empty() || !out.avoid_image.empty();
  if (out.image.empty() && !apart)
    s.fail("image", "must be the path of a PNG, JPG or PFM image, or want_image and avoid_image must be given");
  if (!out.image.empty() && apart) s.fail("image", "must not stand beside want_image or avoid_image");
}

std::string images_text(const SceneSilhouette& s) {
  std::string text;
  if (!s.image.empty()) text += fmt::format("image = {}\n", quote_toml(s.image));
  if (!s.want_image.empty()) text += fmt::format("want_image = {}\n", quote_toml(s.want_image));
  if (!s.avoid_image.empty()) text += fmt::format("avoid_image = {}\n", quote_toml(s.avoid_image));
  return text;
}

}  // namespace

SceneSilhouette read_silhouette(const TomlValue& table, const std::string& file, std::size_t index) {
  const std::string path = fmt::format("silhouette.{}", index);
  TomlSection s(table, file, path);
  SceneSilhouette out;
  read_images(s, out);
  if (const auto size = s.wholes("size", 2, 1, Projection::kMostPixels))
    out.size = {static_cast<std::uint32_t>((*size)[0]), static_cast<std::uint32_t>((*size)[1])};
  take(out.form, s.choice("form", kSilhouetteForms));
  take(out.view, s.choice("view", kVolumeViews));
  take(out.want, s.number("want", 0, kMostWeight));
  take(out.avoid, s.number("avoid", 0, kMostWeight));
  take(out.weight, s.number("weight", 0, kMostWeight));
  const TomlValue* camera = s.table("camera");
  const TomlValue* shadow = s.table("shadow");
  if (camera && shadow) s.fail("shadow", fmt::format("must not stand beside {}.camera", path));
  if (camera) out.camera = read_camera(*camera, file, path + ".camera");
  if (shadow) out.shadow = read_shadow(*shadow, file, path + ".shadow");
  s.finish();
  return out;
}

std::string silhouette_to_toml(const SceneSilhouette& s) {
  std::string text =
      fmt::format("[[silhouette]]\n{}form = \"{}\"\nview = \"{}\"\nwant = {}\navoid = {}\nweight = {}\n",
                  images_text(s), word_for(kSilhouetteForms, s.form), word_for(kVolumeViews, s.view),
                  format_toml(s.want), format_toml(s.avoid), format_toml(s.weight));
  if (s.size) text += fmt::format("size = [{}, {}]\n", (*s.size)[0], (*s.size)[1]);
  if (!s.shadow) return text + camera_text(s.camera);
  const SceneShadow& w = *s.shadow;
  return text + fmt::format("\n[silhouette.shadow]\n{} = {}\ncentre = {}\nnormal = {}\nup = {}\ntall = {}\n",
                            w.lamp ? "lamp" : "sun", format_vector(w.light), format_vector(w.centre),
                            format_vector(w.normal), format_vector(w.up), format_toml(w.tall));
}

// As near as it can with the sphere around the box in the picture, and a tenth left free.
void settle_camera(SceneSilhouette& silhouette, const Bounds& box) {
  SceneCamera& c = silhouette.camera;
  if (!c.fit || silhouette.shadow || box.empty()) return;
  const Vec3 size = box.size();
  const float radius = 0.5f * std::sqrt(size.x * size.x + size.y * size.y + size.z * size.z);
  const auto half_angle = static_cast<float>(0.5 * c.fov_deg * (kPi / 180));
  const float distance = std::max(1.1f * radius / sine(half_angle), static_cast<float>(2 * c.near));
  c.at = 0.5f * (box.min + box.max);
  c.eye = c.at + distance * towards_camera(c.azimuth_deg, c.elevation_deg);
  c.fit = false;
}

Projection projection_of(const SceneSilhouette& silhouette, std::array<std::uint32_t, 2> size) {
  if (const auto& shadow = silhouette.shadow) {
    const ShadowScreen screen{wide(shadow->centre), wide(shadow->normal), wide(shadow->up), shadow->tall};
    return shadow->lamp ? lamp_shadow(wide(shadow->light), screen, size[0], size[1])
                        : sun_shadow(wide(shadow->light), screen, size[0], size[1]);
  }
  const SceneCamera& c = silhouette.camera;
  const LookAt look{wide(c.eye), wide(c.at), wide(c.up)};
  if (c.tall) return orthographic(look, *c.tall, size[0], size[1]);
  return perspective(look, c.fov_deg, c.near, size[0], size[1]);
}

}  // namespace espalier
