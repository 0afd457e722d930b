#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/random.h"

namespace espalier {
namespace {

TEST(Camera, FramesPointsSnugly) {
  RandomStream random({1, Purpose::test});
  for (int round = 0; round < 50; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 20; ++i) {
      const auto number = [&] { return static_cast<float>(2 * random.next_unit() - 1); };
      const float x = number(), y = number(), z = number();
      points.emplace_back(x, 0.5f * y, z);
    }
    const float azimuth = static_cast<float>(360 * random.next_unit());
    const float elevation = static_cast<float>(180 * random.next_unit() - 90);
    const Camera camera = frame_points(points, azimuth, elevation, 400, 300, 0.1f);
    float widest = 0, tallest = 0;
    for (const Vec3& p : points) {
      const Vec3 seen = p - camera.eye;
      const float ahead = glm::dot(seen, camera.forward);
      ASSERT_GT(ahead, 0);
      widest = std::max(widest, std::abs(glm::dot(seen, camera.right)) / (ahead * camera.tan_x));
      tallest = std::max(tallest, std::abs(glm::dot(seen, camera.up)) / (ahead * camera.tan_y));
    }
    EXPECT_LE(widest, 0.8f + 1e-4f);
    EXPECT_LE(tallest, 0.8f + 1e-4f);
    EXPECT_NEAR(std::max(widest, tallest), 0.8f, 1e-4f);
  }
}

TEST(Camera, StandsWhereItIsAskedTo) {
  const std::vector<Vec3> points = {Vec3(-1), Vec3(1)};
  EXPECT_GT(frame_points(points, 0, 0, 4, 3, 0.1f).eye.z, 2);
  EXPECT_GT(frame_points(points, 90, 0, 4, 3, 0.1f).eye.x, 2);
  EXPECT_GT(frame_points(points, 0, 60, 4, 3, 0.1f).eye.y, 2);
}

TEST(Camera, LooksThroughThePicture) {
  const Camera camera = frame_points({}, 0, 0, 400, 300, 0.1f);
  EXPECT_NEAR(glm::distance(camera.direction(0, 0), Vec3(0, 0, -1)), 0, 1e-6);
  EXPECT_GT(camera.direction(1, 0).x, 0.1f);
  EXPECT_GT(camera.direction(0, 1).y, 0.1f);
}

}  // namespace
}  // namespace espalier
