#include "score/projection.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "base/error.h"

namespace espalier {
namespace {

void expect_pixel(const Projection& projection, const DVec3& point, double column, double row) {
  const DVec3 p = projection.point(point);
  EXPECT_NEAR(p.x / p.z, column, 1e-9);
  EXPECT_NEAR(p.y / p.z, row, 1e-9);
}

TEST(Projection, APinholeByHand) {
  // 90 degrees: at distance 10 the picture is 20 m high, 5 pixels a metre.
  const Projection p = perspective({{0, 0, 10}, {0, 0, 0}, {0, 1, 0}}, 90, 0.1, 200, 100);
  expect_pixel(p, {0, 0, 0}, 100, 50);
  expect_pixel(p, {2, 0, 0}, 110, 50);
  expect_pixel(p, {0, 2, 0}, 100, 40);
  expect_pixel(p, {1, 0, 5}, 110, 50);
  EXPECT_NEAR(p.point({0, 0, 4}).z, 6, 1e-12) << "W is the distance along the axis";
}

TEST(Projection, ParallelRaysByHand) {
  const Projection p = orthographic({{10, 1, 0}, {0, 1, 0}, {0, 1, 0}}, 4, 80, 40);
  expect_pixel(p, {0, 1, 0}, 40, 20);
  expect_pixel(p, {-7, 2, 0}, 40, 10);
  expect_pixel(p, {3, 1, -1}, 50, 20);  // from +x, -z lies to the right
}

TEST(Projection, ShadowsByHand) {
  ShadowScreen ground;  // y = 0, seen from above with -z up
  const Projection sun = sun_shadow({1, -1, 0}, ground, 100, 100);
  expect_pixel(sun, {0, 0, 0}, 50, 50);
  expect_pixel(sun, {0, 2, 0}, 70, 50);
  expect_pixel(sun, {0, 0, 1}, 50, 60);
  const Projection lamp = lamp_shadow({0, 4, 0}, ground, 100, 100);
  expect_pixel(lamp, {1, 0, 0}, 60, 50);
  expect_pixel(lamp, {1, 2, 0}, 70, 50);  // half-way up it is twice as large
  EXPECT_LT(lamp.point({0, 5, 0}).z, lamp.nearest) << "above the lamp nothing casts a shadow";
}

TEST(Projection, RaysGoThroughTheirPixels) {
  const LookAt look{{3, 4, 5}, {0, 1, 0}, {0, 1, 0}};
  ShadowScreen wall{{0, 2, -3}, {0.2, 0.1, 1}, {0, 1, 0}, 8};
  for (const Projection& p : {perspective(look, 50, 0.3, 64, 48), orthographic(look, 5, 64, 48),
                              sun_shadow({0.3, -1, -2}, wall, 64, 48), lamp_shadow({1, 3, 6}, wall, 64, 48)}) {
    for (const auto& [column, row] : {std::pair(0.5, 0.5), std::pair(31.25, 17.0), std::pair(63.5, 47.5)}) {
      const PixelRay ray = ray_through(p, column, row);
      for (const double t : {0.5, 2.0, 7.0}) expect_pixel(p, ray.origin + t * ray.direction, column, row);
      if (std::isfinite(ray.least)) {
        EXPECT_NEAR(p.point(ray.origin + ray.least * ray.direction).z, p.nearest, 1e-9);
      }
    }
  }
}

TEST(Projection, RefusesWhatSeesNothing) {
  const LookAt look;
  EXPECT_THROW(perspective(look, 0, 0.1, 10, 10), Error);
  EXPECT_THROW(perspective(look, 180, 0.1, 10, 10), Error);
  EXPECT_THROW(perspective(look, 40, 0, 10, 10), Error);
  EXPECT_THROW(perspective({{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}, 40, 0.1, 10, 10), Error);
  EXPECT_THROW(perspective({{0, 9, 0}, {0, 0, 0}, {0, 1, 0}}, 40, 0.1, 10, 10), Error);
  EXPECT_THROW(orthographic(look, -1, 10, 10), Error);
  EXPECT_THROW(orthographic(look, 1, 0, 10), Error);
  EXPECT_THROW(orthographic(look, 1, 10, 100'000), Error);
  EXPECT_THROW(sun_shadow({1, 0, 0}, ShadowScreen{}, 10, 10), Error);
  EXPECT_THROW(lamp_shadow({1, 0, 0}, ShadowScreen{}, 10, 10), Error);
}

}  // namespace
}  // namespace espalier
