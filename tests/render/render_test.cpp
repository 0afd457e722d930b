#include "render/render.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/hash.h"
#include "render/test_scenes.h"

namespace espalier {
namespace {

TEST(Render, IsTheSameBytesForAnyNumberOfThreads) {
  const std::vector<Mesh> ghosts = {moved_primitive(MeshKind::sphere, Vec3(0), Vec3(3, 1, 3))};
  const Picture serial = picture_of(small_ship(), ghosts);
  const auto one = make_tbb_executor(1), two = make_tbb_executor(2), five = make_thread_executor(5);
  for (Executor* executor : {one.get(), two.get(), five.get()}) {
    const Picture other =
        render(small_ship(), primitive_table(), test_materials(), ghosts, small_settings(), *executor);
    EXPECT_EQ(other.rgb, serial.rgb) << executor->workers();
  }
}

// Pictures are promised to be the same on every machine. Change the hash when a picture is meant to change.
TEST(Render, IsTheSameBytesOnEveryMachine) {
  const Picture p = picture_of(small_ship(), {moved_primitive(MeshKind::sphere, Vec3(0), Vec3(3, 1, 3))});
  EXPECT_EQ(content_hash({reinterpret_cast<const char*>(p.rgb.data()), p.rgb.size()}),
            "240175511a0200f54a6ecad305d33a32");
}

TEST(Render, ManyPartsInOnePlaceAreOnePart) {
  Model once = small_ship(), often = small_ship();
  std::erase_if(once.instances, [](const Instance& i) { return i.material == 2; });  // glass adds up
  often.instances.clear();
  for (int i = 0; i < 500; ++i)
    often.instances.insert(often.instances.end(), once.instances.begin(), once.instances.end());
  EXPECT_EQ(picture_of(often, {}).rgb, picture_of(once, {}).rgb);
}

struct Extent {
  double x = 0, y = 0;  // centroid of what differs
  std::uint32_t left = ~0u, right = 0, top = ~0u, bottom = 0;
  std::size_t count = 0;
};

Extent extent_of_difference(const Picture& a, const Picture& b, int least) {
  Extent e;
  for (std::uint32_t y = 0; y < a.height; ++y) {
    for (std::uint32_t x = 0; x < a.width; ++x) {
      if (difference(a, b, x, y) < least) continue;
      e.x += x, e.y += y, ++e.count;
      e.left = std::min(e.left, x), e.right = std::max(e.right, x);
      e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
    }
  }
  if (e.count > 0) e.x /= static_cast<double>(e.count), e.y /= static_cast<double>(e.count);
  return e;
}

TEST(Render, FramesWhatItIsGiven) {
  RenderSettings settings = small_settings();
  for (const float azimuth : {0.0f, 35.0f, 160.0f, 290.0f}) {
    for (const float elevation : {5.0f, 22.0f, 80.0f}) {
      settings.azimuth_deg = azimuth, settings.elevation_deg = elevation;
      const Picture empty = picture_of({}, {}, settings);
      Model model = small_ship();
      for (Instance& i : model.instances) i.material = 1;  // stands out from any shadow
      const Picture picture = picture_of(model, {}, settings);
      Extent e;
      for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
          const std::uint8_t* p = pixel(picture, x, y);
          if (p[0] < p[1] + 30) continue;  // red
          e.x += x, e.y += y, ++e.count;
          e.left = std::min(e.left, x), e.right = std::max(e.right, x);
          e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
        }
      }
      ASSERT_GT(e.count, 1200u) << azimuth << " " << elevation;
      EXPECT_NEAR(e.x / static_cast<double>(e.count), 80, 16) << azimuth << " " << elevation;
      EXPECT_NEAR(e.y / static_cast<double>(e.count), 60, 12) << azimuth << " " << elevation;
      EXPECT_GE(e.left, 8u);
      EXPECT_LE(e.right, 151u);
      EXPECT_GE(e.top, 6u);
      EXPECT_LE(e.bottom, 113u);
      // It fills the frame one way or the other.
      EXPECT_TRUE(e.right - e.left > 125 || e.bottom - e.top > 90) << azimuth << " " << elevation;
    }
  }
}

TEST(Render, ASizeOrPlaceOfTheWholeDoesNotShow) {
  const Picture plain = picture_of(small_ship());
  Model far = small_ship();
  for (Instance& i : far.instances) {
    i.model_from_mesh.basis *= 1024.0f;
    i.model_from_mesh.origin = i.model_from_mesh.origin * 1024.0f + Vec3(4096, 0, -8192);
  }
  const Picture moved = picture_of(far);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < plain.rgb.size(); ++i) changed += std::abs(plain.rgb[i] - moved.rgb[i]) > 3;
  EXPECT_LT(changed, plain.rgb.size() / 200);
}

TEST(Render, GhostsTintButLetTheModelThrough) {
  Model model;
  model.instances = {part(MeshKind::box, {-0.6f, 0, 0}), part(MeshKind::box, {0.6f, 0, 0}, Mat3(1), 1)};
  RenderSettings settings = small_settings();
  settings.azimuth_deg = 0;
  const Mesh ghost = moved_primitive(MeshKind::sphere, Vec3(0), Vec3(4, 3, 4));
  const Picture bare = picture_of(model, {moved_primitive(MeshKind::quad, Vec3(0, 0, -50), Vec3(1e-3f))}, settings);
  const Picture veiled = picture_of(model, {ghost}, settings);
  EXPECT_GT(extent_of_difference(bare, veiled, 8).count, 5000u);
  // Left of the middle the grey box, right of it the red one: still told apart, both bluer than red allows.
  const std::uint8_t *grey = pixel(veiled, 66, 60), *red = pixel(veiled, 94, 60);
  EXPECT_GT(red[0] - red[1], 40);
  EXPECT_GT(grey[1] - red[1], 60);
  EXPECT_GT(grey[2], grey[0] + 10);
}

TEST(Render, GhostFacesThatCoincideWithTheModelDoNotFlicker) {
  Model model;
  model.instances = {part(MeshKind::box, Vec3(0), scaling(2, 1, 1))};
  RenderSettings settings = small_settings();
  settings.azimuth_deg = 0;
  settings.elevation_deg = 0;
  const Picture picture = picture_of(model, {moved_primitive(MeshKind::box, Vec3(0), Vec3(2, 1, 1))}, settings);
  for (std::uint32_t y = 50; y < 70; ++y) {
    for (std::uint32_t x = 50; x < 110; ++x) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_LE(std::abs(pixel(picture, x, y)[c] - pixel(picture, x + 1, y)[c]), 4) << x << " " << y;
      }
    }
  }
}

TEST(Render, FacesOfTwoPartsThatCoincideShowTheFirst) {
  Model grey, both;
  grey.instances = {part(MeshKind::box, Vec3(0), scaling(2, 1, 1))};
  both.instances = {grey.instances[0], part(MeshKind::box, Vec3(0), scaling(1.2f, 1, 1), 1)};
  const Picture one = picture_of(grey), two = picture_of(both);
  EXPECT_EQ(extent_of_difference(one, two, 12).count, 0u);
}

TEST(Render, GlassShowsWhatIsBehind) {
  Model model;
  model.instances = {part(MeshKind::box, Vec3(0), scaling(1, 1, 0.2f), 1),
                     part(MeshKind::box, Vec3(0, 0, 1), scaling(2, 2, 0.1f), 2)};
  RenderSettings settings = small_settings();
  settings.azimuth_deg = 0;
  settings.elevation_deg = 0;
  const Picture glass = picture_of(model, {}, settings);
  EXPECT_GT(pixel(glass, 80, 60)[0], pixel(glass, 80, 60)[1] + 20) << "the red box behind";
  model.instances[1].material = 0;
  const Picture wall = picture_of(model, {}, settings);
  EXPECT_NEAR(pixel(wall, 80, 60)[0], pixel(wall, 80, 60)[1], 12);
}

TEST(Render, SurfacesTurnedFromTheLightAreDarkerButNotBlack) {
  Model model;
  model.instances = {part(MeshKind::sphere, Vec3(0))};
  const Picture picture = picture_of(model);
  const int lit = pixel(picture, 72, 45)[1], shaded = pixel(picture, 98, 85)[1];
  EXPECT_GT(lit, shaded + 30);
  EXPECT_GT(shaded, 30);
  EXPECT_LT(lit, 254);
}

TEST(Render, TheGroundIsDarkerBelowTheModel) {
  Model model;
  model.instances = {part(MeshKind::sphere, Vec3(0))};
  const Picture with = picture_of(model), without = picture_of({});
  int darkest = 0;
  for (std::uint32_t y = 60; y < 120; ++y) {  // beside the sphere, away from the light
    for (std::uint32_t x = 135; x < 160; ++x)
      darkest = std::max(darkest, pixel(without, x, y)[1] - pixel(with, x, y)[1]);
  }
  EXPECT_GT(darkest, 25);
}

TEST(Render, EmptyModelsGiveAnEmptyStage) {
  const Picture picture = picture_of({});
  ASSERT_EQ(picture.rgb.size(), 3u * 160 * 120);
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    for (std::uint32_t x = 0; x + 1 < picture.width; ++x) {
      EXPECT_GT(pixel(picture, x, y)[0], 120);
      EXPECT_LE(std::abs(pixel(picture, x, y)[0] - pixel(picture, x + 1, y)[0]), 4);
    }
  }
}

TEST(Render, ShowsTheLayersAskedFor) {
  Model model;
  model.instances = {part(MeshKind::box, Vec3(0)), part(MeshKind::box, Vec3(2, 0, 0), Mat3(1), 1)};
  model.instances[1].layer = Layer::detail;
  RenderSettings settings = small_settings();
  const auto reds = [&] {
    const Picture p = picture_of(model, {}, settings);
    std::size_t n = 0;
    for (std::size_t i = 0; i < p.rgb.size(); i += 3) n += p.rgb[i] > p.rgb[i + 1] + 40;
    return n;
  };
  EXPECT_GT(reds(), 500u);
  settings.full = false;
  EXPECT_EQ(reds(), 0u);
}

TEST(Render, SurvivesDegenerateModels) {
  for (const float s : {0.0f, 1e-30f, 1e-9f, 1e9f, 1e17f, 1e30f, INFINITY, NAN}) {
    for (const Mat3& basis : {scaling(s, 1, 1), scaling(s, s, 1), scaling(s, s, s), Mat3(s, s, s, s, s, s, s, s, s)}) {
      Model model;
      for (int kind = 0; kind < static_cast<int>(MeshKind::file); ++kind) {
        model.instances.push_back(part(static_cast<MeshKind>(kind), Vec3(static_cast<float>(kind), 0, 0), basis, 2));
        model.instances.push_back(part(static_cast<MeshKind>(kind), Vec3(s), Mat3(1)));
        model.instances.back().top = s;
      }
      RenderSettings settings = small_settings();
      settings.width = 40, settings.height = 30, settings.samples = 2;
      Mesh broken = make_primitive(MeshKind::box, 1, 3);
      for (Vec3& p : broken.positions) p *= s;
      EXPECT_EQ(picture_of(model, {broken}, settings).rgb.size(), 3600u) << s;
    }
  }
}

TEST(Render, TakesAnySizeOfPicture) {
  for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 50u}, {200u, 2u}}) {
    RenderSettings settings = small_settings();
    settings.width = width, settings.height = height, settings.samples = 0;
    EXPECT_EQ(picture_of(small_ship(), {}, settings).rgb.size(), std::size_t{3} * width * height);
  }
}

}  // namespace
}  // namespace espalier
