// What the shipped trees and plants promise, held against the published numbers.

#include <set>

#include "model/shipped.h"

namespace espalier {
namespace {

using namespace test;

struct Ranges {
  float attach;                               // where children leave, in lengths of the parent from its middle
  float sector_deg, lean_low_deg, lean_high_deg;  // of the numbered branches
};

/// A branch against its parent by the published rules: place, sector, lean, and how much smaller it is.
void check_branch(const Grown& tree, std::size_t gene, const Ranges& ranges) {
  const auto above = static_cast<std::size_t>(tree.parent[gene]);
  const Instance& parent = *tree.parts(above)[0];
  const Instance& part = *tree.parts(gene)[0];
  const Bone& bone = *tree.bones(gene)[0];
  const Vec3 parent_size = size_of(parent), size = size_of(part), base = in_part(parent, bone.from);
  EXPECT_LT(glm::length(base - Vec3(0, ranges.attach, 0)), 1e-4f);
  EXPECT_NEAR(length_of(bone), size.y, 1e-4f);
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(size[k] / parent_size[k], 0.6f - 1e-4f);
    EXPECT_LE(size[k] / parent_size[k], (k == 1 ? 0.801f : 0.7f) + 1e-4f);
  }
  const Vec3 local = in_part(parent, parent.model_from_mesh.origin + direction_of(bone)) * parent_size;
  const float lean = angle_between(local, Vec3(0, 1, 0)) / kDegree;
  if (tree.rule(gene) == "Leader") {
    EXPECT_LE(lean, 2.1f);
    return;
  }
  EXPECT_GE(lean, ranges.lean_low_deg - 0.1f);
  EXPECT_LE(lean, ranges.lean_high_deg + 0.1f);
  // The published turn is left-handed: it takes +x to +z.
  float sector = std::atan2(local.z, local.x) / kDegree;
  if (sector < 0) sector += 360;
  EXPECT_GE(sector, ranges.sector_deg * static_cast<float>(tree.slot[gene]) - 0.1f);
  EXPECT_LE(sector, ranges.sector_deg * static_cast<float>(tree.slot[gene] + 1) + 0.1f);
}

/// Exactly the branches without children carry a leaf of unit size, 3/4 of their length beyond their middle.
void check_leaf(const Grown& tree, std::size_t gene) {
  const bool childless = std::count(tree.parent.begin(), tree.parent.end(), static_cast<int>(gene)) == 0;
  const auto leaves = tree.parts(gene, Layer::proxy);
  ASSERT_EQ(leaves.size(), childless && gene > 0 ? 1u : 0u) << "gene " << gene;
  if (leaves.empty()) return;
  EXPECT_LT(glm::length(size_of(*leaves[0]) - Vec3(1)), 1e-4f);
  EXPECT_LT(glm::length(in_part(*tree.parts(gene)[0], leaves[0]->model_from_mesh.origin) - Vec3(0, 0.75f, 0)), 1e-3f);
}

void check_tree(const char* name, const Ranges& ranges) {
  const auto graph = compile_shipped(name);
  ASSERT_TRUE(graph);
  std::set<int> slots;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Grown tree(*graph, grown(*graph, 60, i));
    EXPECT_GE(tree.derivation.size(), 60u);
    const Vec3 trunk = size_of(*tree.parts(0)[0]);
    EXPECT_NEAR(trunk.x, 0.8f, 1e-5f);
    EXPECT_TRUE(trunk.y >= 1.4f && trunk.y <= 1.8f) << trunk.y;
    for (std::size_t gene = 0; gene < tree.derivation.size(); ++gene) {
      if (gene > 0) check_branch(tree, gene, ranges), slots.insert(tree.slot[gene]);
      check_leaf(tree, gene);
    }
  }
  EXPECT_EQ(slots.size(), graph->rules[graph->start()].slots.size()) << "every kind of branch was seen";
}

TEST(TreeV1, KeepsThePublishedRanges) { check_tree("tree-v1.esp", {0.5f, 180, 35, 55}); }
TEST(TreeV2, KeepsThePublishedRanges) { check_tree("tree-v2.esp", {0.38f, 120, 35, 85}); }
TEST(TreeTwoBranch, KeepsThePublishedRanges) { check_tree("tree-two-branch.esp", {0.5f, 180, 35, 85}); }

TEST(TreeV1, StandsWithinTwoAndAHalfOfTheMiddle) {
  const auto graph = compile_shipped("tree-v1.esp");
  float furthest = 0;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const Vec3 at = Grown(*graph, grown(*graph, 1, i)).parts(0)[0]->model_from_mesh.origin;
    EXPECT_TRUE(std::abs(at.x) <= 2.5f && std::abs(at.z) <= 2.5f && at.y == 0);
    furthest = std::max({furthest, std::abs(at.x), std::abs(at.z)});
  }
  EXPECT_GT(furthest, 2);
}

TEST(GuidedTree, BendsAndShrinksAsInThePaper) {
  const auto graph = compile_shipped("guided-tree.esp");
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Grown tree(*graph, grown(*graph, 150, i));
    std::size_t seen = 0;
    for (const Bone& bone : tree.model.bones) {
      if (bone.parent < 0) continue;
      const Bone& below = tree.model.bones[static_cast<std::size_t>(bone.parent)];
      const float ratio = length_of(bone) / length_of(below);
      EXPECT_TRUE(ratio >= 0.63f - 1e-4f && ratio <= 0.91f + 1e-4f) << ratio;
      EXPECT_LE(angle_between(bone.to - bone.from, below.to - below.from) / kDegree, 80.1f);
      EXPECT_LT(glm::length(bone.from - below.to), 1e-4f);
      ++seen;
    }
    EXPECT_GT(seen, 20u);
  }
}

/// All leaves of the paper's tree look at one point.
TEST(GuidedTree, LeavesLookAtTheirPoint) {
  const auto graph = compile_shipped("guided-tree.esp");
  const Grown tree(*graph, grown(*graph, 60, 1), ExpandTo::full);
  std::size_t stalks = 0;
  for (const Instance& part : tree.model.instances) {
    if (part.layer != Layer::detail || graph->meshes[part.mesh].kind != MeshKind::cylinder) continue;
    const Vec3 axis = part.model_from_mesh.basis[1], to = Vec3(0, 0, -20) - part.model_from_mesh.origin;
    EXPECT_LT(angle_between(axis, to) / kDegree, 0.1f);
    ++stalks;
  }
  EXPECT_GT(stalks, 5u);
}

/// The letters of a Lindenmayer system after so many steps of rewriting every X and F.
std::string rewritten(int steps) {
  std::string word = "X";
  for (int step = 0; step < steps; ++step) {
    std::string next;
    for (const char c : word) next += c == 'X' ? "F[+X][-X]FX" : c == 'F' ? "FF" : std::string(1, c);
    word = next;
  }
  return word;
}

TEST(Plant, FullOfShootsHasTheStemsOfTheRewrittenWord) {
  const auto graph = compile_shipped("plant.esp");
  const Grown plant(*graph, grown(*graph, 1'000'000, 1));
  EXPECT_EQ(plant.derivation.size(), 1 + (729u - 1) / 2) << "1 + 3 + 9 + ... of them, and the start";
  double total = 0;
  std::map<int, int> by_length;
  for (const Instance& part : plant.model.instances) {
    const double units = static_cast<double>(size_of(part).y) / 0.03;
    total += units, ++by_length[static_cast<int>(std::lround(units))];
  }
  const std::string word = rewritten(6);
  EXPECT_NEAR(total, static_cast<double>(std::count(word.begin(), word.end(), 'F')), 0.01);
  EXPECT_EQ(by_length, (std::map<int, int>{{1, 486}, {2, 162}, {4, 54}, {8, 18}, {16, 6}, {32, 2}}));
}

}  // namespace
}  // namespace espalier
