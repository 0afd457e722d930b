#include <cmath>

#include <gtest/gtest.h>

#include "base/hash.h"
#include "render/test_scenes.h"

namespace espalier {
namespace {

std::vector<Picture> turntable_of(const Model& model, const RenderSettings& settings, const Turntable& turntable,
                                  Executor& executor, const std::vector<Mesh>& ghosts = {}) {
  std::vector<Picture> frames;
  render_turntable(model, primitive_table(), test_materials(), ghosts, settings, turntable, executor,
                   [&](std::uint32_t frame, Picture picture) {
                     EXPECT_EQ(frame, turntable.only.value_or(static_cast<std::uint32_t>(frames.size())));
                     frames.push_back(std::move(picture));
                   });
  return frames;
}

std::vector<Picture> turntable_of(const Model& model, const RenderSettings& settings, const Turntable& turntable) {
  return turntable_of(model, settings, turntable, *make_serial_executor());
}

/// The share of bytes that differ by more than `most`.
double changed(const Picture& a, const Picture& b, int most) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) count += std::abs(a.rgb[i] - b.rgb[i]) > most;
  return static_cast<double>(count) / static_cast<double>(a.rgb.size());
}

TEST(Turntable, IsTheSameBytesForAnyNumberOfThreads) {
  const std::vector<Mesh> ghosts = {moved_primitive(MeshKind::sphere, Vec3(0), Vec3(3, 1, 3))};
  RenderSettings settings = small_settings();
  settings.transparent = true;
  const auto one = make_serial_executor(), three = make_tbb_executor(3), five = make_thread_executor(5);
  const std::vector<Picture> serial = turntable_of(small_ship(), settings, {4}, *one, ghosts);
  for (Executor* executor : {three.get(), five.get()}) {
    const std::vector<Picture> other = turntable_of(small_ship(), settings, {4}, *executor, ghosts);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(other[k].rgb, serial[k].rgb);
      EXPECT_EQ(other[k].alpha, serial[k].alpha);
    }
  }
  Turntable third{4};
  third.only = 2;
  EXPECT_EQ(turntable_of(small_ship(), settings, third, *three, ghosts).at(0).rgb, serial[2].rgb);
}

// Pictures are promised to be the same on every machine. Change the hash when a picture is meant to change.
TEST(Turntable, IsTheSameBytesOnEveryMachine) {
  std::string all;
  for (const Picture& p : turntable_of(small_ship(), small_settings(), {3}))
    all.append(reinterpret_cast<const char*>(p.rgb.data()), p.rgb.size());
  EXPECT_EQ(content_hash(all), "abd158f5625afed23a9e4e77343ebee5");
}

TEST(Turntable, ShowsTheModelWholeAtOneSizeFromAllSides) {
  Model model = small_ship();
  for (Instance& i : model.instances) i.material = 1, i.model_from_mesh.origin += Vec3(5, 2, -3);
  for (const float elevation : {0.0f, 22.0f, 70.0f}) {
    RenderSettings settings = small_settings();
    settings.elevation_deg = elevation;
    std::uint32_t widest = 0;
    for (const Picture& p : turntable_of(model, settings, {12})) {
      std::uint32_t left = ~0u, right = 0, count = 0;
      for (std::uint32_t y = 0; y < p.height; ++y) {
        for (std::uint32_t x = 0; x < p.width; ++x) {
          if (pixel(p, x, y)[0] < pixel(p, x, y)[1] + 30) continue;  // red
          ASSERT_TRUE(x >= 8 && x < 152 && y >= 6 && y < 114) << x << " " << y << " at " << elevation;
          left = std::min(left, x), right = std::max(right, x), ++count;
        }
      }
      ASSERT_GT(count, 300u);
      widest = std::max(widest, right - left);
    }
    EXPECT_GT(widest, 80u) << elevation;
  }
}

TEST(Turntable, GoesRoundThePlaceThatThePlacedCameraLooksAt) {
  RenderSettings settings = small_settings();
  settings.place = CameraPlace{{0, 1, 6}, Vec3(0, 0, 0)};
  const std::vector<Picture> frames = turntable_of(small_ship(), settings, {4});
  const Vec3 eyes[] = {{0, 1, 6}, {6, 1, 0}, {0, 1, -6}, {-6, 1, 0}};
  for (std::size_t k = 0; k < 4; ++k) {
    settings.place->eye = eyes[k];
    EXPECT_LT(changed(frames[k], picture_of(small_ship(), {}, settings), 3), 0.005) << k;
  }
}

TEST(Turntable, TheLightStaysWithTheCameraOrWithTheModel) {
  Model model;
  model.instances = {part(MeshKind::sphere, Vec3(0))};
  const std::vector<Picture> turned = turntable_of(model, small_settings(), {2});
  EXPECT_LT(changed(turned[0], turned[1], 6), 0.02);
  const std::vector<Picture> fixed = turntable_of(model, small_settings(), {2, true});
  EXPECT_EQ(fixed[0].rgb, turned[0].rgb);
  EXPECT_GT(pixel(fixed[0], 70, 45)[1], pixel(fixed[1], 70, 45)[1] + 30);
}

TEST(Strip, PutsFramesSideBySide) {
  std::vector<Picture> frames;
  for (std::uint8_t k = 0; k < 5; ++k) frames.push_back({3, 2, std::vector<std::uint8_t>(18, k)});
  Picture strip = empty_strip(5, frames[0], 3);
  for (std::size_t k = 0; k < 5; ++k) paste_frame(strip, frames[k], k, 3);
  ASSERT_EQ(strip.width, 9u);
  ASSERT_EQ(strip.height, 4u);
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 9; ++x) {
      const std::uint32_t k = x / 3 + 3 * (y / 2);
      EXPECT_EQ(pixel(strip, x, y)[0], k < 5 ? k : 0) << x << " " << y;
    }
  }
  EXPECT_TRUE(strip.alpha.empty());
  frames[0].alpha.assign(6, 255);
  Picture clear = empty_strip(2, frames[0], 1);
  paste_frame(clear, frames[0], 1, 1);
  EXPECT_EQ(clear.alpha, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255}));
}

TEST(Strip, ColumnsFillTheSheet) {
  EXPECT_EQ(strip_columns(1, 4, 3), 1u);
  EXPECT_EQ(strip_columns(4, 4, 3), 2u);
  EXPECT_EQ(strip_columns(8, 4, 3), 4u);
  EXPECT_EQ(strip_columns(12, 4, 3), 4u);
  EXPECT_EQ(strip_columns(36, 4, 3), 6u);
  EXPECT_EQ(strip_columns(3, 100, 300), 3u);
}

}  // namespace
}  // namespace espalier
