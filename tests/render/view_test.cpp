// Cameras that are placed, parallel rays, backgrounds and transparency.

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "base/math.h"
#include "model/srgb.h"
#include "render/bone_model.h"
#include "render/camera.h"
#include "render/coverage.h"
#include "render/ground_shade.h"
#include "render/set.h"
#include "render/test_scenes.h"

namespace espalier {
namespace {

double linear(std::uint8_t byte) {
  const double x = byte / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// Left, right, top and bottom of what is red.
struct Reds {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
  explicit Reds(const Picture& p) {
    for (int y = 0; y < static_cast<int>(p.height); ++y) {
      for (int x = 0; x < static_cast<int>(p.width); ++x) {
        const std::uint8_t* rgb = pixel(p, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
        if (rgb[0] < rgb[1] + 40) continue;
        left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
      }
    }
  }
};

Model red_box(const Vec3& at, const Vec3& size) {
  Model model;
  model.instances = {part(MeshKind::box, at, scaling(size.x, size.y, size.z), 1)};
  return model;
}

TEST(View, PlacedCamerasSeeMetres) {
  // A square of 2 m seen from 10 m with 2 * atan(1 / 5) across fills half of the picture's height.
  RenderSettings settings = small_settings();
  settings.place = CameraPlace{{100, 50, 10.01f}, Vec3(100, 50, 0)};
  settings.fov_deg = static_cast<float>(2 * std::atan(0.2) * 180 / kPi);
  const Reds seen(picture_of(red_box({100, 50, 0}, {2, 2, 0.02f}), {}, settings));
  EXPECT_NEAR(seen.top, 30, 1);
  EXPECT_NEAR(seen.bottom, 89, 1);
  EXPECT_NEAR(seen.left, 50, 1);
  EXPECT_NEAR(seen.right, 109, 1);
}

TEST(View, ParallelRaysKeepSizesWhateverTheDistance) {
  RenderSettings settings = small_settings();
  settings.tall = 4;
  settings.azimuth_deg = settings.elevation_deg = 0;
  const Reds orbit(picture_of(red_box({7, 0, 0}, {2, 1, 5}), {}, settings));
  settings.place = CameraPlace{{7, 0, 1e5f}, Vec3(7, 0, 0)};
  const Reds far(picture_of(red_box({7, 0, 0}, {2, 1, 5}), {}, settings));
  settings.place = CameraPlace{{7, 0, 1}, Vec3(7, 0, 0)};  // within the box
  const Reds within(picture_of(red_box({7, 0, 0}, {2, 1, 5}), {}, settings));
  for (const Reds& seen : {orbit, far, within}) {
    EXPECT_NEAR(seen.bottom - seen.top + 1, 30, 1);
    EXPECT_NEAR(seen.right - seen.left + 1, 60, 1);
    EXPECT_NEAR(seen.left + seen.right, 159, 1);
  }
}

TEST(View, FarPinholesSeeWhatParallelRaysSee) {
  RenderSettings settings = small_settings();
  settings.place = CameraPlace{{300, 400, 900}, Vec3(0)};
  settings.tall = 5;
  const Picture parallel = picture_of(small_ship(), {}, settings);
  settings.tall.reset();
  settings.fov_deg = static_cast<float>(5 / std::sqrt(300.0 * 300 + 400 * 400 + 900 * 900) * 180 / kPi);
  const Picture pinhole = picture_of(small_ship(), {}, settings);
  std::size_t changed = 0;
  for (std::uint32_t y = 0; y < 120; ++y) {
    for (std::uint32_t x = 0; x < 160; ++x) changed += difference(parallel, pinhole, x, y) > 12;
  }
  EXPECT_LT(changed, 160u * 120 / 50);
}

TEST(View, PlansLookStraightDown) {
  RenderSettings settings = small_settings();
  settings.azimuth_deg = 0;
  settings.elevation_deg = 90;
  Model model = red_box({0, 0, 0}, {1, 1, 1});
  model.instances.push_back(part(MeshKind::box, {0, -0.4f, -2}, scaling(1, 0.2f, 1)));  // towards -z: above
  const Reds seen(picture_of(model, {}, settings));
  EXPECT_GT(seen.top, 60);
  EXPECT_NEAR(seen.left + seen.right, 159, 2);
}

TEST(View, PicturePointsAreWhereRaysGo) {
  const Lens pinhole = lens_of_angle(50, 160, 120), parallel = parallel_lens(2, 160, 120);
  for (const Lens& lens : {pinhole, parallel}) {
    for (const Vec3& eye : {Vec3(1, 2, 3), Vec3(0, 5, 0), Vec3(0, -5, 0), Vec3(400, 30, -20)}) {
      const Camera camera = placed_camera(eye, glm::dvec3(Vec3(0.1f, 0, -0.2f)) - glm::dvec3(eye), lens);
      EXPECT_NEAR(glm::length(camera.up), 1, 1e-5);
      for (const Vec2& point : {Vec2(0, 0), Vec2(0.7f, -0.3f), Vec2(-1, 1)}) {
        const Vec3 seen = camera.picture_point(camera.ray(point.x, point.y).at(3));
        EXPECT_NEAR(seen.x, point.x, 1e-3);
        EXPECT_NEAR(seen.y, point.y, 1e-3);
        EXPECT_GT(seen.z, 0);
      }
    }
  }
}

TEST(View, BackgroundsAreTheColourAskedFor) {
  RenderSettings settings = small_settings();
  for (const int byte : {0, 1, 100, 200, 255}) {
    const float level = static_cast<float>(linear(static_cast<std::uint8_t>(byte)));
    settings.background = Vec3(level, 0, 1);
    settings.ground = false;
    const Picture picture = picture_of(small_ship(), {}, settings);
    EXPECT_NEAR(pixel(picture, 2, 117)[0], byte, 1);
    EXPECT_EQ(pixel(picture, 2, 117)[1], 0);
    EXPECT_EQ(pixel(picture, 2, 117)[2], 255);
  }
}

// Laying the transparent picture on a colour gives the picture with that background: what alpha means.
TEST(View, TransparentPicturesLieOnAnyBackground) {
  const std::vector<Mesh> ghosts = {moved_primitive(MeshKind::sphere, Vec3(0), Vec3(3, 1, 3))};
  for (const bool ground : {true, false}) {
    for (const std::vector<Mesh>& shells : {std::vector<Mesh>{}, ghosts}) {
      RenderSettings settings = small_settings();
      settings.ground = ground;
      settings.samples = 64;
      settings.background = Vec3(0.2f, 0.4f, 0.6f);
      const Picture whole = picture_of(small_ship(), shells, settings);
      settings.background.reset();
      settings.transparent = true;
      const Picture clear = picture_of(small_ship(), shells, settings);
      ASSERT_EQ(clear.alpha.size(), 160u * 120);
      std::size_t off = 0, open = 0, between = 0, solid = 0;
      for (std::size_t i = 0; i < clear.alpha.size(); ++i) {
        const double alpha = clear.alpha[i] / 255.0;
        open += clear.alpha[i] == 0, solid += clear.alpha[i] == 255;
        between += clear.alpha[i] > 0 && clear.alpha[i] < 255;
        for (std::size_t c = 0; c < 3; ++c) {
          const double laid = alpha * linear(clear.rgb[3 * i + c]) + (1 - alpha) * 0.2 * static_cast<double>(c + 1);
          off += std::abs(255 * srgb_from_linear(laid) - whole.rgb[3 * i + c]) > 12;
        }
      }
      EXPECT_LT(off, clear.rgb.size() / 40) << ground << shells.size();
      EXPECT_GT(open, 500u);
      EXPECT_GT(solid, 500u);
      EXPECT_GT(between, ground ? 2000u : 200u);
    }
  }
}

TEST(View, WithoutGroundThereIsNoShadow) {
  RenderSettings settings = small_settings();
  settings.ground = false;
  Model model;
  model.instances = {part(MeshKind::sphere, Vec3(0))};
  const Picture with = picture_of(model, {}, settings), without = picture_of({}, {}, settings);
  for (std::uint32_t y = 0; y < 120; ++y) {
    for (std::uint32_t x = 140; x < 160; ++x) EXPECT_EQ(difference(with, without, x, y), 0);
  }
}

TEST(View, PartsAHairApartLookLikeOne) {
  Model once = small_ship(), often = small_ship();
  std::erase_if(once.instances, [](const Instance& i) { return i.material == 2; });  // glass adds up
  often.instances.clear();
  for (int i = 0; i < 300; ++i) {
    for (Instance instance : once.instances) {
      instance.model_from_mesh.origin += Vec3(1e-7f * static_cast<float>(i));
      often.instances.push_back(instance);
    }
  }
  const Picture one = picture_of(once), many = picture_of(often);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < one.rgb.size(); ++i) changed += std::abs(one.rgb[i] - many.rgb[i]) > 8;
  EXPECT_LT(changed, one.rgb.size() / 500);
}

TEST(Coverage, NoRayOutsideMeetsAPart) {
  const Set set = build_set(small_ship(), primitive_table(), test_materials(), {}, true);
  std::size_t outside = 0, inside = 0;
  for (const Vec3& eye : {Vec3(2, 1, 3), Vec3(0.3f, 0.1f, 0.2f), Vec3(-20, 4, 1)}) {
    for (const Lens& lens : {lens_of_angle(eye.x < -5 ? 8 : 60, 160, 120), parallel_lens(3, 160, 120)}) {
      const Camera camera = placed_camera(eye, -glm::dvec3(eye), lens);
      Coverage coverage(camera, 160, 120);
      coverage.add(set.opaque), coverage.add(set.translucent);
      for (std::uint32_t y = 0; y < 120; ++y) {
        for (std::uint32_t x = 0; x < 160; ++x) {
          if (coverage.may_show(x, y)) {
            ++inside;
            continue;
          }
          ++outside;
          for (const Vec2& at : {Vec2(0, 0), Vec2(0.5f, 0.5f), Vec2(1, 1)}) {
            const Ray ray = camera.ray(2 * (static_cast<float>(x) + at.x) / 160 - 1,
                                       1 - 2 * (static_cast<float>(y) + at.y) / 120);
            ASSERT_FALSE(set.opaque.intersect(ray)) << x << " " << y;
            ASSERT_FALSE(set.translucent.intersect(ray)) << x << " " << y;
          }
        }
      }
    }
  }
  EXPECT_GT(outside, 10'000u);
  EXPECT_GT(inside, 10'000u);
}

TEST(GroundShade, HidesNothingOutside) {
  const Set set = build_set(small_ship(), primitive_table(), test_materials(), {}, true);
  std::size_t hidden = 0, open = 0;
  for (const float azimuth : {0.0f, 100.0f, 250.0f}) {
    const Stage stage = make_stage(set.lowest, frame_points(set.corners, azimuth, 20, 4, 3, 0.1f));
    const GroundShade shade(stage, set.opaque);
    for (std::uint32_t i = 0; i < 200 * 200; ++i) {
      const Vec3 p(static_cast<float>(i % 200) * 0.06f - 6, set.lowest, static_cast<float>(i / 200) * 0.06f - 6);
      const Vec3 to_key = in_cone(stage.to_key, kKeySpread, stage.tables->on_light(i));
      const bool blocked = set.opaque.blocks({p + Vec3(0, 4e-4f, 0), to_key, 0}, 1e30f);
      hidden += blocked, open += !shade.may_hide(p);
      ASSERT_TRUE(!blocked || shade.may_hide(p)) << p.x << " " << p.z;
    }
  }
  EXPECT_GT(hidden, 500u);
  EXPECT_GT(open, 60'000u);
}

TEST(BoneModel, ReachesFromJointToJoint) {
  Model model;
  model.bones = {{{0, 0, 0}, {0, 2, 0}, -1, 0}, {{0, 2, 0}, {3, 2, 0}, 0, 1}, {{3, 2, 0}, {3, 2, 0}, 1, 2}};
  const LineDrawing bones = bone_model(model, [](std::uint32_t gene) { return std::size_t{gene}; });
  ASSERT_EQ(bones.model.instances.size(), 4u) << "none for the bone without length";
  const Bounds box = bounds(bones.model, bones.meshes, true);
  EXPECT_NEAR(box.min.y, 0, 1e-5);
  EXPECT_NEAR(box.max.x, 3, 1e-5);
  EXPECT_GT(box.size().z, 0.01f);
  EXPECT_LT(box.size().z, 0.5f);
  EXPECT_NE(bones.model.instances[0].material, bones.model.instances[2].material);
  for (const Instance& i : bones.model.instances) EXPECT_GT(glm::determinant(i.model_from_mesh.basis), 0);
}

}  // namespace
}  // namespace espalier
