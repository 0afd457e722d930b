// Tubes: closed, smooth, with pictures to scale; collars and fewer joints.

#include "model/tube.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/math.h"

namespace espalier {
namespace {

std::vector<LimbJoint> straight(std::size_t joints, float step, float base, float tip) {
  std::vector<LimbJoint> out;
  for (std::size_t k = 0; k < joints; ++k) {
    const float share = static_cast<float>(k) / static_cast<float>(joints - 1);
    out.push_back({{0, step * static_cast<float>(k), 0}, base + share * (tip - base)});
  }
  return out;
}

/// A screw: it bends and turns all the way.
std::vector<LimbJoint> screw(std::size_t joints, float radius) {
  std::vector<LimbJoint> out;
  for (std::size_t k = 0; k < joints; ++k) {
    const float a = 0.4f * static_cast<float>(k);
    out.push_back({{cosine(a), 0.25f * a, sine(a)}, radius});
  }
  return out;
}

Mesh tube(const std::vector<LimbJoint>& joints, const TubeLook& look) {
  Mesh mesh;
  add_tube(mesh, joints, look);
  return mesh;
}

void expect_sound(const Mesh& mesh) {
  EXPECT_EQ(open_edges(mesh), 0u);
  EXPECT_GT(volume(mesh), 0);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
  for (const Vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], face = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    for (const std::uint32_t corner : t)
      EXPECT_GT(glm::dot(face, mesh.normals[corner]), 0) << "outwards, as the triangle is";
  }
}

TEST(Tube, IsClosedAndFacesOutwards) {
  for (const std::uint32_t sides : {3u, 4u, 8u, 13u}) {
    SCOPED_TRACE(sides);
    expect_sound(tube(straight(2, 1, 0.3f, 0.2f), {sides, 0.5f}));
    expect_sound(tube(straight(6, 0.2f, 0.1f, 0.1f), {sides, 0.5f}));
    expect_sound(tube(screw(30, 0.08f), {sides, 0}));
    expect_sound(tube(straight(4, 0.3f, 0.1f, 0), {sides, 0.5f}));  // a point
    expect_sound(tube(straight(4, 0.3f, 0, 0.1f), {sides, 0.5f}));
  }
}

TEST(Tube, HasTheTrianglesThatItSays) {
  for (const std::uint32_t sides : {3u, 7u}) {
    for (const std::size_t joints : {2u, 5u})
      EXPECT_EQ(tube(straight(joints, 1, 0.2f, 0.1f), {sides, 1}).triangles.size(), tube_triangles(joints, sides));
  }
}

/// Many sides make the volume of a cone's frustum.
TEST(Tube, HasTheVolumeOfItsFrustum) {
  const double a = 0.3, b = 0.1, h = 2;
  const Mesh mesh = tube(straight(9, 0.25f, 0.3f, 0.1f), {512, 1});
  EXPECT_NEAR(volume(mesh), kPi * h / 3 * (a * a + a * b + b * b), 2e-4);
}

/// The exact normals of a cone: the same share of it leans along the axis everywhere.
TEST(Tube, NormalsAreThoseOfTheCone) {
  const Mesh mesh = tube(straight(5, 0.5f, 0.5f, 0.1f), {16, 10});
  const float lean = 0.2f / std::sqrt(1 + 0.2f * 0.2f);  // 0.4 m thinner over 2 m
  std::size_t sides = 0;
  for (const Vec3& n : mesh.normals) {
    if (std::abs(n.y) > 0.999f) continue;  // the ends
    EXPECT_NEAR(n.y, lean, 1e-5);
    ++sides;
  }
  EXPECT_EQ(sides, 5u * 17);
}

/// Along the tube a picture covers just so many metres; around it stands a whole number that comes nearest.
TEST(Tube, BarkHasOneScale) {
  for (const float metres : {0.1f, 0.25f, 0.7f}) {
    for (const float radius : {0.02f, 0.1f, 0.35f}) {
      const std::vector<LimbJoint> joints = screw(25, radius);
      const Mesh mesh = tube(joints, {12, metres});
      double length = 0;
      for (std::size_t k = 0; k < joints.size(); ++k) {
        if (k > 0) length += static_cast<double>(glm::length(joints[k].at - joints[k - 1].at));
        EXPECT_NEAR(mesh.uvs[13 * k].y * metres, length, 1e-4 * (1 + length));
        const double around = mesh.uvs[13 * k].x - mesh.uvs[13 * k + 12].x;
        EXPECT_EQ(around, std::round(around));
        EXPECT_NEAR(around, std::max(1.0, 2 * kPi * radius / metres), 0.5001);
      }
    }
  }
}

/// A tube that tapers has fewer pictures around where it is thin, and the number is never far from what would fit.
TEST(Tube, BarkKeepsItsScaleOnATaperingTube) {
  const std::vector<LimbJoint> joints = straight(40, 0.1f, 0.5f, 0.02f);
  const Mesh mesh = tube(joints, {8, 0.4f});
  EXPECT_EQ(open_edges(mesh), 0u);
  float least = 99, most = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    if (std::abs(mesh.normals[t[0]].y) > 0.99f) continue;  // the ends
    const float low = std::min({mesh.uvs[t[0]].x, mesh.uvs[t[1]].x, mesh.uvs[t[2]].x});
    const float pictures = 8 * (std::max({mesh.uvs[t[0]].x, mesh.uvs[t[1]].x, mesh.uvs[t[2]].x}) - low);
    const Vec3 middle = (a + b + c) / 3.0f;
    const double wanted = 2 * kPi * (0.5 - 0.48 * static_cast<double>(middle.y) / 3.9) / 0.4;
    EXPECT_NEAR(static_cast<double>(pictures), std::max(wanted, 1.0), 0.85);
    least = std::min(least, pictures), most = std::max(most, pictures);
  }
  EXPECT_FLOAT_EQ(least, 1);
  EXPECT_FLOAT_EQ(most, 8);
}

/// Without a scale one picture goes round, and is as tall as it is wide.
TEST(Tube, PicturesKeepTheirProportions) {
  const Mesh mesh = tube(straight(2, 3, 0.2f, 0.2f), {8, 0});
  EXPECT_FLOAT_EQ(mesh.uvs[0].x - mesh.uvs[8].x, 1);
  EXPECT_NEAR(mesh.uvs[9].y, 3 / (2 * kPi * 0.2), 1e-5);
}

/// A ring has the least turn against the one before: on a flat bend none about the axis.
TEST(Tube, DoesNotTwist) {
  std::vector<LimbJoint> bend;
  for (int k = 0; k < 12; ++k) {
    const float a = 0.2f * static_cast<float>(k);
    bend.push_back({{sine(a), cosine(a), 0}, 0.1f});
  }
  const Mesh mesh = tube(bend, {4, 1});
  for (std::size_t k = 0; k < bend.size(); ++k) {
    const Vec3 out = mesh.positions[5 * k] - bend[k].at;  // across the bend it stays, or turns with it
    const Vec3 first = mesh.positions[0] - bend[0].at;
    EXPECT_NEAR(std::abs(out.z), std::abs(first.z), 1e-5);
  }
}

TEST(Tube, PassesOverWhatIsNoTube) {
  EXPECT_TRUE(tube({}, {}).triangles.empty());
  EXPECT_TRUE(tube({{{0, 0, 0}, 1}}, {}).triangles.empty());
  EXPECT_TRUE(tube({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}}, {}).triangles.empty());
  EXPECT_TRUE(tube({{{0, 0, 0}, 0}, {{0, 1, 0}, 0}}, {}).triangles.empty());
  std::vector<LimbJoint> joints = straight(3, 1, 0.2f, 0.1f);
  const std::size_t whole = tube(joints, {}).triangles.size();
  joints.insert(joints.begin() + 1, joints[1]);                        // twice in one place
  joints.insert(joints.begin() + 1, LimbJoint{{0, NAN, 0}, 0.1f});     // nowhere
  joints.insert(joints.begin() + 1, LimbJoint{{0, 0.5f, 0}, INFINITY});
  EXPECT_EQ(tube(joints, {}).triangles.size(), whole);
  expect_sound(tube(joints, {}));
}

/// What turns right back makes no nonsense.
TEST(Tube, TurnsBack) {
  const Mesh mesh = tube({{{0, 0, 0}, 0.1f}, {{0, 1, 0}, 0.1f}, {{0, 0.2f, 0}, 0.1f}}, {});
  EXPECT_EQ(open_edges(mesh), 0u);
  for (const Vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
}

TEST(Collar, WidensAtTheHostsSurface) {
  Limb limb;
  limb.joints = {{{0, 0, 0}, 0.05f}, {{1, 0, 0}, 0.04f}};
  EXPECT_EQ(with_collar(limb).size(), 2u) << "it leaves nothing";
  limb.host = 0.2f, limb.depth = 0.2f;
  const std::vector<LimbJoint> joints = with_collar(limb);
  ASSERT_EQ(joints.size(), 5u);
  float widest = 0, where = 0;
  for (const LimbJoint& joint : joints) {
    EXPECT_FLOAT_EQ(joint.at.y, 0);
    if (joint.radius > widest) widest = joint.radius, where = joint.at.x;
  }
  EXPECT_GT(widest, 0.05f * 1.2f);
  EXPECT_LT(widest, 0.2f);
  EXPECT_NEAR(where, 0.2f, 0.05f);
  Mesh mesh;
  add_tube(mesh, joints, {});
  expect_sound(mesh);
  limb.host = 0.055f, limb.depth = 0.055f;
  EXPECT_EQ(with_collar(limb).size(), 2u) << "a fork";
  limb.host = 0.95f, limb.depth = 0.95f;
  EXPECT_EQ(with_collar(limb).size(), 2u) << "too short";
}

TEST(StraightJoints, AreLeftOut) {
  EXPECT_EQ(without_straight_joints(straight(9, 1, 0.5f, 0.1f), 0.01f).size(), 2u);
  const std::vector<LimbJoint> bent = screw(20, 0.05f);
  EXPECT_EQ(without_straight_joints(bent, 0.01f).size(), 20u);
  const std::vector<LimbJoint> fewer = without_straight_joints(bent, 2);
  EXPECT_LT(fewer.size(), 20u);
  EXPECT_EQ(fewer.front().at, bent.front().at);
  EXPECT_EQ(fewer.back().at, bent.back().at);
  std::vector<LimbJoint> knot = straight(3, 1, 0.1f, 0.1f);
  knot[1].radius = 0.3f;
  EXPECT_EQ(without_straight_joints(knot, 0.2f).size(), 3u) << "straight, but thicker";
}

RC_GTEST_PROP(TubeProperties, AnyJointsMakeClosedFiniteTubes, ()) {
  const auto count = *rc::gen::inRange(2, 12);
  std::vector<LimbJoint> joints;
  for (int k = 0; k < count; ++k) {
    const auto part = [] { return static_cast<float>(*rc::gen::inRange(-100, 101)) / 50; };
    joints.push_back({{part(), part(), part()}, static_cast<float>(*rc::gen::inRange(0, 20)) / 40});
  }
  Mesh mesh;
  add_tube(mesh, joints, {static_cast<std::uint32_t>(*rc::gen::inRange(3, 9)), 0.3f});
  RC_ASSERT(open_edges(mesh) == 0u);
  for (const Vec3& p : mesh.positions) RC_ASSERT(std::isfinite(p.x + p.y + p.z));
  for (const Vec3& n : mesh.normals) RC_ASSERT(std::abs(glm::length(n) - 1) < 1e-4f);
}

}  // namespace
}  // namespace espalier
