// Limbs: which cones and cylinders belong together.

#include "model/limbs.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "model/shipped.h"
#include "no_files.h"

namespace espalier {
namespace {

using namespace test;

/// 0: cone, 1: cylinder, 2: sphere, 3: box.
MeshTable table() {
  GeneratorGraph graph;
  for (const MeshKind kind : {MeshKind::cone, MeshKind::cylinder, MeshKind::sphere, MeshKind::box})
    graph.meshes.emplace_back().kind = kind;
  return meshes_of(graph);
}

Instance span(const Vec3& from, const Vec3& to, float radius, float tip, std::uint16_t material = 0) {
  Instance out;
  const Vec3 along = to - from, d = glm::normalize(along);
  const Vec3 x = glm::normalize(glm::cross(d, std::abs(d.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0)));
  out.model_from_mesh = {Mat3(2 * radius * x, along, 2 * radius * glm::cross(x, d)), 0.5f * (from + to)};
  out.top = tip / radius, out.material = material;
  return out;
}

TEST(Limbs, OfAnySizeAreFoundAtOnce) {
  Model model;
  // Trumpets of a thousand radii, things as large as a planet's orbit, and a twig in between.
  for (int i = 0; i < 300; ++i) {
    const float x = static_cast<float>(i);
    model.instances.push_back(span({x, 0, 0}, {x, 1, 0}, 0.5f, 500));
    model.instances.push_back(span({x, 0, 1e15f}, {x + 1e15f, 1e15f, 0}, 1e15f, 1e15f));
  }
  model.instances.push_back(span({0.5f, 0, 7}, {0.5f, 1, 7}, 0.01f, 0.01f));
  model.instances.push_back(span({0.5f, 1, 7}, {0.5f, 2, 7}, 0.01f, 0.01f));
  const Limbs limbs = find_limbs(model, table(), true);
  EXPECT_EQ(limbs.limb_of[600], limbs.limb_of[601]);
  EXPECT_NE(limbs.limb_of[600], Limbs::kNone);
}

TEST(Limbs, AreChainsOfWhatTouches) {
  Model model;
  model.instances = {span({0, 0, 0}, {0, 1, 0}, 0.2f, 0.15f), span({0, 1, 0}, {0.2f, 2, 0}, 0.15f, 0.1f),
                     span({0.2f, 2, 0}, {0.2f, 3, 0.3f}, 0.1f, 0.05f)};
  const Limbs limbs = find_limbs(model, table());
  ASSERT_EQ(limbs.limbs.size(), 1u);
  const Limb& limb = limbs.limbs[0];
  EXPECT_EQ(limb.parts, (std::vector<std::uint32_t>{0, 1, 2}));
  ASSERT_EQ(limb.joints.size(), 4u);
  EXPECT_LT(glm::length(limb.joints[1].at - Vec3(0, 1, 0)), 1e-5f);
  EXPECT_NEAR(limb.joints[0].radius, 0.2f, 1e-6);
  EXPECT_NEAR(limb.joints[3].radius, 0.05f, 1e-6);
  EXPECT_EQ(limb.depth, 0);
  EXPECT_EQ(limbs.limb_of, (std::vector<std::uint32_t>{0, 0, 0}));
}

TEST(Limbs, TheMostAlikeGoesOnAndTheOthersLeave) {
  Model model;
  model.instances = {span({0, 0, 0}, {0, 1, 0}, 0.2f, 0.18f), span({0, 1, 0}, {0.9f, 1.5f, 0}, 0.1f, 0.05f),
                     span({0, 1, 0}, {0, 2, 0.1f}, 0.18f, 0.1f), span({0, 0.5f, 0}, {1, 0.5f, 0}, 0.06f, 0.03f)};
  const Limbs limbs = find_limbs(model, table());
  ASSERT_EQ(limbs.limbs.size(), 3u);
  EXPECT_EQ(limbs.limbs[0].parts, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(limbs.limbs[1].parts, (std::vector<std::uint32_t>{1}));
  // The last leaves the trunk at a right angle, from its axis: it comes out after the trunk's radius there.
  EXPECT_NEAR(limbs.limbs[2].host, 0.19f, 1e-5);
  EXPECT_NEAR(limbs.limbs[2].depth, 0.19f, 1e-5);
}

TEST(Limbs, WhatDiffersDoesNotGoOn) {
  const Instance below = span({0, 0, 0}, {0, 1, 0}, 0.2f, 0.2f);
  const Instance others[] = {
      span({0, 1, 0}, {0, 2, 0}, 0.2f, 0.2f, 1),          // another material
      span({0, 1, 0}, {0.1f, 0.2f, 0}, 0.2f, 0.2f),       // turns back
      span({0, 1.3f, 0}, {0, 2, 0}, 0.2f, 0.2f),          // apart
      span({0, 1, 0}, {0, 2, 0}, 0.04f, 0.04f),           // much thinner
      span({0, 1, 0}, {0, 2, 0}, 0.5f, 0.5f),             // much thicker
  };
  for (const Instance& other : others) {
    Model model;
    model.instances = {below, other};
    EXPECT_EQ(find_limbs(model, table()).limbs.size(), 2u);
  }
  Model model;
  model.instances = {below, span({0, 1, 0}, {0, 2, 0}, 0.2f, 0.2f)};
  EXPECT_EQ(find_limbs(model, table()).limbs.size(), 1u) << "else the above says nothing";
  model.instances[1].model_from_mesh.basis[0] *= 2.0f;
  EXPECT_EQ(find_limbs(model, table()).limbs.size(), 1u) << "what is not round is no limb";
  EXPECT_EQ(find_limbs(model, table()).limb_of[1], Limbs::kNone);
}

TEST(Limbs, TakeInTheSpheresOfTheirJoints) {
  Model model;
  model.instances = {span({0, 0, 0}, {0, 1, 0}, 0.2f, 0.15f), span({0, 1, 0}, {0, 2, 0.5f}, 0.15f, 0.1f)};
  const auto sphere = [](const Vec3& at, float radius) {
    Instance out;
    out.mesh = 2;
    out.model_from_mesh = {Mat3(2 * radius), at};
    return out;
  };
  model.instances.push_back(sphere({0, 1, 0}, 0.155f));  // a joint
  model.instances.push_back(sphere({0, 1, 0}, 0.4f));    // a knob
  model.instances.push_back(sphere({0, 2, 1}, 0.1f));    // a fruit
  const Limbs limbs = find_limbs(model, table());
  EXPECT_EQ(limbs.limb_of, (std::vector<std::uint32_t>{0, 0, 0, Limbs::kNone, Limbs::kNone}));
}

TEST(Limbs, OfNothingAreNone) {
  EXPECT_TRUE(find_limbs({}, table()).limbs.empty());
  Model model;
  model.instances.emplace_back().mesh = 3;
  EXPECT_TRUE(find_limbs(model, table()).limbs.empty());
}

/// Thousands in one place end, and soon.
TEST(Limbs, CrowdsEnd) {
  Model model;
  for (int k = 0; k < 20'000; ++k) model.instances.push_back(span({0, 0, 0}, {0, 1, 0}, 0.2f, 0.2f));
  for (int k = 0; k < 20'000; ++k) model.instances.push_back(span({0, 1, 0}, {0, 2, 0}, 0.2f, 0.2f));
  const Limbs limbs = find_limbs(model, table());
  EXPECT_LT(limbs.limbs.size(), 40'000u);
  EXPECT_GE(limbs.limbs.size(), 20'000u);
}

/// Trees of rules with bones have limbs that run along those.
TEST(Limbs, FollowTheBonesOfTheGuidedTree) {
  const auto graph = compile_shipped("guided-tree.esp");
  const Grown tree(*graph, grown(*graph, 100, 3), ExpandTo::full);
  const MeshTable meshes = meshes_of(*graph);
  const Limbs limbs = find_limbs(tree.model, meshes);
  std::size_t joined = 0, stray = 0;
  for (const Limb& limb : limbs.limbs) {
    for (std::size_t k = 1; k < limb.parts.size(); ++k) {
      const std::uint32_t above = tree.model.instances[limb.parts[k]].gene;
      const std::uint32_t below = tree.model.instances[limb.parts[k - 1]].gene;
      int gene = static_cast<int>(above);
      do gene = tree.parent[static_cast<std::size_t>(gene)];  // over the fork between them
      while (gene >= 0 && tree.rule(static_cast<std::size_t>(gene)) != "Branch");
      (gene == static_cast<int>(below) ? joined : stray)++;
    }
  }
  EXPECT_GT(joined, 20u);
  EXPECT_EQ(stray, 0u);
}

}  // namespace
}  // namespace espalier
