// The tree of boxes against a loop over all triangles.

#include "render/tracer.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "base/random.h"
#include "model/primitives.h"

namespace espalier {
namespace {

float number(RandomStream& random, double low, double high) {
  return static_cast<float>(low + (high - low) * random.next_unit());
}
Vec3 vector(RandomStream& random, double size) {
  const float x = number(random, -size, size), y = number(random, -size, size), z = number(random, -size, size);
  return {x, y, z};
}

Ray towards_the_middle(RandomStream& random) {
  const Vec3 origin = vector(random, 3);
  return {origin, vector(random, 1) - origin, 0};
}

Mesh soup(RandomStream& random, int triangles, double size) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(triangles); ++i) {
    const Vec3 middle = vector(random, 1);
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back(middle + vector(random, size));
      mesh.normals.emplace_back(0, 1, 0);
    }
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

/// Distance along the ray in double precision; infinite for a miss. `edge` tells how near the hit is to an edge.
double reference(const Mesh& mesh, const Ray& ray, double& edge) {
  const glm::dvec3 o(ray.origin), d(ray.direction);
  double best = INFINITY;
  edge = 1;
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t[0]]), e1 = glm::dvec3(mesh.positions[t[1]]) - a,
                     e2 = glm::dvec3(mesh.positions[t[2]]) - a;
    const glm::dmat3 m(e1, e2, -d);
    const glm::dvec3 uvt = glm::inverse(m) * (o - a);
    const double inside = std::min({uvt.x, uvt.y, 1 - uvt.x - uvt.y});
    if (uvt.z > 0) edge = std::min(edge, std::abs(inside));
    if (inside >= 0 && uvt.z > 0) best = std::min(best, uvt.z);
  }
  return best;
}

TEST(TriangleSet, FindsTheNearestTriangle) {
  RandomStream random({1, Purpose::test});
  int hits = 0, misses = 0;
  for (const int triangles : {1, 3, 4, 5, 17, 300}) {
    const Mesh mesh = soup(random, triangles, triangles < 10 ? 1.0 : 0.2);
    const TriangleSet set(mesh);
    for (int i = 0; i < 300; ++i) {
      Ray ray = towards_the_middle(random);
      if (i % 10 == 0) ray.direction = {0, 0, i % 20 == 0 ? 1.0f : -1.0f};  // along an axis
      double edge;
      const double expected = reference(mesh, ray, edge);
      if (edge < 1e-3) continue;  // rounding decides
      TriangleSet::Hit hit;
      hit.t = 1e30f;
      const bool found = set.intersect(ray, hit);
      ASSERT_EQ(found, std::isfinite(expected));
      ASSERT_EQ(set.blocks(ray, 1e30f), found);
      if (!found) {
        ++misses;
        continue;
      }
      ++hits;
      EXPECT_NEAR(hit.t, expected, 1e-3 * expected);
      EXPECT_FALSE(set.blocks(ray, 0.99f * hit.t));
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 100);
}

TEST(TriangleSet, LetsNoRayThroughAClosedShape) {
  const Mesh sphere = make_primitive(MeshKind::sphere, 1, 32);
  const TriangleSet set(sphere);
  RandomStream random({2, Purpose::test});
  for (int i = 0; i < 20000; ++i) {
    // Through vertices and edges too, where neighbours meet.
    const Triangle& t = sphere.triangles[random.below(static_cast<std::uint32_t>(sphere.triangles.size()))];
    const float u = i % 3 == 0 ? 0.0f : number(random, 0, 1), v = i % 2 == 0 ? 0.0f : number(random, 0, 1 - u);
    const Vec3 aim = (1 - u - v) * sphere.positions[t[0]] + u * sphere.positions[t[1]] + v * sphere.positions[t[2]];
    const Vec3 from = vector(random, 0.2);
    ASSERT_TRUE(set.blocks({from, aim - from, 0}, 1e30f)) << i;
  }
}

TEST(Tracer, AgreesWithTheMeshInPlace) {
  RandomStream random({3, Purpose::test});
  const Mesh shape = soup(random, 40, 0.3);
  const TriangleSet set(shape);
  std::vector<Placed> parts(30);
  std::vector<Mesh> in_place(parts.size(), shape);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Mat3 basis(vector(random, 0.3), vector(random, 0.3), vector(random, 0.3));
    parts[i].shape = &set;
    parts[i].world_from_shape = {basis, vector(random, 1)};
    const Mat3 inverse = glm::inverse(basis);
    parts[i].shape_from_world = {inverse, -(inverse * parts[i].world_from_shape.origin)};
    for (Vec3& p : in_place[i].positions) p = parts[i].world_from_shape.point(p);
  }
  const Tracer tracer(parts);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Ray ray = towards_the_middle(random);
    double nearest = INFINITY, closest_edge = 1;
    for (const Mesh& mesh : in_place) {
      double edge;
      nearest = std::min(nearest, reference(mesh, ray, edge));
      closest_edge = std::min(closest_edge, edge);
    }
    if (closest_edge < 1e-4) continue;
    const Tracer::Hit hit = tracer.intersect(ray);
    ASSERT_EQ(static_cast<bool>(hit), std::isfinite(nearest));
    ASSERT_EQ(tracer.blocks(ray, 1e30f), static_cast<bool>(hit));
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit.t, nearest, 1e-3 * nearest + 2 * Tracer::kTie);
  }
  EXPECT_GT(hits, 30);
}

TEST(Tracer, TiesGoToTheLowerIndex) {
  const Mesh quad = make_primitive(MeshKind::quad, 1, 3);
  const TriangleSet set(quad);
  std::vector<Placed> parts(9);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].shape = &set;
    parts[i].world_from_shape.origin.z = i % 2 ? 5e-6f : 0;  // nearer by less than what coincides
    parts[i].shape_from_world.origin.z = -parts[i].world_from_shape.origin.z;
  }
  const Tracer tracer(parts);
  EXPECT_EQ(tracer.intersect({{0.1f, 0.1f, 2}, {0, 0, -1}, 0}).part, 0u);
}

TEST(Tracer, NormalsFaceTheRay) {
  const Mesh quad = make_primitive(MeshKind::quad, 1, 3);
  const TriangleSet set(quad);
  std::vector<Placed> parts(1);
  parts[0].shape = &set;
  parts[0].normals_from_shape = Mat3(1);
  const Tracer tracer(parts);
  for (const float side : {1.0f, -1.0f}) {
    const Ray ray{{0.1f, 0.1f, 2 * side}, {0, 0, -side}, 0};
    Vec3 flat, smooth;
    tracer.normals(tracer.intersect(ray), ray.direction, flat, smooth);
    EXPECT_EQ(flat, Vec3(0, 0, side));
    EXPECT_EQ(smooth, Vec3(0, 0, side));
  }
}

TEST(Tracer, EmptyOnesMeetNothing) {
  const Tracer tracer;
  EXPECT_FALSE(tracer.intersect({}));
  EXPECT_FALSE(tracer.blocks({}, 1));
}

}  // namespace
}  // namespace espalier
